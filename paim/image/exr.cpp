// Reads EXR through OpenEXR's C++ interface, in a form that versions 2.5 and 3 share.
#include "paim/image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledInputFile.h>
#include <ImfVersion.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/image/exr_header.h"

namespace paim {

namespace {

// Bytes of scan lines that are decoded at a time. OpenEXR keeps the chunk that it decoded last, so
// that a chunk of more lines is not decoded again.
constexpr size_t kBlockBytes = size_t{1} << 23;

// A rectangle of decoded pixels in the file's coordinates.
struct Block {
    Imath::Box2i box;
    std::vector<Vec3f> pixels;

    explicit Block(const Imath::Box2i& bounds)
        : box(bounds), pixels(static_cast<size_t>(width()) * static_cast<size_t>(height())) {}
    int width() const { return box.max.x - box.min.x + 1; }
    int height() const { return box.max.y - box.min.y + 1; }
};

// Hands on the part of the block that lies in the display window.
void hand_on(const Block& block, const Imath::Box2i& display, const ExrRun& on_run) {
    const int x_begin = std::max(block.box.min.x, display.min.x);
    const int x_end = std::min(block.box.max.x, display.max.x) + 1;
    const int y_begin = std::max(block.box.min.y, display.min.y);
    const int y_end = std::min(block.box.max.y, display.max.y) + 1;
    if (x_begin >= x_end) return;
    for (int y = y_begin; y < y_end; ++y) {
        const Vec3f* row = block.pixels.data() + static_cast<ptrdiff_t>(y - block.box.min.y) *
                                                     static_cast<ptrdiff_t>(block.width());
        on_run(x_begin - display.min.x, y - display.min.y,
               {row + (x_begin - block.box.min.x), row + (x_end - block.box.min.x)});
    }
}

// Slices that let OpenEXR write the named channels, as float, into the block's three components.
Imf::FrameBuffer frame_buffer(Block& block, const std::vector<std::string>& names) {
    constexpr auto kXStride = static_cast<ptrdiff_t>(sizeof(Vec3f));
    const ptrdiff_t y_stride = kXStride * block.width();
    // OpenEXR takes the address of pixel (0, 0), even if the block does not contain that pixel.
    char* origin = reinterpret_cast<char*>(block.pixels.data()) - block.box.min.x * kXStride -
                   block.box.min.y * y_stride;
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < names.size(); ++c) {
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), sizeof(Vec3f),
                                           static_cast<size_t>(y_stride)));
    }
    return buffer;
}

// Grey: the one channel that was read is copied to the other two.
void spread_grey(Block& block) {
    for (Vec3f& pixel : block.pixels) pixel = Vec3f::Constant(pixel.x());
}

// How the image is coded, by the channels of the first part.
struct Coding {
    std::vector<std::string> names;  // R, G, B or Y; empty for luminance-chroma
    bool grey = false;
};

// Scan-line files may have a tile description, too, so its presence does not decide.
bool is_tiled(const Imf::InputFile& file) {
    const Imf::Header& header = file.header();
    return header.hasType() ? header.type() == Imf::TILEDIMAGE : Imf::isTiled(file.version());
}

Coding find_coding(const Imf::InputFile& input, const std::string& file) {
    const Imf::Header& header = input.header();
    const Imf::ChannelList& channels = header.channels();
    const auto has = [&](const char* name) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel == nullptr) return false;
        const bool chroma = std::strlen(name) > 1;
        if (!chroma && (channel->xSampling != 1 || channel->ySampling != 1)) {
            throw_bad_input("{}: channel {} is sampled every {} x {} pixels, expected 1 x 1", file,
                            name, channel->xSampling, channel->ySampling);
        }
        return true;
    };
    if (has("R") && has("G") && has("B")) return {{"R", "G", "B"}, false};
    if (has("Y") && has("RY") && has("BY")) {
        if (is_tiled(input)) {
            throw_bad_input("{}: tiled luminance-chroma, expected scan lines", file);
        }
        return {};
    }
    if (has("Y")) return {{"Y"}, true};
    std::string names;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        names += names.empty() ? "" : ", ";
        names += c.name();
    }
    throw_bad_input("{}: channels {}, expected R, G, B or Y", file, names.empty() ? "none" : names);
}

// The box that blocks of full lines need to cover: the data window's lines within the display's.
template <typename ReadLines>
void read_line_blocks(const Imath::Box2i& data, const Imath::Box2i& display, ReadLines read_lines) {
    const auto row_bytes = sizeof(Vec3f) * (static_cast<size_t>(data.max.x - data.min.x) + 1);
    const int num_lines = static_cast<int>(std::clamp<size_t>(kBlockBytes / row_bytes, 1, 256));
    const int y_end = std::min(data.max.y, display.max.y) + 1;
    for (int y = std::max(data.min.y, display.min.y); y < y_end; y += num_lines) {
        read_lines(Imath::Box2i({data.min.x, y}, {data.max.x, std::min(y + num_lines, y_end) - 1}));
    }
}

