#include <render/gl/targets.h>

#include <array>

namespace mobbscope {

namespace {

void attach_renderbuffer(const Renderbuffer& buffer, GLenum attachment, GLenum format, PictureSize size, int samples) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    if (samples > 1) {
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.width, size.height);
    } else {
        glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
    }
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
}

void attach_texture(const Texture& texture, GLenum attachment, GLenum internal_format, GLenum format,
                    PictureSize size) {
    fill_texture(texture, internal_format, size, format, GL_FLOAT, nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
}

/// Its samples are read one by one.
void attach_samples(const Texture& texture, GLenum attachment, GLenum internal_format, PictureSize size, int samples) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
    // A framebuffer that has a renderbuffer too needs textures with fixed sample locations (OpenGL 3.3, 4.4.4).
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, internal_format, size.width, size.height, GL_TRUE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D_MULTISAMPLE, texture.name(), 0);
}

void require_complete(const char* what) {
    if (glGetError() == GL_OUT_OF_MEMORY) throw LacksMemory();
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw MachineError(std::string("this OpenGL cannot draw into ") + what);
}

void blit(const Framebuffer& from, const Framebuffer& to, PictureSize size, GLbitfield what) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height, what, GL_NEAREST);
}

}  // namespace

Targets::Targets(PictureSize size, int samples) : size_(size), samples_(samples) {
    const bool multisampled = samples > 1;
    glBindFramebuffer(GL_FRAMEBUFFER, result().name());
    attach_texture(picture_, GL_COLOR_ATTACHMENT0, GL_RGBA8, GL_RGBA, size);
    if (multisampled) require_complete("a framebuffer");

    glBindFramebuffer(GL_FRAMEBUFFER, scene_.name());
    if (multisampled) attach_renderbuffer(scene_color_, GL_COLOR_ATTACHMENT0, GL_RGBA8, size, samples);
    attach_renderbuffer(scene_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size, samples);
    require_complete(multisampled ? "a multisampled framebuffer" : "a framebuffer");

    glBindFramebuffer(GL_FRAMEBUFFER, visibility_buffer_.name());
    if (multisampled) {
        attach_samples(visibility_, GL_COLOR_ATTACHMENT0, GL_RG32F, size, samples);
    } else {
        attach_texture(visibility_, GL_COLOR_ATTACHMENT0, GL_RG32F, GL_RG, size);
    }
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, scene_depth_.name());
    require_complete("32-bit float samples");

    glBindFramebuffer(GL_FRAMEBUFFER, faces_.name());
    attach_texture(sums_, GL_COLOR_ATTACHMENT0, GL_RGBA32F, GL_RGBA, size);
    attach_texture(weights_, GL_COLOR_ATTACHMENT1, GL_R32F, GL_RED, size);
    if (multisampled) {
        attach_renderbuffer(faces_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size, 1);
    } else {
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, scene_depth_.name());
    }
    const std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
    require_complete("32-bit float textures");
}

void Targets::share_depth() const {
    if (samples_ > 1) blit(scene_, faces_, size_, GL_DEPTH_BUFFER_BIT);
}

void Targets::resolve() const {
    if (samples_ > 1) blit(scene_, result_, size_, GL_COLOR_BUFFER_BIT);
}

void Targets::enlarge(const Targets& other) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, other.scene_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, scene_.name());
    const auto enlarged = [&](GLbitfield what, GLenum filter) {
        glBlitFramebuffer(0, 0, other.size_.width, other.size_.height, 0, 0, size_.width, size_.height, what, filter);
    };
    enlarged(GL_COLOR_BUFFER_BIT, GL_LINEAR);
    enlarged(GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

IdTarget::IdTarget(PictureSize size) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    attach_renderbuffer(ids_, GL_COLOR_ATTACHMENT0, GL_RG32UI, size, 1);
    attach_renderbuffer(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size, 1);
    require_complete("32-bit integer framebuffers");
}

}  // namespace mobbscope
