# The bake's directions, computed again: scrambled Sobol points, mapped to the disk, projected up.
# Based on: compressor/bake/{sobol,cosine_directions}.* and paim/base/seed.h, which name the papers
import math

_MASK32, _MASK64 = 0xFFFFFFFF, 0xFFFFFFFFFFFFFFFF


def _mix_bits(x):
    x = (x + 0x9E3779B97F4A7C15) & _MASK64
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & _MASK64
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & _MASK64
    return x ^ (x >> 31)


def stream_key(seed, pose, vertex, part):
    key = _mix_bits(seed)
    for number in (pose, vertex, part):
        key = _mix_bits(key ^ number)
    return key


def _reverse(x):
    return int(f"{x:032b}"[::-1], 2)


def _scramble(reversed_bits, seed):
    """The Laine–Karras permutation, and the fraction in [0, 1) that it gives."""
    x = reversed_bits
    x ^= (x * 0x3D20ADEA) & _MASK32
    x = (x + seed) & _MASK32
    x = (x * ((seed >> 16) | 1)) & _MASK32
    x ^= (x * 0x05526C56) & _MASK32
    x ^= (x * 0x53A22864) & _MASK32
    return (_reverse(x) >> 8) * 2.0**-24


def _sobol(j):
    """Reversed bits of both coordinates of point j."""
    y, direction, bits = 0, 0x80000000, j
    while bits:
        if bits & 1:
            y ^= direction
        direction ^= direction >> 1
        bits >>= 1
    return j, _reverse(y)


def disk_points(num_points, key):
    """Points of the unit disk, uniform in area: cosine-distributed directions seen from above."""
    points = []
    for j in range(num_points):
        x, y = _sobol(j)
        a = 2.0 * _scramble(x, key & _MASK32) - 1.0
        b = 2.0 * _scramble(y, key >> 32) - 1.0
        radius, other = (a, b) if abs(a) > abs(b) else (b, a)
        angle = math.pi / 4 * (other / radius if radius else 0.0)
        along, across = radius * math.cos(angle), radius * math.sin(angle)
        points.append((along, across) if abs(a) > abs(b) else (across, along))
    return points


def directions_about_y(num_points, key):
    """Directions about the normal (0, 1, 0), whose tangents are +X and −Z."""
    return [
        (x, math.sqrt(max(0.0, 1.0 - x * x - y * y)), -y) for x, y in disk_points(num_points, key)
    ]
