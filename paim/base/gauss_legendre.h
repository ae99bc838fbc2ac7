// Gauss–Legendre quadrature: n nodes integrate polynomials of degree 2n − 1 exactly.
#pragma once

#include <cmath>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

struct QuadratureNode {
    double x;
    double weight;
};

// Nodes on [from, to].
inline std::vector<QuadratureNode> gauss_legendre(int num_nodes, double from, double to) {
    std::vector<QuadratureNode> nodes;
    const double half = 0.5 * (to - from);
    for (int i = 0; i < num_nodes; ++i) {
        // Newton's method from Tricomi's estimate of the root.
        double x = std::cos(kPi * (i + 0.75) / (num_nodes + 0.5));
        double slope = 0.0;
        for (int iteration = 0; iteration < 10; ++iteration) {
            double before = 1.0, legendre = x;
            for (int l = 2; l <= num_nodes; ++l) {
                const double next = ((2.0 * l - 1.0) * x * legendre - (l - 1.0) * before) / l;
                before = legendre;
                legendre = next;
            }
            slope = num_nodes * (x * legendre - before) / (x * x - 1.0);
            x -= legendre / slope;
        }
        nodes.push_back({from + half * (1.0 + x), half * 2.0 / ((1.0 - x * x) * slope * slope)});
    }
    return nodes;
}

}  // namespace paim
