// Texel counts and texture limits.
#include "player/render/upload_plan.h"

#include <algorithm>
#include <limits>

#include "paim/base/error.h"

namespace paim::player {

// Shaders count texels in 32-bit integers.
int64_t texel_capacity(int max_texture_size) {
    return std::min<int64_t>(int64_t{max_texture_size} * max_texture_size,
                             std::numeric_limits<int32_t>::max());
}

void require_fit(const char* attribute, uint32_t num_components, int64_t num_texels,
                 int max_texture_size) {
    const int64_t available = texel_capacity(max_texture_size);
    if (num_texels <= available) return;
    const int64_t component_texels = num_texels / num_components;
    throw_unsupported(
        "{} components of {} need {} texels, this driver's largest texture (GL_MAX_TEXTURE_SIZE "
        "{}) holds {}: {} components would fit",
        num_components, attribute, num_texels, max_texture_size, available,
        available / component_texels);
}

int64_t geometry_texels(const CodedMesh& mesh, uint32_t num_components) {
    return int64_t{std::min(num_components, mesh.positions.num_components)} *
           mesh.topology.num_vertices;
}

}  // namespace paim::player
