// Values of a matrix in memory: floats, or small integers that are multiples of a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "paim/base/check.h"

namespace paim {

// How values are stored in files. In memory half floats are floats; integers stay integers.
enum class Precision : uint32_t { f32 = 0, f16 = 1, i16 = 2, i8 = 3 };

constexpr const char* precision_name(Precision precision) {
    switch (precision) {
        case Precision::f32:
            return "f32";
        case Precision::f16:
            return "f16";
        case Precision::i16:
            return "i16";
        case Precision::i8:
            return "i8";
    }
    return "unknown";
}

constexpr bool is_integer(Precision precision) {
    return precision == Precision::i16 || precision == Precision::i8;
}

// The largest magnitude of an integer of this precision: 127 or 32767, so that the range is
// symmetrical.
constexpr int32_t largest_integer(Precision precision) {
    return precision == Precision::i8 ? 127 : 32767;
}

class StoredValues {
  public:
    using Values = std::variant<std::vector<float>, std::vector<int16_t>, std::vector<int8_t>>;

    StoredValues() = default;
    StoredValues(std::vector<float> values) : values_(std::move(values)) {}
    StoredValues(std::vector<int16_t> values) : values_(std::move(values)) {}
    StoredValues(std::vector<int8_t> values) : values_(std::move(values)) {}

    size_t size() const {
        return std::visit([](const auto& values) { return values.size(); }, values_);
    }
    size_t size_bytes() const {
        return std::visit([](const auto& values) { return std::span(values).size_bytes(); },
                          values_);
    }
    bool empty() const { return size() == 0; }
    bool holds_floats() const { return std::holds_alternative<std::vector<float>>(values_); }
    bool holds_i8() const { return std::holds_alternative<std::vector<int8_t>>(values_); }

    // Value j, in steps.
    float operator[](size_t j) const {
        return std::visit([j](const auto& values) { return static_cast<float>(values[j]); },
                          values_);
    }

    // out[j] = value first + j, in steps.
    void widen(size_t first, std::span<float> out) const {
        std::visit(
            [&](const auto& values) {
                for (size_t j = 0; j < out.size(); ++j) {
                    out[j] = static_cast<float>(values[first + j]);
                }
            },
            values_);
    }

    // The values; they must be floats (checked).
    const std::vector<float>& floats() const {
        PAIM_CHECK(holds_floats());
        return std::get<std::vector<float>>(values_);
    }

    // Calls use(j, value j in steps) for each j in [first, first + count).
    template <typename Use>
    void for_each(size_t first, size_t count, const Use& use) const {
        std::visit(
            [&](const auto& values) {
                for (size_t j = first; j < first + count; ++j) {
                    use(j, static_cast<float>(values[j]));
                }
            },
            values_);
    }

    const Values& values() const { return values_; }

    bool operator==(const StoredValues&) const = default;

  private:
    Values values_;
};

}  // namespace paim
