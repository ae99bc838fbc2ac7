// Natural order of file names.
#include "compressor/io/natural_order.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include "compressor/io/digit.h"
#include "compressor/io/name_numbers.h"

namespace paim {

namespace {

// Removes the digits at the front of the text, and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
    std::string_view digits = text.substr(0, static_cast<size_t>(end - text.begin()));
    text.remove_prefix(digits.size());
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

// Negative, zero or positive, without the tie-break by bytes.
int compare_naturally(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (is_digit(a[0]) && is_digit(b[0])) {
            const std::string_view number_a = take_number(a);
            const std::string_view number_b = take_number(b);
            if (number_a.size() != number_b.size()) {
                return number_a.size() < number_b.size() ? -1 : 1;
            }
            if (const int order = number_a.compare(number_b); order != 0) return order;
        } else {
            const std::string_view byte_a = a.substr(0, 1), byte_b = b.substr(0, 1);
            if (const int order = byte_a.compare(byte_b); order != 0) return order;
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
}

// A name and its numbers.
struct FileName {
    std::string_view name;
    std::vector<NameNumber> numbers;
};

// Reads a name number by number, and byte by byte between numbers.
class NameCursor {
  public:
    explicit NameCursor(const FileName& name)
        : name_(name), stem_(name.name.substr(0, stem_size(name.name))) {}

    bool at_end() const { return at_ == stem_.size(); }
    bool at_number() const {
        return next_ < name_.numbers.size() && name_.numbers[next_].begin == at_;
    }
    const NameNumber& number() const { return name_.numbers[next_]; }
    // Any number is as great as any digit when it meets another byte.
    unsigned char byte() const {
        return static_cast<unsigned char>(at_number() ? '0' : stem_[at_]);
    }
    void advance() { at_ = at_number() ? name_.numbers[next_++].end : at_ + 1; }

  private:
    const FileName& name_;
    std::string_view stem_;
    size_t at_ = 0, next_ = 0;
};

int compare_names(const FileName& a, const FileName& b) {
    NameCursor at_a(a), at_b(b);
    for (; !at_a.at_end() && !at_b.at_end(); at_a.advance(), at_b.advance()) {
        if (at_a.at_number() && at_b.at_number()) {
            if (const int order = compare(at_a.number(), at_b.number()); order != 0) return order;
        } else if (at_a.byte() != at_b.byte()) {
            return at_a.byte() < at_b.byte() ? -1 : 1;
        }
    }
    if (at_a.at_end() != at_b.at_end()) return at_a.at_end() ? -1 : 1;
    const int order = a.name.substr(stem_size(a.name)).compare(b.name.substr(stem_size(b.name)));
    return order != 0 ? order : a.name.compare(b.name);
}

struct FolderLess {
    bool operator()(const std::filesystem::path& a, const std::filesystem::path& b) const {
        auto part_a = a.begin();
        auto part_b = b.begin();
        for (; part_a != a.end() && part_b != b.end(); ++part_a, ++part_b) {
            const int order = compare_naturally(part_a->native(), part_b->native());
            if (order != 0) return order < 0;
        }
        if ((part_a == a.end()) != (part_b == b.end())) return part_a == a.end();
        return a.native() < b.native();
    }
};

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
    const int order = compare_naturally(a, b);
    return order != 0 ? order < 0 : a < b;
}

void sort_naturally(std::vector<std::filesystem::path>& paths) {
    std::map<std::filesystem::path, std::vector<std::filesystem::path>, FolderLess> folders;
    for (std::filesystem::path& path : paths) {
        folders[path.parent_path()].push_back(std::move(path));
    }
    paths.clear();
    for (auto& [folder, files] : folders) {
        std::vector<std::string> names;
        for (const std::filesystem::path& file : files) names.push_back(file.filename().native());
        const auto numbers = find_numbers({names.begin(), names.end()});
        std::vector<FileName> sortable;
        for (size_t i = 0; i < names.size(); ++i) sortable.push_back({names[i], numbers[i]});
        std::vector<size_t> order(names.size());
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
            return compare_names(sortable[a], sortable[b]) < 0;
        });
        for (const size_t i : order) paths.push_back(std::move(files[i]));
    }
}

}  // namespace paim
