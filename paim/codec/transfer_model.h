// Coded transfer: the interface that every codec implements, and the value that owns one.
//
// A codec is one folder with a class that implements this interface, and a line in codecs.cpp. No
// other code asks which codec it is. All codecs store a matrix over the poses (LowRank); they
// differ in what a point of that matrix is, and in how vertices are rebuilt from points.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/export.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/low_rank.h"
#include "paim/transfer/layout.h"

namespace paim {

struct FrameCost;      // codec/frame_cost.h
struct NamedNumber;    // codec/section_row.h
struct PointGroups;    // codec/point_groups.h
struct SectionRow;     // the same
class TransferPlayer;  // codec/transfer_player.h

class PAIM_EXPORT TransferModel {
  public:
    virtual ~TransferModel();

    // The name of the codec in files and messages.
    virtual std::string_view codec_name() const = 0;
    virtual std::unique_ptr<TransferModel> clone() const = 0;

    virtual uint32_t num_vertices() const = 0;
    // Components of each vertex in addition to those over the poses; 0 if the codec has none.
    virtual uint32_t num_vertex_components() const { return 0; }

    // Computes the values of all vertices from those of the points, on all threads. It is not
    // called for codecs whose points are the vertices.
    // points          [planes][N] steps applied
    // num_components  at most num_vertex_components(): how many of them to use
    // out             [planes][V]
    virtual bool points_are_vertices() const { return false; }
    virtual void vertices_from_points(std::span<const float> points, uint32_t num_components,
                                      std::span<float> out) const;

    // An object that decodes and lights, with its own scratch memory. It keeps references to this
    // model and to the layout.
    virtual std::unique_ptr<TransferPlayer> make_player(const TransferLayout& layout) const;

    // Multiply-adds of a frame within the limits.
    // coloured_light  whether the light has three channels
    virtual FrameCost cost(const TransferLayout& layout, const DecodeLimits& limits,
                           bool coloured_light) const = 0;

    // Bytes in memory of all values outside the matrix, with the first num_components of each
    // vertex.
    virtual uint64_t vertex_bytes(uint32_t num_components) const;

    // Largest factor by which magnitudes grow from points to vertices. The reader uses it to check
    // that a file decodes to finite values before it decodes any.
    virtual double vertex_gain() const { return 1.0; }

    // How vertices are made of points. Nothing if points_are_vertices().
    virtual std::optional<PointGroups> point_groups() const;

    // The numbers of the metadata that this codec has, in the order of the file.
    virtual std::vector<NamedNumber> numbers();
    // The same numbers, to be read only.
    std::vector<NamedNumber> numbers() const;
    // Called when the numbers have been read.
    // num_vertices  of the mesh
    // returns       number of points of the matrix
    virtual uint32_t start(uint32_t num_vertices) = 0;
    // The sections in addition to those of the matrix, in the order of the file. Called after
    // start().
    virtual std::vector<SectionRow> sections();
    // Whether files store these sections packed even if all their values are floats.
    virtual bool always_packed() const { return false; }

    LowRank matrix;

  protected:
    TransferModel() = default;
    explicit TransferModel(LowRank values) : matrix(std::move(values)) {}
    TransferModel(const TransferModel&) = default;
    TransferModel& operator=(const TransferModel&) = default;
};

// Owns a TransferModel and copies like a value. A default one is empty: it may only be assigned to,
// or be asked whether it is empty.
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

    // The model as its own type, for code of the codec itself; nullptr if the codec is another.
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
