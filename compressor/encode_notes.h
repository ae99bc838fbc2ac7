// What paim-compress says on stderr about an encoding, where a person may not expect its result.
#pragma once

#include "compressor/encode/options.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// That errors of the transfer mean nothing, if it is zero.
void say_if_dark(const BakeReader& reader);

// That the bake has fewer bands than were asked for.
void say_if_fewer_bands(const EncodeOptions& asked, const BakeReader& reader);

void say_more_rays_help();

// That an error of the gloss was given in vain, and why.
void say_gloss_error_is_unused(const char* why);

// That still meshes have gloss that is not encoded, and that an error of the gloss is not used.
// reader          of poses without gloss
// asks_for_gloss  whether an error of the gloss was given
void say_if_without_gloss(bool asks_for_gloss, const BakeReader& reader);

}  // namespace paim
