/// The framebuffers that a picture is made in.
#pragma once

#include <base/error.h>
#include <render/gl/gl_objects.h>
#include <render/image/image.h>

namespace mobbscope {

/// OpenGL has too little memory for a framebuffer.
class LacksMemory : public MachineError {
  public:
    LacksMemory() : MachineError("this OpenGL lacks memory for a picture of this size: make it smaller") {}
};

/// Framebuffers of one size and number of samples. Without multisampling the scene is drawn straight into the result,
/// and the faces use its depth.
class Targets {
  public:
    /// `samples`: of the scene's framebuffer, 1 (no multisampling) or more. Throws LacksMemory, or MachineError if this
    /// OpenGL cannot draw so.
    Targets(PictureSize size, int samples);

    PictureSize size() const { return size_; }
    int samples() const { return samples_; }
    const Framebuffer& scene() const { return scene_; }  ///< colour and depth
    /// Which disks are seen, and the scene's depth. It stays as it is while faces and lines are drawn.
    const Framebuffer& visibility_buffer() const { return visibility_buffer_; }
    const Texture& visibility() const { return visibility_; }  ///< its texture
    const Framebuffer& faces() const { return faces_; }        ///< sums, weights and depth of the transparent faces
    /// The picture.
    const Framebuffer& result() const { return samples_ > 1 ? result_ : scene_; }
    const Texture& picture() const { return picture_; }  ///< its colours
    const Texture& sums() const { return sums_; }
    const Texture& weights() const { return weights_; }

    /// Brings the scene's depth to the faces' framebuffer. The faces are smooth inside and their edges are drawn as
    /// lines, so they do without multisampling.
    void share_depth() const;
    /// Brings the scene into the result: averages its samples.
    void resolve() const;

    /// The colours and the depth of another scene, drawn smoothly over all of this one; neither is multisampled.
    void enlarge(const Targets& other) const;

  private:
    PictureSize size_;
    int samples_;
    Framebuffer scene_, visibility_buffer_, faces_, result_;
    Renderbuffer scene_color_, scene_depth_, faces_depth_;
    Texture visibility_, sums_, weights_, picture_;
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
