/// Draws panels and text over the picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>
#include <render/gl/glyph_atlas.h>

namespace mobbscope {

class OverlayPass {
  public:
    explicit OverlayPass(GlContext& context);

    void draw_panels(const DrawList& list, DrawStatistics& statistics);
    /// What lies over the lines: marks, then texts.
    void draw_texts(const DrawList& list, DrawStatistics& statistics);

  private:
    struct Instance;
    void draw(const std::vector<Instance>& instances, PictureSize size, DrawStatistics& statistics);
    void draw(const std::vector<OverlayPanel>& panels, PictureSize size, DrawStatistics& statistics);

    ShaderProgram program_;
    VertexArray array_;
    Buffer instances_;
    Texture atlas_;
    GlyphCache glyphs_;
};

}  // namespace mobbscope
