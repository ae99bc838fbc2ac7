// Predictors of the integers of a .paim, from neighbours on the mesh or in time.
#pragma once

#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/paim/section_table.h"

namespace paim {

class RowPredictors {
  public:
    // Those of an asset whose rows are not predicted from neighbours on its meshes.
    explicit RowPredictors(uint32_t num_poses) : poses_(PlanePredictor::chain(num_poses)) {}
    explicit RowPredictors(const Asset& asset);

    // Of a row of the asset's table.
    const PlanePredictor& of(const TableRow& row) const;

  private:
    struct OfPart {
        PlanePredictor vertices;
        PlanePredictor rows_of_gloss;  // where not all vertices are rows
        bool all_rows = true;
    };

    PlanePredictor poses_;
    std::vector<OfPart> parts_;
    PlanePredictor none_;
};

}  // namespace paim
