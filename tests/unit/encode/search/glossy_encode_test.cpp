// Files of a size with both kinds of transfer, and what is said while one is searched.
#include "compressor/encode/search/glossy_encode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/planes.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kWidth = 8, kVertices = kWidth * kWidth, kPoses = 6;
const TransferLayout kGloss{TransferKind::glossy, 2, 1, 2};
const Materials kShiny{{{"phong:0.5,4", Vec3f::Ones()}}, {1}};

// A smooth function of plane, vertex and pose.
std::vector<float> waves(uint32_t num_planes, uint32_t pose, float scale) {
    std::vector<float> values;
    for (uint32_t plane = 0; plane < num_planes; ++plane) {
        for (uint32_t v = 0; v < kVertices; ++v) {
            const auto x = static_cast<float>(v % kWidth), y = static_cast<float>(v / kWidth);
            values.push_back(scale *
                             std::sin(0.3f * x + 0.2f * y + 0.7f * static_cast<float>(plane) +
                                      0.5f * static_cast<float>(pose * (1 + v % 3))));
        }
    }
    return values;
}

BakedPose pose_of(const Topology& mesh, uint32_t p) {
    BakedPose pose;
    pose.positions = waves(3, 0, 1.0f);
    pose.normals = to_planes(vertex_normals(mesh, from_planes(pose.positions)));
    pose.transfer = waves(4, p, 0.5f);
    pose.noise = waves(4, 2 * p + 1, 0.0005f);
    pose.gloss = waves(kGloss.num_planes(), p + 1, 0.5f);
    pose.gloss_noise = waves(kGloss.num_planes(), 2 * p + 2, 0.0005f);
    pose.statistics.transfer_rms = pose.statistics.gloss_rms = {0.5, 0.5};
    pose.statistics.noise_rms = pose.statistics.gloss_noise_rms = {0.0005, 0.0005};
    return pose;
}

BakeReader write_sheet(const std::filesystem::path& directory) {
    Topology mesh{kVertices, {}};
    for (uint32_t v = 0; v + kWidth + 1 < kVertices; ++v) {
        if (v % kWidth + 1 == kWidth) continue;
        mesh.triangles.push_back({v, v + 1, v + kWidth});
        mesh.triangles.push_back({v + 1, v + kWidth + 1, v + kWidth});
    }
    BakeIdentity identity;
    identity.layout = {TransferKind::diffuse, 2, 1};
    identity.gloss = {kGloss, kShiny.glossy};
    identity.rays = 64;
    identity.sampler = "cosine";
    identity.streams = "per-pose";
    identity.normals = "faces";
    identity.num_vertices = kVertices;
    identity.num_triangles = static_cast<uint32_t>(mesh.triangles.size());
    identity.mesh_xxh3 = mesh_checksum(mesh, {}, {}, kShiny);
    for (uint32_t p = 0; p < kPoses; ++p) identity.poses.push_back({std::to_string(p), p});
    const BakeWriter writer(directory, identity, mesh, {}, {}, kShiny);
    for (uint32_t p = 0; p < kPoses; ++p) writer.write_pose(p, pose_of(mesh, p));
    return BakeReader(directory);
}

TEST(GlossyEncode, SaysWhichErrorsASizeIsFittedBy) {
    const TemporaryDirectory directory;
    const BakeReader bake = write_sheet(directory / "x.bake");
    GlossyTarget target;
    target.diffuse.spectrum = target.gloss.spectrum = BandPower::flat(2);
    target.diffuse.transfer_error = target.gloss.transfer_error = 0.3;
    const std::filesystem::path scratch = directory / "parts";
    std::filesystem::create_directory(scratch);
    const uint64_t size =
        encode_glossy_to_target(bake, {}, target, scratch, directory / "x.paim").both.size_bytes;

    target.diffuse.transfer_error.reset();
    target.gloss.transfer_error.reset();
    target.diffuse.size_bytes = size;
    std::set<std::string> errors;
    double last = 0.0;
    size_t num_reports = 0;
    encode_glossy_to_target(bake, {}, target, scratch, directory / "y.paim",
                            [&](const std::string& part, const std::string& step, double done) {
                                EXPECT_EQ(part, "both");
                                EXPECT_GE(done, last);
                                if (step.starts_with("fitting the size, error ")) {
                                    EXPECT_LT(done, 1.0);
                                    errors.insert(step);
                                    if (done > last) ++num_reports;
                                }
                                last = done;
                            });
    EXPECT_GE(errors.size(), 2u);
    EXPECT_GE(num_reports, 2 * errors.size());  // one for each of the two files of an error
    EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace paim
