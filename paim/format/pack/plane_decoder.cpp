// Decodes planes of small integers. plane_encoder.cpp describes the contents of a frame.
#include "paim/format/pack/plane_decoder.h"

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/format/pack/packed_plane.h"
#include "paim/format/pack/plane_reconstruct.h"
#include "paim/format/pack/zstd_decoder.h"

namespace paim {

namespace {

// Largest number of bytes of a value: one for its symbol and three for its escape.
constexpr uint64_t kMaxBytesPerValue = 4;

// Reads a header. Returns false if it is not valid.
bool parse_header(const uint8_t* bytes, size_t num_points, bool has_mesh, PlaneHeader& header) {
    header.prediction = static_cast<Prediction>(bytes[0] & 3u);
    header.wide = (bytes[0] & 4u) != 0;
    header.magnitude = bytes[1];
    header.num_escapes = 0;
    for (int j = 0; j < 4; ++j) header.num_escapes |= uint32_t{bytes[2 + j]} << (8 * j);
    return bytes[0] < 8 && header.prediction <= Prediction::parallelograms &&
           (header.prediction == Prediction::none || has_mesh) &&
           std::find(kMagnitudes.begin(), kMagnitudes.end(), header.magnitude) !=
               kMagnitudes.end() &&
           header.num_escapes <= num_points;
}

// Splits the contents of a section's frame into planes. Returns false if they are not valid.
template <typename Integer>
bool parse(std::span<const uint8_t> contents, const StoredPlanes<Integer>& section, bool has_mesh,
           std::vector<PlaneSource<Integer>>& planes) {
    const size_t num_points = section.out.size() / section.num_planes;
    const size_t first = planes.size();
    for (size_t j = 0; j < section.num_planes; ++j) {
        PlaneSource<Integer> plane;
        if (!parse_header(contents.data() + kPlaneHeaderBytes * j, num_points, has_mesh,
                          plane.header)) {
            return false;
        }
        plane.out = section.out.data() + j * num_points;
        planes.push_back(plane);
    }
    const std::span mine = std::span(planes).subspan(first);
    size_t place = kPlaneHeaderBytes * section.num_planes;
    const auto take = [&](size_t num_bytes, const uint8_t*& bytes) {
        if (num_bytes > contents.size() - place) return false;
        bytes = contents.data() + place;
        place += num_bytes;
        return true;
    };
    for (const uint8_t magnitude : kMagnitudes) {
        for (PlaneSource<Integer>& plane : mine) {
            if (plane.header.magnitude == magnitude &&
                !take(symbol_bytes(magnitude, num_points), plane.symbols)) {
                return false;
            }
        }
    }
    for (PlaneSource<Integer>& plane : mine) {
        if (!take(plane.header.num_escapes, plane.gaps)) return false;
    }
    for (PlaneSource<Integer>& plane : mine) {
        if (!take(plane.header.num_escapes, plane.lows)) return false;
    }
    for (PlaneSource<Integer>& plane : mine) {
        if (plane.header.wide && !take(plane.header.num_escapes, plane.highs)) return false;
    }
    return place == contents.size();
}

}  // namespace

template <typename Integer>
bool decode_planes(std::span<const StoredPlanes<Integer>> sections, const PlanePredictor& predictor,
                   Workspace& workspace) {
    size_t num_points = 0, num_bytes = 0;
    for (const StoredPlanes<Integer>& section : sections) {
        PAIM_CHECK(section.num_planes > 0);
        num_points = section.out.size() / section.num_planes;
        PAIM_CHECK_EQ(num_points * section.num_planes, section.out.size());
        PAIM_CHECK_EQ(num_points * sections[0].num_planes, sections[0].out.size());
        const uint64_t least = kPlaneHeaderBytes * uint64_t{section.num_planes};
        const uint64_t most = least + kMaxBytesPerValue * uint64_t{section.out.size()};
        const auto size = zstd_content_size(section.bytes);
        if (!size || *size > most || *size < least) return false;
        num_bytes += *size;
    }
    auto* contents = reinterpret_cast<uint8_t*>(workspace.contents.resize(num_bytes));
    std::vector<PlaneSource<Integer>> planes;
    for (const StoredPlanes<Integer>& section : sections) {
        const std::span some(contents, *zstd_content_size(section.bytes));
        if (!zstd_decompress(section.bytes, some) ||
            !parse(std::span<const uint8_t>(some), section, predictor.has_mesh(), planes)) {
            return false;
        }
        contents += some.size();
    }
    return reconstruct_planes(std::span(planes), predictor, num_points, workspace.rows);
}

template bool decode_planes(std::span<const StoredPlanes<int8_t>>, const PlanePredictor&,
                            Workspace&);
template bool decode_planes(std::span<const StoredPlanes<int16_t>>, const PlanePredictor&,
                            Workspace&);

}  // namespace paim
