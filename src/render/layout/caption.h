/// The words at the top of a picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct Caption {
    std::vector<std::string> headlines;  ///< the sentence that answers what is seen, in fewer and fewer words; or none
    std::string detail;                  ///< read second
    Rgba mark{0};                        ///< colour of the dot before the headline; opacity 0: none
    bool panel = false;                  ///< on a panel, as the scene may lie behind
};

/// What the scene is and which boxes are shown, with their volume.
Caption scene_caption(const FittedScene& fitted, std::span<const DrawnAgent> agents, const ViewState& view);

/// What a step of a query shows.
Caption query_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      int step);

/// " at 1.23 s".
std::string at_time(double time);

/// Whether the scene may lie behind the words: it does not where the camera frames it by itself.
bool scene_may_lie_behind(const ViewState& view, const PictureOptions& options);

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

/// `room`: pixels across, with the dot and the panel. A last headline that is too long is cut off visibly.
CaptionLines caption_lines(const Caption& caption, float room, float scale, std::size_t most_headlines);

/// What it covers, pixels: with its dot and its panel.
glm::vec2 caption_size(const Caption& caption, const CaptionLines& lines, float scale);

/// Adds it along the top edge; returns where it ends, pixels from the top.
float add_caption(DrawList& list, const Caption& caption, const CaptionLines& lines, float margin, float scale);

}  // namespace mobbscope
