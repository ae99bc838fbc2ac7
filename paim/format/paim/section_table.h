// The table of sections of a .paim: the arrays of an asset, in the order of the file. Writers walk
// it to lay out a file and to fill it; the reader walks it to check a file and to read it.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/section_row.h"
#include "paim/format/container/container.h"
#include "paim/format/container/texture_sections.h"

namespace paim {

// The kinds of values of a section, with their place in memory. `matrix` is the one that a row
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
struct VertexNumbers {  // of the rows of gloss, different ones, each below num_vertices
    std::vector<uint32_t>* values;
    uint32_t num_vertices;
};
struct MatrixValues {
    LowRank* matrix;
    StoredValues* values;  // nullptr: not in memory, but given in pieces
    bool is_component = false;
};
struct TextureValues {  // one section of a texture (container/texture_sections.h)
    const CodedMesh* mesh;
    TexturePiece piece;
    ScalarType type;
};
using RowValues = std::variant<Topology*, Albedo*, TextureValues, SingularValues, Weights,
                               WeightSteps, Steps, MatrixValues, StoredValues*, SmallNumbers,
                               VertexNumbers, std::vector<float>*, RootMotion*>;

// A dimension that only the file knows.
constexpr uint32_t kAnySize = std::numeric_limits<uint32_t>::max();

// The neighbours that integers of a section are predicted from.
enum class PredictedFrom { none, vertices, rows_of_gloss, poses };

struct TableRow {
    Tag tag;
    uint32_t index = 0;
    std::array<uint32_t, 2> shape{0, 0};
    PredictedFrom neighbours = PredictedFrom::none;
    size_t part = 0;  // number of the part whose vertices are the columns
    RowValues values;

    // Whether the asset in memory has this section. Steps exist only with integers.
    bool is_present() const;
};

// All rows of an asset whose dimensions are set, without metadata. Values may be missing. Rows
// point into the asset.
// Error (unsupported) if the asset has more than two parts, or a second part that moves, which
// files cannot hold.
std::vector<TableRow> section_table(Asset& asset);

// The same, for callers that only read through the rows.
std::vector<TableRow> section_table(const Asset& asset);

// A component of the moving part.
struct ComponentId {
    Attribute attribute;
    uint32_t k;
    bool operator==(const ComponentId&) const = default;
};

// The order of components in a file: by their share of the energy of their attribute, largest
// first. So every prefix has the best components for its size.
std::vector<ComponentId> component_order(const Asset& asset);

}  // namespace paim
