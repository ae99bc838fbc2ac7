// Pictures of a .paim as it is played, without its bake.
#include "analysis/compare/played_pictures.h"

#include <algorithm>
#include <utility>

#include "paim/codec/sequence_bounds.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/unit_scale.h"
#include "paim/render/render.h"

namespace paim {

PlayedViews::PlayedViews(const Asset& asset, const StageOptions& options)
    : size_pixels_(options.size_pixels) {
    Bounds bounds = sequence_bounds(asset);
    const float largest = bounds.empty() ? 0.0f
                                         : std::max(bounds.lower.cwiseAbs().maxCoeff(),
                                                    bounds.upper.cwiseAbs().maxCoeff());
    scale_ = unit_scale(static_cast<double>(largest));
    bounds.lower *= scale_;
    bounds.upper *= scale_;
    for (uint32_t view = 0; view < options.num_views; ++view) {
        const double azimuth = options.azimuth_rad + 2.0 * kPi * view / options.num_views;
        cameras_.push_back(frame_bounds(bounds, 1.0f, static_cast<float>(azimuth),
                                        static_cast<float>(options.elevation_rad)));
    }
}

PlayedPictures::PlayedPictures(std::shared_ptr<const Asset> asset, const PlayedViews& views,
                               const std::vector<NamedLight>& lights)
    : views_(views), lights_(lights), playback_(std::move(asset)) {
    for (const CodedMesh& part : playback_.asset().parts) topology_.append(part.topology);
}

std::vector<Vec3f> PlayedPictures::positions() const {
    std::vector<Vec3f> all;
    for (size_t part = 0; part < playback_.num_parts(); ++part) {
        for (const Vec3f& position : from_planes(playback_.positions(part))) {
            all.emplace_back(views_.scale() * position);
        }
    }
    return all;
}

std::vector<Vec3f> PlayedPictures::radiance() const {
    std::vector<Vec3f> all;
    for (size_t part = 0; part < playback_.num_parts(); ++part) {
        const std::span<const Vec3f> of_part = playback_.radiance(part);
        all.insert(all.end(), of_part.begin(), of_part.end());
    }
    return all;
}

std::vector<Image> PlayedPictures::at(double time) {
    std::vector<std::vector<std::vector<Vec3f>>> seen(views_.num_views());  // [views][lights][V]
    for (const NamedLight& light : lights_) {
        playback_.set_light(DistantLight(light.coefficients));
        for (size_t view = 0; view < seen.size(); ++view) {
            playback_.set_eye(Vec3f(views_.cameras()[view].eye / views_.scale()));
            playback_.update(time);
            seen[view].push_back(radiance());
        }
    }
    const std::vector<Vec3f> places = positions();
    std::vector<Image> pictures;
    for (size_t view = 0; view < seen.size(); ++view) {
        for (Image& image : render_images(topology_, places, seen[view], views_.cameras()[view],
                                          views_.size_pixels(), views_.size_pixels())) {
            pictures.push_back(std::move(image));
        }
    }
    return pictures;
}

}  // namespace paim
