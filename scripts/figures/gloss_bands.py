# Errors of pictures of gloss against bands of light and of outgoing radiance.
#   gloss_bands.py CSV SVG     CSV: what paim-gloss-study printed for one sequence
# Standard library only.
import csv
import math
import sys

from svg import BLUE, Figure, GREEN, ORANGE, SOFT

LOW, HIGH = 0.02, 1.0
COLOURS = (GREEN, BLUE, ORANGE)


def draw(table, svg):
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    brdfs = list(dict.fromkeys(row["brdf"] for row in rows))
    most = {side: max(int(row[side]) for row in rows) for side in ("in_bands", "out_bands")}
    figure = Figure(860, 420, "Errors of pictures of gloss against bands", "gloss_bands.py")
    names = {"out_bands": "outgoing bands", "in_bands": "bands of light"}
    for n, (side, fixed) in enumerate((("out_bands", "in_bands"), ("in_bands", "out_bands"))):
        left, top, width, height = 70 + 290 * n, 40, 230, 300
        values = sorted({int(row[side]) for row in rows})

        def x(value):
            return left + width * (value - values[0]) / (values[-1] - values[0])

        def y(value):
            return top + height * (1 - math.log(value / LOW) / math.log(HIGH / LOW))

        for value in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0):
            figure.line(left, y(value), left + width, y(value), "#d8d8d8", 0.8)
            figure.text(left - 8, y(value) + 5, f"{100 * value:g} %", 13, "end", SOFT)
        for value in values:
            figure.text(x(value), top + height + 20, str(value), 13, "middle", SOFT)
        figure.line(left, top, left, top + height, SOFT)
        figure.line(left, top + height, left + width, top + height, SOFT)
        figure.text(left + width / 2, top + height + 44, names[side], 14, "middle")
        figure.text(left + width / 2, top - 14, f"{most[fixed]} {names[fixed]}", 13, "middle")
        for b, brdf in enumerate(brdfs):
            own = [r for r in rows if r["brdf"] == brdf and int(r[fixed]) == most[fixed]]
            points = [(x(int(r[side])), y(float(r["relative_rms"]))) for r in own]
            dash = "" if b < len(COLOURS) else "6 4"
            figure.path(points, COLOURS[b % len(COLOURS)], 2, dash=dash)
            for point in points:
                figure.circle(*point, 3.5, COLOURS[b % len(COLOURS)], COLOURS[b % len(COLOURS)])
    for b, brdf in enumerate(brdfs):
        line = 90 + 30 * b
        dash = "" if b < len(COLOURS) else "6 4"
        figure.line(610, line, 640, line, COLOURS[b % len(COLOURS)], 2, dash)
        figure.text(648, line + 5, brdf, 13)
    figure.save(svg)


if __name__ == "__main__":
    draw(*sys.argv[1:])
