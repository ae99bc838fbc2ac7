// Coded transfer: the interface that every codec implements, and the value that owns one.
//
// A codec is one folder: its class here, its name in codecs.cpp, and nothing elsewhere asks which
// codec it is. All of them store a matrix over the poses (LowRank); they differ in what a point of that
// matrix is, and in how vertices are rebuilt from points.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/export.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/low_rank.h"
#include "paim/codec/section_row.h"
#include "paim/transfer/layout.h"

namespace paim {

struct FrameCost;      // codec/frame_cost.h
class TransferPlayer;  // codec/transfer_player.h

class PAIM_EXPORT TransferModel {
  public:
    virtual ~TransferModel();

    // What people and programs call the codec.
    virtual std::string_view codec_name() const = 0;
    virtual std::unique_ptr<TransferModel> clone() const = 0;

    virtual uint32_t num_vertices() const = 0;
    // Components that every vertex combines, in addition to those over the poses; 0 if there are none.
    virtual uint32_t num_vertex_components() const { return 0; }

    // Every vertex's values from the points' values, on all threads. Codecs whose points are the
    // vertices do not get this call.
    // points          [planes][N] steps applied
    // num_components  at most num_vertex_components(): how many of them to use
    // out             [planes][V]
    virtual bool points_are_vertices() const { return false; }
    virtual void vertices_from_points(std::span<const float> points, uint32_t num_components,
                                      std::span<float> out) const;

    // Decodes and lights, with scratch memory of its own. Keeps references to both arguments' data.
    virtual std::unique_ptr<TransferPlayer> make_player(const TransferLayout& layout) const;

    // Multiply-adds of a frame within the limits. coloured_light  of three channels
    virtual FrameCost cost(const TransferLayout& layout, const DecodeLimits& limits,
                           bool coloured_light) const = 0;

    // Bytes in memory of everything but the matrix, with the first num_components per vertex.
    virtual uint64_t vertex_bytes(uint32_t num_components) const;

    // Largest factor by which magnitudes grow from points to vertices, so that what a file decodes to
    // is known to be finite before anything is decoded.
    virtual double vertex_gain() const { return 1.0; }

    // How squares of point values add up over the vertices: quadratic forms of consecutive runs of
    // points; empty: each point counts once.
    virtual std::vector<Eigen::MatrixXd> point_metrics() const { return {}; }

    // Numbers of the metadata that describe this codec, in the order of the file. The codec's marker
    // (codecs.h) is one of them.
    virtual std::vector<NamedNumber> numbers() { return {}; }
    // For those who only read them.
    std::vector<NamedNumber> numbers() const { return const_cast<TransferModel*>(this)->numbers(); }
    // Called when the numbers are read: how many points the matrix has. num_vertices  of the mesh
    virtual uint32_t start(uint32_t num_vertices) = 0;
    // Sections beyond those of the matrix, in the order of the file; sizes are known by now.
    virtual std::vector<SectionRow> sections() { return {}; }
    // Whether files store these sections packed although all of their values are floats.
    virtual bool always_packed() const { return false; }

    LowRank matrix;

  protected:
    TransferModel() = default;
    explicit TransferModel(LowRank values) : matrix(std::move(values)) {}
    TransferModel(const TransferModel&) = default;
    TransferModel& operator=(const TransferModel&) = default;
};

// Owns a TransferModel and copies like a value. A default one is empty: nothing but assigning to it,
// and asking whether it is, makes sense then.
class CodedTransfer {
  public:
    CodedTransfer() = default;
    template <typename Model, typename = std::enable_if_t<
                                  std::is_base_of_v<TransferModel, std::remove_cvref_t<Model>>>>
    CodedTransfer(Model&& model)
        : model_(std::make_unique<std::remove_cvref_t<Model>>(std::forward<Model>(model))) {}
    CodedTransfer(std::unique_ptr<TransferModel> model) : model_(std::move(model)) {}
    CodedTransfer(const CodedTransfer& other)
        : model_(other.model_ ? other.model_->clone() : nullptr) {}
    CodedTransfer(CodedTransfer&&) noexcept = default;
    CodedTransfer& operator=(CodedTransfer other) noexcept {
        model_ = std::move(other.model_);
        return *this;
    }
    ~CodedTransfer() = default;

    bool empty() const { return model_ == nullptr; }
    const TransferModel* operator->() const { return get(); }
    TransferModel* operator->() {
        PAIM_CHECK(model_ != nullptr);
        return model_.get();
    }
    const TransferModel& operator*() const { return *get(); }
    TransferModel& operator*() { return *operator->(); }

    // The codec's own type, for the codec's own code; nullptr if it is another codec.
    template <typename Model>
    const Model* as() const {
        return dynamic_cast<const Model*>(model_.get());
    }
    template <typename Model>
    Model* as() {
        return dynamic_cast<Model*>(model_.get());
    }

  private:
    const TransferModel* get() const {
        PAIM_CHECK(model_ != nullptr);
        return model_.get();
    }

    std::unique_ptr<TransferModel> model_;
};

}  // namespace paim
