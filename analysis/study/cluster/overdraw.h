// How often triangles are drawn if a draw has the bases of some clusters alone.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003 (super-clusters, greedily merged); Chen, thesis on clustered principal
//           components for glossy precomputed radiance transfer, 2005 (geometry coherence)
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::study {

// A triangle is drawn once for each different group of its vertices.
// group    [V]
// returns  triangles drawn, over triangles; 1 … 3, not a number without triangles
double overdraw(const Topology& topology, std::span<const uint32_t> group);

// Merges clusters into super-clusters: always the two that have the most triangles in common, until
// no two that may be merged have any. Of equals the first two.
// cluster        [V], all below num_clusters
// most_clusters  of a super-cluster, at least 1
// returns        [clusters] the super-cluster of each, numbered by their first clusters
std::vector<uint32_t> super_clusters(const Topology& topology, std::span<const uint32_t> cluster,
                                     uint32_t num_clusters, uint32_t most_clusters);

// The squared error of a vertex in a cluster.
using VertexErrors = std::function<double(uint32_t v, uint32_t c)>;

// Geometry coherence. A vertex moves to the cluster of a vertex that it shares a triangle with, if its
// squared error there is less than 1 + alpha times that in the cluster where it started, and if fewer
// triangles are drawn then. Of several such clusters it moves to the one with the fewest triangles
// drawn, then with the smallest error, then to the first. Vertices have their turns in order, again and
// again until none moves. The last vertex of a cluster stays.
// cluster  [V] in and out
// returns  how often vertices moved
uint32_t make_coherent(const Topology& topology, const VertexErrors& squared_error, double alpha,
                       std::vector<uint32_t>& cluster);

}  // namespace paim::study
