// Walks the headers by names, types and sizes of attributes, and reads the values of those that
// decide sizes of memory.
// Based on: The OpenEXR File Layout, https://openexr.com/en/latest/OpenEXRFileLayout.html
#include "paim/image/exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "paim/base/error.h"

namespace paim {

namespace {

constexpr uint32_t kMagic = 20000630;
constexpr uint32_t kFlagTiled = 0x200;
constexpr uint32_t kFlagDeep = 0x800;
constexpr uint32_t kFlagMultiPart = 0x1000;

// Limit of the bytes of a chunk (tile, or block of lines). Real files stay far below it.
constexpr int64_t kMaxChunkBytes = int64_t{1} << 27;
// Window corners beyond this are refused as damage, so that pointer arithmetic cannot overflow.
constexpr int64_t kMaxCoordinate = int64_t{1} << 24;
// A short file must not make us allocate gigabytes: above 2^25 pixels (400 MB of RGB) it must hold
// one byte for every 4096 pixels. A ZIP-compressed image of one constant colour holds six times as
// much.
constexpr int64_t kFreePixels = int64_t{1} << 25;
constexpr int64_t kMaxPixelsPerByte = 4096;
constexpr size_t kMaxNameLength = 255;
// Bounds the bytes of a channel list that are read. Lists of real files stay far below it.
constexpr int64_t kMaxAttributeRead = int64_t{1} << 20;

struct Window {
    int64_t x_min, y_min, x_max, y_max;
    int64_t width() const { return x_max - x_min + 1; }
    int64_t height() const { return y_max - y_min + 1; }
};

// Sizes that the header of one part states.
struct Part {
    std::optional<Window> data_window;
    std::optional<Window> display_window;
    std::optional<int64_t> bytes_per_pixel;
    int64_t tile_width = 0;  // 0: scan lines
    int64_t tile_height = 0;
    int64_t num_chunks = 0;
    unsigned compression = 0;
    std::string type;
};

uint32_t load_u32(std::span<const char> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value |= static_cast<uint32_t>(static_cast<uint8_t>(bytes[offset + i])) << (8 * i);
    }
    return value;
}

int64_t load_i32(std::span<const char> bytes, size_t offset) {
    return static_cast<int32_t>(load_u32(bytes, offset));
}

int64_t ceil_div(int64_t a, int64_t b) {
    return (a + b - 1) / b;
}

// Scan lines compressed together, by the file's compression code (none, RLE, ZIPS, ZIP, PIZ, PXR24,
// B44, B44A, DWAA, DWAB). OpenEXR refuses unknown codes.
int64_t lines_per_chunk(unsigned compression) {
    constexpr std::array<int64_t, 10> kLines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression < kLines.size() ? kLines[compression] : 256;
}

class Scanner {
  public:
    Scanner(const std::filesystem::path& path, const ExrLimits& limits)
        : name_(path.string()), limits_(limits) {
        std::error_code failure;
        const auto status = std::filesystem::status(path, failure);
        if (!std::filesystem::exists(status)) throw_bad_input("{}: no such file", name_);
        if (!std::filesystem::is_regular_file(status)) {
            throw_bad_input("{}: expected a regular file", name_);
        }
        file_.open(path, std::ios::binary);
        if (!file_) throw_bad_input("{}: cannot open", name_);
        file_size_ = static_cast<int64_t>(std::filesystem::file_size(path, failure));
        if (failure) throw_bad_input("{}: cannot read: {}", name_, failure.message());
    }

    void scan() {
        if (file_size_ < 8) throw_bad_input("{}: {} bytes, not an EXR file", name_, file_size_);
        const auto start = read(8);
        if (load_u32(start, 0) != kMagic) throw_bad_input("{}: not an EXR file", name_);
        const uint32_t version = load_u32(start, 4);
        if ((version & 0xff) != 2) {
            throw_bad_input("{}: EXR version {}, expected 2", name_, version & 0xff);
        }
        const bool multi_part = (version & kFlagMultiPart) != 0;
        // In files of several parts the flag says that some part is deep; only the first is read.
        if ((version & kFlagDeep) != 0 && !multi_part) refuse_deep();
        bool first = true;
        while (const std::optional<Part> part = read_part()) {
            if (first && part->type.starts_with("deep")) refuse_deep();
            check(*part, multi_part, (version & kFlagTiled) != 0);
            first = false;
            if (!multi_part) return;
        }
        if (first) throw_bad_input("{}: no header", name_);
    }

