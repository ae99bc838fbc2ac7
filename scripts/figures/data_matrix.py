# The data matrix of the transfer, and how the codecs svd and cpca slice it.
#   data_matrix.py DATA SVG      DATA is made by scripts/figures/make
# Colours are values of the octopus, each plane relative to twice its own RMS.
import json
import math
import sys

from octopus import Octopus, centred
from paim_files import Container
from svg import Figure, GREEN, SOFT

PER_PLANE = 8  # vertices of each plane that are drawn


def shades(rows):
    rms = math.sqrt(sum(x * x for row in rows for x in row) / sum(len(row) for row in rows))
    return [[x / (2 * rms) if rms else 0.0 for x in row] for row in rows]


def main(data, svg):
    octopus = Octopus(data)
    num_vertices, num_poses, planes = (
        octopus.num_vertices,
        octopus.num_poses,
        octopus.num_coefficients,
    )
    with open(f"{data}/target.json") as file:
        chosen = next(c for c in json.load(file)["candidates"] if c["chosen"])
    num_components = chosen["components"]
    clusters, per_cluster = chosen["clusters"], chosen["cluster_components"]
    paim = Container(f"{data}/all.paim")
    vertices = [num_vertices * (2 * n + 1) // (2 * PER_PLANE) for n in range(PER_PLANE)]
    rows_of = [[i * num_vertices + v for v in vertices] for i in range(planes)]

    figure = Figure(
        900,
        740,
        "The data matrix: svd takes rows of planes and vertices, cpca takes vertices",
        "data_matrix.py",
    )
    # svd
    figure.text(
        20, 28, "svd: a row is one coefficient i of one vertex v, a column is a pose", 15, bold=True
    )
    top, height = 70, 300
    per_plane = height / planes
    matrix, mean, components = [], [], []
    for rows in rows_of:
        values = [centred(octopus.transfer[r]) for r in rows]
        matrix += shades([v for v, _ in values])
        mean += shades([[m] for _, m in values])
    for rows in rows_of:
        # All components of a plane on one scale: with unit RMS each, times its singular value.
        components += shades([[paim["TCMP", k][r] for k in range(num_components)] for r in rows])
    weights = [row[:] for row in octopus.directions[:num_components]]
    figure.heat(90, top, 240, height, matrix)
    figure.text(210, top - 12, f"X, drawn without μ; P = {num_poses}", 13, "middle")
    for i, name in (
        (0, "i = 0"),
        (1, "1"),
        (2, "2"),
        (3, "3"),
        (4, "4"),
        (planes - 1, str(planes - 1)),
    ):
        figure.text(82, top + per_plane * (i + 0.5) + 5, name, 12, "end", SOFT)
    figure.text(82, top + height * 0.55, "planes", 12, "end", SOFT)
    figure.text(90, top + height + 22, f"C·V = {planes}·{num_vertices} rows", 13, colour=SOFT)
    figure.text(352, top + height / 2 + 6, "≈", 22, "middle")
    figure.heat(374, top, 14, height, mean)
    figure.text(381, top - 12, "μ", 14, "middle")
    figure.text(410, top + height / 2 + 6, "+", 20, "middle")
    figure.heat(432, top, 100, height, components)
    figure.text(482, top - 12, f"K = {num_components} components", 13, "middle")
    figure.text(552, top + height / 2 + 6, "·", 22, "middle")
    figure.heat(572, top + height / 2 - 50, 240, 100, shades(weights))
    figure.text(
        692, top + height / 2 - 62, f"weights W [{num_components}][{num_poses}]", 13, "middle"
    )
    figure.lines(
        572,
        top + height / 2 + 84,
        [
            "A pose is the mean plus a weighted sum of K",
            f"columns. Each has {planes * num_vertices} values.",
        ],
        13,
        colour=SOFT,
    )

    # cpca: vertices as points of C·P coordinates
    base = 440
    figure.line(20, base - 20, 880, base - 20, "#d0d0d0")
    figure.text(
        20,
        base + 10,
        "cpca: the same values, a row is one vertex, a column one (i, p)",
        15,
        bold=True,
    )
    top, height, width = base + 54, 200, 340
    shown = [num_vertices * (2 * n + 1) // 200 for n in range(100)]
    picture = []
    scale = []
    for i in range(planes):
        values = [octopus.transfer[i * num_vertices + v] for v in shown]
        flat = [x for row in values for x in row]
        middle = sum(flat) / len(flat)
        rms = math.sqrt(sum((x - middle) ** 2 for x in flat) / len(flat))
        scale.append((middle, rms))
    for v in shown:
        row = []
        for i in range(planes):
            middle, rms = scale[i]
            values = octopus.transfer[i * num_vertices + v]
            row += [(values[p] - middle) / (2 * rms) for p in range(0, num_poses, 4)]
        picture.append(row)
    figure.heat(90, top, width, height, picture)
    figure.text(
        90 + width / 2,
        top - 12,
        f"C·P = {planes}·{num_poses} = {planes * num_poses} columns",
        13,
        "middle",
    )
    figure.text(82, top + 14, "v = 0", 12, "end", SOFT)
    figure.text(82, top + height - 2, str(num_vertices - 1), 12, "end", SOFT)
    average = num_vertices / clusters
    slice_top, slice_height = top + 84, 14
    figure.rect(88, slice_top, width + 4, slice_height, "none", GREEN, 0, 3)
    figure.text(82, slice_top + 12, "cluster g", 12, "end", GREEN, bold=True)
    figure.text(452, slice_top + 13, "≈", 22, "middle", GREEN)
    figure.rect(474, slice_top - 22, 30, 58, "#dff0df", GREEN)
    figure.text(489, slice_top - 30, "z", 14, "middle", GREEN)
    figure.text(524, slice_top + 13, "·", 22, "middle", GREEN)
    figure.rect(544, slice_top - 22, 330, 58, "#dff0df", GREEN)
    figure.line(544, slice_top - 6, 874, slice_top - 6, GREEN)
    figure.text(709, slice_top - 9, "cluster mean", 12, "middle", GREEN)
    figure.text(709, slice_top + 20, f"J = {per_cluster} basis rows", 13, "middle", GREEN)
    figure.text(474, slice_top + 56, "[V_g][1 + J]", 12, colour=SOFT)
    figure.text(874, slice_top + 56, "[1 + J][C·P]", 12, "end", SOFT)
    figure.lines(
        474,
        slice_top + 84,
        [
            f"{clusters} clusters of {average:.0f} vertices on average. A vertex keeps",
            "its cluster and J coefficients. The basis rows of all clusters",
            "are a matrix over poses again, stored as with svd.",
        ],
        13,
        colour=SOFT,
    )
    figure.lines(
        90,
        top + height + 26,
        [f"every {num_vertices // 100}th vertex and every 4th pose is drawn"],
        12,
        colour=SOFT,
    )
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
