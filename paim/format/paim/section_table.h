// The table of sections of a .paim: what an asset consists of, in the order of the file. Writers walk
// it to lay a file out and to fill it, the reader walks it to check a file and to take it apart.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/container.h"

namespace paim {

// What the values of a section are, and where they are in memory. The matrix is the one that a row
// belongs to.
struct SingularValues {
    LowRank* matrix;
};
struct Weights {
    LowRank* matrix;
};
struct WeightSteps {  // only where weights are integers
    LowRank* matrix;
};
struct Steps {  // only where values are integers
    LowRank* matrix;
};
struct MatrixValues {
    LowRank* matrix;
    StoredValues* values;  // nullptr while they are not in memory: they arrive in pieces
    bool is_component = false;
};
using RowValues = std::variant<Topology*, Albedo*, SingularValues, Weights, WeightSteps, Steps,
                               MatrixValues, StoredValues*, SmallNumbers, std::vector<float>*>;

// Stands for a dimension that the file alone knows.
constexpr uint32_t kAnySize = std::numeric_limits<uint32_t>::max();

// Where integers of a section have neighbours to be predicted from.
enum class Neighbours { none, vertices, poses };

struct TableRow {
    Tag tag;
    uint32_t index = 0;
    std::array<uint32_t, 2> shape{0, 0};
    Neighbours neighbours = Neighbours::none;
    size_t part = 0;  // of the asset, whose vertices those are
    RowValues values;

    // Whether the asset in memory has this section: steps go with integers.
    bool is_present() const;
};

// Every row of an asset whose dimensions are set; values may still be missing. Metadata is not among
// them. Rows point into the asset.
// Error (unsupported): more than one part, beyond the first, or one that does not stand still: files
// have no place for it.
std::vector<TableRow> section_table(Asset& asset);

// For walks that only read through the rows.
std::vector<TableRow> section_table(const Asset& asset);

// A component of the part that moves.
struct ComponentId {
    Attribute attribute;
    uint32_t k;
    bool operator==(const ComponentId&) const = default;
};

// The order of components in a file: by the share of their attribute's energy, largest first, so that
// every prefix is the best coarser animation of its size.
std::vector<ComponentId> component_order(const Asset& asset);

}  // namespace paim
