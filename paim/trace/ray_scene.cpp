// Rays against triangles, through Embree.
// Based on: Wald, Woop, Benthin, Johnson and Ernst, Embree: A Kernel Framework for Efficient CPU
//           Ray Tracing, 2014
#include "paim/trace/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/unit_scale.h"
#include "paim/trace/embree.h"

namespace paim {

namespace {

// An Embree device. It keeps the first error that Embree reports, for throw_if_failed().
class Device {
  public:
    Device() : device_(rtcNewDevice(nullptr)) {
        if (device_ == nullptr) {
            throw_unsupported("Embree cannot start (error {})",
                              static_cast<int>(rtcGetDeviceError(nullptr)));
        }
        rtcSetDeviceErrorFunction(device_, &Device::report, this);
    }
    ~Device() { rtcReleaseDevice(device_); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    RTCDevice handle() const { return device_; }

    void throw_if_failed() {
        const std::lock_guard lock(mutex_);
        if (!error_.empty()) throw_unsupported("Embree: {}", error_);
    }

  private:
    static void report(void* user, RTCError code, const char* text) {
        auto* self = static_cast<Device*>(user);
        const std::lock_guard lock(self->mutex_);
        if (self->error_.empty()) {
            self->error_ = fmt::format("error {}: {}", static_cast<int>(code), text ? text : "");
        }
    }

    RTCDevice device_;
    std::mutex mutex_;
    std::string error_;
};

// Copies into a buffer that Embree owns and pads.
template <typename T>
void set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const T* data,
                size_t count) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
    if (buffer != nullptr) std::uninitialized_copy_n(data, count, static_cast<T*>(buffer));
}

// Factor of the coordinates that are given to Embree, which misses hits if they are beyond about
// 1e±18. It makes the median vertex about 1, so that a single one far away does not make the others
// too small. Embree passes over triangles of vertices that are beyond its range then.
float embree_scale(std::span<const Vec3f> positions, std::span<const Vec3f> more_positions) {
    std::vector<float> magnitudes;
    magnitudes.reserve(positions.size() + more_positions.size());
    for (const auto points : {positions, more_positions}) {
        for (const Vec3f& x : points) magnitudes.push_back(x.cwiseAbs().maxCoeff());
    }
    if (magnitudes.empty()) return 1.0f;
    const auto middle = magnitudes.begin() + static_cast<ptrdiff_t>(magnitudes.size() / 2);
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    if (*middle > 0.0f) return unit_scale(double{*middle});
    return unit_scale(double{*std::max_element(middle, magnitudes.end())});
}

// Replaces triangles without area by points, which no ray hits. Otherwise rounding could let a ray
// hit a triangle that is a line.
std::vector<Triangle> without_needles(const Topology& topology, std::span<const Vec3f> positions) {
    std::vector<Triangle> triangles = topology.triangles;
    for (Triangle& t : triangles) {
        if (face_normal(positions[t[0]], positions[t[1]], positions[t[2]]).isZero(0.0)) {
            t = {t[0], t[0], t[0]};
        }
    }
    return triangles;
}

}  // namespace

struct RayScene::Impl {
    Device device;
    RTCScene scene = nullptr;
    float scale = 1.0f;                   // of the coordinates given to Embree
    uint32_t first_triangle[2] = {0, 0};  // of each mesh

    void attach(unsigned int id, const Topology& topology, std::span<const Vec3f> positions) {
        if (topology.triangles.empty()) return;
        std::vector<Vec3f> scaled(positions.begin(), positions.end());
        for (Vec3f& x : scaled) x *= scale;
        const RTCGeometry geometry = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
        set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, scaled.data(),
                   scaled.size());
        const std::vector<Triangle> triangles = without_needles(topology, positions);
        set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.data(),
                   triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    ~Impl() {
        if (scene != nullptr) rtcReleaseScene(scene);
    }
};

RayScene::RayScene(const Topology& topology, std::span<const Vec3f> positions)
    : RayScene(topology, positions, {}, {}) {}

