// How many rays a bake gets where --max-error decides.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "compressor/encode/search/problem.h"

namespace paim {

// Rays of the pilot bake of a sequence, whose noise tells how many the bake for this error needs:
// about a quarter of what is usual, and no fewer than noise can be judged by.
uint32_t pilot_rays(double transfer_error);

// The rays of a bake that is there with at least one pose; nothing otherwise. Error (bad input): its
// manifest is damaged.
std::optional<uint32_t> rays_of_begun_bake(const std::filesystem::path& directory);

// Removes a bake that is there without poses if it has other rays.
void remove_bake_of_other_rays(const std::filesystem::path& directory, uint32_t rays);

// Whether a directory with files that is no bake is there, into which nothing is baked.
bool is_foreign_directory(const std::filesystem::path& directory);

// How often a sequence is baked until its noise allows the error, the pilot not counted.
constexpr int kMaxBakes = 4;

// What is said before the bake: the rays, and the pilot's errors for which they were chosen.
std::string chosen_rays_note(uint32_t rays, uint32_t pilot_rays, const EncodeTarget& target,
                             const EncodeProblem& pilot);

}  // namespace paim
