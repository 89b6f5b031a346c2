/// The window's own framebuffer, and copies of pictures for its panels. All need a current context, also when they are
/// destroyed.
#pragma once

#include <render/drawlist/palette.h>
#include <render/gl/gl_objects.h>
#include <render/image/image.h>

namespace mobbscope::app {

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

}  // namespace mobbscope::app
