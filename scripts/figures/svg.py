# Draws figures as SVG, and refuses those whose texts overlap or are cut.
# Standard library only.
import base64
import struct
import sys
import zlib
from html import escape
from pathlib import Path

INK, SOFT, PALE, PAPER = "#1a1a1a", "#5a5a5a", "#e9edf2", "#ffffff"
BLUE, ORANGE, GREEN, PURPLE = "#1f5fa8", "#b85410", "#2f7d32", "#6a3d9a"
LIGHT_BLUE, LIGHT_ORANGE, LIGHT_GREEN = "#dbe8f6", "#fbe6d4", "#dff0df"

_SANS = "font-family='DejaVu Sans, Verdana, Arial, sans-serif'"
_MONO = "font-family='DejaVu Sans Mono, Menlo, Consolas, monospace'"


def _advance(text, size, mono, bold):
    """Width of a text, from the widths of DejaVu Sans, the widest of the fonts named."""
    if mono:
        return 0.602 * size * len(text)
    width = 0.0
    for c in text:
        if c in "iljI.,:;|'! ":
            width += 0.33
        elif c in "ft()[]/-·":
            width += 0.40
        elif c in "mwMW@%…—→←":
            width += 0.92
        elif c.isupper() or c in "ΣΔ√≈×≤≥+−=<>²":
            width += 0.74
        else:
            width += 0.61
    return width * size * (1.1 if bold else 1.0)


class Figure:
    def __init__(self, width, height, title, source):
        """title: what the figure shows, for readers who cannot see it. source: the script."""
        self.width, self.height = width, height
        self.parts = [
            f"<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' "
            f"viewBox='0 0 {width} {height}' role='img'>",
            f"<title>{escape(title)}</title>",
            f"<!-- Made by scripts/figures/{source} -->",
            "<defs>"
            + "".join(
                f"<marker id='tip{colour[1:]}' viewBox='0 0 10 10' refX='9' refY='5' markerWidth='8' "
                f"markerHeight='8' orient='auto-start-reverse'><path d='M0 1L10 5L0 9z' "
                f"fill='{colour}'/></marker>"
                for colour in (INK, SOFT, BLUE, ORANGE, GREEN, PURPLE)
            )
            + "</defs>",
            f"<rect width='{width}' height='{height}' fill='{PAPER}'/>",
        ]
        self.boxes = []

    def add(self, markup):
        self.parts.append(markup)

    def text(
        self, x, y, text, size=14, anchor="start", colour=INK, bold=False, mono=False, italic=False
    ):
        width = _advance(text, size, mono, bold)
        left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * width
        self.boxes.append((left, y - 0.76 * size, left + width, y + 0.22 * size, text))
        style = (" font-weight='bold'" if bold else "") + (" font-style='italic'" if italic else "")
        self.add(
            f"<text x='{x:g}' y='{y:g}' font-size='{size}' text-anchor='{anchor}' fill='{colour}' "
            f"{_MONO if mono else _SANS}{style} xml:space='preserve'>{escape(text)}</text>"
        )

    def lines(self, x, y, texts, size=14, leading=1.4, **style):
        for n, text in enumerate(texts):
            self.text(x, y + n * leading * size, text, size, **style)

    def rect(self, x, y, width, height, fill="none", stroke=INK, radius=0, thickness=1.2, dash=""):
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        self.add(
            f"<rect x='{x:g}' y='{y:g}' width='{width:g}' height='{height:g}' rx='{radius}' "
            f"fill='{fill}' stroke='{stroke}' stroke-width='{thickness}'{dash}/>"
        )

    def box(
        self, x, y, width, height, texts, fill=LIGHT_BLUE, stroke=BLUE, size=14, bold=True, radius=6
    ):
        """A box with centred lines; the first is bold."""
        self.rect(x, y, width, height, fill, stroke, radius)
        leading = 1.35 * size
        top = y + height / 2 - leading * (len(texts) - 1) / 2 + 0.36 * size
        for n, text in enumerate(texts):
            self.text(x + width / 2, top + n * leading, text, size, "middle", bold=bold and n == 0)

    def line(self, x0, y0, x1, y1, colour=INK, thickness=1.2, dash="", tip=False):
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        tip = f" marker-end='url(#tip{colour[1:]})'" if tip else ""
        self.add(
            f"<line x1='{x0:g}' y1='{y0:g}' x2='{x1:g}' y2='{y1:g}' stroke='{colour}' "
            f"stroke-width='{thickness}'{dash}{tip}/>"
        )

    def arrow(self, x0, y0, x1, y1, colour=INK, thickness=1.5, dash=""):
        self.line(x0, y0, x1, y1, colour, thickness, dash, tip=True)

    def path(self, points, colour=INK, thickness=1.5, fill="none", tip=False, dash="", close=False):
        d = "M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in points) + ("z" if close else "")
        dash = f" stroke-dasharray='{dash}'" if dash else ""
        tip = f" marker-end='url(#tip{colour[1:]})'" if tip else ""
        self.add(
            f"<path d='{d}' fill='{fill}' stroke='{colour}' stroke-width='{thickness}' "
            f"stroke-linejoin='round'{dash}{tip}/>"
        )

    def circle(self, x, y, radius, fill=PAPER, stroke=INK, thickness=1.2):
        self.add(
            f"<circle cx='{x:.2f}' cy='{y:.2f}' r='{radius}' fill='{fill}' stroke='{stroke}' "
            f"stroke-width='{thickness}'/>"
        )

    def heat(self, x, y, width, height, rows):
        """Rows of numbers as a picture: −1 blue, 0 white, 1 orange; beyond that the same colours."""
        ends = ((31, 95, 168), (255, 255, 255), (184, 84, 16))
        raw = b""
        for row in rows:
            raw += b"\0"
            for value in row:
                share = min(1.0, abs(value))
                end = ends[0] if value < 0 else ends[2]
                raw += bytes(round(w + share * (e - w)) for e, w in zip(end, ends[1]))

        def chunk(name, data):
            body = name + data
            return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

        header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
        png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
        png += chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")
        self.add(
            f"<image x='{x:g}' y='{y:g}' width='{width:g}' height='{height:g}' "
            f"preserveAspectRatio='none' style='image-rendering:pixelated' "
            f"href='data:image/png;base64,{base64.b64encode(png).decode()}'/>"
        )
        self.rect(x, y, width, height, "none", SOFT, 0, 1)

    def save(self, path):
        problems = []
        for n, (x0, y0, x1, y1, text) in enumerate(self.boxes):
            if x0 < 2 or y0 < 2 or x1 > self.width - 2 or y1 > self.height - 2:
                problems.append(f"cut: {text!r}")
            for a0, b0, a1, b1, other in self.boxes[:n]:
                if min(x1, a1) - max(x0, a0) > 1 and min(y1, b1) - max(y0, b0) > 1:
                    problems.append(f"overlap: {text!r} and {other!r}")
        Path(path).write_text("\n".join(self.parts + ["</svg>"]) + "\n")
        for problem in problems:
            print(f"{Path(path).name}: {problem}", file=sys.stderr)
        if problems:
            sys.exit(1)
