# How processor time and memory of encoding to a target grow with vertices, poses and coefficients.
#   encode_cost.py measure BIN FOLDER CSV   bakes octopuses in FOLDER (2 GB) and encodes them
#   encode_cost.py draw CSV SVG
# Standard library only. BIN: the folder of the tools.
import csv
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

from svg import BLUE, Figure, ORANGE, SOFT

# Each line changes one size of these.
USUAL = {"vertices": 5000, "poses": 24, "bands": 5}
SERIES = {
    "vertices": (10_000, 30_000, 100_000, 300_000, 1_000_000),
    "poses": (10, 30, 100, 300, 1000),
    "bands": (2, 3, 4, 5, 6, 7),
}
# Of these series, so that no bake takes more than some minutes.
OTHERS = {"vertices": {"poses": 10}, "poses": {"vertices": 2000}, "bands": {}}
RAYS, ERROR, MEMORY = 64, "10%", "8G"
FIELDS = ["series", "vertices", "poses", "coefficients", "cpu_s", "memory_mb", "bytes"]


def run(command):
    """Processor time in seconds and peak memory in MB."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)}: status {status}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000


def measure(tools, folder, table):
    folder = Path(folder)
    with open(table, "w", newline="") as file:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        for series, values in SERIES.items():
            for value in values:
                size = USUAL | OTHERS[series] | {series: value}
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir(parents=True)
                poses, bake, paim = (str(folder / name) for name in ("poses", "x.bake", "x.paim"))
                count = ["--vertices", str(size["vertices"]), "--poses", str(size["poses"])]
                run([f"{tools}/paim-poses", "octopus", "-o", poses, *count])
                rays = ["--rays", str(RAYS), "--bands", str(size["bands"])]
                run([f"{tools}/paim-compress", "bake", poses, "-o", bake, *rays])
                target = ["--max-error", ERROR, "--memory", MEMORY]
                cpu_s, memory_mb = run(
                    [f"{tools}/paim-compress", "encode", bake, "-o", paim, *target]
                )
                writer.writerow(
                    {
                        "series": series,
                        "vertices": size["vertices"],
                        "poses": size["poses"],
                        "coefficients": size["bands"] ** 2,
                        "cpu_s": f"{cpu_s:.2f}",
                        "memory_mb": f"{memory_mb:.0f}",
                        "bytes": Path(paim).stat().st_size,
                    }
                )
                file.flush()
    shutil.rmtree(folder)


def ticks(low, high):
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [m * 10**p for p in powers for m in (1, 3) if low <= m * 10**p <= high]


def short(value):
    for unit, size in (("M", 1e6), ("k", 1e3)):
        if value >= size:
            return f"{value / size:g}{unit}"
    return f"{value:g}"


def draw(table, svg):
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    figure = Figure(
        1080, 400, "Processor time and memory of encoding against each size", "encode_cost.py"
    )
    names = {"vertices": "vertices", "poses": "poses", "bands": "coefficients"}
    for n, (series, name) in enumerate(names.items()):
        left, top, width, height = 70 + 345 * n, 50, 270, 270
        own = [row for row in rows if row["series"] == series]
        xs = [float(row[name]) for row in own]
        low_x, high_x, low_y, high_y = min(xs) / 1.2, max(xs) * 1.2, 0.1, 3000.0

        def x(value):
            return left + width * math.log(value / low_x) / math.log(high_x / low_x)

        def y(value):
            return top + height * (1 - math.log(value / low_y) / math.log(high_y / low_y))

        for value in (0.1, 1, 10, 100, 1000):
            figure.line(left, y(value), left + width, y(value), "#d8d8d8", 0.8)
            figure.text(left - 8, y(value) + 5, f"{value:g}", 13, "end", SOFT)
        for value in ticks(low_x, high_x) if series != "bands" else xs:
            figure.text(x(value), top + height + 20, short(value), 12, "middle", SOFT)
        figure.line(left, top, left, top + height, SOFT)
        figure.line(left, top + height, left + width, top + height, SOFT)
        figure.text(left + width / 2, top + height + 44, name, 14, "middle")
        for column, colour in (("cpu_s", BLUE), ("memory_mb", ORANGE)):
            points = [(x(v), y(float(row[column]))) for v, row in zip(xs, own)]
            figure.path(points, colour, 2)
            for point in points:
                figure.circle(*point, 4, colour, colour)
        start = float(own[0]["cpu_s"])
        end = min(max(xs), xs[0] * high_y / start)
        alike = [(x(value), y(start * value / xs[0])) for value in (xs[0], end)]
        figure.path(alike, SOFT, 1.2, dash="5 5")
    figure.line(80, 22, 108, 22, BLUE, 2)
    figure.text(116, 27, "processor time, s", 14)
    figure.line(290, 22, 318, 22, ORANGE, 2)
    figure.text(326, 27, "peak memory, MB", 14)
    figure.line(500, 22, 528, 22, SOFT, 1.2, "5 5")
    figure.text(536, 27, "time if it grew as the size", 14)
    figure.save(svg)


if __name__ == "__main__":
    {"measure": measure, "draw": draw}[sys.argv[1]](*sys.argv[2:])
