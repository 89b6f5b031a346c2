/// Draws what Dear ImGui made of a frame. Its stock renderer loads libGL by itself, which does not reach every context.
#pragma once

#include <render/gl/gl_objects.h>
#include <render/image/image.h>

#include <imgui.h>

namespace mobbscope::app {

/// The texture as Dear ImGui hands it around.
ImTextureID texture_id(const Texture& texture);

/// Needs its context to be current, also when it is destroyed.
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

}  // namespace mobbscope::app
