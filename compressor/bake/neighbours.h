// The vertices that share a face with each vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

class Neighbours {
  public:
    explicit Neighbours(const Topology& topology);

    size_t num_vertices() const { return begin_.size() - 1; }

    // In ascending order, each once.
    std::span<const uint32_t> operator[](size_t v) const {
        return std::span(all_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
    }

  private:
    std::vector<size_t> begin_;  // [V + 1]
    std::vector<uint32_t> all_;
};

// The mean fraction of open rays of the neighbours of a vertex that have traced any; 1 if none has.
// num_rays, num_occluded  [V] of each vertex
double open_fraction_around(const Neighbours& neighbours, size_t v,
                            std::span<const uint64_t> num_rays,
                            std::span<const uint64_t> num_occluded);

}  // namespace paim
