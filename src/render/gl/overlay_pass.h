/// Draws panels and text over the picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>
#include <render/gl/glyph_atlas.h>

#include <cstddef>

namespace mobbscope {

class OverlayPass {
  public:
    explicit OverlayPass(GlContext& context);

    /// Uploads the list's panels, marks and texts.
    void keep(const DrawnOverlay& overlay, DrawStatistics& statistics);
    /// Draws what was uploaded: panels; what lies over the lines, marks and then texts.
    void draw_panels(PictureSize size, DrawStatistics& statistics);
    void draw_texts(PictureSize size, DrawStatistics& statistics);

  private:
    struct Instance;
    void draw(std::size_t first, std::size_t end, PictureSize size, DrawStatistics& statistics);

    ShaderProgram program_;
    VertexArray array_;
    Buffer instances_;  ///< panels, then marks and glyphs
    std::size_t panels_ = 0, all_ = 0;
    Texture atlas_;
    KeptGlyphs glyphs_;
};

}  // namespace mobbscope
