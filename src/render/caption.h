/// The words at the top of a picture.
#pragma once

#include <render/draw_list.h>
#include <render/subject.h>

#include <span>
#include <string>

namespace mobbscope {

struct Caption {
    std::string headline;  ///< the sentence that answers what is seen
    std::string detail;    ///< read second
    Rgba mark{0};          ///< colour of the dot before the headline; opacity 0: none
};

/// What the scene is and which boxes are shown, with their volume.
Caption scene_caption(const Palette& palette, const FittedScene& fitted, std::span<const Subject> subjects,
                      const ViewState& view);

/// What a step of a query shows.
Caption query_caption(const Palette& palette, std::span<const Subject> sides, const RecordedQuery& recorded, int step);

/// Adds it along the top edge, at most two lines of headline; returns where it ends, pixels from the top.
float add_caption(DrawList& list, const Caption& caption, float margin, float scale);

}  // namespace mobbscope
