// The manifest of a .bake directory.
#include "paim/format/bake/bake_manifest.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/base/json_text.h"
#include "paim/codec/asset.h"
#include "paim/format/container/metadata.h"
#include "paim/format/container/root_numbers.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

constexpr uint32_t kManifestVersion = 2;
// With a root motion, and with one that not all vertices follow, so that readers which know nothing
// of it refuse the bake.
constexpr uint32_t kRootMotionVersion = 3;
constexpr uint32_t kFollowingVersion = 4;
// With glossy transfer; root motion and vertices that do not follow it are there or not.
constexpr uint32_t kGlossVersion = 5;
constexpr uint32_t kMaxCount = std::numeric_limits<int32_t>::max();
constexpr uint64_t kMaxSizeBytes = 64 << 20;

// 64-bit numbers are 16 hexadecimal digits, because JSON readers may round numbers.
std::string hex(uint64_t value) {
    return fmt::format("{:016x}", value);
}

uint64_t parse_hex(const std::string& text, const std::string& file, const char* what) {
    uint64_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != 16 || failure != std::errc() || end != text.data() + text.size()) {
        throw_bad_input("{}: '{}': expected 16 hexadecimal digits, got '{}'", file, what, text);
    }
    return value;
}

std::string shown(const Vec3d& point) {
    return fmt::format("({}, {}, {})", point.x(), point.y(), point.z());
}

std::string shown(const RootMotion& motion) {
    if (motion.empty()) return "none";
    const std::vector<double> numbers = root_numbers(motion);
    const uint64_t checksum = xxh3(numbers.data(), numbers.size() * sizeof(double));
    return fmt::format("one of checksum {}", hex(checksum));
}

std::string count_or_all(uint32_t count) {
    return count == kAllVertices ? "all" : std::to_string(count);
}

// The first difference of two lists of the same length, in words; empty if there is none.
std::string first_difference(const char* what, const std::vector<BakeIdentity::Source>& there,
                             const std::vector<BakeIdentity::Source>& wanted) {
    for (size_t j = 0; j < wanted.size(); ++j) {
        if (there[j] == wanted[j]) continue;
        return fmt::format("{} {}: {} ({}) there, {} ({}) asked for", what, j, there[j].name,
                           hex(there[j].xxh3), wanted[j].name, hex(wanted[j].xxh3));
    }
    return {};
}

uint32_t manifest_version(const BakeIdentity& identity) {
    if (identity.gloss) return kGlossVersion;
    if (identity.root_motion.empty()) return kManifestVersion;
    return identity.num_following == kAllVertices ? kRootMotionVersion : kFollowingVersion;
}

ordered_json gloss_json(const GlossIdentity& gloss) {
    ordered_json json;
    json["bands"] = gloss.layout.in_bands;
    json["out_bands"] = gloss.layout.out_bands;
    json["channels"] = gloss.layout.channels;
    for (const GlossMaterial& material : gloss.materials) {
        const Vec3f& tint = material.tint;
        json["materials"].push_back(
            {{"brdf", material.brdf}, {"tint", {tint.x(), tint.y(), tint.z()}}});
    }
    return json;
}

GlossIdentity parse_gloss(const nlohmann::json& member, const std::string& file) {
    if (!member.is_object()) throw_bad_input("{}: 'gloss': expected an object", file);
    const Metadata metadata = Metadata::part(member, file);
    GlossIdentity gloss;
    gloss.layout.kind = TransferKind::glossy;
    gloss.layout.in_bands = metadata.integer("bands", 1, sh::kMaxBands);
    gloss.layout.out_bands = metadata.integer("out_bands", 1, kMaxOutBands);
    gloss.layout.channels = metadata.integer("channels", 1, 3);
    if (gloss.layout.channels == 2) throw_unsupported("{}: 2 channels of gloss", file);
    const auto materials = metadata.root().find("materials");
    if (materials == metadata.root().end() || !materials->is_array() || materials->empty() ||
        materials->size() > kMaxGlossMaterials) {
        throw_bad_input("{}: 'gloss': expected a list of 1 to {} materials", file,
                        kMaxGlossMaterials);
    }
    for (const nlohmann::json& entry : *materials) {
        const Metadata material = Metadata::part(entry, file);
        const std::vector<double> tint = material.numbers("tint", 3, 0.0, 1.0);
        gloss.materials.push_back(
            {material.text("brdf"), Vec3d(tint[0], tint[1], tint[2]).cast<float>()});
    }
    return gloss;
}

