// Notes about frame numbers that are missing, or there twice.
#include "compressor/io/frame_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>

#include "compressor/io/lower_case.h"
#include "compressor/io/name_numbers.h"

namespace paim {

namespace {

constexpr size_t kMaxNotes = 8;
constexpr size_t kMaxRanges = 6;          // in a note
constexpr size_t kMaxFractionDigits = 6;  // longer fractions are roundings, not steps
constexpr size_t kMaxWholeDigits = 12;

struct Frame {
    const std::filesystem::path* path = nullptr;
    std::string name;
    std::vector<NameNumber> numbers;
    size_t varying = 0;  // which of its numbers is that of the frame
};

std::string canonical(const NameNumber& number) {
    std::string text = number.negative ? "-" : "";
    text += number.whole.empty() ? "0" : number.whole;
    if (!number.fraction.empty()) text += '.' + std::string(number.fraction);
    return text;
}

// The name up to the number `last`, or all of it, with each number in one form; that at `skipped`
// is left out. The extension is in lower case.
std::string key_of(const Frame& frame, std::optional<size_t> last, std::optional<size_t> skipped) {
    const std::string& name = frame.name;
    std::string key;
    size_t at = 0;
    for (size_t i = 0; i < frame.numbers.size(); ++i) {
        key.append(name, at, frame.numbers[i].begin - at);
        key += '\1';  // in no name of a text
        if (i != skipped) key += canonical(frame.numbers[i]);
        key += '\1';
        at = frame.numbers[i].end;
        if (i == last) return key;
    }
    const size_t stem = std::max(at, stem_size(name));
    key.append(name, at, stem - at);
    for (const char c : name.substr(stem)) key += lower_case(c);
    return key;
}

// What alike names have in common: the key without any number.
std::string alike_key(const Frame& frame) {
    Frame without = frame;
    for (NameNumber& number : without.numbers) {
        number.negative = false;
        number.whole = number.fraction = {};
    }
    return key_of(without, std::nullopt, std::nullopt);
}

// The number as an integer in units of 10^-digits.
std::optional<int64_t> scaled(const NameNumber& number, size_t digits) {
    if (number.whole.size() > kMaxWholeDigits || number.fraction.size() > digits) return {};
    std::string text = '0' + std::string(number.whole) + std::string(number.fraction);
    text.append(digits - number.fraction.size(), '0');
    int64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return number.negative ? -value : value;
}

std::string unscaled(int64_t value, size_t digits) {
    std::string text = std::to_string(value < 0 ? -value : value);
    if (text.size() <= digits) text.insert(0, digits + 1 - text.size(), '0');
    if (digits > 0) {
        text.insert(text.size() - digits, 1, '.');
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return value < 0 ? '-' + text : text;
}

std::string gap_note(const std::vector<const Frame*>& row) {
    size_t digits = 0;
    for (const Frame* frame : row) {
        digits = std::max(digits, frame->numbers[frame->varying].fraction.size());
    }
    if (digits > kMaxFractionDigits) return {};
    std::vector<int64_t> values;
    for (const Frame* frame : row) {
        const auto value = scaled(frame->numbers[frame->varying], digits);
        if (!value) return {};
        values.push_back(*value);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (values.size() < 3) return {};

    int64_t step = values[1] - values[0];
    for (size_t i = 2; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
    size_t num_steps = 0, num_ranges = 0;
    std::string ranges;
    bool several = false;
    for (size_t i = 1; i < values.size(); ++i) {
        const int64_t difference = values[i] - values[i - 1];
        if (difference % step != 0) return {};
        if (difference == step) {
            ++num_steps;
            continue;
        }
        if (++num_ranges > kMaxRanges) continue;
        const int64_t first = values[i - 1] + step, last = values[i] - step;
        if (num_ranges > 1 || first != last) several = true;
        if (!ranges.empty()) ranges += ", ";
        ranges += unscaled(first, digits);
        if (first != last) ranges += " to " + unscaled(last, digits);
    }
    if (num_ranges == 0) return {};
    int64_t one = 1;
    for (size_t i = 0; i < digits; ++i) one *= 10;
    if (step != one && num_steps < 2) return {};
    if (num_ranges > kMaxRanges)
        ranges += fmt::format(" and {} more gaps", num_ranges - kMaxRanges);
    return fmt::format("{} to {}: {} {} missing", row.front()->path->string(), row.back()->name,
                       several ? "frames" : "frame", ranges + (several ? " are" : " is"));
}

using Row = std::vector<const Frame*>;

void note_twice(const Row& row, std::vector<std::string>& notes) {
    for (size_t i = 1; i < row.size(); ++i) {
        const NameNumber& number = row[i]->numbers[row[i]->varying];
        if (compare(number, row[i - 1]->numbers[row[i - 1]->varying]) != 0) continue;
        notes.push_back(fmt::format("{}: frame {} is also in {}", row[i]->path->string(),
                                    canonical(number), row[i - 1]->name));
    }
}

// Which number of alike names differs, the last one of several.
std::optional<size_t> varying_number(const Row& alike) {
    const size_t count = alike.front()->numbers.size();
    for (size_t k = count; k-- > 0;) {
        for (const Frame* frame : alike) {
            if (compare(frame->numbers[k], alike.front()->numbers[k]) != 0) return k;
        }
    }
    return std::nullopt;
}

// Notes names that continue where the name of a frame ends.
void note_copies(const std::map<std::string, std::vector<Frame*>>& kinds,
                 std::vector<std::string>& notes) {
    struct Place {
        const Frame* frame;
        size_t kind_size;
    };
    std::map<std::string, Place> places;
    for (const auto& [key, kind] : kinds) {
        if (kind.size() < 3) continue;
        for (const Frame* frame : kind) {
            if (frame->varying >= frame->numbers.size()) continue;
            places.try_emplace(key_of(*frame, frame->varying, std::nullopt),
                               Place{frame, kind.size()});
        }
    }
    for (const auto& [key, kind] : kinds) {
        for (const Frame* frame : kind) {
            for (size_t i = 0; i < frame->numbers.size(); ++i) {
                const auto found = places.find(key_of(*frame, i, std::nullopt));
                if (found == places.end()) continue;
                const Place& place = found->second;
                if (place.frame == frame || 2 * kind.size() > place.kind_size) continue;
                notes.push_back(fmt::format("{}: frame {} is also in {}", frame->path->string(),
                                            canonical(frame->numbers[i]), place.frame->name));
                break;
            }
        }
    }
}

void note_folder(std::vector<Frame>& frames, std::vector<std::string>& notes) {
    std::vector<std::string_view> names;
    for (const Frame& frame : frames) names.emplace_back(frame.name);
    auto numbers = find_numbers(names);
    std::map<std::string, std::vector<Frame*>> kinds;
    for (size_t i = 0; i < frames.size(); ++i) {
        frames[i].numbers = std::move(numbers[i]);
        frames[i].varying = frames[i].numbers.size();
        if (!frames[i].numbers.empty()) kinds[alike_key(frames[i])].push_back(&frames[i]);
    }
    for (auto& [key, kind] : kinds) {
        const Row alike(kind.begin(), kind.end());
        std::optional<size_t> varying = varying_number(alike);
        if (!varying && alike.size() > 1) varying = alike.front()->numbers.size() - 1;
        if (!varying) continue;
        std::map<std::string, Row> rows;
        for (Frame* frame : kind) {
            frame->varying = *varying;
            rows[key_of(*frame, std::nullopt, varying)].push_back(frame);
        }
        for (auto& [row_key, row] : rows) {
            std::stable_sort(row.begin(), row.end(), [&](const Frame* a, const Frame* b) {
                return compare(a->numbers[*varying], b->numbers[*varying]) < 0;
            });
            if (std::string note = gap_note(row); !note.empty()) notes.push_back(std::move(note));
            note_twice(row, notes);
        }
    }
    note_copies(kinds, notes);
}

}  // namespace

void append_frame_notes(const std::vector<std::filesystem::path>& files,
                        std::vector<std::string>& notes) {
    std::map<std::filesystem::path, std::vector<Frame>> folders;
    for (const std::filesystem::path& file : files) {
        folders[file.parent_path()].push_back({&file, file.filename().string(), {}, 0});
    }
    std::vector<std::string> found;
    for (auto& [folder, frames] : folders) note_folder(frames, found);
    const size_t num_more = found.size() > kMaxNotes ? found.size() - kMaxNotes : 0;
    found.resize(found.size() - num_more);
    notes.insert(notes.end(), found.begin(), found.end());
    if (num_more > 0) notes.push_back(fmt::format("{} more notes about frame numbers", num_more));
}

}  // namespace paim