  private:
    [[noreturn]] void refuse_deep() const {
        throw_bad_input("{}: a deep image, expected a flat one", name_);
    }

    std::vector<char> read(int64_t size_bytes) {
        need(size_bytes);
        std::vector<char> bytes(static_cast<size_t>(size_bytes));
        file_.read(bytes.data(), size_bytes);
        if (!file_) throw_bad_input("{}: cannot read", name_);
        position_ += size_bytes;
        return bytes;
    }

    void skip(int64_t size_bytes) {
        need(size_bytes);
        position_ += size_bytes;
        file_.seekg(position_);
    }

    void need(int64_t size_bytes) const {
        if (size_bytes < 0 || size_bytes > file_size_ - position_) {
            throw_bad_input("{}: truncated or damaged: the header needs {} bytes at {} of {}",
                            name_, size_bytes, position_, file_size_);
        }
    }

    std::string read_name() {
        std::string name;
        while (true) {
            need(1);
            const int c = file_.get();
            ++position_;
            if (c == 0) return name;
            if (c < 0 || name.size() == kMaxNameLength) {
                throw_bad_input("{}: damaged: a name in the header does not end", name_);
            }
            name.push_back(static_cast<char>(c));
        }
    }

    // Returns nothing for the empty header that ends the list of parts.
    std::optional<Part> read_part() {
        Part part;
        bool empty = true;
        for (std::string name = read_name(); !name.empty(); name = read_name()) {
            empty = false;
            const std::string type = read_name();
            const int64_t size_bytes = load_i32(read(4), 0);
            need(size_bytes);
            read_attribute(name, type, size_bytes, part);
        }
        if (empty) return std::nullopt;
        return part;
    }

    void read_attribute(std::string_view name, std::string_view type, int64_t size_bytes,
                        Part& part) {
        // `wanted` attributes must have their standard type and, unless 0, size.
        const auto wanted = [&](std::string_view w_name, std::string_view w_type, int64_t w_size) {
            if (name != w_name) return false;
            if (type != w_type || (w_size != 0 && size_bytes != w_size) ||
                size_bytes > kMaxAttributeRead) {
                throw_bad_input("{}: damaged: header entry '{}' has type {} and {} bytes", name_,
                                name, type, size_bytes);
            }
            return true;
        };
        if (wanted("dataWindow", "box2i", 16)) {
            part.data_window = read_window();
        } else if (wanted("displayWindow", "box2i", 16)) {
            part.display_window = read_window();
        } else if (wanted("channels", "chlist", 0)) {
            part.bytes_per_pixel = read_channels(size_bytes);
        } else if (wanted("compression", "compression", 1)) {
            part.compression = static_cast<uint8_t>(read(1)[0]);
        } else if (wanted("tiles", "tiledesc", 9)) {
            const auto bytes = read(9);
            part.tile_width = load_u32(bytes, 0);
            part.tile_height = load_u32(bytes, 4);
            if (part.tile_width == 0 || part.tile_height == 0) {
                throw_bad_input("{}: damaged: empty tiles", name_);
            }
        } else if (wanted("type", "string", 0)) {
            const auto bytes = read(size_bytes);
            part.type.assign(bytes.begin(), bytes.end());
        } else if (wanted("chunkCount", "int", 4)) {
            part.num_chunks = load_i32(read(4), 0);
        } else if (type == "preview" && size_bytes >= 8) {
            const auto bytes = read(8);
            const int64_t width = load_u32(bytes, 0);
            const int64_t height = load_u32(bytes, 4);
            if (width > size_bytes || height > size_bytes || 8 + 4 * width * height != size_bytes) {
                throw_bad_input("{}: damaged: preview of {} x {} in {} bytes", name_, width, height,
                                size_bytes);
            }
            skip(size_bytes - 8);
        } else {
            skip(size_bytes);
        }
    }

    Window read_window() {
        const auto bytes = read(16);
        return {load_i32(bytes, 0), load_i32(bytes, 4), load_i32(bytes, 8), load_i32(bytes, 12)};
    }

