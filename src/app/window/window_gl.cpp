#include <app/window/window_gl.h>
#include <base/error.h>
#include <render/gl/gl_objects.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mobbscope::app {

namespace {

void allocate(const Texture& texture, PictureSize size) {
    glActiveTexture(GL_TEXTURE0);
    fill_texture(texture, GL_RGBA8, size, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void attach(const Texture& texture) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw MachineError("this OpenGL cannot draw into a texture");
    }
}

static_assert(sizeof(ImDrawIdx) == 2, "indices are drawn as GL_UNSIGNED_SHORT");

constexpr int kChequer = 8;  // pixels of a square

/// What is transparent shows a chequer of two greys.
std::vector<std::uint8_t> on_chequer(const Image& image) {
    std::vector<std::uint8_t> out = image.rgba;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* from = image.at(x, y);
            if (from[3] == 255) continue;
            const int grey = (x / kChequer + y / kChequer) % 2 == 0 ? 150 : 110;
            std::uint8_t* to = out.data() + (from - image.rgba.data());
            for (int c = 0; c < 3; ++c) {
                to[c] = static_cast<std::uint8_t>((from[c] * from[3] + grey * (255 - from[3]) + 127) / 255);
            }
            to[3] = 255;
        }
    }
    return out;
}

const void* at_byte(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

void attribute(GLuint index, GLint components, GLenum type, GLboolean normalised, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, components, type, normalised, sizeof(ImDrawVert), at_byte(offset));
}

template <class T>
void fill(GLenum target, const ImVector<T>& with) {
    glBufferData(target, static_cast<GLsizeiptr>(with.size_in_bytes()), with.Data, GL_STREAM_DRAW);
}

/// How many of the command's first indices make triangles of plain colour, which take one texel all over.
unsigned leading_plain(const ImDrawList& list, const ImDrawCmd& command) {
    const auto texel = [&](unsigned i) {
        const unsigned vertex = command.VtxOffset + list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
        return list.VtxBuffer[static_cast<int>(vertex)].uv;
    };
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    const auto is_plain = [&](unsigned i) { return texel(i).x == white.x && texel(i).y == white.y; };
    unsigned count = 0;
    while (count < command.ElemCount && is_plain(count)) ++count;
    return count - count % 3;
}

}  // namespace

ImTextureID texture_id(const Texture& texture) {
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.name()));
}

UiPass::UiPass(GlContext& context) : textured_(context, "ui"), plain_(context, "ui", "ui_plain") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    context.check("preparing the panels");
}

void UiPass::upload(ImFontAtlas& fonts) {
    unsigned char* coverage = nullptr;
    int width = 0;
    int height = 0;
    fonts.GetTexDataAsAlpha8(&coverage, &width, &height);
    reset_state();
    glActiveTexture(GL_TEXTURE0);
    fill_texture(glyphs_, GL_R8, {width, height}, GL_RED, GL_UNSIGNED_BYTE, coverage);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    // White, as opaque as the glyph covers the pixel.
    const std::array<GLint, 4> swizzle{GL_ONE, GL_ONE, GL_ONE, GL_RED};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle.data());
    fonts.ClearTexData();
    fonts.SetTexID(texture_id(glyphs_));
}

void UiPass::draw(const ImDrawData& data, PictureSize size) {
    reset_state();
    glViewport(0, 0, size.width, size.height);
    blend_over();
    glEnable(GL_SCISSOR_TEST);
    for (ShaderProgram* program : {&plain_, &textured_}) {
        program->use();
        program->set("viewport", size);
    }
    textured_.set("picture", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        fill(GL_ARRAY_BUFFER, list.VtxBuffer);
        fill(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;
            const auto width = static_cast<GLsizei>(clip.z - clip.x);
            const auto height = static_cast<GLsizei>(clip.w - clip.y);
            if (width <= 0 || height <= 0 || command.ElemCount == 0) continue;
            // OpenGL counts rows from below.
            glScissor(static_cast<GLint>(clip.x), size.height - static_cast<GLint>(clip.w), width, height);
            glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
            const auto draw_indices = [&](unsigned first, unsigned count) {
                glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_SHORT,
                                         at_byte((command.IdxOffset + first) * sizeof(ImDrawIdx)),
                                         static_cast<GLint>(command.VtxOffset));
            };
            const unsigned plain = leading_plain(list, command);
            if (plain > 0) {
                plain_.use();
                draw_indices(0, plain);
                textured_.use();
            }
            if (plain == command.ElemCount) continue;
            // A picture hides what is behind it.
            const bool is_picture = command.GetTexID() != texture_id(glyphs_);
            if (is_picture) glDisable(GL_BLEND);
            draw_indices(plain, command.ElemCount - plain);
            if (is_picture) glEnable(GL_BLEND);
        }
    }
    glDisable(GL_SCISSOR_TEST);
}

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

bool ImageTexture::take(const std::shared_ptr<const Image>& image, bool smooth) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (image->width > most || image->height > most) return false;
    const bool other = image_ != image;
    if (!other && smooth == smooth_) return true;
    reset_state();
    glActiveTexture(GL_TEXTURE0);
    if (other) {
        allocate(texture_, {image->width, image->height});
        const std::vector<std::uint8_t> pixels = on_chequer(*image);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image->width, image->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        glGenerateMipmap(GL_TEXTURE_2D);
    }
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smooth ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
    image_ = image;
    smooth_ = smooth;
    return true;
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
