// A strict check of an OBJ file.
#include "compressor/io/obj_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "compressor/io/obj_text.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// Parsers store indices as int.
constexpr int64_t kMaxIndex = std::numeric_limits<int32_t>::max();
constexpr uint32_t kMaxCorners = 1000000;

// The range of indices into one kind of element (v, vt or vn). They are checked as far as possible
// before the number of elements is known.
struct IndexRange {
    const char* what;
    int64_t num_elements = 0;
    int64_t greatest = 0;  // of the positive ones
    size_t greatest_line = 0;

    // The index counted from 0. Error if it cannot be in range.
    int64_t resolve(const ObjText& text, int64_t index, bool fits, const char* word) {
        if (fits && index > 0 && index <= kMaxIndex) {
            if (index > greatest) {
                greatest = index;
                greatest_line = text.line();
            }
            return index - 1;
        }
        if (fits && index < 0 && index >= -num_elements) return num_elements + index;
        std::string digits(text.word_from(word));
        digits.resize(std::min(digits.find('/'), digits.size()));
        if (index < 0 && num_elements == 0) {
            text.fail(fmt::format("{} {} is out of range: none precedes this line", what,
                                  printable(digits)));
        } else if (index < 0) {
            text.fail(fmt::format("{} {} is out of range: expected -{} to -1", what,
                                  printable(digits), num_elements));
        }
        text.fail(fmt::format("{} {} is out of range: expected {}", what, printable(digits),
                              fits && index == 0 ? "1 or more" : "at most 2147483647"));
    }

    void check(const std::string& name) const {
        if (greatest <= num_elements) return;
        throw_bad_input("{}:{}: {} {} is out of range: {}", name, greatest_line, what, greatest,
                        num_elements == 0 ? std::string("the file has none")
                                          : fmt::format("expected 1 to {}", num_elements));
    }
};

// The first two numbers of the text; the second is 0 if there is none. Zero if one is not finite.
Vec2f parse_coordinate(std::string_view text) {
    Vec2f coordinate = Vec2f::Zero();
    for (int axis = 0; axis < 2; ++axis) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t+"), text.size()));
        const auto [end, failure] =
            std::from_chars(text.data(), text.data() + text.size(), coordinate[axis]);
        if (failure != std::errc()) break;
        text.remove_prefix(static_cast<size_t>(end - text.data()));
    }
    return coordinate.allFinite() ? coordinate : Vec2f(Vec2f::Zero());
}

class Scanner {
  public:
    Scanner(const std::string& name, std::span<char> text, const ObjScanOptions& options)
        : name_(name), text_(name, text), options_(options) {}

    ObjScan run() {
        for (; !text_.at_end(); text_.next_line()) {
            const std::string_view keyword = text_.read_keyword();
            if (keyword == "v") {
                vertex();
            } else if (keyword == "f") {
                face();
            } else if (keyword == "vn") {
                normal();
            } else if (keyword == "vt") {
                texture_coordinate();
            } else if (!keyword.empty() && keyword[0] != '#') {
                other_line(keyword);
            }
        }
        check_whole();
        return std::move(scan_);
    }

    // Lines that others are continued on begin with no keyword.
    std::vector<Vec3d> run_positions() {
        for (; !text_.at_end(); text_.next_line()) {
            if (text_.read_keyword() != "v") continue;
            Vec3d position = Vec3d::Zero();
            for (int axis = 0; axis < 3 && text_.find_word(); ++axis) {
                position[axis] = text_.read_number("vertex coordinate");
            }
            scan_.positions.push_back(position);
        }
        return std::move(scan_.positions);
    }

  private:
    void vertex() {
        int num_values = 0;
        Vec3d position = Vec3d::Zero(), color = Vec3d::Ones();
        for (; text_.find_word(); ++num_values) {
            if (num_values < 3 && options_.read_positions) {
                position[num_values] = text_.read_number("vertex coordinate");
            } else if (num_values >= 3 && num_values < 6 && options_.read_colors) {
                color[num_values - 3] = text_.read_number("vertex attribute");
            } else {
                text_.skip_number(num_values < 3 ? "vertex coordinate" : "vertex attribute");
            }
        }
        if (num_values < 3) {
            text_.fail(fmt::format("vertex coordinate: expected 3 numbers, got {}", num_values));
        }
        vertex_has_color_.push_back(num_values >= 6);
        if (options_.read_positions) scan_.positions.push_back(position);
        if (options_.read_colors) {
            scan_.colors.push_back(num_values >= 6 ? color : Vec3d(Vec3d::Ones()));
        }
        if (++vertices_.num_elements > kMaxIndex) {
            text_.fail(fmt::format("expected at most {} vertices", kMaxIndex));
        }
    }

