// How long a frame of an asset takes on the CPU.
#include "analysis/frame_time.h"

#include "paim/codec/playback.h"

namespace paim {

PoseTime time_frames(const std::shared_ptr<const Asset>& asset, const LightCoefficients& light,
                     double most_seconds) {
    Playback playback(asset);
    playback.keep_exit_radiance(true);
    const DistantLight distant(light);
    const auto frame = [&](uint32_t p) {
        playback.set_light(distant);  // else a single pose would be no work
        playback.update(p);
    };
    return time_poses(asset->num_poses(), frame, most_seconds);
}

}  // namespace paim
