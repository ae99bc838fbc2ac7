// The table of sections of a .paim.
#include "paim/format/paim/section_table.h"

#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"

namespace paim {

namespace {

uint32_t size_of(size_t size) {
    return static_cast<uint32_t>(size);
}

Tag tag_of(std::string_view name) {
    PAIM_CHECK_EQ(name.size(), size_t{4});
    Tag tag;
    std::copy(name.begin(), name.end(), tag.text.begin());
    return tag;
}

StoredValues* component_of(LowRank& matrix, uint32_t k) {
    return k < matrix.components.size() ? &matrix.components[k] : nullptr;
}

class TableBuilder {
  public:
    explicit TableBuilder(Asset& asset) : asset_(asset) {}

    std::vector<TableRow> build() {
        CodedMesh& moving = asset_.moving();
        add(section::kTriangles, {size_of(moving.topology.triangles.size()), 3}, &moving.topology);
        add(section::kAlbedo, {size_of(moving.albedo.values.size()), 3}, &moving.albedo);
        if (CodedMesh* still = asset_.still()) {
            part_ = 1;
            add_still(*still);
            part_ = 0;
        }
        add_texture();
        if (!moving.root_motion.empty()) {
            add(section::kRootMotion, {size_of(moving.root_motion.size()), kRootNumbers},
                &moving.root_motion);
        }
        for (const SectionRow& row : moving.transfer->sections()) add_codec_row(row, false);
        if (moving.gloss) {
            add_gloss_rows(moving, section::kGlossTint, section::kGlossVertices);
            add_turns(moving.gloss->frame_turns, section::kFrameTurns, section::kFrameTurnSteps);
            for (const SectionRow& row : moving.gloss->transfer->sections()) {
                add_codec_row(row, true);
            }
        }
        const std::vector<Attribute> attributes = moving.attributes();
        for (const Attribute which : attributes) add_frame(which, moving.attribute(which));
        if (LowRank& positions = moving.positions; positions.fraction_bits > 0) {
            add(section::kSmoothing, {1 + positions.num_components, positions.num_planes},
                SmallNumbers{&positions.smoothing, kMaxSmoothingRounds + 1});
        }
        for (const Attribute which : attributes) {
            LowRank& matrix = moving.attribute(which);
            add_values(section::kMean[number(which)], 0, {&matrix, &matrix.mean, false}, which);
        }
        for (const auto& [which, k] : component_order(asset_)) {
            LowRank& matrix = moving.attribute(which);
            add_values(section::kComponent[number(which)], k,
                       {&matrix, component_of(matrix, k), true}, which);
        }
        return std::move(rows_);
    }

  private:
    void add(Tag tag, std::array<uint32_t, 2> shape, RowValues values,
             PredictedFrom neighbours = PredictedFrom::none, uint32_t index = 0) {
        rows_.push_back({tag, index, shape, neighbours, part_, std::move(values)});
    }

    static size_t number(Attribute which) { return static_cast<size_t>(which); }

    // What rows of gloss there are.
    void add_gloss_rows(CodedMesh& mesh, Tag tint, Tag vertices) {
        CodedGloss& gloss = *mesh.gloss;
        add(tint, {size_of(gloss.tint.values.size()), 3}, &gloss.tint);
        if (gloss.num_rows < mesh.topology.num_vertices) {
            add(vertices, {gloss.num_rows, 1},
                VertexNumbers{&gloss.vertices, mesh.topology.num_vertices});
        }
    }

    // A matrix that is a mean alone.
    void add_planes(Tag tag, Tag tag_of_steps, LowRank& matrix, PredictedFrom neighbours) {
        add(tag_of_steps, {1, matrix.num_planes}, Steps{&matrix});
        add(tag, {matrix.num_planes, matrix.num_points}, MatrixValues{&matrix, &matrix.mean},
            neighbours);
    }

    // Most files have none.
    void add_turns(LowRank& turns, Tag tag, Tag tag_of_steps) {
        if (turns.num_points > 0) {
            add_planes(tag, tag_of_steps, turns, PredictedFrom::rows_of_gloss);
        }
    }

    void add_still(CodedMesh& mesh) {
        add(section::kStillTriangles, {size_of(mesh.topology.triangles.size()), 3}, &mesh.topology);
        add_planes(section::kStillPositions, section::kStillPositionSteps, mesh.positions,
                   PredictedFrom::vertices);
        add(section::kStillAlbedo, {size_of(mesh.albedo.values.size()), 3}, &mesh.albedo);
        add_planes(section::kStillTransfer, section::kStillTransferSteps, mesh.transfer->matrix,
                   PredictedFrom::vertices);
        if (!mesh.gloss) return;
        add_gloss_rows(mesh, section::kStillGlossTint, section::kStillGlossVertices);
        add_turns(mesh.gloss->frame_turns, section::kStillFrameTurns,
                  section::kStillFrameTurnSteps);
        add_planes(section::kStillGloss, section::kStillGlossSteps, mesh.gloss->transfer->matrix,
                   PredictedFrom::rows_of_gloss);
    }

