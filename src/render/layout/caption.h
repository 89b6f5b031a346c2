/// The words at the top of a picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct Caption {
    std::vector<std::string> headlines;  ///< the sentence that answers what is seen, in fewer and fewer words; or none
    std::string detail;                  ///< read second
    std::string title;                   ///< what is left of it when it is folded; empty: its last headline
    Rgba mark{0};                        ///< colour of the dot before the headline; opacity 0: none
};

/// What the scene is and which boxes are shown, with their volume.
Caption scene_caption(const FittedScene& fitted, std::span<const DrawnAgent> agents, const ViewState& view);

/// What a step of a query shows.
Caption query_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      int step);

/// " at 1.23 s".
std::string at_time(double time);

/// Says something in the detail, before all else.
void mention(Caption& caption, const std::string& text);

/// Says in the detail who is hidden: by name, or how many of all.
void mention_hidden(Caption& caption, std::span<const std::string> hidden, std::size_t all);

/// Says in the detail that a time cursor is not drawn, as it lies outside what the paths take.
void mention_cursor_outside(Caption& caption, double time, double begin, double end);

/// A caption cut to a picture: the first headline of at most so many lines, and the detail below it.
struct CaptionLines {
    std::vector<std::string> headline;
    std::vector<std::string> detail;
};

/// `room`: pixels across, with the dot. A last headline that is too long is cut off visibly.
CaptionLines caption_lines(const Caption& caption, float room, float scale, std::size_t most_headlines);

/// What it covers, pixels: with its dot.
glm::vec2 caption_size(const Caption& caption, const CaptionLines& lines, float scale);

/// Adds it with its upper left corner at a point.
void add_caption(DrawList& list, const Caption& caption, const CaptionLines& lines, glm::vec2 corner, float scale);

}  // namespace mobbscope
