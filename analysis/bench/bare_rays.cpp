// The bare loop over rtcOccluded1.
#include "analysis/bench/bare_rays.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>

#include "paim/base/parallel.h"
#include "paim/trace/embree.h"

namespace paim::bench {

namespace {

bool is_occluded(embree::Context& context, RTCScene scene, const Vec3f& origin,
                 const Vec3f& direction) {
    RTCRay ray = embree::make_ray(origin, direction);
    context.occluded(scene, ray);
    return ray.tfar < 0.0f;
}

}  // namespace

struct BareScene::Impl {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
};

BareScene::BareScene(const Topology& topology, std::span<const Vec3f> positions)
    : impl_(std::make_unique<Impl>()) {
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        sizeof(Vec3f), positions.size()),
                positions.data(), positions.size_bytes());
    std::memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        sizeof(Triangle), topology.triangles.size()),
                topology.triangles.data(), topology.triangles.size() * sizeof(Triangle));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(impl_->scene);
}

BareScene::~BareScene() {
    rtcReleaseScene(impl_->scene);
    rtcReleaseDevice(impl_->device);
}

bool BareScene::is_blocked(const Vec3f& origin, const Vec3f& direction) const {
    embree::Context context;
    return is_occluded(context, impl_->scene, origin, direction);
}

uint64_t BareScene::count_blocked(const RayList& rays, size_t origins_per_piece) const {
    std::atomic<uint64_t> total{0};
    parallel_for(rays.origins.size(), origins_per_piece, [&](size_t begin, size_t end) {
        embree::Context context;
        uint64_t num_occluded = 0;
        const Vec3f* direction = rays.directions.data() + begin * rays.per_origin;
        for (size_t v = begin; v < end; ++v) {
            const Vec3f& origin = rays.origins[v];
            for (uint32_t j = 0; j < rays.per_origin; ++j, ++direction) {
                num_occluded += is_occluded(context, impl_->scene, origin, *direction) ? 1 : 0;
            }
        }
        total += num_occluded;
    });
    return total;
}

uint64_t BareScene::count_blocked_by_packets(const RayList& rays, size_t origins_per_piece) const {
    constexpr uint32_t kPacket = 16;
    std::atomic<uint64_t> total{0};
    parallel_for(rays.origins.size(), origins_per_piece, [&](size_t begin, size_t end) {
        embree::Context context;
        uint64_t num_occluded = 0;
        alignas(64) int valid[kPacket];
        std::fill_n(valid, kPacket, -1);
        RTCRay16 packet{};
        std::fill_n(packet.mask, kPacket, 0xffffffffu);
        const Vec3f* direction = rays.directions.data() + begin * rays.per_origin;
        for (size_t v = begin; v < end; ++v) {
            std::fill_n(packet.org_x, kPacket, rays.origins[v].x());
            std::fill_n(packet.org_y, kPacket, rays.origins[v].y());
            std::fill_n(packet.org_z, kPacket, rays.origins[v].z());
            for (uint32_t first = 0; first < rays.per_origin; first += kPacket) {
                for (uint32_t j = 0; j < kPacket; ++j, ++direction) {
                    packet.dir_x[j] = direction->x();
                    packet.dir_y[j] = direction->y();
                    packet.dir_z[j] = direction->z();
                    packet.tfar[j] = std::numeric_limits<float>::infinity();
                }
                context.occluded(valid, impl_->scene, packet);
                for (const float tfar : packet.tfar) num_occluded += tfar < 0.0f ? 1 : 0;
            }
        }
        total += num_occluded;
    });
    return total;
}

}  // namespace paim::bench
