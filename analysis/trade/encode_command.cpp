// The command line that makes the file of a point.
#include "analysis/trade/encode_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace paim {

namespace {

// What no option can be taken for.
std::string path_word(const std::filesystem::path& path) {
    const std::string text = path.string();
    return shell_word(text.starts_with('-') ? "./" + text : text);
}

}  // namespace

std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain = "_./%+=:,@-";
    const auto is_plain = [&](char c) {
        return (static_cast<unsigned char>(c) < 0x80 &&
                std::isalnum(static_cast<unsigned char>(c)) != 0) ||
               kPlain.find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string file_stem(const std::filesystem::path& bake) {
    const std::filesystem::path path = std::filesystem::absolute(bake).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).stem().string();
}

std::string encode_arguments(const TradeSettings& settings) {
    const std::string bands = fmt::format("--bands {}", settings.bands);
    if (settings.is_plain()) {
        const std::string components = settings.keeps_all_components()
                                           ? "--geometry-components all --transfer-components all"
                                           : "--auto-transfer-error " + settings.max_error;
        // As points state what they err, so do their files.
        return fmt::format("--precision {} {} --measure {}", precision_name(settings.precision),
                           components, bands);
    }
    const std::string geometry =
        settings.geometry_error.empty() ? "" : " --geometry-error " + settings.geometry_error;
    return fmt::format("--max-error {}{} --codec {} --prefer {} {}", settings.max_error, geometry,
                       settings.codec, preference_name(settings.preference), bands);
}

std::string encode_command(const std::filesystem::path& bake, const TradeSettings& settings) {
    const std::string stem = file_stem(bake);
    const auto encode = [&](const std::filesystem::path& from) {
        return fmt::format("paim-compress encode {} -o {} {}", path_word(from),
                           path_word(stem + ".paim"), encode_arguments(settings));
    };
    if (settings.rays == 0) return encode(bake);
    const std::string other = fmt::format("{}-{}.bake", stem, settings.rays);
    return fmt::format("paim-compress bake POSES -o {} --rays {} && {}", path_word(other),
                       settings.rays, encode(other));
}

}  // namespace paim