    void normal() {
        ++normals_.num_elements;
        if (!options_.check_normals) return text_.blank_rest_of_line();
        int num_values = 0;
        for (; text_.find_word(); ++num_values) text_.skip_number("normal");
        if (num_values < 3)
            text_.fail(fmt::format("normal: expected 3 numbers, got {}", num_values));
    }

    // Nothing is said about coordinates that are no numbers: most files are read without them.
    void texture_coordinate() {
        ++texture_coordinates_.num_elements;
        if (options_.read_coordinates) {
            scan_.coordinates.push_back(parse_coordinate(text_.read_rest_of_line()));
            return text_.comment_out_line();
        }
        text_.blank_rest_of_line();
    }

    void other_line(std::string_view keyword) {
        if (keyword == "p" || keyword == "l") ++scan_.num_other_shapes;
        if (keyword == "o" || keyword == "g") name(keyword == "o");
        if (options_.read_materials && keyword == "mtllib") {
            scan_.libraries.emplace_back(text_.read_rest_of_line());
        } else if (options_.read_materials && keyword == "usemtl") {
            use_material(std::string(text_.read_rest_of_line()));
        }
        text_.comment_out_line();
    }

    void use_material(const std::string& name) {
        const auto next = static_cast<int32_t>(scan_.materials.size());
        const auto [known, is_new] = materials_.try_emplace(name, next);
        if (is_new) scan_.materials.push_back(name);
        material_ = known->second;
    }

    void face() {
        const size_t line = text_.line();
        const size_t first_corner = scan_.faces.corners.size();
        uint32_t num_corners = 0;
        while (text_.find_word()) {
            if (++num_corners > kMaxCorners) {
                text_.fail(fmt::format("face: expected at most {} vertices", kMaxCorners));
            }
            corner();
        }
        if (num_corners < 3) {
            scan_.faces.corners.resize(first_corner);
            scan_.corner_coordinates.resize(
                std::min(first_corner, scan_.corner_coordinates.size()));
            if (options_.check_normals) corner_has_normal_.resize(first_corner);
            text_.comment_out_line();
            ++scan_.num_small_faces;
            return;
        }
        if (!scan_.corner_coordinates.empty()) pad_corner_coordinates();
        scan_.faces.sizes.push_back(num_corners);
        face_lines_.push_back(line);
        if (options_.read_materials) scan_.face_materials.push_back(material_);
    }

    void name(bool is_object) {
        if (options_.reference != nullptr || (has_objects_ && !is_object)) return;
        has_objects_ = has_objects_ || is_object;
        ObjName name{printable(text_.read_rest_of_line()), scan_.faces.num_faces()};
        if (!scan_.names.empty() && scan_.names.back().first_face == name.first_face) {
            scan_.names.back() = std::move(name);
        } else {
            scan_.names.push_back(std::move(name));
        }
    }

    void corner() {
        const char* word = text_.position();
        const auto read_index = [&](IndexRange& range) {
            const char* start = text_.position();
            int64_t index = 0;
            const bool fits = text_.read_integer(range.what, index);
            if (!fits) index = *start == '-' ? -kMaxIndex : 0;
            return range.resolve(text_, index, fits, start);
        };
        scan_.faces.corners.push_back(static_cast<uint32_t>(read_index(vertices_)));
        bool has_normal = false;
        if (text_.skip('/')) {
            if (text_.skip('/')) {
                has_normal = true;
            } else {
                const int64_t index = read_index(texture_coordinates_);
                if (options_.read_coordinates) set_corner_coordinate(static_cast<uint32_t>(index));
                has_normal = text_.skip('/');
            }
            if (has_normal) read_index(normals_);
        }
        if (!text_.at_word_end()) {
            text_.fail(fmt::format("face corner: expected v, v/vt, v//vn or v/vt/vn, got '{}'",
                                   printable(text_.word_from(word))));
        }
        if (options_.check_normals) corner_has_normal_.push_back(has_normal);
    }

    // Of the corner that was added last.
    void set_corner_coordinate(uint32_t index) {
        pad_corner_coordinates();
        scan_.corner_coordinates.back() = index;
    }

    void pad_corner_coordinates() {
        scan_.corner_coordinates.resize(scan_.faces.corners.size(), kNoCoordinate);
    }

    // Corners may name coordinates that follow them, or none that the file has.
    void check_corner_coordinates() {
        if (scan_.corner_coordinates.empty()) scan_.coordinates = {};
        for (uint32_t& index : scan_.corner_coordinates) {
            if (index >= scan_.coordinates.size()) index = kNoCoordinate;
        }
    }

