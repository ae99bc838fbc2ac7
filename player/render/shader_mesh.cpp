// Uploading a mesh, and running its shaders.
#include "player/render/shader_mesh.h"

#include <algorithm>
#include <array>

#include "paim/base/check.h"

#include "player/gl/check.h"
#include "player/gl/feedback.h"
#include "player/render/plan_upload.h"
#include "player/render/value_textures.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

gl::Program make_program(const char* name, std::span<const char* const> captured,
                         std::string_view defines,
                         std::initializer_list<std::string_view> sources) {
    std::string vertex(shaders::vertex_data_glsl);
    for (const std::string_view source : sources) vertex += source;
    return {name, vertex, shaders::nothing_frag, defines, captured};
}

constexpr std::array<const char*, 1> kPosition{"position"};
constexpr std::array<const char*, 2> kRadiance{"radiance", "white_radiance"};

}  // namespace

ShaderMesh::ShaderMesh(const CodedMesh& mesh, const DecodeLimits& limits)
    : mesh_(mesh),
      plan_(plan_upload(mesh, limits, gl::max_texture_size())),
      geometry_("geometry", mesh.positions, {mesh.topology.num_vertices, 1, 3, 3, 1},
                plan_.geometry_components, plan_.width_log2),
      transfer_(find_uploader(mesh).upload(mesh, plan_)),
      position_program_(
          make_program("positions", kPosition, geometry_.defines(), {shaders::position_vert})),
      radiance_program_(
          make_program("radiance", std::span(kRadiance).first(mesh.texture.empty() ? 1 : 2),
                       transfer_->defines(), {transfer_->shader(), shaders::radiance_vert})),
      albedo_("the albedo", gl::TexelFormat::rgba32f, plan_.width_log2,
              at_least_one(static_cast<int64_t>(mesh.albedo.values.size()))) {
    upload_albedo();
}

uint64_t ShaderMesh::texture_bytes() const {
    return geometry_.size_bytes() + transfer_->size_bytes() + albedo_.size_bytes();
}

void ShaderMesh::upload_albedo() const {
    albedo_.upload([&](int64_t first, std::span<float> out) {
        for (size_t i = 0; i < out.size(); i += 4) {
            const Vec3f& value = mesh_.albedo.values[static_cast<size_t>(first) + i / 4];
            std::copy_n(value.data(), 3, out.data() + i);
        }
    });
}

void ShaderMesh::decode(double time, const DecodeLimits& limits,
                        const gl::BufferHandle& positions) {
    const gl::Program& program = position_program_;
    program.use();
    geometry_.bind(program, 0, time, limits.geometry_components);
    program.set("width_log2", plan_.width_log2);
    program.set("num_vertices", static_cast<int>(mesh_.topology.num_vertices));
    const LowRank& geometry = mesh_.positions;
    program.set("geometry_step", Vec3f(geometry.step(0), geometry.step(1), geometry.step(2)));
    const gl::BufferHandle* const buffers[] = {&positions};
    capture_.run(buffers, 3, 0, mesh_.topology.num_vertices);
}

void ShaderMesh::light(double time, const DecodeLimits& limits, const LightCoefficients& light,
                       std::span<const gl::BufferHandle* const> colors) {
    PAIM_CHECK_EQ(colors.size(), mesh_.texture.empty() ? size_t{1} : size_t{2});
    const uint32_t num_vertices = mesh_.topology.num_vertices;
    const uint32_t num_following = std::min(num_vertices, mesh_.num_following);
    const RigidTransform root = root_at(mesh_.root_motion, time);
    if (!root.turns()) return light_vertices(0, num_vertices, time, limits, light, colors);
    light_vertices(0, num_following, time, limits, to_local(light, root), colors);
    light_vertices(num_following, num_vertices - num_following, time, limits, light, colors);
}

void ShaderMesh::light_vertices(uint32_t first, uint32_t count, double time,
                                const DecodeLimits& limits, const LightCoefficients& light,
                                std::span<const gl::BufferHandle* const> colors) {
    if (count == 0) return;
    const gl::Program& program = radiance_program_;
    program.use();
    const int unit = transfer_->bind(program, 0, time, limits, light);
    program.set_texture("albedo", unit, albedo_.handle());
    program.set("width_log2", plan_.width_log2);
    program.set("num_vertices", static_cast<int>(mesh_.topology.num_vertices));
    program.set("albedo_stride", mesh_.albedo.values.size() == 1 ? 0 : 1);
    capture_.run(colors, 3, first, count);
}

}  // namespace paim::player
