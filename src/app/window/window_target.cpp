#include <app/window/window_target.h>
#include <base/error.h>
#include <render/gl/gl_objects.h>

namespace mobbscope::app {

namespace {

void allocate(const Texture& texture, PictureSize size) {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void attach(const Texture& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw MachineError("this OpenGL cannot draw into a texture");
    }
}

}  // namespace

WindowTarget::WindowTarget(PictureSize size) : size_(size) {
    reset_state();
    allocate(color_, size);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    attach(color_);
}

void WindowTarget::clear(const Rgba& color) const {
    reset_state();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glClearColor(color.r, color.g, color.b, color.a);
    glClear(GL_COLOR_BUFFER_BIT);
}

Image WindowTarget::read() const {
    reset_state();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    Image image(size_.width, size_.height);
    // OpenGL's first row is the lowest.
    for (int y = 0; y < size_.height; ++y) {
        glReadPixels(0, size_.height - 1 - y, size_.width, 1, GL_RGBA, GL_UNSIGNED_BYTE, image.at(0, y));
    }
    return image;
}

void WindowTarget::present() const {
    reset_state();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

void PictureCopy::take(const Texture& picture, PictureSize size) {
    reset_state();
    glBindFramebuffer(GL_FRAMEBUFFER, from_.name());
    attach(picture);
    if (size != size_) {
        allocate(copy_, size);
        size_ = size;
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, copy_.name());
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, size.width, size.height);
}

}  // namespace mobbscope::app
