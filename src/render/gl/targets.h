/// The framebuffers that a picture is made in.
#pragma once

#include <base/error.h>
#include <render/gl/gl_objects.h>
#include <render/image/image.h>

#include <optional>

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

    // What not every picture needs takes most of the memory, and clearing that takes time. Made once; throw as above.
    void need_visibility();
    void need_faces();

    PictureSize size() const { return size_; }
    int samples() const { return samples_; }
    const Framebuffer& scene() const { return scene_; }  ///< colour and depth
    /// Which disks are seen, and the scene's depth; once it was needed. It stays as it is while faces and lines are
    /// drawn.
    const Framebuffer& visibility_buffer() const { return *visibility_buffer_; }
    const Texture& visibility() const { return visibility_; }    ///< its texture
    const Framebuffer& faces() const { return *faces_; }         ///< sums, weights and depth of the transparent faces
    const Texture& scene_color() const { return scene_color_; }  ///< multisampled; not used where it has one sample
    const Texture& scene_depth() const { return scene_depth_; }
    /// The picture.
    const Framebuffer& result() const { return samples_ > 1 ? result_ : scene_; }
    const Texture& picture() const { return picture_; }  ///< its colours
    const Texture& sums() const { return sums_; }
    const Texture& weights() const { return weights_; }

    /// The colours and the depth of another scene, drawn smoothly over all of this one; neither is multisampled.
    void enlarge(const Targets& other) const;

  private:
    void attach_scene_depth() const;  ///< to the bound framebuffer

    PictureSize size_;
    int samples_;
    Framebuffer scene_, result_;
    std::optional<Framebuffer> visibility_buffer_, faces_;  ///< none until they are needed
    Renderbuffer faces_depth_;
    Texture scene_color_, scene_depth_, visibility_, sums_, weights_, picture_;
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
