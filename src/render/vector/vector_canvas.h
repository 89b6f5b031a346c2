/// What vector files hold, and their writers.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <memory>
#include <string>
#include <vector>

namespace mobbscope {

/// Runs of straight lines that are drawn alike; where it is translucent no two of them share a point but their ends.
struct VectorStroke {
    std::vector<std::vector<glm::vec2>> runs;  ///< of at least two points each
    Rgba color{1};
    float width = 1;
    Dash dash = kSolid;
    float dash_start = 0;  ///< pixels into the pattern at each run's first point
};

/// Joins a line to the last of the strokes where that looks the same: opaque ones may cross, and a line may go on.
/// `style`: without hidden parts and cap, which are the caller's.
void add_line(std::vector<VectorStroke>& strokes, glm::vec2 from, glm::vec2 to, const LineStyle& style,
              float dash_start = 0);

/// Takes what a picture shows from the lowest on, in pixels from the upper left corner.
class VectorCanvas {
  public:
    virtual ~VectorCanvas() = default;
    virtual void fill(Rgba color) = 0;           ///< all of the picture
    virtual void image(const Image& image) = 0;  ///< over all of the picture, of whatever size it is
    /// With round corners, and a line along its edge, half outside; what has opacity 0 is not drawn.
    virtual void rectangle(const Rect& rect, float radius, Rgba fill, Rgba line, float width) = 0;
    virtual void stroke(const VectorStroke& stroke) = 0;
    virtual void text(const TextRun& text) = 0;
    /// The bytes of the file; nothing may be drawn after that.
    virtual std::string finish() = 0;
};

/// A panel of the overlay: its border lies within it.
void draw_panel(VectorCanvas& canvas, const OverlayPanel& panel);

/// `title`: what the file says it shows. The same calls give the same bytes.
std::unique_ptr<VectorCanvas> svg_canvas(PictureSize size, const std::string& title);
/// Throws MachineError if cairo refuses.
std::unique_ptr<VectorCanvas> pdf_canvas(PictureSize size, const std::string& title);

}  // namespace mobbscope
