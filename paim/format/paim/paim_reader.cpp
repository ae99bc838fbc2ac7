// Reads .paim files.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "paim/base/error.h"
#include "paim/codec/codecs.h"
#include "paim/codec/section_row.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/metadata.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/prefixes.h"
#include "paim/format/paim/section_reader.h"

namespace paim {

namespace {

// The longest playable prefix that the source has. Error (bad input) if there is none.
Prefix find_prefix(const ContainerReader& reader) {
    const std::vector<Prefix> prefixes = list_prefixes(reader);
    const auto next = std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& prefix) {
        return prefix.size_bytes > reader.file_size_bytes();
    });
    if (next == prefixes.begin()) {
        throw_bad_input("{}: cut short: {} bytes, expected at least the {} that can be played",
                        reader.name(), reader.file_size_bytes(), next->size_bytes);
    }
    return *std::prev(next);
}

void read_channels(const Metadata& metadata, TransferLayout& layout) {
    layout.in_bands = metadata.integer("bands", 1, sh::kMaxBands);
    layout.channels = metadata.integer("channels", 1, 3);
    if (layout.channels == 2) throw_unsupported("{}: 2 transfer channels", metadata.file());
}

TransferLayout read_layout(const Metadata& metadata, TransferKind kind) {
    TransferLayout layout;
    layout.kind = kind;
    read_channels(metadata, layout);
    if (kind == TransferKind::glossy) {
        layout.out_bands = metadata.integer("out_bands", 1, kMaxOutBands);
    }
    return layout;
}

// The names of the kind of transfer that is asked for. Error (unsupported) if the file has another.
const TransferNames& check_kind(const Metadata& metadata, TransferKind kind) {
    const TransferNames& names = kTransferNames[static_cast<size_t>(kind)];
    const std::string name = metadata.text("transfer_kind");
    if (name != names.in_scene && name != names.local && name != names.local_on_floor) {
        throw_unsupported("{}: transfer of kind '{}'", metadata.file(), name);
    }
    return names;
}

VertexOrder read_vertex_order(const Metadata& metadata) {
    if (!metadata.root().contains("vertex_order")) return VertexOrder::baked;
    if (metadata.text("vertex_order") != "local") {
        throw_unsupported("{}: vertices in '{}' order", metadata.file(),
                          metadata.text("vertex_order"));
    }
    return VertexOrder::cache;
}

const TransferCodec& find_codec(const Metadata& metadata) {
    const bool is_named = metadata.root().contains("codec");
    const std::string name = is_named ? metadata.text("codec") : "";
    for (const TransferCodec& codec : transfer_codecs()) {
        const bool is_marked = !codec.marker.empty() && metadata.root().contains(codec.marker);
        if (is_named ? codec.name == name : is_marked) return codec;
    }
    if (is_named) throw_unsupported("{}: transfer of codec '{}'", metadata.file(), name);
    return plain_codec();
}

// The codec that the metadata names, with its numbers.
CodedTransfer start_transfer(const Metadata& metadata) {
    CodedTransfer transfer = find_codec(metadata).make();
    for (const NamedNumber& number : transfer->numbers()) {
        *number.value = metadata.integer(number.name, number.lowest, number.highest);
    }
    return transfer;
}

// A matrix with the dimensions of the file, without values.
// components  the metadata's member with the number of components
// exceptions  the most components of exceptions
LowRank start_matrix(const Metadata& metadata, const char* components, uint32_t num_points,
                     uint32_t num_planes, uint32_t num_poses, uint64_t exceptions) {
    LowRank matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_poses = num_poses;
    // No matrix has more components than columns or rows, but for exceptions.
    const uint64_t most = std::min<uint64_t>(num_poses, matrix.num_rows()) + exceptions;
    matrix.num_components = metadata.integer(components, 0, static_cast<uint32_t>(most));
    return matrix;
}

// A matrix of a mean alone, without values.
LowRank start_still_matrix(uint32_t num_planes, uint32_t num_points) {
    LowRank matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_poses = 1;
    return matrix;
}

