# Section coding 3 as bytes: two planes of six residuals, their symbols and escapes, and the frame.
#   coding3_bytes.py SVG
# The test PlanePacking.PacksTheExampleOfTheDocuments holds the encoder to the same bytes.
import sys
from pathlib import Path

from svg import BLUE, Figure, GREEN, LIGHT_BLUE, LIGHT_GREEN, LIGHT_ORANGE, ORANGE, PALE, SOFT

PLANES = [
    {"magnitude": 1, "per_byte": 5, "residuals": [1, 0, -1, 0, 6, -1]},
    {"magnitude": 2, "per_byte": 3, "residuals": [302, -2, 0, -699, 0, -1]},
]
COLOURS = {
    "header": (PALE, SOFT),
    "symbols": (LIGHT_BLUE, BLUE),
    "gaps": (LIGHT_ORANGE, ORANGE),
    "lows": (LIGHT_GREEN, GREEN),
    "highs": (LIGHT_GREEN, GREEN),
}


def zigzag(value):
    return 2 * value if value >= 0 else -2 * value - 1


def pack(plane):
    a, base = plane["magnitude"], 2 * plane["magnitude"] + 1
    plane["symbols"] = [max(-a, min(a, r)) for r in plane["residuals"]]
    escapes = [
        (n, r - s) for n, (r, s) in enumerate(zip(plane["residuals"], plane["symbols"])) if r != s
    ]
    plane["escapes"] = escapes
    shifted = [s + a for s in plane["symbols"]]
    while len(shifted) % plane["per_byte"]:
        shifted.append(a)
    plane["groups"] = [
        shifted[n : n + plane["per_byte"]] for n in range(0, len(shifted), plane["per_byte"])
    ]
    plane["packed"] = []
    for group in plane["groups"]:
        byte = 0
        for digit in group:
            byte = byte * base + digit
        plane["packed"].append(byte)
    before = [-1] + [n for n, _ in escapes]
    plane["gaps"] = [n - last - 1 for (n, _), last in zip(escapes, before)]
    codes = [zigzag(value) for _, value in escapes]
    plane["wide"] = any(code > 255 for code in codes)
    plane["lows"] = [code & 255 for code in codes]
    plane["highs"] = [code >> 8 for code in codes] if plane["wide"] else []
    count = len(escapes)
    plane["header"] = [4 if plane["wide"] else 0, a, count & 255, count >> 8, 0, 0]


def signed(value):
    return str(value).replace("-", "−")


def draw_plane(figure, y, number, plane):
    left, step = 150, 68
    base = 2 * plane["magnitude"] + 1
    figure.text(16, y + 20, f"plane {number}", 15, bold=True)
    figure.text(
        16, y + 42, f"symbols −{plane['magnitude']} … {plane['magnitude']}", 13, colour=SOFT
    )
    figure.text(16, y + 62, f"base {base}", 13, colour=SOFT)
    for n, (residual, symbol) in enumerate(zip(plane["residuals"], plane["symbols"])):
        x = left + n * step
        escaped = residual != symbol
        figure.rect(
            x, y, step - 8, 28, LIGHT_ORANGE if escaped else PALE, ORANGE if escaped else SOFT
        )
        figure.text(x + (step - 8) / 2, y + 19, signed(residual), 14, "middle", mono=True)
        figure.arrow(x + (step - 8) / 2, y + 29, x + (step - 8) / 2, y + 47, SOFT)
        figure.rect(x, y + 48, step - 8, 28, LIGHT_BLUE, BLUE)
        figure.text(x + (step - 8) / 2, y + 67, signed(symbol), 14, "middle", mono=True)
    x = left + 6 * step + 12
    figure.text(x, y + 19, "residuals", 13, colour=SOFT)
    figure.text(x, y + 67, "symbols", 13, colour=SOFT)
    for n, (group, byte) in enumerate(zip(plane["groups"], plane["packed"])):
        powers = [base**e for e in range(len(group) - 1, -1, -1)]
        terms = " + ".join(
            f"{digit}·{power}" if power > 1 else str(digit) for digit, power in zip(group, powers)
        )
        figure.text(
            left, y + 100 + 22 * n, f"{terms} = {byte} = 0x{byte:02x}", 13, mono=True, colour=BLUE
        )
    top = y + 100
    place = left + 440
    for n, ((index, value), gap) in enumerate(zip(plane["escapes"], plane["gaps"])):
        code = zigzag(value)
        figure.text(
            place,
            top + 22 * n,
            f"skip {gap}, add {signed(value)} = zigzag 0x{code:0{4 if plane['wide'] else 2}x}",
            13,
            colour=ORANGE,
        )


def main(svg):
    for plane in PLANES:
        pack(plane)
    test = Path(__file__).parents[2] / "tests/unit/format/pack/plane_codec_test.cpp"
    for plane in PLANES:
        for part in ("packed", "gaps", "lows", "highs"):
            text = "{" + ", ".join(f"0x{byte:02x}" for byte in plane[part]) + "}"
            assert not plane[part] or text in test.read_text(), f"{test.name} has no {part} {text}"

    figure = Figure(
        900, 470, "Section coding 3: residuals become symbols and escapes, and then bytes", "coding3_bytes.py"
    )
    draw_plane(figure, 14, 0, PLANES[0])
    draw_plane(figure, 164, 1, PLANES[1])

    figure.text(16, 336, "contents of the Zstandard frame", 15, bold=True)
    x, y, width = 16, 352, 31
    labels = []
    for part in ("header", "symbols", "gaps", "lows", "highs"):
        start = x
        for plane in PLANES:
            values = plane["packed"] if part == "symbols" else plane[part]
            for byte in values:
                fill, stroke = COLOURS[part]
                figure.rect(x, y, width, 30, fill, stroke)
                figure.text(x + width / 2, y + 20, f"{byte:02x}", 13, "middle", mono=True)
                x += width
            x += 4 if values else 0
        labels.append((part, start, x - 4))
        x += 8
    names = {
        "header": "6 bytes a plane: prediction, magnitude, escapes",
        "symbols": "symbols",
        "gaps": "gaps",
        "lows": "lows",
        "highs": "highs",
    }
    for part, start, end in labels:
        colour = COLOURS[part][1]
        figure.line(start, y + 38, end, y + 38, colour, 2)
        figure.text((start + end) / 2, y + 56, names[part], 13, "middle", colour)
    figure.text(
        16,
        445,
        "Gaps, lows and highs of both planes follow one another. "
        "Plane 1 is wide: its escapes have high bytes.",
        13,
        colour=SOFT,
    )
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
