# From OBJ files to a picture: tools, files, and the shapes of what they hold.
#   pipeline.py DATA SVG      DATA is made by scripts/figures/make
# Sizes are those of the octopus that scripts/figures/make bakes and encodes.
import json
import sys
from pathlib import Path

from paim_files import Bake, Container
from svg import BLUE, Figure, GREEN, PALE, SOFT

LEFT, BOX, RIGHT = 20, 230, 282
TYPES = {0: "u8", 1: "u32", 2: "f16", 3: "f32", 4: "f64", 5: "i8", 6: "i16"}


def kilobytes(num_bytes):
    return (
        f"{num_bytes / 1000:,.0f} kB".replace(",", " ")
        if num_bytes < 1e6
        else f"{num_bytes / 1e6:.1f} MB"
    )


def section(container, tag, index=0):
    scalar, _, shape, _, _, _ = container.sections[tag, index]
    sizes = [n for n in shape if n != 1] or [1]
    return f"{tag} {TYPES[scalar]} " + "".join(f"[{n}]" for n in sizes)


class Chart:
    def __init__(self, figure):
        self.figure, self.y = figure, 16

    def data(self, name, lines, height):
        """A thing that is stored or held, with its shapes to the right."""
        self.figure.box(LEFT, self.y, BOX, height, name, PALE, SOFT)
        for n, line in enumerate(lines):
            place = self.y + height / 2 + (n - (len(lines) - 1) / 2) * 21 + 5
            self.figure.text(RIGHT, place, line, 13, mono=True)
        self.y += height

    def step(self, name, lines, colour=BLUE):
        """An arrow down, with what happens on the way."""
        height = max(40, 21 * len(lines) + 20)
        middle = LEFT + BOX / 2
        self.figure.arrow(middle, self.y + 2, middle, self.y + height - 2, colour, 2)
        self.figure.text(LEFT + 4, self.y + height / 2 + 5, name, 13, colour=colour, bold=True)
        for n, line in enumerate(lines):
            place = self.y + height / 2 + (n - (len(lines) - 1) / 2) * 21 + 5
            self.figure.text(RIGHT, place, line, 13, colour=colour)
        self.y += height


def main(data, svg):
    bake = Bake(f"{data}/octopus.bake")
    pose, mesh = bake.pose(0), bake.mesh()
    paim_path = Path(f"{data}/target.paim")
    paim = Container(paim_path)
    chosen = next(
        c for c in json.loads(Path(f"{data}/target.json").read_text())["candidates"] if c["chosen"]
    )
    num_vertices, num_poses = bake.num_vertices, bake.num_poses
    num_triangles = mesh.sections["TRIS", 0][2][1]
    objs = sorted(Path(f"{data}/octopus").glob("*.obj"))
    obj_bytes = sum(path.stat().st_size for path in objs)
    bake_bytes = sum(path.stat().st_size for path in bake.path.iterdir())
    planes = bake.manifest["bands"] ** 2
    assert chosen["codec"] == "cpca"
    clusters, per_cluster = chosen["clusters"], chosen["cluster_components"]

    def last(tag):
        return max(index for name, index in paim.sections if name == tag)

    figure = Figure(
        900,
        770,
        "The pipeline from OBJ files to an error, with file names and array shapes",
        "pipeline.py",
    )
    chart = Chart(figure)
    chart.data(
        ["OBJ files", kilobytes(obj_bytes)],
        [
            f"{objs[0].name} … {objs[-1].name}",
            f"V = {num_vertices} vertices, F = {num_triangles} triangles, P = {num_poses} poses",
        ],
        58,
    )
    chart.step("", ["paim-compress bake: trace rays from every vertex in every pose"])
    chart.data(
        ["octopus.bake/", kilobytes(bake_bytes)],
        [
            f"mesh.bin          {section(mesh, 'TRIS')}",
            f"pose_000000.bin … {section(pose, 'POSN')}  positions",
            f"                  {section(pose, 'TRNF')} transfer, C = {planes}",
            f"                  {section(pose, 'NOIS')} its noise",
        ],
        98,
    )
    chart.step("", ["paim-compress encode: one column a pose"])
    chart.data(
        ["data matrices", "read in blocks"],
        [
            f"geometry X [3·V][P] = [{3 * num_vertices}][{num_poses}]",
            f"transfer X [C·V][P] = [{planes * num_vertices}][{num_poses}]",
            f"noise    D [C·V][P] = [{planes * num_vertices}][{num_poses}]",
        ],
        78,
    )
    chart.step("", ["decompose X, take out what is noise (D tells how much)"])
    chart.data(
        ["scaled factors", "in memory"],
        [
            f"mean [C·V], components [K][C·V], weights [K][P]",
            f"K = {chosen['components']} of the transfer above its noise",
        ],
        58,
    )
    chart.step(
        "",
        [
            "search: clusters or not, how many components, which step",
            "then integers, prediction, packing, Zstandard",
        ],
    )
    chart.data(
        [paim_path.name.replace("target", "octopus"), kilobytes(paim_path.stat().st_size)],
        [
            f"geometry {section(paim, 'GMEA')}, GCMP 0 … {last('GCMP')}, GWGT",
            f"bases    {section(paim, 'TMEA')}, TCMP 0 … {last('TCMP')}, TWGT",
            f"         {clusters} clusters × {per_cluster + 1} rows = {clusters * (per_cluster + 1)}",
            f"vertices {section(paim, 'CIDX')}, CCOE 0 … {last('CCOE')}",
        ],
        98,
    )
    chart.step("", ["play: a time, a light L [C][3]"], GREEN)
    chart.data(
        ["a frame"],
        [f"positions f32 [3][{num_vertices}]", f"radiance  f32 [{num_vertices}][3]"],
        54,
    )
    chart.step("", ["rasterise; compare with the bake (paim-analyze)"], GREEN)
    chart.data(["picture, errors"], ["docs/metrics.md"], 40)
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
