// What a map_Kd line says.
#include "compressor/io/obj_texture_map.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace paim {

namespace {

constexpr std::string_view kSpace = " \t";

// The words of a line, of which the last are the name of a file.
class Words {
  public:
    explicit Words(std::string_view text) : rest_(text) { skip_space(); }

    std::string_view next() const { return rest_.substr(0, rest_.find_first_of(kSpace)); }
    void skip() {
        rest_.remove_prefix(next().size());
        skip_space();
    }
    std::string_view rest() const { return rest_; }

    // The next word as a number, passed over; nothing if it is none, or the last word.
    std::optional<double> take_number() {
        std::string_view word = next();
        if (word.size() == rest_.size()) return std::nullopt;  // the name of the file
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool whole = end == word.data() + word.size() && !word.empty();
        if (failure != std::errc() || !whole || !(std::abs(value) < 1e6)) return std::nullopt;
        skip();
        return value;
    }

  private:
    void skip_space() {
        const size_t first = rest_.find_first_not_of(kSpace);
        rest_ = first == std::string_view::npos ? std::string_view() : rest_.substr(first);
    }

    std::string_view rest_;
};

struct MapOption {
    std::string_view name;
    int num_words = 0;     // that are no numbers
    int most_numbers = 0;  // after them
    bool matters = false;  // whether pictures are others without it
};
constexpr MapOption kOptions[] = {
    {"-blendu", 1, 0, false}, {"-blendv", 1, 0, false}, {"-boost", 0, 1, false},
    {"-texres", 0, 1, false}, {"-bm", 0, 1, false},     {"-imfchan", 1, 0, false},
    {"-type", 1, 0, false},   {"-cc", 1, 0, true},      {"-clamp", 1, 0, true},
    {"-mm", 0, 2, true},      {"-t", 0, 3, true},       {"-s", 0, 3, true},
    {"-o", 0, 3, true}};

const MapOption* find_option(std::string_view word) {
    for (const MapOption& option : kOptions) {
        if (option.name == word) return &option;
    }
    return nullptr;
}

// Numbers of an option; those that are missing keep their value.
void take_numbers(Words& words, int most, std::array<double, 3>& numbers) {
    for (int i = 0; i < most; ++i) {
        const std::optional<double> number = words.take_number();
        if (!number) return;
        numbers[static_cast<size_t>(i)] = *number;
    }
}

}  // namespace

ObjTextureMap parse_texture_map(std::string_view text) {
    ObjTextureMap map;
    Words words(text);
    while (const MapOption* option = find_option(words.next())) {
        words.skip();
        std::string_view word;
        for (int i = 0; i < option->num_words; ++i) {
            word = words.next();
            words.skip();
        }
        const bool scales = option->name == "-s";
        std::array<double, 3> numbers{};
        if (scales) numbers.fill(1.0);
        take_numbers(words, option->most_numbers, numbers);
        if (scales) {
            map.scale = Eigen::Vector2d(numbers[0], numbers[1]).cast<float>();
        } else if (option->name == "-o") {
            map.offset = Eigen::Vector2d(numbers[0], numbers[1]).cast<float>();
        } else if (option->matters && word != "off") {
            map.ignored = option->name;
        }
    }
    map.file = words.rest();
    return map;
}

}  // namespace paim
