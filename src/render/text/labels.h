/// Places labels so that none overlaps another or leaves the picture.
#pragma once

#include <render/drawlist/draw_list.h>

#include <functional>
#include <string>
#include <vector>

namespace mobbscope {

/// A label that wants to stand near a point of the picture.
struct LabelRequest {
    std::string text;
    TextRole role = TextRole::label;
    FontFace face = FontFace::text;
    float size = 12;
    Rgba color{1};
    glm::vec2 anchor{0};                ///< pixels
    std::vector<glm::vec2> directions;  ///< where it may stand from there, best first; any length
    float distance = 4;                 ///< pixels from the anchor to the label's edge
    bool pill = false;                  ///< on a small panel of its own
    Rgba border{0};                     ///< of the panel
};

class LabelLayout {
  public:
    explicit LabelLayout(PictureSize size);
    /// Of a picture: labels stay out of the words and panels that it has so far.
    explicit LabelLayout(const DrawList& list);

    /// Keeps labels out of a rectangle.
    void reserve(const Rect& rect) { taken_.push_back(rect); }
    /// Whether nothing is there, nor within `room` pixels to the left and right of it.
    bool is_free(const Rect& rect, float room) const;

    /// Adds the label to the list at the first direction that is free; false if none is. Earlier labels have
    /// precedence.
    bool place(const LabelRequest& request, DrawList& list);

  private:
    Rect picture_;
    std::vector<Rect> taken_;
};

/// A line of text with its upper left corner at a point; its `box` is filled in.
TextRun text_at(TextRole role, const std::string& text, FontFace face, float size, Rgba color, glm::vec2 corner);

/// The height of a line of text, pixels.
float line_height(FontFace face, float size);

/// Pixels between its edge and what is written on it. `text_size`: pixels, of the legend's words.
float panel_padding(float text_size);

/// In the palette's colours.
OverlayPanel text_panel(const Rect& rect, const Palette& palette, float text_size);

/// The largest of 1, 2, 5 times a power of ten that divides `span` into at least `parts` pieces. span > 0, parts > 0.
double nice_step(double span, double parts);

/// The finest of 1, 2, 5 times a power of ten at which labels along a ruler of that length have room; `width_of` says
/// how much one takes, with the gap to the next. to > from, length > 0.
double ruler_step(double from, double to, float length, const std::function<float(const std::string&)>& width_of);

/// The multiples of `step` in [from, to], with a hair's breadth of tolerance at the ends.
std::vector<double> ticks(double from, double to, double step);

/// A multiple of `step` with just the decimals that the step needs: "0.5", "10".
std::string tick_text(double value, double step);

}  // namespace mobbscope
