/// The window in OpenGL: its framebuffer, copies of pictures for its panels, and what Dear ImGui made of a frame. All
/// need a current context, also when they are destroyed.
#pragma once

#include <render/drawlist/palette.h>
#include <render/gl/gl_objects.h>
#include <render/image/image.h>

#include <imgui.h>

#include <memory>

namespace mobbscope::app {

/// The texture as Dear ImGui hands it around.
ImTextureID texture_id(const Texture& texture);

/// Draws what Dear ImGui made of a frame. Its stock renderer loads libGL by itself, which does not reach every context.
class UiPass {
  public:
    explicit UiPass(GlContext& context);

    /// Uploads the glyphs; again when they were made anew.
    void upload(ImFontAtlas& fonts);

    /// Into the framebuffer that is bound, whose size in pixels is given; what is there is opaque and stays so.
    void draw(const ImDrawData& data, PictureSize size);

  private:
    ShaderProgram textured_, plain_;
    VertexArray array_;
    Buffer vertices_, indices_;
    Texture glyphs_;
};

/// Opaque RGBA8 without multisampling: panels bring their smooth edges along.
class WindowTarget {
  public:
    explicit WindowTarget(PictureSize size);

    PictureSize size() const { return size_; }
    /// Binds it and fills it with a colour.
    void clear(const Rgba& color) const;
    Image read() const;
    /// Copies it to the context's default framebuffer.
    void present() const;

  private:
    PictureSize size_;
    Framebuffer framebuffer_;
    Texture color_;
};

/// A texture that keeps what was in another one.
class PictureCopy {
  public:
    const Texture& texture() const { return copy_; }
    void take(const Texture& picture, PictureSize size);

  private:
    PictureSize size_;
    Framebuffer from_;
    Texture copy_;
};

/// A picture of the CPU as a texture, upper row first.
class ImageTexture {
  public:
    /// Whether OpenGL can hold it. Uploads it if it is another than the last.
    bool take(const std::shared_ptr<const Image>& image, bool smooth);
    const Texture& texture() const { return texture_; }

  private:
    std::shared_ptr<const Image> image_;
    bool smooth_ = false;
    Texture texture_;
};

}  // namespace mobbscope::app
