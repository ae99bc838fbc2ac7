// Points between those of a grid, near a wanted limit.
#include "analysis/trade/refine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "analysis/trade/grid.h"

namespace paim {

namespace {

// The largest --max-error that is tried. Files of larger errors have nothing in common with the
// bake.
constexpr double kLargestMaxError = 0.5;
// Errors that are not told apart.
constexpr double kSameError = 1.01;

TradeValues values_of(const TradePoint& point, TradeError kind) {
    return trade_values({point}, kind).front();
}

// What is to be small within the limit.
double objective(const TradePoint& point, TradeLimit::Of of, TradeError kind) {
    return of == TradeLimit::Of::error ? static_cast<double>(point.size_bytes)
                                       : error_of(point, kind);
}

// Multiply-adds are those of a few numbers of components. So one near the limit does not mean that
// no smaller error has the same.
bool come_in_steps(const TradeLimit& limit) {
    return limit.of == TradeLimit::Of::multiply_adds;
}

// Where between the two the limit is, by a power law: 0 at `within`, 1 at `beyond`. Halfway where
// values say nothing.
double place_of_limit(const Bracket& bracket, const TradeLimit& limit, TradeError kind) {
    constexpr double kHalfway = 0.5;
    constexpr int kByLaw = 2;  // what such points miss by, no law tells
    if (!bracket.beyond || come_in_steps(limit) || bracket.num_tried >= kByLaw) return kHalfway;
    const double within = value_of(values_of(bracket.within, kind), limit.of);
    const double beyond = value_of(values_of(*bracket.beyond, kind), limit.of);
    const double place = std::log(limit.at_most / within) / std::log(beyond / within);
    return place >= 0.0 && place <= 1.0 ? place : kHalfway;
}

double between(double a, double b, double place) {
    if (!(a > 0.0 && b > 0.0)) return a;
    return a * std::pow(b / a, place);
}

void expect(Bracket& bracket, const TradeLimit& limit, TradeError kind) {
    const TradePoint& within = bracket.within;
    const TradePoint& beyond = bracket.beyond ? *bracket.beyond : within;
    const double place = place_of_limit(bracket, limit, kind);
    bracket.expected =
        between(objective(within, limit.of, kind), objective(beyond, limit.of, kind), place);
    bracket.expected_multiply_adds = between(static_cast<double>(within.multiply_adds),
                                             static_cast<double>(beyond.multiply_adds), place);
}

// Of points of one family, by ascending --max-error.
std::optional<Bracket> bracket_of(const std::vector<const TradePoint*>& family,
                                  const TradeLimit& limit, TradeError kind) {
    const auto within = [&](const TradePoint* point) {
        return is_within(values_of(*point, kind), limit);
    };
    Bracket bracket;
    if (limit.of == TradeLimit::Of::error) {
        // The largest --max-error that is within, and the one after it.
        const auto last = std::find_if(family.rbegin(), family.rend(), within);
        if (last == family.rend()) return std::nullopt;
        bracket.within = **last;
        if (last != family.rbegin()) {
            bracket.beyond = **std::prev(last);
        } else if (bracket.within.settings.transfer_error() < kLargestMaxError) {
            bracket.beyond_error = kLargestMaxError;
        } else {
            return std::nullopt;
        }
    } else {
        const auto first = std::find_if(family.begin(), family.end(), within);
        if (first == family.end() || first == family.begin()) return std::nullopt;
        bracket.within = **first;
        bracket.beyond = **std::prev(first);
    }
    if (bracket.beyond) bracket.beyond_error = bracket.beyond->settings.transfer_error();
    expect(bracket, limit, kind);
    return bracket;
}

// The most promising ones: by what is wanted, and for an error one by multiply-adds, too.
std::vector<Bracket> promising(std::vector<Bracket> all, const TradeLimit& limit) {
    if (all.size() <= kMostBrackets) return all;
    std::vector<Bracket> some(all.begin(), all.begin() + kMostBrackets);
    if (limit.of != TradeLimit::Of::error) return some;
    const auto cheapest =
        std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.expected_multiply_adds < b.expected_multiply_adds;
        });
    if (cheapest - all.begin() >= static_cast<std::ptrdiff_t>(kMostBrackets)) {
        some.back() = *cheapest;
    }
    return some;
}

}  // namespace

