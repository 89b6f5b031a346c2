#include <render/gl/targets.h>

#include <array>
#include <utility>

namespace mobbscope {

namespace {

void attach_renderbuffer(const Renderbuffer& buffer, GLenum attachment, GLenum format, PictureSize size) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
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
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, internal_format, size.width, size.height, GL_TRUE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D_MULTISAMPLE, texture.name(), 0);
}

void require_complete(const char* what) {
    if (glGetError() == GL_OUT_OF_MEMORY) throw LacksMemory();
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw MachineError(std::string("this OpenGL cannot draw into ") + what);
}

}  // namespace

Targets::Targets(PictureSize size, int samples) : size_(size), samples_(samples) {
    const bool multisampled = samples > 1;
    glBindFramebuffer(GL_FRAMEBUFFER, result().name());
    attach_texture(picture_, GL_COLOR_ATTACHMENT0, GL_RGBA8, GL_RGBA, size);
    if (multisampled) require_complete("a framebuffer");

    glBindFramebuffer(GL_FRAMEBUFFER, scene_.name());
    if (multisampled) {
        attach_samples(scene_color_, GL_COLOR_ATTACHMENT0, GL_RGBA8, size, samples);
        attach_samples(scene_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size, samples);
    } else {
        attach_texture(scene_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, size);
    }
    require_complete(multisampled ? "a multisampled framebuffer" : "a framebuffer");
}

void Targets::attach_scene_depth() const {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                           samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, scene_depth_.name(), 0);
}

void Targets::need_visibility() {
    if (visibility_buffer_) return;
    Framebuffer made;
    glBindFramebuffer(GL_FRAMEBUFFER, made.name());
    if (samples_ > 1) {
        attach_samples(visibility_, GL_COLOR_ATTACHMENT0, GL_RG32F, size_, samples_);
    } else {
        attach_texture(visibility_, GL_COLOR_ATTACHMENT0, GL_RG32F, GL_RG, size_);
    }
    attach_scene_depth();
    require_complete("32-bit float samples");
    visibility_buffer_ = std::move(made);
}

void Targets::need_faces() {
    if (faces_) return;
    Framebuffer made;
    glBindFramebuffer(GL_FRAMEBUFFER, made.name());
    attach_texture(sums_, GL_COLOR_ATTACHMENT0, GL_RGBA32F, GL_RGBA, size_);
    attach_texture(weights_, GL_COLOR_ATTACHMENT1, GL_R32F, GL_RED, size_);
    if (samples_ > 1) {
        attach_renderbuffer(faces_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size_);
    } else {
        attach_scene_depth();
    }
    const std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
    require_complete("32-bit float textures");
    faces_ = std::move(made);
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
    attach_renderbuffer(ids_, GL_COLOR_ATTACHMENT0, GL_RG32UI, size);
    attach_renderbuffer(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, size);
    require_complete("32-bit integer framebuffers");
}

}  // namespace mobbscope
