// Everything about a bake that the search for settings compares them on.
#include "compressor/encode/search/problem.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/data/still_part.h"
#include "compressor/encode/search/problem_reader.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/texture_order.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

namespace {

Albedo in_order(const Albedo& albedo, const std::vector<uint32_t>& old_vertex) {
    if (albedo.values.size() == 1) return albedo;
    Albedo ordered;
    ordered.values.clear();
    for (const uint32_t old : old_vertex) ordered.values.push_back(albedo.values[old]);
    return ordered;
}

// A still part of floats with vertices and triangles in cache order.
CodedMesh in_cache_order(CodedMesh mesh) {
    CacheOrder order = cache_order(mesh.topology);
    const auto reorder = [&](LowRank& matrix) {
        std::vector<float> values = matrix.mean.floats();
        reorder_planes(values, order.old_vertex);
        matrix.mean = std::move(values);
    };
    reorder(mesh.positions);
    reorder(mesh.transfer->matrix);
    mesh.albedo = in_order(mesh.albedo, order.old_vertex);
    mesh.texture = reordered(mesh.texture, mesh.topology, order.topology, order.old_vertex);
    mesh.topology = std::move(order.topology);
    return mesh;
}

// The asset without positions and transfer of the part that moves.
// order  of that part's vertices
Asset make_shell(const BakeReader& bake, const EncodeOptions& options, const TransferLayout& layout,
                 CacheOrder& order) {
    Asset shell;
    shell.vertex_order = VertexOrder::cache;
    shell.origin = bake.identity().origin;
    shell.frames_per_second = options.frames_per_second;
    shell.name = options.name;
    CodedMesh& mesh = shell.moving();
    mesh.topology = std::move(order.topology);
    mesh.albedo = in_order(bake.albedo(), order.old_vertex);
    mesh.texture = reordered(bake.texture(), bake.topology(), mesh.topology, order.old_vertex);
    mesh.layout = layout;
    mesh.positions.num_poses = bake.num_poses();
    mesh.root_motion = bake.identity().root_motion;
    mesh.num_following = new_number_of_first(bake.identity().num_following, order.old_vertex);
    if (auto still = still_part(bake, layout.in_bands)) {
        shell.parts.push_back(in_cache_order(std::move(*still)));
    }
    return shell;
}

// Light has some of every band, if little: no band may err without bounds.
std::vector<double> plane_weights(const TransferLayout& layout, const BandPower& spectrum) {
    std::vector<double> weights;
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        weights.push_back(std::max(1e-6, spectrum.weight(layout.input_band(plane))));
    }
    return weights;
}

}  // namespace

EncodeProblem start_problem(const BakeReader& bake, const EncodeOptions& options,
                            const BandPower& spectrum, PositionOutliers outliers, CacheOrder& order,
                            std::shared_ptr<SearchProgress> progress) {
    EncodeProblem problem{.bake = bake,
                          .layout = bake.identity().layout.with_bands(options.bands),
                          .spectrum = spectrum,
                          .statistics = bake.total_statistics(),
                          .progress = std::move(progress)};
    problem.shell = make_shell(bake, options, problem.layout, order);
    for (CodedMesh& part : problem.shell.parts) {
        Texture texture = std::exchange(part.texture, {});
        if (options.textures) problem.textures.push_back(std::move(texture));
    }
    problem.predictor = PlanePredictor(problem.shell.moving().topology);
    problem.plane_weight = plane_weights(problem.layout, problem.spectrum);
    problem.smoother.emplace(problem.shell.moving().topology);
    problem.meter.emplace(problem.shell, 0, bake, outliers);
    if (problem.shell.still() != nullptr) problem.still_meter.emplace(problem.shell, 1, bake);
    problem.num_face_vertices = static_cast<uint32_t>(face_vertices(bake.topology()).size());
    problem.file_outliers = outliers.reordered(order.old_vertex);
    problem.outliers = std::move(outliers);
    return problem;
}

EncodeProblem read_problem(const BakeReader& bake, const EncodeOptions& options,
                           const EncodeTarget& target, std::shared_ptr<SearchProgress> progress) {
    encoders_to_try(target.codec, options.precision);  // checks, before it takes time
    ProblemReader reader(bake, options, target.spectrum, std::move(progress));
    reader.read(target);
    return std::move(reader).take();
}

}  // namespace paim
