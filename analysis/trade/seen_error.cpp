// What only playing a file shows.
#include "analysis/trade/seen_error.h"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "analysis/file_poses.h"
#include "analysis/frame_time.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

using ReferenceImages = std::vector<std::vector<Image>>;  // [poses][pictures]

// The largest that is a number.
double largest_seen(const std::vector<ImageError>& errors) {
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (const ImageError& error : errors) largest = std::fmax(largest, error.visual_error());
    return largest;
}

double visual_error(const Asset& asset, const BakeReader& bake, const Stage& stage,
                    const ReferenceImages& references) {
    FilePoses poses(asset, bake);
    const DecodedPose* const still = poses.still();
    std::vector<ImageError> errors(stage.lights().size());
    for (size_t j = 0; j < references.size(); ++j) {
        const std::vector<Image> pictures = stage.render_pose(poses.pose(stage.poses()[j]), still);
        for (size_t k = 0; k < pictures.size(); ++k) {
            errors[k % errors.size()].add(compare_images(pictures[k], references[j][k]));
        }
    }
    return largest_seen(errors);
}

}  // namespace

PlayFile play_on_stage(const BakeReader& bake, const Stage& stage, const ReferenceSource& reference,
                       std::vector<double>& noise) {
    RelativeNoise relative(stage.lights().size());
    auto references = std::make_shared<ReferenceImages>();
    for (const uint32_t p : stage.poses()) {
        ReferencePictures pictures = reference(p, baked_pose(bake, p, bake.read_pose(p)));
        relative.add(pictures);
        references->push_back(std::move(pictures.pictures));
    }
    noise = relative.relative();
    return [&bake, &stage, references = std::move(references)](const Asset& asset) {
        const PoseTime frame = time_frames(std::make_shared<const Asset>(asset),
                                           stage.lights().front().coefficients, kQuickSeconds);
        return PlayedFile{visual_error(asset, bake, stage, *references), frame.median_ms};
    };
}

}  // namespace paim
