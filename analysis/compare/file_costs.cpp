// What a .paim takes.
#include "analysis/compare/file_costs.h"

#include "paim/codec/frame_cost.h"
#include "paim/metrics/rates.h"

namespace paim {

FileCosts costs_of(const std::filesystem::path& path, const Asset& asset) {
    const CodedMesh& mesh = asset.moving();
    FileCosts file;
    file.path = path;
    file.codec = mesh.transfer->codec_name();
    file.bands = mesh.layout.in_bands;
    file.geometry_components = mesh.positions.num_components;
    file.transfer_components = mesh.transfer->matrix.num_components;
    file.size_bytes = std::filesystem::file_size(path);
    file.bits_per_vertex_per_pose =
        bits_per_vertex_per_pose(file.size_bytes, mesh.topology.num_vertices, mesh.num_poses());
    const FrameCost cost = mesh.transfer->cost(mesh.layout, {}, true);
    file.multiply_adds = cost.per_vertex();
    file.position_multiply_adds = positions_cost(file.geometry_components).per_vertex();
    file.cpu_multiply_adds = cost.cpu_per_frame;
    return file;
}

}  // namespace paim
