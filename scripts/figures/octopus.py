# What the figures and examples ask of the octopus: its components, and the noise along them.
import json
import math
from operator import mul
from pathlib import Path

from paim_files import Bake, Container


def dot(a, b):
    return sum(map(mul, a, b))


def centred(row):
    mean = sum(row) / len(row)
    return [x - mean for x in row], mean


class Octopus:
    """DATA holds octopus.bake and all.paim, made by scripts/figures/make."""

    def __init__(self, data):
        self.data = Path(data)
        self.bake = Bake(f"{data}/octopus.bake")
        self.num_vertices, self.num_poses = self.bake.num_vertices, self.bake.num_poses
        self.num_coefficients = self.bake.manifest["bands"] ** 2
        self.transfer = self.bake.rows("TRNF")
        self.noise = self.bake.rows("NOIS")
        paim = Container(f"{data}/all.paim")
        self.singular_values = list(paim["TSPC"])
        weights = paim["TWGT"]
        # A row of the weights is s_k / √rows times a pose direction q_k, which is a unit vector.
        self.directions = []
        for k in range(len(weights) // self.num_poses):
            row = weights[k * self.num_poses : (k + 1) * self.num_poses]
            length = math.sqrt(dot(row, row))
            self.directions.append([w / length for w in row])

    def band_of_row(self, row):
        return math.isqrt(row // self.num_vertices)

    def measure(self):
        """Energies, as component_noise.h has them: [bands][K] along the pose directions and
        [bands][V] of the vertices, of the transfer and of the noise. Kept in energies.json."""
        kept = self.data / "energies.json"
        if kept.exists():
            return json.loads(kept.read_text())
        bands, num_components = math.isqrt(self.num_coefficients), len(self.directions)
        result = {}
        for name, rows in (("energy", self.transfer), ("noise", self.noise)):
            along = [[0.0] * num_components for _ in range(bands)]
            of_vertex = [[0.0] * self.num_vertices for _ in range(bands)]
            for r, row in enumerate(rows):
                values, _ = centred(row)
                band = self.band_of_row(r)
                of_vertex[band][r % self.num_vertices] += dot(values, values)
                sums = along[band]
                for k, direction in enumerate(self.directions):
                    factor = dot(values, direction)
                    sums[k] += factor * factor
            result[name] = along
            result["vertex_" + name] = of_vertex
        kept.write_text(json.dumps(result))
        return result


def total(by_band):
    """[K] from [bands][K]."""
    return [sum(column) for column in zip(*by_band)]


def effective_vertices(vertex_noise):
    """ν: how many vertices' worth of noise there is."""
    of_vertex = [sum(column) for column in zip(*vertex_noise)]
    return sum(of_vertex) ** 2 / dot(of_vertex, of_vertex)
