# When svd and cpca apply pose weights, light and coefficients, as matrix products with their sizes.
#   light_order.py DATA SVG      DATA is made by scripts/figures/make
# Sizes are those of the two best candidates for an error of 5 % of the octopus.
import json
import sys

from svg import BLUE, Figure, GREEN, LIGHT_BLUE, LIGHT_GREEN, LIGHT_ORANGE, ORANGE, PALE, SOFT


def matrix(figure, x, middle, width, height, fill, stroke, name, size):
    figure.rect(x, middle - height / 2, width, height, fill, stroke, 2, 1.6)
    figure.text(x + width / 2, middle - height / 2 - 26, name, 13, "middle", stroke, bold=True)
    figure.text(x + width / 2, middle - height / 2 - 9, size, 12, "middle", SOFT, mono=True)
    return x + width


def sign(figure, x, middle, text):
    figure.text(x, middle + 7, text, 20, "middle")


def with_spaces(number):
    return f"{number:,}".replace(",", " ")


def main(data, svg):
    with open(f"{data}/target.json") as file:
        report = json.load(file)
    candidates = report["candidates"]
    cpca = next(c for c in candidates if c["chosen"])
    svd = min((c for c in candidates if c["codec"] == "svd"), key=lambda c: c["transfer_bytes"])
    assert cpca["codec"] == "cpca"
    num_vertices = report["num_vertices"]
    coefficients = report["bands"] ** 2
    k, over_time = svd["components"], cpca["components"]
    j, clusters = cpca["cluster_components"], cpca["clusters"]
    svd_cost = (k + 1) * coefficients + 3 * coefficients
    cpca_cost = 3 * (j + 1)
    bases = clusters * (j + 1)
    cpu = bases * coefficients * (3 + over_time)
    assert svd["multiply_adds"] == svd_cost and cpca["multiply_adds"] == cpca_cost

    figure = Figure(
        900,
        640,
        "When svd and cpca apply pose weights, light and coefficients, as matrix products",
        "light_order.py",
    )
    figure.text(20, 28, "svd: pose weights, then light", 15, bold=True)
    figure.text(320, 28, "in every vertex, every frame", 14, colour=SOFT)
    middle = 150
    x = matrix(
        figure, 40, middle, 90, 130, LIGHT_BLUE, BLUE, "components", f"[{coefficients}][{k + 1}]"
    )
    sign(figure, x + 22, middle, "·")
    x = matrix(figure, x + 45, middle, 14, 60, LIGHT_ORANGE, ORANGE, "weights", f"[{k + 1}]")
    sign(figure, x + 40, middle, "=")
    x = matrix(figure, x + 78, middle, 14, 130, LIGHT_BLUE, BLUE, "transfer t", f"[{coefficients}]")
    figure.text(x + 34, middle + 6, "then", 14, colour=SOFT)
    x = matrix(figure, x + 115, middle, 130, 14, LIGHT_BLUE, BLUE, "tᵀ", f"[1][{coefficients}]")
    sign(figure, x + 22, middle, "·")
    x = matrix(
        figure, x + 45, middle, 26, 130, LIGHT_GREEN, GREEN, "light L", f"[{coefficients}][3]"
    )
    sign(figure, x + 30, middle, "=")
    x = matrix(figure, x + 58, middle, 26, 14, PALE, SOFT, "radiance", "[3]")
    figure.text(
        40,
        250,
        f"({k} + 1) · {coefficients} + 3 · {coefficients} = {svd_cost} multiply-adds a vertex",
        14,
        bold=True,
    )

    figure.line(20, 282, 880, 282, "#d0d0d0")
    figure.text(20, 314, "cpca: pose weights, then light, then the coefficients of each vertex", 15, bold=True)
    figure.text(40, 346, "once a frame, for all clusters", 14, colour=SOFT)
    middle = 450
    x = matrix(
        figure, 40, middle, 130, 120, LIGHT_BLUE, BLUE, "basis rows", f"[{bases}][{coefficients}]"
    )
    sign(figure, x + 22, middle, "·")
    x = matrix(
        figure, x + 45, middle, 26, 110, LIGHT_GREEN, GREEN, "light L", f"[{coefficients}][3]"
    )
    sign(figure, x + 32, middle, "=")
    x = matrix(figure, x + 62, middle, 26, 120, LIGHT_GREEN, GREEN, "lit rows", f"[{bases}][3]")
    figure.text(
        40,
        536,
        f"{clusters} clusters × ({j} + 1) rows = {bases} rows; pose weights make",
        13,
        colour=SOFT,
    )
    figure.text(40, 556, f"each row of {over_time} components, then light meets it:", 13, colour=SOFT)
    figure.text(
        40,
        584,
        f"{bases} · {coefficients} · ({over_time} + 3) = {with_spaces(cpu)} a frame",
        14,
        bold=True,
    )
    figure.line(455, 332, 455, 600, "#d0d0d0")
    figure.text(480, 346, "then in every vertex", 14, colour=SOFT)
    x = matrix(figure, 490, middle, 90, 14, LIGHT_ORANGE, ORANGE, "coefficients", f"[1][{j + 1}]")
    sign(figure, x + 22, middle, "·")
    x = matrix(
        figure,
        x + 62,
        middle,
        26,
        80,
        LIGHT_GREEN,
        GREEN,
        "its cluster's lit rows",
        f"[{j + 1}][3]",
    )
    sign(figure, x + 62, middle, "=")
    matrix(figure, x + 120, middle, 26, 14, PALE, SOFT, "radiance", "[3]")
    figure.text(480, 584, f"3 · ({j} + 1) = {cpca_cost} multiply-adds a vertex", 14, bold=True)
    share = cpu / num_vertices
    figure.text(
        20,
        626,
        f"octopus, {with_spaces(num_vertices)} vertices, error 5 %: the rows cost as much as "
        f"{share:.0f} more a vertex, and do not grow with the mesh",
        13,
        colour=SOFT,
    )
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
