# The worked examples of docs/algorithms, computed from what the tools bake and encode.
#   examples.py DATA PAGES        writes them into the pages (DATA is made by scripts/figures/make)
#   examples.py DATA PAGES check  only compares; exit code 1 if a page has something else
# An example stands between <!-- example NAME --> and <!-- end -->.
import json
import math
import re
import sys
from pathlib import Path

from eight_rays import EightRays, RAYS, Y0
from linear import dot, jacobi_svd
from octopus import Octopus, centred, effective_vertices, total
from paim_files import Bake, Container


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def number(x, digits=4):
    return f"{x:.{digits}f}".replace("-", "−")


def signed(x, digits=4):
    return ("" if x < 0 else "+") + number(x, digits)


def plain(block):
    return "```\n" + block.strip("\n") + "\n```"


class Examples:
    def __init__(self, data):
        self.data = Path(data)
        self.octopus = Octopus(data)

    def report(self, name):
        return json.loads((self.data / f"{name}.json").read_text())

    def transfer(self):
        rays = EightRays(self.data)
        c = rays.c
        a, b = rays.estimates[0][0], rays.estimates[1][0]
        open_a, open_b = (count / RAYS for count in rays.num_open)
        return plain(
            f"""
of the neighbours' rays c = {c:.4f} are open
half A has {RAYS} rays, {rays.num_open[0]} of them open       half B: {rays.num_open[1]}
coefficient 0: λ₀ = 1, y₀ = {Y0:.4f}

t_A = c λ₀ y₀ + (1/{RAYS}) Σ (Vis − c) y₀ = {c:.4f} · {Y0:.4f} + ({open_a} − {c:.4f}) · {Y0:.4f} = {a:.4f}
t_B = c λ₀ y₀ + (1/{RAYS}) Σ (Vis − c) y₀ = {c:.4f} · {Y0:.4f} + ({open_b} − {c:.4f}) · {Y0:.4f} = {b:.4f}
mean  (t_A + t_B) / 2          = {rays.mean[0]:.4f}     exact: {rays.exact[0]:.4f}
noise (t_A − t_B) / 2 / {rays.ratio:.2f} = {number(rays.noise[0])}    error: {number(rays.mean[0] - rays.exact[0])}
"""
        )

    def bounces(self):
        rho = 0.8
        rows = []
        sum_so_far = 0.0
        for bounces in range(5):
            added = 0.5 * (rho / 2) ** bounces
            sum_so_far += added
            bake = Bake(self.data / f"bowl_{bounces}.bake")
            transfer = bake.pose(0)["TRNF"]
            mean = sum(transfer) / len(transfer) / Y0
            rows.append([bounces, number(added), number(sum_so_far), number(mean)])
        return table(
            ["bounces", "added by this bounce", "sum", "baked, mean over the vertices"], rows
        )

    def svd(self):
        positions = self.octopus.bake.rows("POSN")
        count = self.octopus.num_vertices
        vertices, poses = (1573, 1419, 2210), (0, 12, 24, 36)
        x = [[round(positions[count + v][p], 1) for p in poses] for v in vertices]
        rows = [centred(row) for row in x]
        s, u, q = jacobi_svd([row for row, _ in rows])
        text = ["                 pose 0    12     24     36     mean      without the mean"]
        for v, row, (without, mean) in zip(vertices, x, rows):
            text.append(
                f"height of vertex {v}  "
                + "  ".join(f"{value:.1f}" for value in row)
                + f"   {mean:5.2f}   "
                + " ".join(f"{signed(value, 2):>6}" for value in without)
            )
        text[0] = " " * 21 + "  ".join(f"{p:<3}" for p in poses) + "   μ       X′ = X − μ"
        text.append("")
        text.append("s = " + ", ".join(number(value) for value in s))
        text.append(
            "q_0 = ("
            + ", ".join(signed(value) for value in q[0])
            + ")   u_0 = ("
            + ", ".join(signed(value) for value in u[0])
            + ")"
        )
        kept = [
            [mean + s[0] * u[0][r] * value for value in q[0]] for r, (_, mean) in enumerate(rows)
        ]
        text.append("")
        text.append("with K = 1:")
        for v, row in zip(vertices, kept):
            text.append(f"height of vertex {v}   " + "  ".join(f"{value:.2f}" for value in row))
        text.append("")
        theory = sum(s[1:]) / sum(s)
        energy = math.sqrt(dot(s[1:], s[1:]) / dot(s, s))
        error = math.sqrt(
            sum((a - b) ** 2 for one, other in zip(x, kept) for a, b in zip(one, other))
        )
        size = math.sqrt(sum(dot(row, row) for row, _ in rows))
        assert abs(error / size - energy) < 1e-12
        text.append(f"theoretical error  ({s[1]:.4f} + {s[2]:.4f}) / {sum(s):.4f} = {theory:.3f}")
        text.append(
            f"energy error       √(({s[1]:.4f}² + {s[2]:.4f}²) / {dot(s, s):.4f}) = {energy:.3f}"
        )
        text.append(f"‖X′ − s_0 u_0 q_0ᵀ‖ / ‖X′‖ = {error:.4f} / {size:.4f} = {error / size:.3f}")
        return plain("\n".join(text))

    def noise(self):
        octopus = self.octopus
        energies = octopus.measure()
        energy, noise = total(energies["energy"]), total(energies["noise"])
        nu = effective_vertices(energies["vertex_noise"])
        edge = (1 + math.sqrt((octopus.num_poses - 1) / nu)) ** 2
        report = self.report("auto")["transfer"]
        rows = []
        for k in (0, 4, 8, 10, 13, 14, 15, 46):
            signal = max(0.0, energy[k] - noise[k])
            rows.append(
                [
                    k,
                    number(energy[k], 2),
                    number(noise[k], 2),
                    number(edge * noise[k], 2),
                    "yes" if energy[k] > edge * noise[k] else "no",
                    number(signal / energy[k], 3),
                ]
            )
        above = sum(e > edge * n for e, n in zip(energy, noise))
        assert above == report["above_noise"]
        lines = [
            f"P = {octopus.num_poses} poses, ν = {nu:.0f} of V = {octopus.num_vertices} vertices, so the edge is "
            f"(1 + √({octopus.num_poses - 1} / {nu:.0f}))² = {edge:.3f} times the noise.",
            "",
            table(["k", "s_k²", "noise along q_k", "edge", "stands out", "1 − noise / s_k²"], rows),
        ]
        return "\n".join(lines)

    def shrinkage(self):
        octopus = self.octopus
        energies = octopus.measure()
        band, k = 3, 4
        count = octopus.num_vertices
        signal_lk = [
            max(0.0, e - n) for e, n in zip(energies["energy"][band], energies["noise"][band])
        ]
        phi = signal_lk[k] / sum(signal_lk)
        psi = energies["noise"][band][k] / sum(energies["vertex_noise"][band])
        by_signal = sorted(
            range(count),
            key=lambda v: energies["vertex_energy"][band][v] - energies["vertex_noise"][band][v],
        )
        chosen = [by_signal[count - 40], by_signal[count * 9 // 10], by_signal[count // 2]]
        rows = []
        for v in chosen:
            e, n = energies["vertex_energy"][band][v], energies["vertex_noise"][band][v]
            signal = max(0.0, e - n) * phi
            of_noise = n * psi
            factor = signal / (signal + of_noise) if of_noise > 0 else 1.0
            rows.append(
                [v, number(e), number(n), f"{signal:.2e}", f"{of_noise:.2e}", number(factor, 3)]
            )
        return "\n".join(
            [
                f"Band l = {band}, component k = {k}: φ_lk = {phi:.4f}, ψ_lk = {psi:.4f}.",
                "",
                table(["vertex", "ε_vl", "η_vl", "signal", "noise", "factor f_vlk"], rows),
            ]
        )

    def errors(self):
        report = self.report("auto")["transfer"]
        bake = self.report("octopus")
        return table(
            ["figure", "relative to the bake's transfer"],
            [
                [
                    "the bake, estimated from D (`relative_noise`)",
                    f"{100 * bake['relative_noise']:.2f} %",
                ],
                [
                    f"`auto`: {report['components']} components, shrunk, predicted error",
                    f"{100 * report['expected_error']:.2f} %",
                ],
                [
                    "… of this: signal that was dropped",
                    f"{100 * report['expected_truncation_error']:.2f} %",
                ],
                [
                    "… noise that is left, and signal lost with the rest",
                    f"{100 * report['expected_noise_error']:.2f} %",
                ],
            ],
        )

    def quantisation(self):
        octopus = self.octopus
        paim = Container(self.data / "all.paim")
        target = Container(self.data / "target.paim")
        step = target["GSTP"][1]
        k, count = 4, octopus.num_vertices
        weights = paim["GWGT"][k * octopus.num_poses : (k + 1) * octopus.num_poses]
        rms = math.sqrt(dot(weights, weights) / octopus.num_poses)
        values = [rms * x for x in paim["GCMP", k][count : 2 * count]]
        in_steps = [x / step for x in values]
        chosen = []
        for wanted in (0.3, 0.55, 0.7, 1.4, -1.6, 6.3):
            v = min(range(count), key=lambda v: abs(in_steps[v] - wanted))
            chosen.append(v)
        rows = []
        for v in chosen:
            q = 0 if abs(in_steps[v]) < 0.6 else round(in_steps[v])
            rows.append(
                [
                    v,
                    signed(values[v], 5),
                    signed(in_steps[v], 2),
                    str(q).replace("-", "−"),
                    signed(q * step - values[v], 5),
                ]
            )
        quantised = [0 if abs(x) < 0.6 else round(x) for x in in_steps]
        zeros = sum(q == 0 for q in quantised)
        nearest = sum(round(x) == 0 for x in in_steps)
        return "\n".join(
            [
                table(["vertex", "a_4, scene units", "in steps", "stored", "error"], rows),
                "",
                f"Δ = {step:.5f}. Of the {count} heights of this component {zeros} become zero; "
                f"rounding to the nearest would make {nearest} zero.",
            ]
        )

    def cpca(self):
        octopus = self.octopus
        count, planes = octopus.num_vertices, octopus.num_coefficients
        position = octopus.bake.pose(0)["POSN"]
        place = [[position[axis * count + v] for axis in range(3)] for v in range(count)]
        size = 31
        middle = 2210
        members = sorted(range(count), key=lambda v: math.dist(place[v], place[middle]))[:size]
        points = [
            [x for i in range(planes) for x in octopus.transfer[i * count + v]] for v in members
        ]
        mean = [sum(column) / size for column in zip(*points)]
        s, u, q = jacobi_svd([[x - m for x, m in zip(point, mean)] for point in points])
        whole = sum(dot(point, point) for point in points)
        rows = []
        for j in (0, 1, 2, 4, 8, 13):
            left = sum(x * x for x in s[j:])
            rows.append([j, number(left, 3), f"{100 * math.sqrt(left / whole):.1f} %", 3 * (j + 1)])
        j = 8

        # The vertex that the cluster's own fit leans on most: its share of the first directions.
        def leverage(v):
            return 1 / size + sum(u[k][v] ** 2 for k in range(j))

        def distance(v):
            return sum((s[k] * u[k][v]) ** 2 for k in range(j, size))

        by_leverage = sorted(range(size), key=leverage)
        examples = []
        for v in (by_leverage[0], by_leverage[-1]):
            h, d2 = leverage(v), distance(v)
            examples.append([members[v], number(h, 3), number(d2), number(d2 / (1 - h))])
        return "\n".join(
            [
                table(["J", "squared error", "relative", "multiply-adds a vertex"], rows),
                "",
                f"With J = {j}, the members that this fit follows least and most:",
                "",
                table(["vertex", "leverage h", "squared distance", "counted as"], examples),
            ]
        )

    def search(self):
        rows = []
        for c in self.report("target")["candidates"]:
            name = c["codec"]
            if name == "cpca":
                name += f", {c['clusters']} × {c['cluster_components']}"
            bytes_ = f"{c['transfer_bytes']:,}".replace(",", " ")
            cells = [name, c["components"], bytes_, c["multiply_adds"]]
            if c["chosen"]:
                cells = [f"**{cell}**" for cell in cells]
            rows.append(cells)
        return table(
            ["codec", "components over time", "bytes, estimated", "multiply-adds a vertex"], rows
        )


def main(data, pages, mode="write"):
    examples = Examples(data)
    differ = False
    for page in sorted(Path(pages).glob("*.md")):
        text = page.read_text()

        def fill(match):
            return f"<!-- example {match[1]} -->\n{getattr(examples, match[1])()}\n<!-- end -->"

        filled = re.sub(r"<!-- example (\w+) -->\n.*?<!-- end -->", fill, text, flags=re.S)
        if filled == text:
            continue
        if mode == "check":
            print(f"{page}: its examples are not what the tools give", file=sys.stderr)
            differ = True
        else:
            page.write_text(filled)
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
