/// Averages the samples of a multisampled picture.
#pragma once

#include <render/gl/gl_objects.h>

namespace mobbscope {

/// By a shader of ours: those that glBlitFramebuffer needs are compiled anew by llvmpipe in each process, whatever it
/// keeps on disk, which takes longer than all else of a small picture.
class ResolvePass {
  public:
    explicit ResolvePass(GlContext& context) : program_(context, "resolve") {}

    /// Into all of the bound framebuffer. `scene`: a texture of its size with so many samples (> 1).
    void draw(const Texture& scene, int samples, DrawStatistics& statistics) {
        program_.use();
        program_.set("scene", 0);
        program_.set("samples", samples);
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, scene.name());
        glBindVertexArray(array_.name());
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        ++statistics.triangles;
        ++statistics.draw_calls;
    }

  private:
    ShaderProgram program_;
    VertexArray array_;
};

}  // namespace mobbscope
