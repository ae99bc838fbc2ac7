# The bake's directions, computed again: a spiral on the disk, projected up.
# Based on: compressor/bake/{cosine_directions,direction_sampler}.* and paim/base/seed.h, which name the papers
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


def disk_points(num_points, key, half):
    """Points of the unit disk, uniform in area: cosine-distributed directions seen from above.
    num_points is that of both halves."""
    shift = ((key & _MASK32) >> 8) * 2.0**-24
    turn = (key >> 40) * 2.0**-24
    points = []
    for j in range(half ^ (key & 1), num_points, 2):
        radius = math.sqrt((j + shift) / num_points)
        angle = 2.0 * math.pi * (j / math.sqrt(2) + turn)
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return points


def directions_about_y(num_points, key, half):
    """Directions about the normal (0, 1, 0), whose tangents are +X and −Z."""
    return [
        (x, math.sqrt(max(0.0, 1.0 - x * x - y * y)), -y)
        for x, y in disk_points(num_points, key, half)
    ]


def half_difference_ratio(num_points):
    """That of direction_sampler.cpp, for 2 to 32 points."""
    return 1.1 + (math.log2(num_points) - 1.0) / 4.0 * (1.42 - 1.1)
