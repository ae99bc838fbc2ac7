// Plays an asset on the CPU.
#include "paim/codec/playback.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/codec/gloss_player.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/transfer_player.h"
#include "paim/light/light_in_place.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// The centre of the bounding box of the mean positions, of vertices that a face has. A floor does not
// count under a body that moves, as the body is what light is for.
Vec3f centre_of(const CodedMesh& mesh) {
    if (mesh.topology.num_vertices == 0) return Vec3f::Zero();
    std::vector<uint32_t> vertices = face_vertices(mesh.topology);
    const auto floor = std::lower_bound(vertices.begin(), vertices.end(), mesh.num_following);
    if (floor != vertices.begin()) vertices.erase(floor, vertices.end());
    return bounds_of_vertices(mesh.positions.mean_floats(), vertices).center();
}

}  // namespace

struct Playback::Part {
    explicit Part(const CodedMesh& coded)
        : mesh(coded),
          centre(centre_of(coded)),
          root(root_at(coded.root_motion, 0.0)),
          player(coded.transfer->make_player(coded.layout)) {
        if (coded.gloss) gloss.emplace(coded);
    }

    // What is looked at: the gloss towards an eye, its outgoing coefficients, or neither.
    struct Looks {
        std::optional<Vec3f> eye;
        bool keeps_exit = false;
    };

    void update(double new_time, const DecodeLimits& new_limits, const Looks& looks) {
        const bool moved = time != new_time;
        if (moved) root = root_at(mesh.root_motion, new_time);
        if (moved || limits.geometry_components != new_limits.geometry_components) {
            decoder.decode(mesh.positions, new_time, new_limits.geometry_components, positions);
            place();
            is_placed = false;
            is_gloss_lit = false;
        }
        if (light.bands > 0 && (moved || !is_lit || limits != new_limits)) {
            light_all(new_time, new_limits);
            is_lit = true;
            is_gloss_lit = false;
        }
        const bool is_wanted = gloss && is_lit && (looks.eye || looks.keeps_exit);
        if (is_wanted && !is_gloss_lit) {
            if (!is_placed) gloss->place(positions);
            is_placed = true;
            gloss->light(new_time, new_limits, to_local(light, root));
            is_gloss_lit = true;
            is_seen = false;
        }
        has_eye = is_wanted && looks.eye;
        if (has_eye && (!is_seen || seen_from != *looks.eye)) look_from(*looks.eye);
        time = new_time;
        limits = new_limits;
    }

    // All glossy vertices that can be seen follow the root motion: floors are matte.
    void look_from(const Vec3f& eye) {
        towards_eye = gloss->towards(root.to_local(eye.cast<double>()));
        shown = radiance;
        for (uint32_t r = 0; r < towards_eye.size(); ++r) {
            shown[mesh.gloss->vertex(r)] += towards_eye[r];
        }
        is_seen = true;
        seen_from = eye;
    }

    // The light is met once, in white if that is kept.
    void light_all(double new_time, const DecodeLimits& new_limits) {
        static const Albedo white{{Vec3f::Ones()}};
        if (!keeps_white) return shade(new_time, new_limits, mesh.albedo, radiance);
        shade(new_time, new_limits, white, white_radiance);
        radiance.clear();
        for (const Vec3f& value : white_radiance) {
            const auto v = static_cast<uint32_t>(radiance.size());
            radiance.push_back(mesh.albedo.at(v).cwiseProduct(value));
        }
    }

    void shade(double new_time, const DecodeLimits& new_limits, const Albedo& albedo,
               std::vector<Vec3f>& shaded) {
        light_in_place(root, mesh.num_following, light, shaded, radiance_in_scene,
                       [&](const LightCoefficients& local, std::vector<Vec3f>& lit) {
                           player->light(new_time, new_limits, local, albedo, lit);
                       });
    }

    void keep_white_radiance(bool keep) {
        if (mesh.texture.empty() || keep == keeps_white) return;
        keeps_white = keep;
        white_radiance.clear();
        is_lit = false;
    }