    // Bytes of one pixel over all channels, subsampled ones counted in full.
    int64_t read_channels(int64_t size_bytes) {
        const auto bytes = read(size_bytes);
        int64_t sum = 0;
        auto at = bytes.begin();
        while (at != bytes.end() && *at != 0) {
            at = std::find(at, bytes.end(), '\0');
            if (bytes.end() - at < 17) throw_bad_input("{}: damaged: channel list", name_);
            sum += load_u32(bytes, static_cast<size_t>(at - bytes.begin()) + 1) == 1 ? 2 : 4;
            at += 17;  // the end of the name, type, linearity and its padding, two samplings
        }
        if (at == bytes.end()) throw_bad_input("{}: damaged: channel list does not end", name_);
        return sum;
    }

    void check_window(const std::optional<Window>& window, std::string_view which) const {
        if (!window) throw_bad_input("{}: damaged: no {} window", name_, which);
        const auto [x_min, y_min, x_max, y_max] = *window;
        if (std::max({std::abs(x_min), std::abs(y_min), std::abs(x_max), std::abs(y_max)}) >
                kMaxCoordinate ||
            x_max < x_min || y_max < y_min) {
            throw_bad_input("{}: damaged: {} window ({} {}) - ({} {})", name_, which, x_min, y_min,
                            x_max, y_max);
        }
        if (window->width() > limits_.max_width || window->height() > limits_.max_height) {
            throw_bad_input("{}: {} window of {} x {} pixels, expected at most {} x {}", name_,
                            which, window->width(), window->height(), limits_.max_width,
                            limits_.max_height);
        }
        const int64_t num_pixels = window->width() * window->height();
        if (num_pixels > kFreePixels && num_pixels / kMaxPixelsPerByte > file_size_) {
            throw_bad_input("{}: truncated or damaged: {} x {} pixels in {} bytes", name_,
                            window->width(), window->height(), file_size_);
        }
    }

    void check(const Part& part, bool multi_part, bool tiled_flag) const {
        check_window(part.data_window, "data");
        check_window(part.display_window, "display");
        if (!part.bytes_per_pixel) throw_bad_input("{}: damaged: no channel list", name_);
        // In single-part files OpenEXR follows the flag, not the type.
        const bool tiled =
            multi_part ? part.type.starts_with("tiled") || part.type == "deeptile" : tiled_flag;
        if (tiled && part.tile_width == 0) throw_bad_input("{}: damaged: no tile size", name_);
        const Window& window = *part.data_window;
        const int64_t chunk_width = tiled ? part.tile_width : window.width();
        const int64_t chunk_height = tiled ? part.tile_height : lines_per_chunk(part.compression);
        const int64_t bytes_per_pixel = std::max<int64_t>(1, *part.bytes_per_pixel);
        if (chunk_width > kMaxChunkBytes / bytes_per_pixel / chunk_height) {
            throw_bad_input("{}: {} of {} x {} pixels with {} bytes each, expected at most {} MiB",
                            name_, tiled ? "tiles" : "blocks of lines", chunk_width, chunk_height,
                            bytes_per_pixel, kMaxChunkBytes >> 20);
        }
        // The chunk table has 8 bytes a chunk, and each chunk itself has at least 8 more.
        const int64_t num_chunks =
            std::max(ceil_div(window.width(), tiled ? chunk_width : window.width()) *
                         ceil_div(window.height(), chunk_height),
                     part.num_chunks);
        if (num_chunks > file_size_ / 16) {
            throw_bad_input("{}: truncated or damaged: {} {} in {} bytes", name_, num_chunks,
                            tiled ? "tiles" : "blocks of lines", file_size_);
        }
    }

    std::string name_;
    ExrLimits limits_;
    std::ifstream file_;
    int64_t file_size_ = 0;
    int64_t position_ = 0;
};

}  // namespace

bool is_exr(const std::filesystem::path& path) {
    std::array<char, 4> start{};
    std::ifstream file(path, std::ios::binary);
    return file.read(start.data(), start.size()) && load_u32(start, 0) == kMagic;
}

void check_exr_header(const std::filesystem::path& path, const ExrLimits& limits) {
    Scanner(path, limits).scan();
}

}  // namespace paim
