# One vertex with eight rays, in numbers: both halves, their estimates, mean and noise.
# A vertex on the ground next to a long wall; docs/algorithms/transfer.md explains the figure.
#   eight_rays.py DATA SVG      DATA holds wall.bake, made by scripts/figures/make
# The directions are computed again here. The script stops unless the bake's transfer and noise are
# those of its own rays.
import math
import sys

from paim_files import Bake
from sampler import directions_about_y, half_difference_ratio, stream_key
from svg import BLUE, Figure, INK, LIGHT_BLUE, LIGHT_ORANGE, ORANGE, SOFT

SEED = 5
SLOPE = 2.0  # the wall is this high at distance 1
RAYS = 4  # of a half
Y0, Y1 = math.sqrt(1 / (4 * math.pi)), math.sqrt(3 / (4 * math.pi))
LOBE = [1.0, 2 / 3, 2 / 3, 2 / 3]  # λ of each coefficient


def basis(w):
    return [Y0, Y1 * w[1], Y1 * w[2], Y1 * w[0]]


def is_open(w, distance=1.0):
    """From a vertex at a distance from the wall."""
    return w[0] <= 0 or distance * w[1] >= SLOPE * w[0]


def directions(vertex):
    key = stream_key(SEED, 0, vertex, 0)
    return [directions_about_y(2 * RAYS, key, half) for half in (0, 1)]


# Vertices that share a face with vertex 0: two at this distance from the wall, and two on the
# wall, which occludes all their rays.
NEIGHBOURS, DISTANCE, NUM_ON_WALL = (2, 3), 2.0, 2


def open_fraction_around():
    """The mean of the neighbours' fractions of open rays."""
    rays = [is_open(w, DISTANCE) for v in NEIGHBOURS for half in directions(v) for w in half]
    return sum(rays) / len(rays) * len(NEIGHBOURS) / (len(NEIGHBOURS) + NUM_ON_WALL)


def exact():
    """Closed form: the open part of the sky is a wedge between the wall's top and the ground."""
    wall = math.atan(SLOPE)
    span = math.pi - wall
    lobes = 4 / (3 * math.pi)
    up = lobes * (span / 2 + math.sin(2 * wall) / 4)
    return [
        Y0 * (0.5 + 0.5 * math.cos(wall)),
        Y1 * up,
        0.0,
        Y1 * lobes * (math.sin(math.pi) ** 2 - math.sin(wall) ** 2) / 2,
    ]


class EightRays:
    def __init__(self, data):
        self.directions = directions(0)
        self.open = [[is_open(w) for w in half] for half in self.directions]
        self.num_open = [sum(half) for half in self.open]
        self.c = open_fraction_around()
        unoccluded = [l * y for l, y in zip(LOBE, basis((0, 1, 0)))]
        self.unoccluded = unoccluded
        self.estimates = []
        for half in (0, 1):
            c = self.c
            sums = [0.0] * 4
            for w, visible in zip(self.directions[half], self.open[half]):
                for i, y in enumerate(basis(w)):
                    sums[i] += (visible - c) * y
            self.estimates.append([c * u + s / RAYS for u, s in zip(unoccluded, sums)])
        a, b = self.estimates
        self.mean = [(x + y) / 2 for x, y in zip(a, b)]
        self.ratio = half_difference_ratio(2 * RAYS)
        self.noise = [(x - y) / 2 / self.ratio for x, y in zip(a, b)]
        self.exact = exact()
        bake = Bake(f"{data}/wall.bake")
        pose = bake.pose(0)
        for i in range(4):
            transfer, noise = (
                pose["TRNF"][i * bake.num_vertices],
                pose["NOIS"][i * bake.num_vertices],
            )
            # Floats in the sampler, f16 in the file.
            assert abs(transfer - self.mean[i]) < 1e-6, (i, transfer, self.mean[i])
            assert abs(noise - self.noise[i]) < 5e-5, (i, noise, self.noise[i])


def draw_disk(figure, x0, y0, radius, rays):
    def place(w):
        return x0 + radius * w[0], y0 + radius * w[2]

    # Directions behind the wall: from its top edge, an ellipse, to the horizon.
    top = [math.pi * (n / 60 - 0.5) for n in range(61)]
    edge = [(math.cos(a) / math.hypot(1, SLOPE), 0, math.sin(a)) for a in top]
    rim = [(math.cos(a), 0, math.sin(a)) for a in reversed(top)]
    figure.circle(x0, y0, radius, "#eef5fc", SOFT)
    figure.path([place(w) for w in edge + rim], SOFT, 1.0, "#cfcfcf", close=True)
    figure.circle(x0, y0, 2.5, INK)
    for half, (colour, fill) in enumerate(((BLUE, LIGHT_BLUE), (ORANGE, LIGHT_ORANGE))):
        for w, visible in zip(rays.directions[half], rays.open[half]):
            x, y = place(w)
            if half == 0:
                figure.circle(x, y, 8, colour if visible else "#ffffff", colour, 2)
            else:
                figure.rect(x - 7, y - 7, 14, 14, colour if visible else "#ffffff", colour, 0, 2)
    figure.text(x0 - 12, y0 - 8, "normal", 12, "end", SOFT)
    figure.text(x0 + 0.74 * radius, y0 - 4, "wall", 14, "middle", SOFT, italic=True)
    figure.text(x0 - radius + 8, y0 + radius + 20, "the sky of one vertex, seen from above", 13)


def number(x):
    return f"{x:+.4f}".replace("-", "−")


def main(data, svg):
    rays = EightRays(data)
    figure = Figure(
        900,
        400,
        "One vertex with eight rays: open and occluded directions, and the estimates of both halves",
        "eight_rays.py",
    )
    draw_disk(figure, 165, 190, 150, rays)
    x = 350
    figure.circle(x + 8, 33, 8, BLUE, BLUE, 2)
    figure.text(x + 26, 38, f"half A, open: {rays.num_open[0]} of {RAYS}", 14)
    figure.rect(x + 1, 53, 14, 14, ORANGE, ORANGE, 0, 2)
    figure.text(x + 26, 65, f"half B, open: {rays.num_open[1]} of {RAYS}", 14)
    figure.text(x + 206, 38, "outlined: occluded", 14, colour=SOFT)
    figure.text(x + 206, 65, f"open around the vertex: c = {rays.c:.3f}", 14)

    columns = [x + 205, x + 300, x + 395, x + 490]
    heads = ["t₀", "t₁ (up)", "t₂", "t₃ (wall)"]
    y = 110
    for head, at in zip(heads, columns):
        figure.text(at + 6, y, head, 14, "end", bold=True)
    rows = [
        ("if nothing occludes", rays.unoccluded, SOFT),
        ("estimate of A", rays.estimates[0], BLUE),
        ("estimate of B", rays.estimates[1], ORANGE),
        ("(A + B) / 2", rays.mean, INK),
        ("noise", rays.noise, INK),
        ("exact", rays.exact, SOFT),
        ("error of the mean", [m - e for m, e in zip(rays.mean, rays.exact)], SOFT),
    ]
    for n, (name, values, colour) in enumerate(rows):
        top = y + 32 * (n + 1)
        if n in (3, 5):
            figure.line(x, top - 22, x + 510, top - 22, SOFT, 0.8)
        figure.text(x, top, name, 14, colour=colour, bold=n == 3 or n == 4)
        for value, at in zip(values, columns):
            figure.text(at + 14, top, number(value), 14, "end", colour, mono=True, bold=n in (3, 4))
    figure.text(x, 372, "The bake stores the two rows in bold: TRNF and NOIS.", 14)
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