    void place() {
        if (mesh.root_motion.empty()) return;
        scene_positions = positions;
        move_to_scene(root, scene_positions, mesh.num_following);
    }

    Vec3f centre_in_scene() const { return root.to_scene(centre.cast<double>()).cast<float>(); }

    const CodedMesh& mesh;
    Vec3f centre;  // local coordinates
    RigidTransform root;
    PositionDecoder decoder;
    std::unique_ptr<TransferPlayer> player;
    std::optional<GlossPlayer> gloss;
    LightCoefficients light;
    bool is_lit = false;        // whether the radiance is up to date with the light
    bool is_placed = false;     // whether the gloss knows the positions
    bool is_gloss_lit = false;  // the same of the outgoing coefficients of the gloss
    bool is_seen = false;       // whether `shown` is up to date, seen from `seen_from`
    bool has_eye = false;       // at the last update
    Vec3f seen_from = Vec3f::Zero();
    std::optional<double> time;  // of positions and radiance
    DecodeLimits limits;
    std::vector<float> positions;        // local
    std::vector<float> scene_positions;  // only where there is a root motion
    bool keeps_white = false;
    std::vector<Vec3f> radiance;           // diffuse
    std::vector<Vec3f> shown;              // with gloss
    std::span<const Vec3f> towards_eye;    // [R] the gloss alone
    std::vector<Vec3f> white_radiance;     // empty unless it is kept
    std::vector<Vec3f> radiance_in_scene;  // scratch: of a floor under a body that turns
};

struct Playback::State {
    std::shared_ptr<const Asset> asset;
    std::vector<Part> parts;
    Part::Looks looks;
};

Playback::Playback(std::shared_ptr<const Asset> asset) : state_(std::make_unique<State>()) {
    PAIM_CHECK(asset != nullptr && !asset->parts.empty());
    state_->asset = std::move(asset);
    for (const CodedMesh& mesh : state_->asset->parts) state_->parts.emplace_back(mesh);
}

Playback::~Playback() = default;
Playback::Playback(Playback&&) noexcept = default;
Playback& Playback::operator=(Playback&&) noexcept = default;

const Asset& Playback::asset() const {
    return *state_->asset;
}

size_t Playback::num_parts() const {
    return state_->parts.size();
}

void Playback::set_light(const LightField& light) {
    for (Part& part : state_->parts) {
        part.light = light.at(part.centre_in_scene(), static_cast<int>(part.mesh.light_bands()));
        part.is_lit = false;
    }
}

void Playback::set_eye(const std::optional<Vec3f>& eye) {
    state_->looks.eye = eye;
}

void Playback::keep_exit_radiance(bool keep) {
    state_->looks.keeps_exit = keep;
}

void Playback::keep_white_radiance(bool keep) {
    for (Part& part : state_->parts) part.keep_white_radiance(keep);
}

void Playback::update(double time, const DecodeLimits& limits) {
    for (Part& part : state_->parts) {
        part.update(part.mesh.num_poses() == 1 ? 0.0 : time, limits, state_->looks);
    }
}

std::span<const float> Playback::positions(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    const Part& of = state_->parts[part];
    return of.mesh.root_motion.empty() ? of.positions : of.scene_positions;
}

std::span<const float> Playback::local_positions(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    return state_->parts[part].positions;
}

RigidTransform Playback::root(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    return state_->parts[part].root;
}

std::span<const Vec3f> Playback::radiance(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    const Part& of = state_->parts[part];
    return of.has_eye ? of.shown : of.radiance;
}

std::span<const Vec3f> Playback::exit_radiance(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    const Part& of = state_->parts[part];
    return of.is_gloss_lit ? of.gloss->exit_radiance() : std::span<const Vec3f>();
}

std::span<const Vec3f> Playback::gloss_radiance(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    const Part& of = state_->parts[part];
    return of.has_eye ? of.towards_eye : std::span<const Vec3f>();
}

std::span<const Vec3f> Playback::white_radiance(size_t part) const {
    PAIM_CHECK_LT(part, num_parts());
    return state_->parts[part].white_radiance;
}

}  // namespace paim