    // Of all parts. The reader reads textures whole, and has none yet when it asks for rows.
    void add_texture() {
        for (size_t part = 0; part < asset_.parts.size(); ++part) {
            const CodedMesh& mesh = asset_.parts[part];
            for (const auto& [piece, spec] :
                 texture_sections(mesh.texture, section::kTexture[part])) {
                rows_.push_back({spec.tag,
                                 spec.index,
                                 {spec.shape[1], spec.shape[2]},
                                 PredictedFrom::none,
                                 part,
                                 TextureValues{&mesh, piece, spec.type}});
            }
        }
    }

    void add_codec_row(const SectionRow& row, bool of_gloss) {
        Tag tag = tag_of(row.tag);
        if (of_gloss) tag.text[0] = 'X';
        const PredictedFrom neighbours =
            of_gloss ? PredictedFrom::rows_of_gloss : PredictedFrom::vertices;
        std::visit(
            [&](auto values) {
                add(tag, {row.num_rows, row.num_columns}, values,
                    row.by_vertex ? neighbours : PredictedFrom::none, row.index);
            },
            row.values);
    }

    // Adds the rows of an attribute without mean and components.
    void add_frame(Attribute which, LowRank& matrix) {
        const size_t i = number(which);
        add(section::kSingularValues[i], {1, size_of(matrix.singular_values.size())},
            SingularValues{&matrix});
        add(section::kWeights[i], {matrix.num_components, matrix.num_poses}, Weights{&matrix},
            PredictedFrom::poses);
        add(section::kWeightSteps[i], {1, matrix.num_components}, WeightSteps{&matrix});
        add(section::kSteps[i], {1, matrix.num_planes}, Steps{&matrix});
    }

    // The neighbours of the points of an attribute.
    PredictedFrom neighbours_of(Attribute which) const {
        const CodedMesh& moving = asset_.moving();
        switch (which) {
            case Attribute::geometry:
                return PredictedFrom::vertices;
            case Attribute::transfer:
                return moving.transfer->points_are_vertices() ? PredictedFrom::vertices
                                                              : PredictedFrom::none;
            case Attribute::gloss:
                break;
        }
        return moving.gloss->transfer->points_are_vertices() ? PredictedFrom::rows_of_gloss
                                                             : PredictedFrom::none;
    }

    void add_values(Tag tag, uint32_t index, MatrixValues values, Attribute which) {
        add(tag, {values.matrix->num_planes, values.matrix->num_points}, values,
            neighbours_of(which), index);
    }

    Asset& asset_;
    size_t part_ = 0;
    std::vector<TableRow> rows_;
};

void check_parts(const Asset& asset) {
    if (asset.parts.size() > 2) {
        throw_unsupported("an asset of {} parts: files hold one that moves and one that is still",
                          asset.parts.size());
    }
    const CodedMesh* const still = asset.still();
    if (still == nullptr) return;
    const TransferModel& transfer = *still->transfer;
    const CodedMesh& moving = asset.moving();
    const bool is_plain_gloss =
        !still->gloss || (moving.gloss && still->gloss->layout == moving.gloss->layout &&
                          still->gloss->transfer->matrix.num_components == 0 &&
                          still->gloss->transfer->points_are_vertices());
    if (!is_plain_gloss || still->num_poses() != 1 || still->positions.num_components != 0 ||
        transfer.matrix.num_components != 0 || !transfer.points_are_vertices() ||
        still->layout != moving.layout) {
        throw_unsupported(
            "a second part that moves, or whose transfer is coded otherwise: files hold one that "
            "is still, every vertex with its own transfer of the first part's layout");
    }
}

}  // namespace

bool TableRow::is_present() const {
    if (const auto* row = std::get_if<Steps>(&values)) return !row->matrix->steps.empty();
    if (const auto* row = std::get_if<WeightSteps>(&values)) {
        return !row->matrix->weight_steps.empty() && row->matrix->num_components > 0;
    }
    return true;
}

std::vector<TableRow> section_table(Asset& asset) {
    check_parts(asset);
    return TableBuilder(asset).build();
}

std::vector<TableRow> section_table(const Asset& asset) {
    // Rows point to values that the reader fills. Callers with a constant asset do not write
    // through them.
    return section_table(const_cast<Asset&>(asset));
}

std::vector<ComponentId> component_order(const Asset& asset) {
    struct Ranked {
        ComponentId id;
        double share;
    };
    std::vector<Ranked> ranked;
    for (const Attribute attribute : asset.moving().attributes()) {
        const LowRank& matrix = asset.moving().attribute(attribute);
        const double largest = matrix.singular_values.empty() ? 0.0 : matrix.singular_values[0];
        double energy = 0.0;  // relative to the largest value, whose square may overflow
        for (const double s : matrix.singular_values) energy += (s / largest) * (s / largest);
        for (uint32_t k = 0; k < matrix.num_components; ++k) {
            const size_t index = matrix.singular_index(k);
            const double ratio = largest > 0.0 && index < matrix.singular_values.size()
                                     ? matrix.singular_values[index] / largest
                                     : 0.0;
            ranked.push_back({{attribute, k}, largest > 0.0 ? ratio * ratio / energy : 0.0});
        }
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Ranked& a, const Ranked& b) { return a.share > b.share; });
    std::vector<ComponentId> order(ranked.size());
    std::transform(ranked.begin(), ranked.end(), order.begin(),
                   [](const Ranked& r) { return r.id; });
    return order;
}

}  // namespace paim
