// Textures of outgoing coefficients.
#include "player/render/surface_gloss.h"

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/check.h"
#include "player/render/value_textures.h"

namespace paim::player {

namespace {

int64_t num_exits(const CodedMesh& mesh) {
    return int64_t{sh::num_coefficients(static_cast<int>(mesh.gloss->layout.out_bands))} *
           mesh.gloss->num_rows;
}

int width_log2_of(const CodedMesh& mesh) {
    const int64_t most = std::max(num_exits(mesh), int64_t{mesh.topology.num_vertices});
    const int width_log2 = gl::fitting_width_log2(most, gl::max_texture_size());
    if (width_log2 < 0) {
        throw_unsupported("{} outgoing coefficients of gloss, this driver's textures hold fewer",
                          most);
    }
    return width_log2;
}

}  // namespace

SurfaceGloss::SurfaceGloss(const CodedMesh& mesh)
    : num_rows_(mesh.gloss.value().num_rows),
      out_bands_(mesh.gloss->layout.out_bands),
      width_log2_(width_log2_of(mesh)),
      exits_("gloss", gl::TexelFormat::rgb32f, width_log2_, at_least_one(num_exits(mesh))),
      rows_("rows of gloss", gl::TexelFormat::r32f, width_log2_,
            at_least_one(mesh.topology.num_vertices)) {
    constexpr uint32_t kMostRows = 1u << 24;  // whose numbers floats hold exactly
    if (num_rows_ > kMostRows) {
        throw_unsupported("{} glossy vertices, this player draws at most {}", num_rows_, kMostRows);
    }
    std::vector<float> rows(std::max(1u, mesh.topology.num_vertices), -1.0f);
    for (uint32_t r = 0; r < num_rows_; ++r) {
        rows[mesh.gloss->vertex(r)] = static_cast<float>(r);
    }
    rows_.update(rows);
    gl::check_errors("uploading gloss");
}

void SurfaceGloss::upload(std::span<const Vec3f> exits) const {
    PAIM_CHECK_EQ(static_cast<int64_t>(exits.size()), exits_.num_texels());
    exits_.update({exits.front().data(), 3 * exits.size()});
}

void SurfaceGloss::set(const gl::Program& program, int unit, const Vec3f& eye) const {
    program.set_texture("exits", unit, exits_.handle());
    program.set_texture("rows", unit + 1, rows_.handle());
    program.set("num_rows", static_cast<int>(num_rows_));
    program.set("gloss_width_log2", width_log2_);
    program.set("local_eye", Eigen::Vector3f(eye));
}

}  // namespace paim::player