// Whether frames are turned, by this member.
bool has_turns(const Metadata& metadata, const char* member) {
    const auto found = metadata.root().find(member);
    if (found == metadata.root().end()) return false;
    if (*found == true) return true;
    throw_bad_input("{}: metadata: '{}': expected true, or no such member", metadata.file(),
                    member);
}

// The gloss of the file's moving part, without values; nothing if it has none.
std::optional<CodedGloss> start_gloss(const Metadata& metadata, uint32_t num_vertices,
                                      uint32_t num_poses) {
    const auto member = metadata.root().find("gloss");
    if (member == metadata.root().end()) return std::nullopt;
    const Metadata part = Metadata::part(*member, metadata.file());
    CodedGloss gloss;
    gloss.layout = read_layout(part, TransferKind::glossy);
    if (num_vertices == 0) throw_bad_input("{}: gloss without vertices", metadata.file());
    gloss.num_rows = part.integer("rows", 1, num_vertices);
    if (has_turns(part, "frame_turns")) gloss.frame_turns = start_still_matrix(3, gloss.num_rows);
    gloss.transfer = start_transfer(part);
    const uint32_t num_points = gloss.transfer->start(gloss.num_rows);
    gloss.transfer->matrix =
        start_matrix(part, "components", num_points, gloss.layout.num_planes(), num_poses, 0);
    return gloss;
}

CodedMesh start_moving(const Metadata& metadata, TransferKind kind) {
    CodedMesh mesh;
    mesh.topology.num_vertices =
        metadata.integer("num_vertices", 0, std::numeric_limits<int32_t>::max());
    mesh.layout = read_layout(metadata, kind);
    const TransferNames& names = check_kind(metadata, kind);
    const uint32_t num_poses = metadata.integer("num_poses", 1, kMaxPoses);
    mesh.positions = start_matrix(metadata, "geometry_components", mesh.topology.num_vertices, 3,
                                  num_poses, uint64_t{kExceptionsPerPose} * num_poses);
    if (metadata.root().contains("geometry_fraction_bits")) {
        mesh.positions.fraction_bits = metadata.integer("geometry_fraction_bits", 2, 4);
    }
    // 64 MB at most, which every file may claim (kMaxFreeBytes).
    const std::string name = metadata.text("transfer_kind");
    if (name != names.in_scene) mesh.root_motion.resize(num_poses);
    if (name == names.local_on_floor) {
        mesh.num_following =
            metadata.integer("num_following", 0, std::max(1u, mesh.topology.num_vertices) - 1);
    }
    mesh.transfer = start_transfer(metadata);
    const uint32_t num_points = mesh.transfer->start(mesh.topology.num_vertices);
    mesh.transfer->matrix = start_matrix(metadata, "transfer_components", num_points,
                                         mesh.layout.num_planes(), num_poses, 0);
    mesh.gloss = start_gloss(metadata, mesh.topology.num_vertices, num_poses);
    return mesh;
}

bool has_still_part(const ContainerReader& reader) {
    const Tag tags[] = {section::kStillTriangles, section::kStillPositions, section::kStillAlbedo,
                        section::kStillTransfer};
    return std::any_of(std::begin(tags), std::end(tags),
                       [&](Tag tag) { return reader.find(tag) != nullptr; });
}

CodedMesh start_still(const ContainerReader& reader, const Metadata& metadata,
                      const CodedMesh& moving) {
    CodedMesh mesh;
    mesh.layout = moving.layout;
    mesh.topology.num_vertices = count_vertices(reader, section::kStillPositions);
    const uint32_t num_vertices = mesh.topology.num_vertices;
    mesh.positions = start_still_matrix(3, num_vertices);
    mesh.transfer = plain_transfer(start_still_matrix(mesh.layout.num_planes(), num_vertices));
    if (!moving.gloss) return mesh;
    const Metadata part = Metadata::part(metadata.root()["gloss"], metadata.file());
    if (!part.root().contains("still_rows")) return mesh;
    CodedGloss& gloss = mesh.gloss.emplace();
    gloss.layout = moving.gloss->layout;
    gloss.num_rows = part.integer("still_rows", 1, num_vertices);
    gloss.transfer = plain_transfer(start_still_matrix(gloss.layout.num_planes(), gloss.num_rows));
    if (has_turns(part, "still_frame_turns")) {
        gloss.frame_turns = start_still_matrix(3, gloss.num_rows);
    }
    return mesh;
}

