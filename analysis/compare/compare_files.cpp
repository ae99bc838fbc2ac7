// Several .paim files of one bake side by side.
#include "analysis/compare/compare_files.h"

#include <memory>
#include <utility>

#include "analysis/bake_file.h"
#include "analysis/file_poses.h"
#include "analysis/frame_time.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

constexpr double kMostSeconds = 2.0;  // for the time of a frame

}  // namespace

size_t compare_steps(size_t num_files, const BakeReader& bake, const Stage& stage) {
    return num_files * (2 + bake.num_poses()) + stage.poses().size() * num_files;
}

FileComparison compare_files(const std::vector<std::filesystem::path>& paths,
                             const BakeReader& bake, const Stage& stage,
                             const ReferenceSource& reference,
                             const std::function<void()>& on_step) {
    const size_t num_lights = stage.lights().size();
    FileComparison comparison;
    std::vector<std::shared_ptr<const Asset>> assets;
    std::vector<std::unique_ptr<FilePoses>> poses;
    for (const std::filesystem::path& path : paths) {
        assets.push_back(std::make_shared<const Asset>(read_file_of(bake, path)));
        poses.push_back(std::make_unique<FilePoses>(*assets.back(), bake));
        static_cast<FileCosts&>(comparison.files.emplace_back()) = costs_of(path, *assets.back());
        comparison.files.back().seen.resize(num_lights);
    }
    const BandPower flat = BandPower::flat(bake.identity().layout.in_bands);
    for (size_t j = 0; j < paths.size(); ++j) {
        ComparedFile& file = comparison.files[j];
        file.error = measure_asset(*assets[j], bake, flat);
        on_step();
        file.frame = time_frames(assets[j], stage.lights().front().coefficients, kMostSeconds);
        on_step();
        file.flicker = measure_flicker(bake, *poses[j], stage, on_step);
    }
    RelativeNoise noise(num_lights);
    for (const uint32_t p : stage.poses()) {
        const bool is_first = p == stage.poses().front();
        ReferencePictures expected = reference(p, baked_pose(bake, p, bake.read_pose(p)));
        noise.add(expected);
        for (size_t j = 0; j < paths.size(); ++j) {
            const DecodedPose* const still = poses[j]->still();
            std::vector<Image> pictures = stage.render_pose(poses[j]->pose(p), still);
            for (size_t k = 0; k < pictures.size(); ++k) {
                comparison.files[j].seen[k % num_lights].add(
                    compare_images(pictures[k], expected.pictures[k]), p, k / num_lights);
            }
            if (is_first) {
                pictures.resize(num_lights);
                comparison.files[j].images = std::move(pictures);
            }
            on_step();
        }
        if (is_first) {
            expected.pictures.resize(num_lights);
            comparison.reference = std::move(expected.pictures);
        }
    }
    comparison.reference_noise = noise.relative();
    return comparison;
}

}  // namespace paim