std::string shown(const std::optional<GlossIdentity>& gloss) {
    if (!gloss) return "none";
    std::string text = fmt::format("{} bands in, {} out, {} channels", gloss->layout.in_bands,
                                   gloss->layout.out_bands, gloss->layout.channels);
    for (const auto& [brdf, tint] : gloss->materials) {
        text += fmt::format(", {} of tint ({}, {}, {})", brdf, tint.x(), tint.y(), tint.z());
    }
    return text;
}

}  // namespace

std::string as_manifest_text(const std::string& text) {
    const std::string dumped = json_text(ordered_json(text));
    return ordered_json::parse(dumped).get<std::string>();
}

std::string manifest_text(const BakeIdentity& identity) {
    ordered_json json;
    json["format"] = "paim-bake";
    json["version"] = manifest_version(identity);
    json["baker"] = identity.baker;
    json["transfer_kind"] = "diffuse";
    json["bands"] = identity.layout.in_bands;
    json["channels"] = identity.layout.channels;
    json["sampler"] = identity.sampler;
    json["streams"] = identity.streams;
    json["rays"] = identity.rays;
    json["transfer_error"] = identity.transfer_error;
    json["seed"] = hex(identity.seed);
    json["normals"] = identity.normals;
    if (identity.bounces > 0) json["bounces"] = identity.bounces;
    if (!identity.floor.empty()) json["floor"] = identity.floor;
    if (identity.gloss) json["gloss"] = gloss_json(*identity.gloss);
    json["num_vertices"] = identity.num_vertices;
    if (identity.num_following != kAllVertices && !identity.root_motion.empty()) {
        json["num_following"] = identity.num_following;
    }
    json["num_triangles"] = identity.num_triangles;
    json["mesh_xxh3"] = hex(identity.mesh_xxh3);
    // JSON numbers are written with enough digits to read the same double.
    if (const Vec3d& o = identity.origin; !o.isZero(0.0)) json["origin"] = {o.x(), o.y(), o.z()};
    ordered_json poses = ordered_json::array();
    for (const auto& pose : identity.poses) {
        poses.push_back({{"name", pose.name}, {"xxh3", hex(pose.xxh3)}});
    }
    const std::vector<double> root = root_numbers(identity.root_motion);
    for (size_t p = 0; p * kRootNumbers < root.size(); ++p) {
        const auto first = root.begin() + static_cast<ptrdiff_t>(p * kRootNumbers);
        poses[p]["root"] = std::vector<double>(first, first + kRootNumbers);
    }
    json["poses"] = std::move(poses);
    for (const auto& source : identity.still_meshes) {
        json["static"].push_back({{"name", source.name}, {"xxh3", hex(source.xxh3)}});
    }
    return json_text(json, 2) + "\n";
}

