// Error of the change from pose to pose.
#include "analysis/temporal/flicker.h"

#include <limits>
#include <utility>

namespace paim {

namespace {

using Radiance = std::vector<std::vector<Vec3f>>;  // [lights][V + S]

double ratio(double error, double reference) {
    if (reference > 0.0) return error / reference;
    return error > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

void add_step(const std::vector<Vec3f> baked[2], const std::vector<Vec3f> decoded[2],
              const std::vector<Vec3f> noise[2], Flicker& flicker) {
    double error = 0.0, change = 0.0, radiance = 0.0;
    for (size_t v = 0; v < baked[0].size(); ++v) {
        const Vec3d step = baked[1][v].cast<double>() - baked[0][v].cast<double>();
        const Vec3d decoded_step = decoded[1][v].cast<double>() - decoded[0][v].cast<double>();
        error += (decoded_step - step).cwiseAbs().sum();
        change += step.cwiseAbs().sum();
        flicker.noise_sum +=
            (noise[1][v].cast<double>() - noise[0][v].cast<double>()).cwiseAbs().sum();
        radiance += baked[1][v].cast<double>().cwiseAbs().sum();
    }
    flicker.error_sum += error;
    flicker.change_sum += change;
    flicker.radiance_sum += radiance;
    flicker.of_step.push_back(radiance > 0.0 ? error / radiance
                                             : std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

double Flicker::of_change() const {
    if (of_step.empty()) return std::numeric_limits<double>::quiet_NaN();
    return ratio(error_sum, change_sum);
}

double Flicker::of_radiance() const {
    return radiance_sum > 0.0 ? error_sum / radiance_sum : std::numeric_limits<double>::quiet_NaN();
}

double Flicker::noise_of_change() const {
    if (of_step.empty()) return std::numeric_limits<double>::quiet_NaN();
    return ratio(noise_sum, change_sum);
}

std::vector<Flicker> measure_flicker(const BakeReader& bake, FilePoses& file, const Stage& stage,
                                     const std::function<void()>& on_pose) {
    const size_t num_lights = stage.lights().size();
    const DecodedPose* const still = file.still();
    std::vector<Flicker> flickers(num_lights);
    Radiance last_baked, last_decoded, last_noise;
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        BakedPose pose = bake.read_pose(p);
        BakedPose only_noise = pose;
        only_noise.transfer = std::move(only_noise.noise);
        Radiance baked = stage.light(baked_pose(bake, p, std::move(pose)));
        Radiance noise = stage.light(baked_pose(bake, p, std::move(only_noise)));
        Radiance decoded = stage.light(file.pose(p), still);
        for (size_t light = 0; light < num_lights && p > 0; ++light) {
            const std::vector<Vec3f> of_bake[2] = {std::move(last_baked[light]), baked[light]};
            const std::vector<Vec3f> of_file[2] = {std::move(last_decoded[light]), decoded[light]};
            const std::vector<Vec3f> of_noise[2] = {std::move(last_noise[light]), noise[light]};
            add_step(of_bake, of_file, of_noise, flickers[light]);
        }
        last_baked = std::move(baked);
        last_decoded = std::move(decoded);
        last_noise = std::move(noise);
        on_pose();
    }
    for (Flicker& flicker : flickers) {
        double worst = 0.0;
        for (uint32_t p = 0; p < flicker.of_step.size(); ++p) {
            if (!(flicker.of_step[p] > worst)) continue;
            worst = flicker.of_step[p];
            flicker.worst_step = p;
        }
    }
    return flickers;
}

}  // namespace paim
