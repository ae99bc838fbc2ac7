// Signs right behind a digit.
#include "compressor/io/digit_signs.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "compressor/io/digit.h"

namespace paim {

namespace {

using Names = std::vector<std::string_view>;
using Numbers = std::vector<std::vector<NameNumber>>;

// Number `number` of name `name`. The digits behind `cut` may be a number of their own.
struct NumberPlace {
    size_t name, number, cut;
};

// The end of the digits in front of the fraction.
size_t whole_end(std::string_view name, const NameNumber& number) {
    return std::min(name.find('.', number.begin), number.end);
}

// Numbers behind the same text, which ends in a digit.
struct Continuations {
    std::vector<NumberPlace> with_hyphen, plain;
    size_t width = 0;  // of those with hyphen, which counts it; 0 if there are several
    bool before_zero = false, padded = false;  // a hyphen is before 0; before a number like 001

    void add_hyphen(const NumberPlace& place, std::string_view name, const NameNumber& number) {
        const size_t width_here = whole_end(name, number) - place.cut;
        width = with_hyphen.empty() || width == width_here ? width_here : 0;
        with_hyphen.push_back(place);
        if (number.is_zero()) before_zero = true;
        if (name[number.begin] == '0') padded = true;
    }
};

class DigitSigns {
  public:
    DigitSigns(const Names& names, Numbers& numbers) : names_(names), numbers_(numbers) {}

    void find() {
        each_number([&](size_t i, size_t k, const NameNumber& number) {
            if (!has_hyphen(i, number)) return;
            const size_t hyphen = number.begin - 1;
            texts_[key(i, hyphen, number)].add_hyphen({i, k, hyphen}, names_[i], number);
        });
        if (texts_.empty()) return;
        each_number([&](size_t i, size_t k, const NameNumber& number) {
            if (!has_hyphen(i, number)) add_plain(i, k, number);
        });
        for (auto& [text, found] : texts_) choose(found);
        cut();
    }

  private:
    template <typename Use>
    void each_number(const Use& use) const {
        for (size_t i = 0; i < names_.size(); ++i) {
            for (size_t k = 0; k < numbers_[i].size(); ++k) {
                if (!numbers_[i][k].negative) use(i, k, numbers_[i][k]);
            }
        }
    }

    bool has_hyphen(size_t i, const NameNumber& number) const {
        return number.begin > 1 && names_[i][number.begin - 1] == '-' &&
               is_digit(names_[i][number.begin - 2]);
    }

    // The text in front of `end`, and the shape of the text behind the number.
    std::string key(size_t i, size_t end, const NameNumber& number) const {
        return std::string(names_[i].substr(0, end)) + '\0' +
               place_of({}, names_[i].substr(number.end));
    }

    std::string alike_key(const NumberPlace& place) const {
        const NameNumber& number = numbers_[place.name][place.number];
        const std::string_view name = names_[place.name];
        return place_of(name.substr(0, number.begin), name.substr(number.end));
    }

    void add_plain(size_t i, size_t k, const NameNumber& number) {
        bool any = false;
        const size_t end = whole_end(names_[i], number);
        for (size_t at = number.begin + 1; at < end; ++at) {
            const auto found = texts_.find(key(i, at, number));
            if (found == texts_.end()) continue;
            found->second.plain.push_back({i, k, at});
            any = true;
        }
        if (!any) others_.insert(alike_key({i, k, 0}));
    }

    // Decides what the hyphens are. If they are signs, keeps where to cut.
    void choose(const Continuations& found) {
        if (found.plain.empty() || found.before_zero) return;
        const bool no_others = others_.count(alike_key(found.plain[0])) == 0;
        std::vector<NumberPlace> of_width;
        bool zero = false, plain_padded = false;
        for (const NumberPlace& place : found.plain) {
            const std::string_view name = names_[place.name];
            const NameNumber& number = numbers_[place.name][place.number];
            const size_t width = whole_end(name, number) - place.cut;
            const bool begins_with_zero = name[place.cut] == '0';
            if (begins_with_zero && width > 1) plain_padded = true;
            if (number_of(name, place.cut, number.end).is_zero()) zero = true;
            const bool fits = width == found.width || (width > found.width && !begins_with_zero);
            if (found.width > 0 && fits) of_width.push_back(place);
        }
        const bool has_width =
            std::any_of(of_width.begin(), of_width.end(), [&](const auto& place) {
                const NameNumber& number = numbers_[place.name][place.number];
                return whole_end(names_[place.name], number) - place.cut == found.width;
            });
        if (has_width && (found.padded || (plain_padded && no_others))) {
            accept(found.with_hyphen, of_width);
        } else if (!found.padded && !plain_padded && no_others && zero && found.plain.size() > 1) {
            accept(found.with_hyphen, found.plain);
        }
    }

    void accept(const std::vector<NumberPlace>& with_hyphen,
                const std::vector<NumberPlace>& plain) {
        for (const NumberPlace& place : with_hyphen) {
            NameNumber& number = numbers_[place.name][place.number];
            number.begin = place.cut;
            number.negative = true;
        }
        cuts_.insert(cuts_.end(), plain.begin(), plain.end());
    }

    // The last numbers first, so that the places of the others stay. Of several cuts the first counts.
    void cut() {
        std::sort(cuts_.begin(), cuts_.end(), [](const NumberPlace& a, const NumberPlace& b) {
            return std::tuple(a.name, b.number, a.cut) < std::tuple(b.name, a.number, b.cut);
        });
        const NumberPlace* last = nullptr;
        for (const NumberPlace& place : cuts_) {
            if (last && last->name == place.name && last->number == place.number) continue;
            last = &place;
            std::vector<NameNumber>& of_name = numbers_[place.name];
            const NameNumber whole = of_name[place.number];
            const std::string_view name = names_[place.name];
            of_name[place.number] = number_of(name, whole.begin, place.cut);
            of_name.insert(of_name.begin() + static_cast<std::ptrdiff_t>(place.number) + 1,
                           number_of(name, place.cut, whole.end));
        }
    }

    const Names& names_;
    Numbers& numbers_;
    std::unordered_map<std::string, Continuations> texts_;
    std::set<std::string> others_;  // alike keys of names that continue no such text
    std::vector<NumberPlace> cuts_;
};

}  // namespace

void find_signs_behind_digits(const Names& names, Numbers& numbers) {
    DigitSigns(names, numbers).find();
}

}  // namespace paim
