/// The words at the top of a picture.
#pragma once

#include <explain/query_progress.h>
#include <explain/query_proof.h>
#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct Caption {
    std::vector<std::string> headlines;  ///< the sentence that answers what is seen, in fewer and fewer words; or none
    std::string detail;                  ///< read second
    /// The same in fewer and fewer words, for what is too narrow even for small letters; or none.
    std::vector<std::string> short_headlines{}, short_details{};
    std::string title;  ///< what is left of it when it is folded; empty: its last headline
    Rgba mark{0};       ///< colour of the dot before the headline; opacity 0: none
};

/// What the scene is called and which boxes are shown, with their volume. Of a scene without a file the detail alone.
/// `box_tests`: of a query of the trees; none: they are not told.
Caption scene_caption(const FittedScene& fitted, std::span<const DrawnAgent> agents, const ViewState& view,
                      std::optional<double> box_tests = {});

/// What a step of a query shows.
Caption query_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      const QueryProgress& progress);

/// What the last step of a query shows where the proof of a miss stands in place of the test: the answer, and its
/// proof.
Caption proof_caption(const Palette& palette, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                      const QueryProof& proof);

/// " at 1.23 s".
std::string at_time(double time);

/// Says something in the detail, before all else.
void mention(Caption& caption, const std::string& text);

/// Says in the detail who is in the foreground, by name, or how many; and likewise who of all is hidden.
void mention_foreground(Caption& caption, std::span<const std::string> foreground);
void mention_hidden(Caption& caption, std::span<const std::string> hidden, std::size_t all);

/// Says in the detail that a time cursor is not drawn, as it lies outside what the paths take.
void mention_cursor_outside(Caption& caption, double time, double begin, double end);

/// How large a caption's headline is: of a narrow picture as small as the detail, in more lines.
enum class CaptionSize { large, small };

/// A caption cut to a picture: the first words that its lines hold.
struct CaptionLines {
    std::vector<std::string> headline;
    std::vector<std::string> detail;
    CaptionSize size = CaptionSize::large;
    bool whole_headline = true, whole_detail = true;  ///< nothing is cut off
};

/// `room`: pixels across, with the dot. Last words that are too long are cut off visibly.
CaptionLines caption_lines(const Caption& caption, float room, float scale, CaptionSize size);

/// What it covers, pixels: with its dot.
glm::vec2 caption_size(const Caption& caption, const CaptionLines& lines, float scale);

/// Adds it with its upper left corner at a point.
void add_caption(DrawList& list, const Caption& caption, const CaptionLines& lines, glm::vec2 corner, float scale);

}  // namespace mobbscope
