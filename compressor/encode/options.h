// What the command line sets about encoding. Plain values: no Eigen, no bake, no algorithm.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "paim/codec/stored_values.h"
#include "paim/metrics/band_power.h"

namespace paim {

// How many components of the geometry or of the transfer to keep.
struct ComponentChoice {
    enum class Kind { automatic, all, number } kind = Kind::automatic;
    uint32_t number = 0;  // if larger than the rank, all are kept
};

// How the bake's noise in the components of the transfer is treated.
enum class NoiseTreatment : uint32_t {
    shrink,  // each component is scaled down by its share of noise (noise/shrinkage.h)
    keep,    // the components stay as the bake has them, with its noise
};

struct EncodeOptions {
    ComponentChoice geometry;
    ComponentChoice transfer;
    // ComponentChoice::Kind::automatic keeps the energy error below these.
    double automatic_geometry_error = 0.01;
    double automatic_transfer_error = 0.01;
    uint32_t bands = std::numeric_limits<uint32_t>::max();  // if more than the bake has, all
    // With Kind::all, components of the transfer are never shrunk.
    NoiseTreatment noise = NoiseTreatment::shrink;
    Precision precision = Precision::f32;
    // The process stays below this. The bytes of the file do not depend on it.
    uint64_t memory_bytes = 1'000'000'000;
    // encode() measures the file and states its errors in it. encode_to_target() always does.
    bool measure = false;
    float frames_per_second = 24.0f;
    std::string name;
    bool textures = true;  // false: images on faces are left out
};

// Which of the files that meet a target is the best.
enum class Preference : uint32_t {
    size,   // the smallest
    speed,  // the one with the fewest multiply-adds per vertex and frame, then the smallest
};

// What a file has to meet. At least one of transfer_error and size_bytes is set.
struct EncodeTarget {
    std::optional<double> transfer_error;  // expected against the truth, relative, 0 … 1
    // Of the positions. Those that are not set follow from the ones above them.
    std::optional<double> geometry_error;    // RMS distance by the diagonal
    std::optional<double> sted;              // of the worst piece, 0 … 1
    std::optional<double> normal_angle_deg;  // mean of the worst piece
    // Error of the worst vertex to the bake, relative to the RMS over vertices; else any is good.
    std::optional<double> vertex_error;
    std::optional<uint64_t> size_bytes;   // of the file, at most
    std::optional<uint32_t> decode_cost;  // multiply-adds per vertex and frame for lit transfer
    // The codec of the transfer, as transfer_encoders() names it (search/transfer_encoder.h);
    // "auto" or empty: the best one. Some code integers alone (EncodeOptions::precision i16).
    std::string codec;
    Preference preference = Preference::size;
    BandPower spectrum = BandPower::flat(1);
};

// Of the diagonal: motion of a vertex up to this RMS distance cannot be seen. It is the geometry
// error that goes with a transfer error of 1 % (below).
constexpr double kInvisibleMotion = 2e-4;

// The geometry error for a transfer error E, if none is asked for: E / 50 of the diagonal. A figure
// that is a thousand pixels high then errs by 0.2 pixels at 1 % and by one pixel at 5 %.
constexpr double kGeometryPerTransferError = 1.0 / 50.0;

// STED and mean angle of face normals for a geometry error G, if none is asked for: 50 G and 5000 G
// degrees. An RMS distance alone allows errors that are as large as the edges of a fine mesh or of a
// small piece, which look like a staircase. At G = 0.1 %, a `--max-error` of 5 %, edges may be off
// by 5 % from their neighbours and faces may turn by 5 degrees.
constexpr double kStedPerGeometryError = 50.0;
constexpr double kNormalDegreesPerGeometryError = 5000.0;
// The largest such targets: a surface with these errors has nothing in common with the original.
constexpr double kLargestSted = 1.0;
constexpr double kLargestNormalAngle_deg = 90.0;

// A number that one codec chooses, by the name that it has in the metadata of files.
struct CodecNumber {
    std::string name;
    uint32_t value = 0;
};

// One way to code the transfer that was tried.
struct Candidate {
    std::string codec;
    uint32_t bands = 0;
    uint32_t components = 0;           // over time
    std::vector<CodecNumber> numbers;  // what else the codec chose
    uint64_t bytes = 0;                // of the transfer, by an estimate
    uint32_t multiply_adds = 0;        // per vertex and frame
    bool chosen = false;

    // The codec's number of this name; 0 if the codec has none of it.
    uint32_t number(std::string_view name) const {
        for (const CodecNumber& one : numbers) {
            if (one.name == name) return one.value;
        }
        return 0;
    }
};

}  // namespace paim
