// A .bake directory becomes a .paim file.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry, 2012
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>

#include "paim/codec/model.h"
#include "paim/format/bake_directory.h"

namespace paim {

// How many components to keep.
struct ComponentChoice {
    enum class Kind { automatic, all, number } kind = Kind::automatic;
    uint32_t number = 0;  // more than there are means all
};

struct EncodeOptions {
    ComponentChoice geometry;
    ComponentChoice transfer;
    // What `automatic` keeps the energy error below.
    double automatic_geometry_error = 0.01;
    double automatic_transfer_error = 0.01;
    uint32_t bands = std::numeric_limits<uint32_t>::max();  // more than the bake has means all
    Precision precision = Precision::f32;
    uint64_t memory_bytes =
        1'000'000'000;  // that the process stays below; the bytes do not depend on it
    float frames_per_second = 24.0f;
    std::string name;
};

struct EncodeSummary {
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    uint32_t geometry_rank = 0;
    uint32_t transfer_rank = 0;
    uint32_t bands = 0;
    double geometry_theory_error = 0.0;  // E5
    double transfer_theory_error = 0.0;
    double geometry_energy_error = 0.0;  // √(Σ dropped s² / Σ s²)
    double transfer_energy_error = 0.0;
    uint64_t size_bytes = 0;
};

// The components that a choice keeps of this spectrum, at most `rank`.
uint32_t choose_components(const ComponentChoice& choice, std::span<const double> singular_values,
                           uint32_t rank, double automatic_energy_error);

// Rows that encode() reads: every one twice.
uint64_t num_rows_to_read(const BakeReader& bake, const EncodeOptions& options);

// Error (unsupported), saying what is needed, if this bake cannot be encoded in options.memory_bytes.
void check_memory(const BakeReader& bake, const EncodeOptions& options);

// Encodes and writes, all or nothing. Memory grows with P² and the topology, not with V · P.
// bake     verified (BakeReader::verify_all)
// on_rows  called with a number of rows whenever they have been read, from any thread
// Errors: unsupported as check_memory(); bad input for a bake that changes meanwhile; output failed.
EncodeSummary encode(const BakeReader& bake, const EncodeOptions& options,
                     const std::filesystem::path& output,
                     const std::function<void(uint64_t)>& on_rows = {});

}  // namespace paim