void read_scan_lines(Imf::InputFile& file, const Coding& coding, const ExrRun& on_run) {
    const Imath::Box2i& display = file.header().displayWindow();
    read_line_blocks(file.header().dataWindow(), display, [&](const Imath::Box2i& box) {
        Block block(box);
        file.setFrameBuffer(frame_buffer(block, coding.names));
        file.readPixels(box.min.y, box.max.y);
        if (coding.grey) spread_grey(block);
        hand_on(block, display, on_run);
    });
}

void read_tiles(Imf::TiledInputFile& file, const Coding& coding, const ExrRun& on_run) {
    const Imath::Box2i& display = file.header().displayWindow();
    for (int ty = 0; ty < file.numYTiles(0); ++ty) {
        for (int tx = 0; tx < file.numXTiles(0); ++tx) {
            const Imath::Box2i box = file.dataWindowForTile(tx, ty, 0, 0);
            if (!box.intersects(display)) continue;
            Block block(box);
            file.setFrameBuffer(frame_buffer(block, coding.names));
            file.readTile(tx, ty, 0, 0);
            if (coding.grey) spread_grey(block);
            hand_on(block, display, on_run);
        }
    }
}

// Reads luminance-chroma images by OpenEXR's own conversion, which gives half precision.
void read_luminance_chroma(Imf::RgbaInputFile& file, const ExrRun& on_run) {
    const Imath::Box2i& display = file.displayWindow();
    read_line_blocks(file.dataWindow(), display, [&](const Imath::Box2i& box) {
        Block block(box);
        std::vector<Imf::Rgba> line(static_cast<size_t>(block.width()));
        auto pixel = block.pixels.begin();
        for (int y = box.min.y; y <= box.max.y; ++y) {
            file.setFrameBuffer(line.data() - box.min.x, 1, 0);
            file.readPixels(y);
            for (const Imf::Rgba& c : line) *pixel++ = Vec3f(c.r, c.g, c.b);
        }
        hand_on(block, display, on_run);
    });
}

void read_checked(const std::string& name, const ExrRun& on_run) {
    Imf::InputFile file(name.c_str());
    const Coding coding = find_coding(file, name);
    if (!file.isComplete()) throw_bad_input("{}: truncated: pixels are missing", name);
    if (coding.names.empty()) {
        Imf::RgbaInputFile rgba(name.c_str());
        read_luminance_chroma(rgba, on_run);
    } else if (is_tiled(file)) {
        Imf::TiledInputFile tiled(name.c_str());
        read_tiles(tiled, coding, on_run);
    } else {
        read_scan_lines(file, coding, on_run);
    }
}

std::optional<Chromaticities> find_chromaticities(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    const Imf::Chromaticities& stated = Imf::chromaticities(header);
    const auto xy = [](const Imath::V2f& v) { return Eigen::Vector2d(v.x, v.y); };
    return Chromaticities{xy(stated.red), xy(stated.green), xy(stated.blue), xy(stated.white)};
}

ExrHeader read_header(const std::string& name) {
    const Imf::InputFile file(name.c_str());
    const Imf::Header& header = file.header();
    const Imath::Box2i& display = header.displayWindow();
    ExrHeader result;
    result.width = display.max.x - display.min.x + 1;
    result.height = display.max.y - display.min.y + 1;
    if (Imf::isMultiPart(file.version())) {
        result.num_parts = Imf::MultiPartInputFile(name.c_str()).parts();
    }
    if (header.hasName()) result.part_name = header.name();
    if (Imf::hasEnvmap(header)) result.envmap = static_cast<int>(Imf::envmap(header));
    result.chromaticities = find_chromaticities(header);
    if (Imf::hasWhiteLuminance(header)) result.white_luminance = Imf::whiteLuminance(header);
    return result;
}

// Calls the reader, and says what is wrong with the file in our words.
template <typename Read>
auto with_errors_of(const std::filesystem::path& path, const Read& read) {
    try {
        return read(path.string());
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw_bad_input("{}: not enough memory for its pixels", path.string());
    } catch (const std::exception& failure) {
        throw_bad_input("{}: truncated or damaged: {}", path.string(), failure.what());
    }
}

}  // namespace

ExrHeader read_exr_header(const std::filesystem::path& path, const ExrLimits& limits) {
    check_exr_header(path, limits);
    return with_errors_of(path, read_header);
}

void read_exr_rows(const std::filesystem::path& path, const ExrRun& on_run,
                   const ExrLimits& limits) {
    check_exr_header(path, limits);
    with_errors_of(path, [&](const std::string& name) { read_checked(name, on_run); });
}

Image read_exr(const std::filesystem::path& path, const ExrLimits& limits) {
    const ExrHeader header = read_exr_header(path, limits);
    return with_errors_of(path, [&](const std::string& name) {
        Image image(header.width, header.height);
        read_checked(name, [&](int x, int y, std::span<const Vec3f> pixels) {
            std::copy(pixels.begin(), pixels.end(), &image.at(x, y));
        });
        return image;
    });
}

}  // namespace paim
