// Differences of two poses, vertex by vertex.
#include "player/inspect/limit_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/face_vertices.h"

namespace paim::player {

namespace {

constexpr size_t kVerticesAtOnce = 4096;
constexpr uint32_t kAll = std::numeric_limits<uint32_t>::max();

// Squared norms of the difference and of the whole, of vertices [first, first + sums.size()).
// limited  within fewer or as many bands as whole
void add_planes(const TransferLayout& limited_layout, std::span<const float> limited,
                const TransferLayout& whole_layout, std::span<const float> whole, size_t first,
                std::span<double> errors, std::span<double> norms) {
    const size_t num_vertices = whole.size() / whole_layout.num_planes();
    for (uint32_t channel = 0; channel < whole_layout.channels; ++channel) {
        for (uint32_t i = 0; i < whole_layout.num_coefficients(); ++i) {
            const float* const all =
                whole.data() + whole_layout.plane(channel, i) * num_vertices + first;
            const float* const some =
                i < limited_layout.num_coefficients()
                    ? limited.data() + limited_layout.plane(channel, i) * num_vertices + first
                    : nullptr;
            for (size_t v = 0; v < errors.size(); ++v) {
                const double value = double{all[v]};
                const double error = some == nullptr ? value : double{some[v]} - value;
                errors[v] += error * error;
                norms[v] += value * value;
            }
        }
    }
}

double fraction_of(double error, double reference) {
    return error == 0.0 ? 0.0 : error / reference;
}

}  // namespace

LimitErrors::Part::Part(const CodedMesh& coded)
    : mesh(coded),
      counted(face_vertices(coded.topology)),
      player(coded.transfer->make_player(coded.layout)) {}

LimitErrors::LimitErrors(std::shared_ptr<const Asset> asset)
    : asset_(std::move(asset)), limited_(asset_), whole_(asset_) {
    for (const CodedMesh& mesh : asset_->parts) parts_.emplace_back(mesh);
    errors_.resize(parts_.size());
}

void LimitErrors::set_light(const LightField& light) {
    limited_.set_light(light);
    whole_.set_light(light);
    has_light_ = true;
}

const std::vector<std::vector<float>>& LimitErrors::measure(ErrorOf what, double time,
                                                            const DecodeLimits& limits) {
    switch (what) {
        case ErrorOf::transfer:
            measure_transfer(time, limits);
            break;
        case ErrorOf::radiance:
            measure_radiance(time, limits);
            break;
        case ErrorOf::position:
            measure_positions(time, limits);
            break;
    }
    return errors_;
}

const Playback& LimitErrors::play(double time, const DecodeLimits& limits) {
    PAIM_CHECK(has_light_);
    limited_.update(time, limits);
    return limited_;
}

void LimitErrors::measure_transfer(double time, const DecodeLimits& limits) {
    for (size_t number = 0; number < parts_.size(); ++number) {
        Part& part = parts_[number];
        if (part.whole_time != time) {
            part.player->decode(time, {}, part.whole_layout, part.whole);
            part.whole_time = time;
        }
        part.player->decode(time, limits, part.layout, part.limited);
        const size_t num_vertices = part.mesh.topology.num_vertices;
        part.norms.resize(num_vertices);
        errors_[number].resize(num_vertices);
        parallel_for(num_vertices, kVerticesAtOnce, [&](size_t first, size_t end) {
            std::array<double, kVerticesAtOnce> sums{};
            const std::span errors = std::span(sums).first(end - first);
            const std::span norms = std::span(part.norms).subspan(first, end - first);
            std::fill(norms.begin(), norms.end(), 0.0);
            add_planes(part.layout, part.limited, part.whole_layout, part.whole, first, errors,
                       norms);
            for (size_t v = first; v < end; ++v) {
                errors_[number][v] = static_cast<float>(std::sqrt(errors[v - first]));
            }
        });
    }
    divide_by(root_mean_square());
}

void LimitErrors::measure_radiance(double time, const DecodeLimits& limits) {
    play(time, limits);
    whole_.update(time);
    for (size_t number = 0; number < parts_.size(); ++number) {
        const std::span limited = limited_.radiance(number);
        const std::span whole = whole_.radiance(number);
        parts_[number].norms.resize(whole.size());
        errors_[number].resize(whole.size());
        parallel_for(whole.size(), kVerticesAtOnce, [&](size_t first, size_t end) {
            for (size_t v = first; v < end; ++v) {
                parts_[number].norms[v] = whole[v].cast<double>().squaredNorm();
                errors_[number][v] = (limited[v] - whole[v]).norm();
            }
        });
    }
    divide_by(root_mean_square());
}

void LimitErrors::measure_positions(double time, const DecodeLimits& limits) {
    for (size_t number = 0; number < parts_.size(); ++number) {
        Part& part = parts_[number];
        const LowRank& matrix = part.mesh.positions;
        part.decoder.decode(matrix, time, kAll, part.whole_positions);
        part.decoder.decode(matrix, time, limits.geometry_components, part.limited_positions);
        const size_t num_vertices = part.mesh.topology.num_vertices;
        errors_[number].resize(num_vertices);
        parallel_for(num_vertices, kVerticesAtOnce, [&](size_t first, size_t end) {
            for (size_t v = first; v < end; ++v) {
                Vec3d difference;
                for (size_t axis = 0; axis < 3; ++axis) {
                    const size_t row = axis * num_vertices + v;
                    difference[static_cast<int>(axis)] =
                        double{part.limited_positions[row]} - double{part.whole_positions[row]};
                }
                errors_[number][v] = static_cast<float>(difference.norm());
            }
        });
    }
    Part& body = parts_.front();
    const uint32_t num_usual = body.mesh.positions.num_usual_components();
    if (num_usual < body.mesh.positions.num_components) {
        body.decoder.decode(body.mesh.positions, time, num_usual, body.whole_positions);
    }
    divide_by(double{body_bounds(body.mesh, body.whole_positions, body.counted).diagonal()});
}

// Of the whole file, over the counted vertices of all parts, in their order.
double LimitErrors::root_mean_square() const {
    double sum = 0.0;
    size_t count = 0;
    for (const Part& part : parts_) {
        for (const uint32_t v : part.counted) sum += part.norms[v];
        count += part.counted.size();
    }
    return std::sqrt(sum / static_cast<double>(count));
}

void LimitErrors::divide_by(double reference) {
    for (std::vector<float>& errors : errors_) {
        for (float& error : errors) {
            error = static_cast<float>(fraction_of(double{error}, reference));
        }
    }
}

Bounds body_bounds(const CodedMesh& mesh, std::span<const float> positions,
                   std::span<const uint32_t> counted) {
    const size_t num_following = num_below(mesh.num_following, counted);
    return bounds_of_vertices(positions,
                              num_following == 0 ? counted : counted.first(num_following));
}

bool show_all(const Asset& asset, const DecodeLimits& limits) {
    return std::all_of(asset.parts.begin(), asset.parts.end(), [&](const CodedMesh& mesh) {
        return limits.geometry_components >= mesh.positions.num_components &&
               limits.transfer_components >= mesh.transfer->matrix.num_components &&
               limits.vertex_components >= mesh.transfer->num_vertex_components() &&
               limits.bands >= mesh.layout.in_bands;
    });
}

}  // namespace paim::player
