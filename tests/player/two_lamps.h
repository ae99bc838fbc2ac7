// A light with colour and direction.
#pragma once

#include "paim/light/environment.h"

namespace paim::player {

// A red light from +X and a blue one from −Z.
inline Image make_two_lamps() {
    Image image(64, 32, Vec3f::Constant(0.1f));
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            const Vec3d w = direction_from_latlong((x + 0.5) / 64, (y + 0.5) / 32);
            if (w.x() > 0.8) image.at(x, y) += Vec3f(9, 1, 1);
            if (w.z() < -0.7) image.at(x, y) += Vec3f(1, 2, 8);
        }
    }
    return image;
}

}  // namespace paim::player