    void check_whole() {
        if (vertices_.num_elements == 0) throw_bad_input("{}: no vertices", name_);
        scan_.num_vertices = static_cast<uint32_t>(vertices_.num_elements);
        const ObjReference* reference = options_.reference;
        if (reference != nullptr && scan_.num_vertices != reference->scan.num_vertices) {
            throw_bad_input("{}: {} vertices, expected {} (as in {})", name_, scan_.num_vertices,
                            reference->scan.num_vertices, reference->name);
        }
        vertices_.check(name_);
        if (scan_.faces.num_faces() == 0) throw_bad_input("{}: no faces", name_);
        if (reference != nullptr) check_faces(*reference);
        find_colors();
        check_corner_coordinates();
        if (options_.check_normals) {
            normals_.check(name_);
            check_corner_normals();
        }
    }

    void find_colors() {
        std::vector<bool> seen(scan_.num_vertices, false);
        bool any = false;
        for (const uint32_t v : scan_.faces.corners) {
            if (seen[v]) continue;
            seen[v] = true;
            if (vertex_has_color_[v]) {
                any = true;
            } else if (scan_.num_uncolored++ == 0 || v < scan_.first_uncolored) {
                scan_.first_uncolored = v;
            }
        }
        scan_.has_colors = any && scan_.num_uncolored == 0;
        if (!any) scan_.num_uncolored = scan_.first_uncolored = 0;
        if (!scan_.has_colors) scan_.colors = {};
    }

    void check_faces(const ObjReference& reference) const {
        const Polygons& got = scan_.faces;
        const Polygons& expected = reference.scan.faces;
        if (got.num_faces() != expected.num_faces()) {
            throw_bad_input("{}: {} faces, expected {} (as in {})", name_, got.num_faces(),
                            expected.num_faces(), reference.name);
        }
        if (got == expected) return;
        size_t corner = 0;  // all earlier faces are the same, so it is valid for both files
        for (size_t i = 0; i < got.num_faces(); ++i) {
            const std::span a = std::span(got.corners).subspan(corner, got.sizes[i]);
            const std::span b = std::span(expected.corners).subspan(corner, expected.sizes[i]);
            if (!std::equal(a.begin(), a.end(), b.begin(), b.end())) {
                throw_bad_input("{}:{}: face {} is '{}', expected '{}' (as in {})", name_,
                                face_lines_[i], i + 1, describe(a), describe(b), reference.name);
            }
            corner += got.sizes[i];
        }
    }

    static std::string describe(std::span<const uint32_t> corners) {
        constexpr size_t kMaxShown = 8;
        std::string text;
        for (const uint32_t v : corners.first(std::min(corners.size(), kMaxShown))) {
            text += fmt::format("{}{}", text.empty() ? "" : " ", uint64_t{v} + 1);
        }
        if (corners.size() > kMaxShown) text += fmt::format(" ... ({} vertices)", corners.size());
        return text;
    }

    void check_corner_normals() const {
        std::vector<bool> needs(scan_.num_vertices, false), has(scan_.num_vertices, false);
        for (size_t i = 0; i < corner_has_normal_.size(); ++i) {
            needs[scan_.faces.corners[i]] = true;
            if (corner_has_normal_[i]) has[scan_.faces.corners[i]] = true;
        }
        for (uint32_t v = 0; v < scan_.num_vertices; ++v) {
            if (needs[v] && !has[v]) {
                throw_bad_input("{}: vertex {} has no normal (vn) in any of its faces", name_,
                                uint64_t{v} + 1);
            }
        }
    }

    const std::string& name_;
    ObjText text_;
    ObjScanOptions options_;
    ObjScan scan_;
    IndexRange vertices_{"face index"};
    IndexRange texture_coordinates_{"texture coordinate index"};
    IndexRange normals_{"normal index"};
    std::vector<size_t> face_lines_;
    std::vector<bool> vertex_has_color_, corner_has_normal_;
    std::unordered_map<std::string, int32_t> materials_;  // indices into those of the scan
    int32_t material_ = -1;
    bool has_objects_ = false;
};

}  // namespace

ObjScan scan_obj(const std::string& name, std::span<char> text, const ObjScanOptions& options) {
    if (!text.empty()) {
        const void* nul = std::memchr(text.data(), '\0', text.size());
        if (nul != nullptr) {
            throw_bad_input("{}: expected text, got a zero byte at offset {}", name,
                            static_cast<const char*>(nul) - text.data());
        }
    }
    return Scanner(name, text, options).run();
}

std::vector<Vec3d> scan_positions(const std::string& name, std::span<char> text) {
    return Scanner(name, text, {}).run_positions();
}

}  // namespace paim
