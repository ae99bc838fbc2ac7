// Measures error curves.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include "analysis/measure.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "paim/base/median.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

// Sums over the poses of one setting.
struct Sums {
    std::vector<ImageError> images;  // [lights]
    std::vector<double> times_ms;    // [poses]
};

// Adds a decoded pose. Planes that it does not have count as zero.
void add_transfer(ArrayError& error, const DecodedPose& decoded, const DecodedPose& baked,
                  uint32_t p) {
    const size_t num_vertices = baked.positions.size() / 3;
    const std::vector<float> zeros(num_vertices, 0.0f);
    for (uint32_t channel = 0; channel < baked.layout.channels; ++channel) {
        for (uint32_t i = 0; i < baked.layout.num_coefficients(); ++i) {
            const auto plane_of = [&](const DecodedPose& pose) {
                return std::span(pose.transfer)
                    .subspan(pose.layout.plane(channel, i) * num_vertices, num_vertices);
            };
            const bool kept = i < decoded.layout.num_coefficients();
            error.add(kept ? plane_of(decoded) : std::span(zeros), plane_of(baked), p);
        }
    }
}

}  // namespace

std::vector<Image> measure_curves(const BakeReader& bake, const Asset& asset, const Stage& stage,
                                  std::vector<Curve>& curves,
                                  const std::function<void()>& on_step) {
    using Clock = std::chrono::steady_clock;
    MeshDecoder decoder(asset.moving());
    const std::vector<uint32_t> counted = face_vertices(bake.topology());
    const PositionOutliers& outliers = stage.outliers();
    const auto positions_of = [&](const DecodedPose& pose, uint32_t p) {
        std::vector<float> planes = pose.positions;
        outliers.replace(p, bake.identity().num_vertices, 0, planes);
        keep_vertices(planes, bake.identity().num_vertices, counted);
        return planes;
    };
    std::vector<CurvePoint*> points;
    for (Curve& curve : curves) {
        for (CurvePoint& point : curve.points) points.push_back(&point);
    }
    std::vector<Sums> sums(points.size(), {std::vector<ImageError>(stage.lights().size()), {}});
    std::vector<Image> first_reference;
    DecodedPose decoded;
    for (const uint32_t p : stage.poses()) {
        BakedPose file = bake.read_pose(p);
        const DecodedPose baked{bake.identity().layout, std::move(file.positions),
                                std::move(file.transfer), root_at(bake.identity().root_motion, p),
                                bake.identity().num_following};
        std::vector<Image> reference = stage.render_pose(baked);
        for (size_t j = 0; j < points.size(); ++j) {
            CurvePoint& point = *points[j];
            // Allocates memory, so that the timed call does not.
            decoder.decode(p, point.limits, decoded);
            const auto start = Clock::now();
            decoder.decode(p, point.limits, decoded);
            sums[j].times_ms.push_back(
                std::chrono::duration<double, std::milli>(Clock::now() - start).count());
            std::vector<Image> images = stage.render_pose(decoded);
            for (size_t light = 0; light < images.size(); ++light) {
                sums[j].images[light].add(compare_images(images[light], reference[light]));
            }
            point.distance.add(positions_of(decoded, p), positions_of(baked, p), p);
            add_transfer(point.transfer, decoded, baked, p);
            if (p == stage.poses().front()) point.images = std::move(images);
            on_step();
        }
        if (p == stage.poses().front()) first_reference = std::move(reference);
    }
    for (size_t j = 0; j < points.size(); ++j) {
        points[j]->decode_ms = median(sums[j].times_ms);
        uint32_t& worst_vertex = points[j]->distance.worst_vertex;
        worst_vertex = counted[worst_vertex];
        for (const ImageError& error : sums[j].images) {
            points[j]->visual_error.push_back(error.visual_error());
        }
    }
    return first_reference;
}

}  // namespace paim
