/// The framebuffers that a picture is made in.
#pragma once

#include <render/gl_objects.h>
#include <render/image.h>

namespace mobbscope {

/// Framebuffers of one size.
class Targets {
  public:
    /// `samples`: of the scene's framebuffer, 1 (no multisampling) or more.
    Targets(PictureSize size, int samples);

    PictureSize size() const { return size_; }
    const Framebuffer& scene() const { return scene_; }    ///< multisampled colour and depth
    const Framebuffer& faces() const { return faces_; }    ///< sums, weights and depth of the transparent faces
    const Framebuffer& result() const { return result_; }  ///< the picture
    const Texture& sums() const { return sums_; }
    const Texture& weights() const { return weights_; }

    /// Copies the scene's depth to the faces' framebuffer. The faces are smooth inside and their edges are drawn as
    /// lines, so they do without multisampling.
    void share_depth() const;
    /// Averages the samples of the scene into the result.
    void resolve() const;

  private:
    PictureSize size_;
    Framebuffer scene_, faces_, result_;
    Renderbuffer scene_color_, scene_depth_, faces_depth_, result_color_;
    Texture sums_, weights_;
};

/// The framebuffer that object ids are drawn in: no multisampling, the nearest wins.
class IdTarget {
  public:
    explicit IdTarget(PictureSize size);
    const Framebuffer& framebuffer() const { return framebuffer_; }

  private:
    Framebuffer framebuffer_;
    Renderbuffer ids_, depth_;
};

}  // namespace mobbscope