RayScene::RayScene(const Topology& topology, std::span<const Vec3f> positions,
                   const Topology& still_mesh, std::span<const Vec3f> still_positions)
    : impl_(std::make_unique<Impl>()) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(still_positions.size(), still_mesh.num_vertices);
    impl_->scene = rtcNewScene(impl_->device.handle());
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
    impl_->scale = embree_scale(positions, still_positions);
    impl_->attach(0, topology, positions);
    impl_->attach(1, still_mesh, still_positions);
    impl_->first_triangle[1] = static_cast<uint32_t>(topology.triangles.size());
    rtcCommitScene(impl_->scene);
    impl_->device.throw_if_failed();
}

RayScene::~RayScene() = default;

namespace {

constexpr uint32_t kPacket = 16;

// Sets the members that all rays from one origin share.
void set_origin(const Vec3f& start, RTCRay16& rays) {
    std::fill_n(rays.org_x, kPacket, start.x());
    std::fill_n(rays.org_y, kPacket, start.y());
    std::fill_n(rays.org_z, kPacket, start.z());
    std::fill_n(rays.mask, kPacket, 0xffffffffu);
}

// Sets the directions of num_rays rays of a packet; the others are not valid.
void set_directions(const float* x, const float* y, const float* z, uint32_t num_rays,
                    RTCRay16& rays, int* valid) {
    for (uint32_t j = 0; j < kPacket; ++j) valid[j] = j < num_rays ? -1 : 0;
    std::copy_n(x, num_rays, rays.dir_x);
    std::copy_n(y, num_rays, rays.dir_y);
    std::copy_n(z, num_rays, rays.dir_z);
    std::fill_n(rays.tfar, kPacket, std::numeric_limits<float>::infinity());
}

}  // namespace

uint32_t RayScene::occluded(const Vec3f& origin, const float* x, const float* y, const float* z,
                            uint32_t count, float* occluded) const {
    embree::Context context;
    RTCRay16 rays{};
    set_origin(impl_->scale * origin, rays);
    alignas(64) int valid[kPacket];
    uint32_t num_occluded = 0;
    for (uint32_t first = 0; first < count; first += kPacket) {
        const uint32_t num_rays = std::min(kPacket, count - first);
        set_directions(x + first, y + first, z + first, num_rays, rays, valid);
        context.occluded(valid, impl_->scene, rays);
        for (uint32_t j = 0; j < num_rays; ++j) {
            const bool hit = rays.tfar[j] < 0.0f;  // Embree's mark of an occluded ray
            occluded[first + j] = hit ? 1.0f : 0.0f;
            num_occluded += hit ? 1 : 0;
        }
    }
    return num_occluded;
}

void RayScene::intersect(const Vec3f& origin, const float* x, const float* y, const float* z,
                         uint32_t count, Hit* hits) const {
    embree::Context context;
    RTCRayHit16 query{};
    set_origin(impl_->scale * origin, query.ray);
    alignas(64) int valid[kPacket];
    for (uint32_t first = 0; first < count; first += kPacket) {
        const uint32_t num_rays = std::min(kPacket, count - first);
        set_directions(x + first, y + first, z + first, num_rays, query.ray, valid);
        std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(query.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
        context.intersect(valid, impl_->scene, query);
        for (uint32_t j = 0; j < num_rays; ++j) {
            const unsigned int mesh = query.hit.geomID[j];
            hits[first + j] = {query.ray.tfar[j] / impl_->scale, kNoTriangle, query.hit.u[j],
                               query.hit.v[j]};
            if (mesh == RTC_INVALID_GEOMETRY_ID) continue;
            hits[first + j].triangle = impl_->first_triangle[mesh] + query.hit.primID[j];
        }
    }
}

std::optional<Hit> RayScene::intersect_first(const Vec3f& origin, const Vec3f& direction,
                                             std::span<const uint32_t> ignored) const {
    embree::Context context;
    RTCRayHit query;
    for (float after = 0.0f;;) {
        query.ray = embree::make_ray(impl_->scale * origin, direction);
        query.ray.tnear = after;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        context.intersect(impl_->scene, query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const uint32_t triangle = impl_->first_triangle[query.hit.geomID] + query.hit.primID;
        if (!std::binary_search(ignored.begin(), ignored.end(), triangle)) {
            return Hit{query.ray.tfar / impl_->scale, triangle, query.hit.u, query.hit.v};
        }
        // Goes on behind it, by more than the rounding of distances: coordinates are about 1 here.
        after = query.ray.tfar * (1.0f + 0x1p-21f) + 0x1p-100f;
    }
}

}  // namespace paim
