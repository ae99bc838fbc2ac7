// What a .paim takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "analysis/stable_time.h"
#include "paim/codec/asset.h"

namespace paim {

struct FileCosts {
    std::filesystem::path path;
    std::string codec;
    uint32_t bands = 0;
    uint32_t geometry_components = 0, transfer_components = 0;
    uint64_t size_bytes = 0;
    double bits_per_vertex_per_pose = 0.0;
    // Of the lit transfer and of the positions, per vertex and frame, and on the CPU once a frame.
    uint64_t multiply_adds = 0, position_multiply_adds = 0, cpu_multiply_adds = 0;
    PoseTime frame;  // positions and radiance of a frame on the CPU
};

// All but the time of a frame, which is left to be measured.
FileCosts costs_of(const std::filesystem::path& path, const Asset& asset);

}  // namespace paim
