# The fewest rays a vertex with which a bake can be encoded to an error, and how many paim-compress chooses.
#   rays_for_error.py BIN FOLDER ERROR VERTICES:POSES ... OBJ_FOLDER:POSES ... > CSV
# Bakes in FOLDER, some hundred MB. A number of vertices stands for an octopus. Standard library only.
# BIN: the folder of the tools.
import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

CODECS = ("svd", "cpca")
FIELDS = ["sequence", "poses", "codec", "pilot_rays", "chosen_rays", "chosen_bytes", "fewest_rays",
          "fewest_bytes"]  # fmt: skip
NEAR = 0.02  # the fewest rays are searched for to this share of themselves


def run(command, may_miss=False):
    """The JSON of a tool; None if it says that the error cannot be met."""
    done = subprocess.run([*command, "--json"], capture_output=True, text=True)
    if may_miss and done.returncode == 5:
        return None
    if done.returncode != 0:
        sys.exit(f"{' '.join(command[:2])}: status {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)


class Sequence:
    def __init__(self, tools, folder, poses, error):
        self.compress, self.folder = f"{tools}/paim-compress", folder
        self.poses, self.error = poses, error

    def encode(self, rays, codec):
        """The report of a file of a bake of this many rays, which is kept for the other codec."""
        bake = str(self.folder / f"{rays}.bake")
        run([self.compress, "bake", *self.poses, "-o", bake, "--rays", str(rays)])
        target = ["-o", str(self.folder / "x.paim"), "--max-error", self.error, "--codec", codec]
        return run([self.compress, "encode", bake, *target], may_miss=True)

    def choose(self, codec):
        target = ["--max-error", self.error, "--codec", codec, "--discard-bake"]
        return run([self.compress, *self.poses, "-o", str(self.folder / "y.paim"), *target])

    def fewest(self, codec, enough):
        """Halves the interval between what does not do, at first two rays, and what does."""
        too_few, best = 2, self.encode(enough, codec)
        while best is None:
            too_few, enough = enough, 2 * enough
            best = self.encode(enough, codec)
        while enough - too_few > max(2, NEAR * enough):
            middle = (too_few + enough) // 4 * 2
            report = self.encode(middle, codec)
            if report is None:
                too_few = middle
            else:
                enough, best = middle, report
        return enough, best


def main(tools, folder, error, *sequences):
    folder = Path(folder)
    writer = csv.DictWriter(sys.stdout, FIELDS)
    writer.writeheader()
    for name, count in (text.rsplit(":", 1) for text in sequences):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        poses = Path(name)
        if name.isdigit():
            poses, size = folder / "octopus", ["--vertices", name, "--poses", count]
            run([f"{tools}/paim-poses", "octopus", "-o", str(poses), *size])
            name = "octopus"
        files = sorted(map(str, poses.glob("*.obj")))[: int(count)]
        sequence = Sequence(tools, folder, files, error)
        for codec in CODECS:
            chosen = sequence.choose(codec)
            rays, report = sequence.fewest(codec, chosen["bake"]["rays"])
            row = [Path(name).name, len(files), codec, chosen["pilot"]["rays"],
                   chosen["bake"]["rays"], chosen["encode"]["size_bytes"], rays,
                   report["size_bytes"]]  # fmt: skip
            writer.writerow(dict(zip(FIELDS, row)))
            sys.stdout.flush()
    shutil.rmtree(folder)


main(*sys.argv[1:])
