// Float framebuffers and reading them back.
#include "player/gl/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/check.h"

namespace paim::player::gl {

Target::Target(int width, int height, TargetKind kind)
    : width_(width), height_(height), kind_(kind) {
    const int max_size = max_target_size();
    if (width > max_size || height > max_size) {
        throw_unsupported("a picture of {} x {} samples is larger than this driver's {} x {}",
                          width, height, max_size, max_size);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    glBindTexture(GL_TEXTURE_2D, color_.id());
    // Display values are shown at any size; floats cannot be filtered everywhere.
    const GLint filter = kind == TargetKind::display ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    check_errors("making a framebuffer");
    if (kind == TargetKind::display) {
        if (!complete_with(GL_RGBA8)) throw_unsupported("this driver cannot draw into pictures");
        return;
    }
    if (!complete_with(GL_RGBA32F) && !complete_with(GL_RGBA16F)) {
        throw_unsupported("this driver cannot draw into floating-point pictures");
    }
}

bool Target::complete_with(GLint color_format) const {
    glTexImage2D(GL_TEXTURE_2D, 0, color_format, width_, height_, 0, GL_RGBA,
                 color_format == GL_RGBA8     ? GL_UNSIGNED_BYTE
                 : color_format == GL_RGBA32F ? GL_FLOAT
                                              : GL_HALF_FLOAT,
                 nullptr);
    check_errors(fmt::format("making room for a picture of {} x {} samples", width_, height_));
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void Target::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, width_, height_);
}

void Target::show() const {
    PAIM_CHECK(kind_ == TargetKind::display);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

Image Target::read() const {
    PAIM_CHECK(kind_ == TargetKind::radiance);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    Image image(width_, height_);
    // A few rows at a time, so that no second copy of a large picture is needed.
    const int num_rows = std::max(1, (1 << 16) / width_);
    std::vector<float> rows;
    for (int bottom = 0; bottom < height_; bottom += num_rows) {
        const int count = std::min(num_rows, height_ - bottom);
        rows.resize(static_cast<size_t>(count) * static_cast<size_t>(width_) * 4);
        glReadPixels(0, bottom, width_, count, GL_RGBA, GL_FLOAT, rows.data());
        const float* rgba = rows.data();
        for (int row = 0; row < count; ++row) {
            for (int x = 0; x < width_; ++x, rgba += 4) {
                image.at(x, height_ - 1 - bottom - row) = {rgba[0], rgba[1], rgba[2]};
            }
        }
    }
    check_errors("reading the picture back");
    return image;
}

void clear(const Vec3f& color) {
    glClearColor(color[0], color[1], color[2], 1.0f);
    // The function of floats is OpenGL ES's, which OpenGL has from 4.1 on.
    if (epoxy_is_desktop_gl()) {
        glClearDepth(1.0);
    } else {
        glClearDepthf(1.0f);
    }
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace paim::player::gl
