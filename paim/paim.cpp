// The C interface: checks arguments, keeps exceptions inside, copies into the caller's memory.
#include "paim/paim.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "paim/base/error.h"
#include "paim/base/version.h"
#include "paim/codec/asset.h"
#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "paim/light/light.h"

struct paim_asset {
    std::shared_ptr<const paim::Asset> asset;
};

struct paim_player {
    explicit paim_player(std::shared_ptr<const paim::Asset> asset) : playback(std::move(asset)) {}

    paim::Playback playback;
    bool is_updated = false;
};

namespace {

thread_local std::string message;

paim_status fail(paim_status status, std::string what) {
    message = std::move(what);
    return status;
}

paim_status bad_argument(const char* function, const char* what) {
    return fail(PAIM_BAD_ARGUMENT, std::string(function) + ": " + what);
}

paim_status status_of(paim::ExitCode code) {
    switch (code) {
        case paim::ExitCode::bad_input:
            return PAIM_BAD_INPUT;
        case paim::ExitCode::unsupported:
            return PAIM_UNSUPPORTED;
        default:
            return PAIM_FAILED;
    }
}

// Runs `body` and turns exceptions into a status, so that none leaves the library.
template <typename Body>
paim_status guarded(const Body& body) noexcept {
    try {
        return body();
    } catch (const paim::Error& error) {
        return fail(status_of(error.code()), error.what());
    } catch (const std::bad_alloc&) {
        return fail(PAIM_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return fail(PAIM_FAILED, error.what());
    } catch (...) {
        return fail(PAIM_FAILED, "unknown failure");
    }
}

paim_status open_bytes(const char* function, const void* bytes, size_t num_bytes, const char* name,
                       const paim::ReadOptions& options, paim_asset** asset) {
    if (asset == nullptr) return bad_argument(function, "asset is null");
    *asset = nullptr;
    if (bytes == nullptr && num_bytes > 0) return bad_argument(function, "bytes are null");
    return guarded([&] {
        const std::span span(static_cast<const uint8_t*>(bytes), num_bytes);
        *asset = new paim_asset{std::make_shared<const paim::Asset>(
            paim::read_paim(span, name == nullptr ? "memory" : name, options))};
        return PAIM_OK;
    });
}

bool has_part(const paim::Asset& asset, uint32_t part) {
    return part < asset.parts.size();
}

// Copies planes [3][V] of a part as [V][3].
paim_status copy_points(const char* function, const paim_player* player, uint32_t part,
                        std::span<const float> (paim::Playback::*planes_of)(size_t) const,
                        float* xyz, size_t num_floats) {
    if (player == nullptr || xyz == nullptr) return bad_argument(function, "an argument is null");
    if (part >= player->playback.num_parts())
        return bad_argument(function, "there is no such part");
    if (!player->is_updated) return bad_argument(function, "expected an update before");
    const std::span<const float> planes = (player->playback.*planes_of)(part);
    if (num_floats != planes.size())
        return bad_argument(function, "expected room for 3 floats a vertex");
    const size_t num_vertices = planes.size() / 3;
    for (size_t v = 0; v < num_vertices; ++v) {
        for (size_t axis = 0; axis < 3; ++axis) *xyz++ = planes[axis * num_vertices + v];
    }
    return PAIM_OK;
}

}  // namespace

const char* paim_version(void) {
    return paim::kVersion;
}

const char* paim_error_message(void) {
    return message.c_str();
}

paim_status paim_asset_open_file(const char* path, paim_asset** asset) {
    if (asset == nullptr) return bad_argument(__func__, "asset is null");
    *asset = nullptr;
    if (path == nullptr) return bad_argument(__func__, "path is null");
    return guarded([&] {
        *asset = new paim_asset{std::make_shared<const paim::Asset>(paim::read_paim(path))};
        return PAIM_OK;
    });
}

paim_status paim_asset_open_memory(const void* bytes, size_t num_bytes, const char* name,
                                   paim_asset** asset) {
    return open_bytes(__func__, bytes, num_bytes, name, {}, asset);
}

paim_status paim_asset_open_prefix(const void* bytes, size_t num_bytes, const char* name,
                                   paim_asset** asset) {
    return open_bytes(__func__, bytes, num_bytes, name, {.prefix = true}, asset);
}

void paim_asset_close(paim_asset* asset) {
    delete asset;
}

paim_status paim_asset_get_info(const paim_asset* asset, paim_asset_info* info) {
    if (asset == nullptr || info == nullptr) return bad_argument(__func__, "an argument is null");
    const paim::Asset& a = *asset->asset;
    *info = {static_cast<uint32_t>(a.parts.size()),
             a.num_poses(),
             a.frames_per_second,
             {a.origin.x(), a.origin.y(), a.origin.z()}};
    return PAIM_OK;
}

paim_status paim_asset_get_part(const paim_asset* asset, uint32_t part, paim_part_info* info) {
    if (asset == nullptr || info == nullptr) return bad_argument(__func__, "an argument is null");
    if (!has_part(*asset->asset, part)) return bad_argument(__func__, "there is no such part");
    const paim::CodedMesh& mesh = asset->asset->parts[part];
    *info = {mesh.topology.num_vertices,
             static_cast<uint32_t>(mesh.topology.triangles.size()),
             mesh.light_bands(),
             mesh.layout.channels,
             0,
             0};
    if (mesh.gloss) {
        info->num_glossy = mesh.gloss->num_rows;
        info->num_out_bands = mesh.gloss->layout.out_bands;
    }
    return PAIM_OK;
}

paim_status paim_asset_copy_triangles(const paim_asset* asset, uint32_t part, uint32_t* indices,
                                      size_t num_indices) {
    if (asset == nullptr) return bad_argument(__func__, "asset is null");
    if (!has_part(*asset->asset, part)) return bad_argument(__func__, "there is no such part");
    const auto& triangles = asset->asset->parts[part].topology.triangles;
    if (num_indices != 3 * triangles.size() || (indices == nullptr && num_indices > 0)) {
        return bad_argument(__func__, "expected room for 3 indices a triangle");
    }
    for (const paim::Triangle& triangle : triangles) {
        for (const uint32_t v : triangle) *indices++ = v;
    }
    return PAIM_OK;
}

paim_status paim_player_create(const paim_asset* asset, paim_player** player) {
    if (player == nullptr) return bad_argument(__func__, "player is null");
    *player = nullptr;
    if (asset == nullptr) return bad_argument(__func__, "asset is null");
    return guarded([&] {
        *player = new paim_player(asset->asset);
        return PAIM_OK;
    });
}

void paim_player_destroy(paim_player* player) {
    delete player;
}

paim_limits paim_no_limits(void) {
    constexpr uint32_t kAll = std::numeric_limits<uint32_t>::max();
    return {kAll, kAll, kAll, kAll, kAll, kAll};
}

paim_status paim_player_set_light(paim_player* player, const float* rgb, uint32_t num_bands) {
    if (player == nullptr || rgb == nullptr) return bad_argument(__func__, "an argument is null");
    if (num_bands < 1 || num_bands > static_cast<uint32_t>(paim::sh::kMaxBands)) {
        return bad_argument(__func__, "expected 1 to 64 bands");
    }
    return guarded([&] {
        paim::LightCoefficients light;
        light.bands = static_cast<int>(num_bands);
        light.values.resize(static_cast<size_t>(paim::sh::num_coefficients(light.bands)));
        for (paim::Vec3f& value : light.values) {
            value = paim::Vec3f(rgb[0], rgb[1], rgb[2]);
            if (!value.allFinite()) return bad_argument("paim_player_set_light", "not finite");
            rgb += 3;
        }
        player->playback.set_light(paim::DistantLight(std::move(light)));
        return PAIM_OK;
    });
}

paim_status paim_player_set_eye(paim_player* player, const float* xyz) {
    if (player == nullptr) return bad_argument(__func__, "player is null");
    std::optional<paim::Vec3f> eye;
    if (xyz != nullptr) eye = paim::Vec3f(xyz[0], xyz[1], xyz[2]);
    if (eye && !eye->allFinite()) return bad_argument(__func__, "not finite");
    player->playback.set_eye(eye);
    return PAIM_OK;
}

paim_status paim_player_update(paim_player* player, double time, const paim_limits* limits) {
    if (player == nullptr) return bad_argument(__func__, "player is null");
    if (std::isnan(time)) return bad_argument(__func__, "time is not a number");
    return guarded([&] {
        paim::DecodeLimits used;
        if (limits != nullptr) {
            used = {limits->geometry_components,
                    limits->transfer_components,
                    limits->bands,
                    limits->vertex_components,
                    limits->gloss_components,
                    limits->gloss_vertex_components};
        }
        player->playback.update(time, used);
        player->is_updated = true;
        return PAIM_OK;
    });
}

paim_status paim_player_copy_positions(const paim_player* player, uint32_t part, float* xyz,
                                       size_t num_floats) {
    return copy_points(__func__, player, part, &paim::Playback::positions, xyz, num_floats);
}

paim_status paim_player_copy_local_positions(const paim_player* player, uint32_t part, float* xyz,
                                             size_t num_floats) {
    return copy_points(__func__, player, part, &paim::Playback::local_positions, xyz, num_floats);
}

paim_status paim_player_get_root(const paim_player* player, uint32_t part, paim_root* root) {
    if (player == nullptr || root == nullptr) return bad_argument(__func__, "an argument is null");
    if (part >= player->playback.num_parts())
        return bad_argument(__func__, "there is no such part");
    if (!player->is_updated) return bad_argument(__func__, "expected an update before");
    const paim::RigidTransform of_part = player->playback.root(part);
    const Eigen::Quaterniond& q = of_part.rotation;
    const paim::Vec3d& t = of_part.translation;
    const paim::CodedMesh& mesh = player->playback.asset().parts[part];
    *root = {{q.w(), q.x(), q.y(), q.z()},
             {t.x(), t.y(), t.z()},
             std::min(mesh.num_following, mesh.topology.num_vertices)};
    return PAIM_OK;
}

paim_status paim_player_copy_radiance(const paim_player* player, uint32_t part, float* rgb,
                                      size_t num_floats) {
    if (player == nullptr || rgb == nullptr) return bad_argument(__func__, "an argument is null");
    if (part >= player->playback.num_parts())
        return bad_argument(__func__, "there is no such part");
    const std::span<const paim::Vec3f> radiance = player->playback.radiance(part);
    const size_t num_vertices = player->playback.asset().parts[part].topology.num_vertices;
    if (radiance.size() != num_vertices) {
        return bad_argument(__func__, "expected a light and an update before");
    }
    if (num_floats != 3 * num_vertices)
        return bad_argument(__func__, "expected room for 3 floats a vertex");
    for (const paim::Vec3f& value : radiance) {
        for (Eigen::Index c = 0; c < 3; ++c) *rgb++ = value[c];
    }
    return PAIM_OK;
}
