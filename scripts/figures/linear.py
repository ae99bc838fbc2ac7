# Small matrices without a library: one-sided Jacobi, as the encoder has it.
# Based on: Hestenes, Inversion of Matrices by Biorthogonalization and Related Results, 1958
import math
from operator import mul


def dot(a, b):
    return sum(map(mul, a, b))


def transposed(rows):
    return [list(column) for column in zip(*rows)]


def jacobi_svd(rows):
    """rows [m][n], m <= n. Returns singular values [m], descending, u [m][m] and q [m][n], both as
    lists of vectors; the largest entry of each q is positive. Zero values have zero vectors q."""
    working = [list(row) for row in rows]  # becomes S Qᵀ, row by row
    m = len(rows)
    turns = [[float(i == j) for j in range(m)] for i in range(m)]  # becomes Uᵀ
    for _ in range(60):
        largest = 0.0
        for i in range(m):
            for j in range(i + 1, m):
                a, b, c = (
                    dot(working[i], working[i]),
                    dot(working[j], working[j]),
                    dot(working[i], working[j]),
                )
                if c == 0.0 or a == 0.0 or b == 0.0:
                    continue
                largest = max(largest, abs(c) / math.sqrt(a * b))
                zeta = (b - a) / (2 * c)
                t = math.copysign(1.0, zeta) / (abs(zeta) + math.sqrt(1 + zeta * zeta))
                cosine = 1 / math.sqrt(1 + t * t)
                sine = cosine * t
                for pair in (working, turns):
                    x, y = pair[i], pair[j]
                    pair[i] = [cosine * p - sine * r for p, r in zip(x, y)]
                    pair[j] = [sine * p + cosine * r for p, r in zip(x, y)]
        if largest < 1e-15:
            break
    order = sorted(range(m), key=lambda i: -dot(working[i], working[i]))
    values, u, q = [], [], []
    for i in order:
        length = math.sqrt(dot(working[i], working[i]))
        vector = [x / length for x in working[i]] if length else [0.0] * len(working[i])
        sign = math.copysign(1.0, max(vector, key=abs)) if length else 1.0
        values.append(length)
        q.append([sign * x for x in vector])
        u.append([sign * x for x in turns[i]])
    return values, u, q
