# The search for a file of a given error as a flow chart, with the numbers of one run.
#   search_flow.py DATA SVG      DATA is made by scripts/figures/make
import json
import sys

from svg import BLUE, Figure, GREEN, LIGHT_BLUE, LIGHT_GREEN, LIGHT_ORANGE, ORANGE, PALE, SOFT


def diamond(figure, x, y, width, height, texts):
    figure.path(
        [(x, y - height / 2), (x + width / 2, y), (x, y + height / 2), (x - width / 2, y)],
        ORANGE,
        1.4,
        LIGHT_ORANGE,
        close=True,
    )
    for n, text in enumerate(texts):
        figure.text(x, y + 5 + (n - (len(texts) - 1) / 2) * 18, text, 13, "middle")


def main(data, svg):
    with open(f"{data}/target.json") as file:
        report = json.load(file)
    candidates = report["candidates"]
    chosen = next(c for c in candidates if c["chosen"])
    assert chosen["codec"] == "cpca"
    num_svd = sum(c["codec"] == "svd" for c in candidates)
    num_cpca = len(candidates) - num_svd
    percent = lambda x: f"{100 * x:.2f} %"
    figure = Figure(900, 800, "The search for the smallest file of a given error", "search_flow.py")
    x, wide = 250, 430
    left = x - wide / 2
    note = 500

    def box(y, height, texts, fill=LIGHT_BLUE, stroke=BLUE):
        figure.box(left, y, wide, height, texts, fill, stroke)

    def down(y0, y1, text=""):
        figure.arrow(x, y0, x, y1)
        if text:
            figure.text(x + 10, (y0 + y1) / 2 + 5, text, 13, colour=SOFT)

    box(
        14,
        50,
        ["target: error τ of the transfer", "distance of positions: τ / 50 of the diagonal"],
        PALE,
        SOFT,
    )
    figure.text(note, 44, f"--max-error {100 * report['transfer_target']:.0f}%", 14, mono=True)
    down(64, 90)
    box(90, 50, ["components, without their noise", "as floats these have the error τ₀, measured"])
    figure.text(note, 120, f"τ₀ = {percent(report['best_transfer_error'])}", 14)
    down(140, 166)
    diamond(figure, x, 196, 190, 60, ["τ > τ₀?"])
    figure.arrow(x + 95, 196, note - 10, 196, ORANGE)
    figure.text(x + 108, 188, "no", 13, colour=SOFT)
    figure.text(note, 192, "refused, exit code 5, with τ₀", 14, colour=ORANGE)
    figure.text(note, 211, "and what would help: --rays, --bands", 13, colour=SOFT)
    down(226, 256, "yes")
    box(256, 50, ["budget of squared error: (τ² − τ₀²) ‖x‖²", "what coding may add"])
    down(306, 336)
    box(
        336,
        92,
        [
            "candidates, each with the largest step in the budget",
            "svd: up to 6 numbers of components",
            "cpca: 32 to 1024 clusters, up to 3 numbers each",
            "geometry: up to 6 numbers of components",
        ],
    )
    figure.text(note, 366, f"{num_svd} of svd, {num_cpca} of cpca", 14)
    figure.text(note, 388, "sizes: the transfer alone, in fast packing", 13, colour=SOFT)
    down(428, 458)
    box(
        458,
        50,
        [
            "the best: the smallest, or by --prefer speed",
            "within 1 % of its size the fewest multiply-adds",
        ],
    )
    figure.text(
        note, 480, f"{chosen['clusters']} clusters × {chosen['cluster_components']} components,", 14
    )
    figure.text(note, 500, f"{chosen['multiply_adds']} multiply-adds a vertex", 14)
    down(508, 538)
    box(
        538,
        50,
        ["build the model and measure it against the bake", "all of it, after every rounding"],
    )
    down(588, 614)
    diamond(figure, x, 654, 330, 80, ["within the targets,", "and less than 1.5 % below?"])
    # Back to building, with another step.
    figure.path(
        [(x + 165, 654), (note + 40, 654), (note + 40, 563), (left + wide + 4, 563)],
        ORANGE,
        1.5,
        tip=True,
    )
    figure.text(x + 178, 646, "no", 13, colour=SOFT)
    figure.text(note + 52, 590, "another step: finer if above,", 13)
    figure.text(note + 52, 608, "coarser if far below; up to 8 times", 13)
    figure.text(note + 52, 634, "never within: choose again for", 13, colour=SOFT)
    figure.text(note + 52, 652, "0.97, 0.93, 0.88 of τ", 13, colour=SOFT)
    down(694, 722, "yes")
    box(
        722,
        50,
        ["pack and write", "the measured errors are stated in the file"],
        LIGHT_GREEN,
        GREEN,
    )
    figure.text(note, 744, f"measured {percent(report['measured']['transfer_total_error'])},", 14)
    figure.text(note, 764, f"{report['size_bytes']:,} bytes".replace(",", " "), 14)
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