BakeIdentity parse_manifest(std::string_view text, const std::string& file) {
    const Metadata metadata(text, file);
    if (metadata.text("format") != "paim-bake") throw_bad_input("{}: not a bake's manifest", file);
    const uint32_t version = metadata.integer("version", 1, kMaxCount);
    if (version < kManifestVersion || version > kGlossVersion) {
        throw_unsupported("{}: bake version {}, expected {} to {}", file, version, kManifestVersion,
                          kGlossVersion);
    }
    if (metadata.text("transfer_kind") != "diffuse") {
        throw_unsupported("{}: transfer of kind '{}'", file, metadata.text("transfer_kind"));
    }
    BakeIdentity identity;
    identity.layout.in_bands = metadata.integer("bands", 1, sh::kMaxBands);
    identity.layout.channels = metadata.integer("channels", 1, 3);
    if (identity.layout.channels == 2) throw_unsupported("{}: 2 transfer channels", file);
    identity.baker = metadata.integer("baker", 0, kMaxCount);
    identity.rays = metadata.integer("rays", 1, kMaxCount);
    identity.sampler = metadata.text("sampler");
    identity.streams = metadata.text("streams");
    identity.transfer_error =
        metadata.number("transfer_error", 0.0, std::numeric_limits<double>::max());
    identity.seed = parse_hex(metadata.text("seed"), file, "seed");
    identity.normals = metadata.text("normals");
    if (metadata.root().contains("bounces")) {
        identity.bounces = metadata.integer("bounces", 0, kMaxBounces);
    }
    if (metadata.root().contains("floor")) identity.floor = metadata.text("floor");
    if (version == kGlossVersion) {
        identity.gloss = parse_gloss(metadata.root().value("gloss", nlohmann::json()), file);
    }
    identity.num_vertices = metadata.integer("num_vertices", 1, kMaxCount);
    const bool has_following =
        version == kGlossVersion && metadata.root().contains("num_following");
    if (version == kFollowingVersion || has_following) {
        identity.num_following = metadata.integer("num_following", 0, identity.num_vertices - 1);
    }
    identity.num_triangles = metadata.integer("num_triangles", 1, kMaxCount);
    identity.mesh_xxh3 = parse_hex(metadata.text("mesh_xxh3"), file, "mesh_xxh3");
    identity.origin = metadata.point("origin");
    const auto poses = metadata.root().find("poses");
    if (poses == metadata.root().end() || !poses->is_array() || poses->empty()) {
        throw_bad_input("{}: 'poses': expected a list of at least one pose", file);
    }
    if (poses->size() > kMaxPoses) {
        throw_unsupported("{}: {} poses, expected at most {}", file, poses->size(), kMaxPoses);
    }
    const auto source_of = [&](const nlohmann::json& entry) {
        const Metadata source = Metadata::part(entry, file);
        return BakeIdentity::Source{source.text("name"),
                                    parse_hex(source.text("xxh3"), file, "xxh3")};
    };
    const bool has_root = version == kGlossVersion
                              ? poses->front().is_object() && poses->front().contains("root")
                              : version != kManifestVersion;
    std::vector<double> root;
    for (const nlohmann::json& entry : *poses) {
        identity.poses.push_back(source_of(entry));
        if (!has_root) continue;
        constexpr double kMax = 4e38;  // the range of floats, and rounding
        const Metadata pose = Metadata::part(entry, file);
        const std::vector<double> numbers = pose.numbers("root", kRootNumbers, -kMax, kMax);
        root.insert(root.end(), numbers.begin(), numbers.end());
    }
    identity.root_motion = root_motion_of(root, file);
    if (identity.root_motion.empty() && identity.num_following != kAllVertices) {
        throw_bad_input("{}: 'num_following' without a root motion", file);
    }
    const auto still_meshes = metadata.root().find("static");
    if (still_meshes == metadata.root().end()) return identity;
    if (!still_meshes->is_array() || still_meshes->empty()) {
        throw_bad_input("{}: 'static': expected a list of at least one file", file);
    }
    for (const nlohmann::json& entry : *still_meshes)
        identity.still_meshes.push_back(source_of(entry));
    return identity;
}

BakeIdentity read_manifest(const std::filesystem::path& path) {
    const std::vector<char> bytes = read_file(path, kMaxSizeBytes);
    return parse_manifest({bytes.data(), bytes.size()}, path.string());
}

std::string first_difference(const BakeIdentity& there, const BakeIdentity& wanted) {
    const auto differ = [](const char* what, const auto& a, const auto& b) {
        return a == b ? std::string() : fmt::format("{}: {} there, {} asked for", what, a, b);
    };
    const auto or_none = [](const std::string& text) { return text.empty() ? "none" : text; };
    for (const std::string& difference :
         {differ("gloss", shown(there.gloss), shown(wanted.gloss)),
          differ("baker", there.baker, wanted.baker),
          differ("bounces", there.bounces, wanted.bounces),
          differ("bands", there.layout.in_bands, wanted.layout.in_bands),
          differ("channels", there.layout.channels, wanted.layout.channels),
          differ("sampler", there.sampler, wanted.sampler),
          differ("streams", there.streams, wanted.streams),
          differ("transfer error", there.transfer_error, wanted.transfer_error),
          differ("rays", there.rays, wanted.rays),
          differ("seed", there.seed, wanted.seed),
          differ("normals", there.normals, wanted.normals),
          differ("floor", or_none(there.floor), or_none(wanted.floor)),
          differ("vertices", there.num_vertices, wanted.num_vertices),
          differ("triangles", there.num_triangles, wanted.num_triangles),
          differ("poses", there.num_poses(), wanted.num_poses()),
          differ("origin", shown(there.origin), shown(wanted.origin)),
          differ("root motion", shown(there.root_motion), shown(wanted.root_motion)),
          differ("vertices that follow the root motion", count_or_all(there.num_following),
                 count_or_all(wanted.num_following)),
          differ("static files", there.still_meshes.size(), wanted.still_meshes.size()),
          differ("checksum of faces, albedo and texture", hex(there.mesh_xxh3),
                 hex(wanted.mesh_xxh3))}) {
        if (!difference.empty()) return difference;
    }
    const std::string difference = first_difference("pose", there.poses, wanted.poses);
    if (!difference.empty()) return difference;
    return first_difference("static file", there.still_meshes, wanted.still_meshes);
}

uint64_t identity_checksum(const BakeIdentity& identity) {
    const std::string text = manifest_text(identity);
    return xxh3(text.data(), text.size());
}

}  // namespace paim
