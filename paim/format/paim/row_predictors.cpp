// Predictors of the integers of a .paim.
#include "paim/format/paim/row_predictors.h"

#include "paim/mesh/face_vertices.h"

namespace paim {

RowPredictors::RowPredictors(const Asset& asset) : RowPredictors(asset.num_poses()) {
    for (const CodedMesh& mesh : asset.parts) {
        OfPart part;
        part.vertices = PlanePredictor(mesh.topology);
        part.all_rows = !mesh.gloss || mesh.gloss->vertices.empty();
        if (!part.all_rows) {
            part.rows_of_gloss = PlanePredictor(faces_among(mesh.topology, mesh.gloss->vertices));
        }
        parts_.push_back(std::move(part));
    }
}

const PlanePredictor& RowPredictors::of(const TableRow& row) const {
    if (row.neighbours == PredictedFrom::poses) return poses_;
    if (row.neighbours == PredictedFrom::none || parts_.empty()) return none_;
    const OfPart& part = parts_[row.part];
    const bool among_rows = row.neighbours == PredictedFrom::rows_of_gloss && !part.all_rows;
    return among_rows ? part.rows_of_gloss : part.vertices;
}

}  // namespace paim