void read_indices(const Metadata& metadata, Attribute attribute, uint32_t num_components,
                  LowRank& matrix) {
    matrix.singular_indices =
        read_singular_indices(metadata, attribute, num_components, matrix.singular_values.size());
    // Only those of the components that the file has.
    if (!matrix.singular_indices.empty()) matrix.singular_indices.resize(matrix.num_components);
}

ContainerReader open(std::shared_ptr<const ByteSource> source, const std::string& name,
                     const ReadOptions& options) {
    return {std::make_shared<FirstBytes>(std::move(source), options.most_bytes), name,
            section::kKindAnimation, options.prefix ? Extent::prefix : Extent::whole};
}

// Error (bad input) if a vertex of a floor's face is glossy: light of gloss is in the axes of the body.
void check_matte_floor(const CodedMesh& mesh, const std::string& file) {
    if (!mesh.gloss || mesh.num_following >= mesh.topology.num_vertices) return;
    std::vector<bool> is_row(mesh.topology.num_vertices, mesh.gloss->vertices.empty());
    for (const uint32_t v : mesh.gloss->vertices) is_row[v] = true;
    const std::vector<Triangle>& faces = mesh.topology.triangles;
    for (size_t f = mesh.topology.num_triangles_before(mesh.num_following); f < faces.size(); ++f) {
        for (const uint32_t v : faces[f]) {
            if (is_row[v]) throw_bad_input("{}: vertex {} of the floor has gloss", file, v);
        }
    }
}

Asset read_asset(const ContainerReader& reader, TransferKind kind) {
    const Prefix prefix = find_prefix(reader);
    const Metadata metadata(reader.read_text(reader.require(section::kMetadata, ScalarType::u8)),
                            reader.name());
    Asset asset;
    asset.frames_per_second = static_cast<float>(metadata.number("frames_per_second", 1e-3, 1e6));
    asset.origin = metadata.point("origin");
    asset.name = metadata.text("name");
    asset.provenance_json = metadata.object_text("provenance");
    asset.vertex_order = read_vertex_order(metadata);
    asset.moving() = start_moving(metadata, kind);
    if (has_still_part(reader)) {
        asset.parts.push_back(start_still(reader, metadata, asset.moving()));
    }
    ComponentCounts of_file{};
    for (const Attribute which : asset.moving().attributes()) {
        of_file[static_cast<size_t>(which)] = asset.moving().attribute(which).num_components;
    }
    read_sections(reader,
                  {prefix.geometry_components, prefix.transfer_components, prefix.gloss_components},
                  asset);
    check_floor(asset.moving().topology, asset.moving().num_following, reader.name());
    check_matte_floor(asset.moving(), reader.name());
    asset.complete = true;
    for (const Attribute which : asset.moving().attributes()) {
        LowRank& matrix = asset.moving().attribute(which);
        const uint32_t num_components = of_file[static_cast<size_t>(which)];
        const bool of_gloss = which == Attribute::gloss;
        read_indices(
            of_gloss ? Metadata::part(metadata.root()["gloss"], metadata.file()) : metadata, which,
            num_components, matrix);
        asset.complete = asset.complete && matrix.num_components == num_components;
    }
    return asset;
}

}  // namespace

Asset read_paim(const std::filesystem::path& path, const ReadOptions& options) {
    if (std::filesystem::is_directory(path)) {
        throw_bad_input(
            "{}: is a directory, expected a .paim file (paim-compress encode makes one of a .bake)",
            path.string());
    }
    return read_asset(open(std::make_shared<FileSource>(path), path.string(), options),
                      options.kind);
}

Asset read_paim(std::span<const uint8_t> bytes, const std::string& name,
                const ReadOptions& options) {
    return read_asset(open(std::make_shared<MemorySource>(bytes), name, options), options.kind);
}

}  // namespace paim
