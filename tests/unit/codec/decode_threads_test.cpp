// Decoded frames: the same bytes on any number of threads, and as the plain loops give them, of
// meshes of many pieces of work.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/accumulate.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/svd/svd_transfer.h"

// Pieces of memory large enough to hold values of a pose that were taken since the program began.
static std::atomic<int> num_large_pieces{0};

static void* take(size_t size, size_t alignment) {
    constexpr size_t kLarge = 1000;
    if (size >= kLarge) ++num_large_pieces;
    void* const memory =
        std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
void* operator new(size_t size) {
    return take(std::max<size_t>(size, 1), __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(size_t size, std::align_val_t alignment) {
    return take(std::max<size_t>(size, 1), static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace paim {
namespace {

constexpr uint32_t kVertices = 9001;

template <typename T>
StoredValues random_values(RandomStream& random, size_t count, double limit) {
    std::vector<T> values(count);
    for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
    return values;
}

LowRank random_matrix(uint32_t num_points, uint32_t num_planes) {
    RandomStream random(num_planes);
    LowRank matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_poses = 3;
    matrix.num_components = 5;
    matrix.precision = Precision::i16;
    for (uint32_t j = 0; j < num_planes; ++j) matrix.steps.push_back(0.01f * float(j + 1));
    matrix.mean = random_values<int16_t>(random, matrix.num_rows(), 30000.0);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        matrix.components.push_back(k < 2
                                        ? random_values<int16_t>(random, matrix.num_rows(), 30000.0)
                                        : random_values<int8_t>(random, matrix.num_rows(), 127.0));
    }
    for (int j = 0; j < 15; ++j) matrix.weights.push_back(float(random.uniform()) - 0.5f);
    return matrix;
}

CodedMesh random_mesh(bool clustered) {
    CodedMesh mesh;
    mesh.topology.num_vertices = kVertices;
    mesh.layout = {TransferKind::diffuse, 3, 1};
    mesh.positions = random_matrix(kVertices, 3);
    if (!clustered) {
        mesh.transfer = SvdTransfer(random_matrix(kVertices, 9));
        return mesh;
    }
    RandomStream random(4);
    VertexClusters clusters;
    clusters.num_clusters = 7;
    clusters.num_components = 4;
    for (uint32_t v = 0; v < kVertices; ++v) {
        clusters.cluster.push_back(static_cast<uint32_t>(6.999 * random.uniform()));
    }
    for (uint32_t j = 0; j < 4; ++j) {
        clusters.coefficients.push_back(random_values<int8_t>(random, kVertices, 127.0));
    }
    clusters.scales.assign(clusters.num_rows(), 0.5f);
    LowRank bases = random_matrix(clusters.num_rows(), 9);
    mesh.transfer = CpcaTransfer(std::move(bases), std::move(clusters));
    return mesh;
}

TEST(DecodeThreads, GiveTheSameBytes) {
    for (const bool clustered : {false, true}) {
        const CodedMesh mesh = random_mesh(clustered);
        MeshDecoder decoder(mesh);
        DecodedPose one, some;
        {
            const ThreadLimit limit(1);
            decoder.decode(1.3, {}, one);
        }
        for (const int num_threads : {2, 3, 7}) {
            const ThreadLimit limit(num_threads);
            decoder.decode(1.3, {}, some);
            EXPECT_EQ(some.positions, one.positions);
            EXPECT_EQ(some.transfer, one.transfer);
        }
    }
}

TEST(DecodeThreads, GiveTheBytesOfThePlainLoop) {
    const CodedMesh mesh = random_mesh(false);
    DecodedPose pose;
    MeshDecoder(mesh).decode(1.3, {}, pose);
    const LowRank& matrix = mesh.transfer->matrix;
    std::vector<float> weights, plane(kVertices);
    interpolate_weights(matrix, 1.3, weights);
    for (uint32_t j = 0; j < matrix.num_planes; ++j) {
        accumulate(matrix.mean, matrix.components, weights, matrix.step(j), size_t{j} * kVertices,
                   plane, VectorUnit::plain);
        EXPECT_TRUE(std::equal(plane.begin(), plane.end(),
                               pose.transfer.begin() + ptrdiff_t{j} * kVertices));
    }
}

// Frames of one decoder into one pose: the work space is that of the first. The smallest, the rows
// of the bases, has 35 rows of 9 planes: 1260 bytes.
TEST(DecodeThreads, KeepTheWorkSpace) {
    for (const bool clustered : {false, true}) {
        const CodedMesh mesh = random_mesh(clustered);
        MeshDecoder decoder(mesh);
        DecodedPose pose;
        decoder.decode(0.0, {}, pose);
        const std::vector<const float*> before{pose.positions.data(), pose.transfer.data()};
        const int taken = num_large_pieces;
        decoder.decode(1.0, {.bands = 2}, pose);
        decoder.decode(2.0, {}, pose);
        EXPECT_EQ(num_large_pieces, taken);
        EXPECT_EQ(before, (std::vector<const float*>{pose.positions.data(), pose.transfer.data()}));
    }
}

}  // namespace
}  // namespace paim
