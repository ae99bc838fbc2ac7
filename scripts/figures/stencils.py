# The two predictions of section coding 3 at one vertex of the octopus, with its values in steps.
#   stencils.py DATA SVG      DATA is made by scripts/figures/make
# Vertices are in the bake's order here; files have them in cache order.
# Based on: paim/format/pack/plane_predictor.*
import math
import sys

from paim_files import Bake, Container
from svg import BLUE, Figure, GREEN, LIGHT_BLUE, LIGHT_GREEN, LIGHT_ORANGE, ORANGE, SOFT


def latest_parents(triangles, num_vertices):
    """[V] up to four latest vertices before each that share a triangle with it, the latest first."""
    parents = [set() for _ in range(num_vertices)]
    for triangle in triangles:
        for n in range(3):
            a, b = triangle[n], triangle[(n + 1) % 3]
            if a != b:
                parents[max(a, b)].add(min(a, b))
    return [sorted(p, reverse=True)[:4] for p in parents]


def parallelograms(parents, v):
    """Up to two (a, b, c), which predict a + b − c."""
    found = []
    for i, a in enumerate(parents[v]):
        for b in parents[v][i + 1 :]:
            if b not in parents[a]:
                continue
            for c in parents[a]:
                if (c > b and b in parents[c]) or (c < b and c in parents[b]):
                    found.append((a, b, c))
                    break
            if len(found) == 2:
                return found
    return found


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


class Patch:
    """A vertex with four parents and two parallelograms, and the triangles round it, seen along its
    normal: the one of the mesh whose corners are farthest apart."""

    def __init__(self, data):
        bake = Bake(f"{data}/octopus.bake")
        count = bake.num_vertices
        flat = bake.mesh()["TRIS"]
        self.triangles = [tuple(flat[n : n + 3]) for n in range(0, len(flat), 3)]
        pose = bake.pose(0)
        plane = pose["POSN"]
        self.position = [[plane[axis * count + v] for axis in range(3)] for v in range(count)]
        normals = pose["NRML"]
        self.normal = [[normals[axis * count + v] for axis in range(3)] for v in range(count)]
        self.parents = latest_parents(self.triangles, count)
        # The mean's height in steps of the file that was made for an error of 5 %.
        step = Container(f"{data}/target.paim")["GSTP"][1]
        mean = Container(f"{data}/all.paim")["GMEA"]
        self.value = [round(mean[count + v] / step) for v in range(count)]
        best = max(range(count), key=self.quality)
        self.v, self.flat = best, self.flatten(best)
        self.two = parallelograms(self.parents, best)

    def corners(self, v):
        return [v, *self.parents[v], *(c for _, _, c in parallelograms(self.parents, v))]

    def flatten(self, v):
        normal = self.normal[v]
        side = unit(cross([0.0, 1.0, 0.0] if abs(normal[1]) < 0.9 else [1.0, 0.0, 0.0], normal))
        up = cross(normal, side)
        around = {u for t in self.triangles if set(t) & set(self.corners(v)) for u in t}
        place = {u: sub(self.position[u], self.position[v]) for u in around}
        return {u: (dot(p, side), -dot(p, up)) for u, p in place.items()}

    def quality(self, v):
        if len(self.parents[v]) < 4 or len(set(parallelograms(self.parents, v))) < 2:
            return 0.0
        corners = sorted(set(self.corners(v)))
        normal = self.normal[v]
        if len(corners) < 7 or min(dot(self.normal[u], normal) for u in corners) < 0.9:
            return 0.0
        points = [self.position[u] for u in corners]
        lengths = [math.dist(a, b) for n, a in enumerate(points) for b in points[:n]]
        return min(lengths) / max(lengths)


def signed(value):
    return str(value).replace("-", "−")


def draw(figure, patch, x0, y0, scale, chosen, colour, fill):
    def place(u):
        return x0 + scale * patch.flat[u][0], y0 + scale * patch.flat[u][1]

    near = set(patch.corners(patch.v))
    for t in patch.triangles:
        if len(set(t) & near) >= 2 and all(u in patch.flat for u in t):
            figure.path([place(u) for u in t], "#b9b9b9", 1.0, close=True)
    if chosen == "mean":
        for u in patch.parents[patch.v]:
            figure.line(*place(u), *place(patch.v), colour, 3)
    else:
        for n, (a, b, c) in enumerate(patch.two):
            figure.path(
                [place(u) for u in (c, a, patch.v, b)],
                colour,
                2.4,
                fill if n == 0 else "none",
                close=True,
                dash="" if n == 0 else "6 4",
            )
            figure.line(*place(a), *place(b), colour, 1.2, "2 3")
    used = set(patch.parents[patch.v]) if chosen == "mean" else {u for p in patch.two for u in p}
    for u in sorted(near):
        x, y = place(u)
        own = u == patch.v
        shade = LIGHT_ORANGE if own else (fill if u in used else "#ffffff")
        figure.circle(x, y, 21, shade, ORANGE if own else (colour if u in used else "#b9b9b9"), 2)
        figure.text(x, y + 5, "?" if own else signed(patch.value[u]), 14, "middle", bold=own)


def main(data, svg):
    patch = Patch(data)
    v, value = patch.v, patch.value
    figure = Figure(
        900, 450, "The mean and the parallelogram prediction at one vertex", "stencils.py"
    )
    near = [patch.flat[u] for u in set(patch.corners(v))]
    left, right = min(x for x, _ in near), max(x for x, _ in near)
    top, bottom = min(y for _, y in near), max(y for _, y in near)
    scale = min(330 / (right - left), 230 / (bottom - top))
    middle = (left + right) / 2 * scale, (top + bottom) / 2 * scale
    figure.text(225, 28, "mean of the four latest neighbours", 15, "middle", bold=True)
    figure.text(675, 28, "mean of two parallelograms", 15, "middle", bold=True)
    draw(figure, patch, 225 - middle[0], 185 - middle[1], scale, "mean", BLUE, LIGHT_BLUE)
    draw(figure, patch, 675 - middle[0], 185 - middle[1], scale, "slopes", GREEN, LIGHT_GREEN)

    parents = [value[u] for u in patch.parents[v]]
    mean = (sum(parents) + 2) >> 2
    terms = " + ".join(signed(p) for p in parents)
    figure.text(
        20,
        374,
        f"⌊({terms} + 2) / 4⌋ = {signed(mean)}".replace("+ −", "− "),
        14,
        mono=True,
        colour=BLUE,
    )
    figure.text(20, 400, f"value {signed(value[v])}: residual {signed(value[v] - mean)}", 14)
    p, q = (value[a] + value[b] - value[c] for a, b, c in patch.two)
    two = (p + q + 1) >> 1
    for n, ((a, b, c), result) in enumerate(zip(patch.two, (p, q))):
        text = f"{signed(value[a])} + {signed(value[b])} − {signed(value[c])} = {signed(result)}"
        figure.text(
            480,
            374 + 24 * n,
            text.replace("+ −", "− ").replace("− −", "+ "),
            14,
            mono=True,
            colour=GREEN,
        )
    figure.text(
        480,
        424,
        f"⌊({signed(p)} + {signed(q)} + 1) / 2⌋ = {signed(two)}".replace("+ −", "− "),
        14,
        mono=True,
        colour=GREEN,
    )
    figure.text(755, 424, f"residual {signed(value[v] - two)}", 14)
    figure.text(20, 432, f"octopus, vertex {v}, height in steps", 12, colour=SOFT)
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
