// The octopus: rest mesh, colours and motion put together.
#include "poses/octopus.h"

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "poses/octopus_mesh.h"
#include "poses/octopus_motion.h"
#include "poses/octopus_shape.h"

namespace paim::poses {

namespace {

class Octopus : public Sequence {
  public:
    explicit Octopus(uint32_t num_vertices) : rest_(make_rest_octopus(num_vertices)) {
        albedo_.values.clear();
        for (const Vec3d& point : rest_.positions) {
            albedo_.values.push_back(octopus_albedo(point));
        }
    }

    const Topology& topology() const override { return rest_.topology; }
    const Albedo& albedo() const override { return albedo_; }

    std::vector<Vec3f> positions(uint32_t p, uint32_t num_poses) const override {
        PAIM_CHECK_LT(p, num_poses);
        const OctopusMotion motion(2.0 * kPi * p / num_poses);
        std::vector<Vec3f> placed(rest_.positions.size());
        parallel_for(placed.size(), 4096, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                placed[v] = motion.place(rest_.positions[v]).cast<float>();
            }
        });
        return placed;
    }

  private:
    RestMesh rest_;
    Albedo albedo_;
};

}  // namespace

std::unique_ptr<Sequence> make_octopus_sequence(uint32_t num_vertices) {
    if (num_vertices < kMinOctopusVertices || num_vertices > kMaxOctopusVertices) {
        throw_usage("octopus: expected {} to {} vertices, got {}", kMinOctopusVertices,
                    kMaxOctopusVertices, num_vertices);
    }
    return std::make_unique<Octopus>(num_vertices);
}

PoseSet make_octopus(uint32_t num_vertices, uint32_t num_poses) {
    return make_pose_set(*make_octopus_sequence(num_vertices), num_poses);
}

}  // namespace paim::poses
