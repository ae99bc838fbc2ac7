# Which components stand out from noise: the spectrum, the noise along each component, the edge.
#   noise_spectrum.py DATA SVG      DATA is made by scripts/figures/make
import json
import math
import sys

from octopus import Octopus, effective_vertices, total
from svg import BLUE, Figure, GREEN, LIGHT_BLUE, ORANGE, SOFT

LEFT, TOP, WIDTH, HEIGHT = 90, 40, 780, 330
LOW, HIGH = 3.0, 3000.0


def main(data, svg):
    octopus = Octopus(data)
    energies = octopus.measure()
    energy, noise = total(energies["energy"]), total(energies["noise"])
    num_poses = octopus.num_poses
    nu = effective_vertices(energies["vertex_noise"])
    edge = (1 + math.sqrt((num_poses - 1) / nu)) ** 2
    above = next(k for k, (e, n) in enumerate(zip(energy, noise)) if e <= edge * n)
    with open(f"{data}/auto.json") as file:
        assert above == json.load(file)["transfer"]["above_noise"]

    figure = Figure(
        900,
        430,
        "Energy of each component, of the noise along it, and the noise's edge",
        "noise_spectrum.py",
    )

    def x(k):
        return LEFT + WIDTH * (k + 0.7) / (len(energy) + 0.4)

    def y(value):
        return TOP + HEIGHT * (1 - math.log(value / LOW) / math.log(HIGH / LOW))

    figure.rect(LEFT, TOP, x(above - 0.5) - LEFT, HEIGHT, LIGHT_BLUE, "none")
    for value in (3, 10, 30, 100, 300, 1000, 3000):
        figure.line(LEFT, y(value), LEFT + WIDTH, y(value), "#d8d8d8", 0.8)
        figure.text(LEFT - 10, y(value) + 5, f"{value:,}".replace(",", " "), 13, "end", SOFT)
    for k in range(0, len(energy), 5):
        figure.text(x(k), TOP + HEIGHT + 20, str(k), 13, "middle", SOFT)
    figure.line(LEFT, TOP, LEFT, TOP + HEIGHT, SOFT)
    figure.line(LEFT, TOP + HEIGHT, LEFT + WIDTH, TOP + HEIGHT, SOFT)
    figure.text(LEFT + WIDTH / 2, TOP + HEIGHT + 44, "component k", 14, "middle")
    figure.text(LEFT - 70, TOP - 14, "energy", 14)

    figure.path([(x(k), y(n)) for k, n in enumerate(noise)], ORANGE, 2)
    figure.path([(x(k), y(edge * n)) for k, n in enumerate(noise)], GREEN, 2, dash="7 5")
    for k, e in enumerate(energy):
        figure.circle(x(k), y(e), 4.5, BLUE if k < above else "#ffffff", BLUE, 2)

    legend = x(above + 6)
    figure.rect(legend - 16, 56, 360, 156, "#ffffff", "#d8d8d8", 4)
    figure.circle(legend + 14, 75, 4.5, BLUE, BLUE, 2)
    figure.text(legend + 40, 80, "s²ₖ: energy of component k", 14)
    figure.circle(legend + 14, 101, 4.5, "#ffffff", BLUE, 2)
    figure.text(legend + 40, 106, f"the same, not above the edge: k ≥ {above}", 14)
    figure.line(legend, 128, legend + 28, 128, ORANGE, 2)
    figure.text(
        legend + 40, 133, f"noise along component k, about {sum(noise) / len(noise):.1f}", 14
    )
    figure.line(legend, 154, legend + 28, 154, GREEN, 2, "7 5")
    figure.text(legend + 40, 159, f"its edge, {edge:.3f} times as much", 14)
    factors = f"P = {num_poses}, ν = {nu:.0f}"
    figure.text(legend, 196, f"edge: (1 + √((P − 1) / ν))², {factors}", 14, colour=SOFT)
    figure.text(LEFT + 12, TOP + HEIGHT - 12, f"{above} stand out", 14, colour=BLUE, bold=True)
    figure.save(svg)


if __name__ == "__main__":
    main(*sys.argv[1:])
