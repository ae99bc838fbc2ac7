// A low-rank matrix, clusters and still planes from the sections of a .paim.
#pragma once

#include "paim/codec/model.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/pack/plane_predictor.h"

namespace paim {

// Error (bad input) unless the section has this shape.
void expect_shape(const ContainerReader& reader, const Section& section, uint32_t rows,
                  uint32_t columns);

// What integers of a mesh are predicted with; nothing where no section is predicted.
// Error (bad input) if a file of this size has no business with so many vertices: sections may claim
// few bytes for each.
PlanePredictor read_predictor(const ContainerReader& reader, const Topology& topology);

// Fills a matrix whose dimensions are set, those of the whole file.
// predictor  of its points, where they are a mesh
// num_there  components are read, and matrix.num_components becomes that if the file has more
// Errors (bad input, unsupported) name the file and the section.
void read_matrix(const ContainerReader& reader, Attribute attribute,
                 const PlanePredictor& predictor, uint32_t num_there, LowRankMatrix& matrix);

// Fills clusters whose dimensions are set. The same errors; and an index or coefficient that no
// cluster has.
void read_clusters(const ContainerReader& reader, const PlanePredictor& predictor,
                   uint32_t num_vertices, VertexClusters& clusters);

// Planes of what does not move, with the steps that integers count. The same errors.
StillPlanes read_still_planes(const ContainerReader& reader, Tag values, Tag steps,
                              uint32_t num_planes, uint32_t num_points,
                              const PlanePredictor& predictor);

}  // namespace paim
