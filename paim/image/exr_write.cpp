// Writes EXR through OpenEXR's C++ interface, in a form that versions 2.5 and 3 share.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/image/exr.h"

namespace paim {

namespace {

// Writes a file into memory.
class MemoryStream : public Imf::OStream {
  public:
    explicit MemoryStream(const char* name) : Imf::OStream(name) {}

    void write(const char bytes[], int size_bytes) override {
        const auto size = static_cast<size_t>(size_bytes);
        if (position_ + size > data_.size()) data_.resize(position_ + size);
        std::copy_n(bytes, size, data_.data() + position_);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    const std::vector<char>& data() const { return data_; }

  private:
    std::vector<char> data_;
    size_t position_ = 0;
};

void encode(const Image& image, MemoryStream& stream) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    // OpenEXR uses the same slices for reading and writing, so they take a mutable address.
    char* origin = reinterpret_cast<char*>(const_cast<Vec3f*>(image.pixels.data()));
    const char* const names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), sizeof(Vec3f),
                                           sizeof(Vec3f) * static_cast<size_t>(image.width)));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(image.height);
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image) {
    PAIM_CHECK_LE(1, image.width);
    PAIM_CHECK_LE(1, image.height);
    MemoryStream stream(path.c_str());
    try {
        encode(image, stream);
    } catch (const std::exception& failure) {
        throw_output_failed("{}: cannot encode: {}", path.string(), failure.what());
    }
    AtomicFile file(path);
    file.write(stream.data().data(), stream.data().size());
    file.commit();
}

}  // namespace paim
