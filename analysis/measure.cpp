// Measures error curves.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include "analysis/measure.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "paim/codec/mesh_decoder.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/image_error.h"

namespace paim {

void add_transfer(ArrayError& error, const DecodedPose& decoded, const DecodedPose& baked,
                  uint32_t p) {
    const size_t num_vertices = baked.positions.size() / 3;
    const std::vector<float> zeros(num_vertices, 0.0f);
    for (uint32_t channel = 0; channel < baked.layout.channels; ++channel) {
        for (uint32_t i = 0; i < baked.layout.num_coefficients(); ++i) {
            const auto plane_of = [&](const DecodedPose& pose) {
                return std::span(pose.transfer)
                    .subspan(pose.layout.plane(std::min(channel, pose.layout.channels - 1), i) *
                                 num_vertices,
                             num_vertices);
            };
            const bool kept = i < decoded.layout.num_coefficients();
            error.add(kept ? plane_of(decoded) : std::span(zeros), plane_of(baked), p);
        }
    }
}

MeasuredReference measure_curves(const BakeReader& bake, const Asset& asset, const Stage& stage,
                                 const ReferenceSource& reference, std::vector<Curve>& curves,
                                 const std::function<void()>& on_step) {
    MeshDecoder decoder(asset.moving());
    const std::vector<uint32_t> counted = face_vertices(bake.topology());
    const PositionOutliers& outliers = stage.outliers();
    const auto without_outliers = [&](const DecodedPose& pose, uint32_t p) {
        std::vector<float> planes = pose.positions;
        outliers.replace(p, bake.identity().num_vertices, 0, planes);
        return planes;
    };
    const auto positions_of = [&](std::vector<float> planes) {
        keep_vertices(planes, bake.identity().num_vertices, counted);
        return planes;
    };
    const ShapeNeighbours neighbours(bake.topology());
    const size_t num_lights = stage.lights().size();
    std::vector<CurvePoint*> points;
    std::vector<ShapeErrorMeter> shapes;
    for (Curve& curve : curves) {
        for (CurvePoint& point : curve.points) {
            point.seen.resize(num_lights);
            points.push_back(&point);
            shapes.emplace_back(neighbours);
        }
    }
    MeasuredReference measured;
    RelativeNoise noise(num_lights);
    DecodedPose decoded;
    for (const uint32_t p : stage.poses()) {
        const bool is_first = p == stage.poses().front();
        const DecodedPose baked = baked_pose(bake, p, bake.read_pose(p));
        ReferencePictures expected = reference(p, baked);
        noise.add(expected);
        const std::vector<float> baked_planes = without_outliers(baked, p);
        for (size_t j = 0; j < points.size(); ++j) {
            CurvePoint& point = *points[j];
            decoder.decode(p, point.limits, decoded);
            std::vector<Image> pictures = stage.render_pose(decoded);
            for (size_t k = 0; k < pictures.size(); ++k) {
                point.seen[k % num_lights].add(compare_images(pictures[k], expected.pictures[k]), p,
                                               k / num_lights);
            }
            const std::vector<float> planes = without_outliers(decoded, p);
            point.distance.add(positions_of(planes), positions_of(baked_planes), p);
            const ShapeErrorMeter::Pose pose{planes, baked_planes};
            shapes[j].add({&pose, 1});
            add_transfer(point.transfer, decoded, baked, p);
            if (is_first) {
                pictures.resize(num_lights);
                point.images = std::move(pictures);
            }
            on_step();
        }
        if (is_first) {
            expected.pictures.resize(num_lights);
            measured.images = std::move(expected.pictures);
        }
    }
    for (size_t j = 0; j < points.size(); ++j) {
        points[j]->shape = shapes[j].result().whole;
        points[j]->shape.sted_time = 0.0;  // the measured poses do not follow one another
        uint32_t& worst_vertex = points[j]->distance.worst_vertex;
        worst_vertex = counted[worst_vertex];
    }
    measured.noise = noise.relative();
    return measured;
}

void time_curves(const Asset& asset, std::vector<Curve>& curves,
                 const std::function<void()>& on_step) {
    MeshDecoder decoder(asset.moving());
    DecodedPose decoded;
    for (Curve& curve : curves) {
        for (CurvePoint& point : curve.points) {
            point.decode = time_poses(
                asset.num_poses(), [&](uint32_t p) { decoder.decode(p, point.limits, decoded); });
            on_step();
        }
    }
}

}  // namespace paim