std::vector<Bracket> brackets(const std::vector<TradePoint>& points, const TradeLimit& limit,
                              TradeError kind) {
    using Family = std::tuple<uint32_t, std::string, Preference, bool>;
    std::map<Family, std::vector<const TradePoint*>> families;
    for (const TradePoint& point : points) {
        const TradeSettings& settings = point.settings;
        // Other bakes are gone by now, and plain storage has no steps to choose.
        if (std::isnan(error_of(point, kind)) || settings.rays != 0 || settings.is_plain()) {
            continue;
        }
        families[{settings.bands, settings.codec, settings.preference,
                  settings.geometry_error.empty()}]
            .push_back(&point);
    }
    std::vector<Bracket> result;
    for (auto& [family, members] : families) {
        std::stable_sort(members.begin(), members.end(), [](const auto* a, const auto* b) {
            return a->settings.transfer_error() < b->settings.transfer_error();
        });
        if (auto bracket = bracket_of(members, limit, kind)) result.push_back(std::move(*bracket));
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.expected < b.expected; });
    return result;
}

std::optional<std::string> next_error(const Bracket& bracket, const TradeLimit& limit,
                                      TradeError kind) {
    const double near = value_of(values_of(bracket.within, kind), limit.of);
    if (!come_in_steps(limit) && near >= kNearLimit * limit.at_most) return std::nullopt;
    const double within = bracket.within.settings.transfer_error(), beyond = bracket.beyond_error;
    if (std::abs(std::log(beyond / within)) <= std::log(kSameError)) return std::nullopt;
    // A little within the limit, and never so near to an end that nothing is learnt.
    constexpr double kWithin = 0.98, kLeast = 0.1, kMost = 0.9;
    const TradeLimit aim{limit.of, kWithin * limit.at_most};
    const double place = std::clamp(place_of_limit(bracket, aim, kind), kLeast, kMost);
    const std::string text = max_error_text(between(within, beyond, place));
    if (text == bracket.within.settings.max_error) return std::nullopt;
    if (bracket.beyond && text == bracket.beyond->settings.max_error) return std::nullopt;
    return text;
}

void refine_points(std::vector<TradePoint>& points, const TradeLimit& limit,
                   const std::function<std::optional<TradePoint>(const TradeSettings&)>& measure,
                   const std::function<void(uint64_t)>& on_points) {
    const TradeError kind = error_kind(points);
    std::vector<Bracket> some = promising(brackets(points, limit, kind), limit);
    // Those of the same bands have much in common.
    std::stable_sort(some.begin(), some.end(), [](const auto& a, const auto& b) {
        return a.within.settings.bands > b.within.settings.bands;
    });
    for (Bracket& bracket : some) {
        for (int round = 0; round < kMostRefined; ++round) {
            on_points(1);
            const auto error = next_error(bracket, limit, kind);
            if (!error) continue;
            TradeSettings settings = bracket.within.settings;
            if (!settings.geometry_error.empty()) {  // in the same ratio
                settings.geometry_error = max_error_text(
                    settings.geometry_target() * max_error_of(*error) / settings.transfer_error());
            }
            settings.max_error = *error;
            ++bracket.num_tried;
            std::optional<TradePoint> point = measure(settings);
            if (!point) {  // as if it were beyond
                bracket.beyond_error = settings.transfer_error();
                bracket.beyond.reset();
                continue;
            }
            point->refined = true;
            points.push_back(*point);
            if (is_within(values_of(*point, kind), limit)) {
                bracket.within = std::move(*point);
            } else {
                bracket.beyond_error = settings.transfer_error();
                bracket.beyond = std::move(*point);
            }
        }
    }
}

}  // namespace paim
