/// What is pointed out in a picture: the selection, what is under the mouse, and the like.
#pragma once

#include <mobb/clip.h>
#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Lines through points, each on a line in the ground's colour that sets it off from what is below. `scale`: of line
/// widths, as for all that follow.
void add_highlight_lines(DrawList& list, std::span<const std::vector<glm::vec3>> lines, HighlightLine::Role role,
                         float scale);

/// Outlines a node's box, a sample's disk, or the ends of a path; in the picture of a moment the disk that holds then.
/// Returns false and adds nothing where the picture of a moment does not show it. The part must exist.
bool add_highlight(DrawList& list, const DrawnAgent& agent, const AgentPart& part, HighlightLine::Role role,
                   float scale);

/// Outlines the boxes above a node in fine dashes, the fainter the higher; in place of those that are outlined so.
/// Nothing in the picture of a moment.
void add_ancestors(DrawList& list, const DrawnAgent& agent, int node, float scale);
/// Those above the node that the view shows alone, if it shows them.
void add_ancestors_of_part(DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view, float scale);

/// A way that somebody could take or has left: the line of its centres.
void add_way_highlight(DrawList& list, const mobb::PlacedClip& way, HighlightLine::Role role, float scale);

/// Where an agent stood before it was dragged: the line of its centres, and the disks at both ends.
void add_ghost(DrawList& list, const mobb::PlacedClip& before, float scale);

/// A part of an agent in the picture by name. As text "A", "A:node:12" or "A:sample:40"; the name goes up to the last
/// ":node:N" or ":sample:N". A name that itself ends like a part is followed by ":path" where its path is meant.
struct NamedPart {
    std::string agent;
    AgentPart part;
    friend bool operator==(const NamedPart&, const NamedPart&) = default;
};
/// Throws std::invalid_argument if it is empty.
NamedPart parse_named_part(std::string_view text);
std::string text_of(const NamedPart& named);

/// Highlights it as selected in the list of a view of the scene (or of a run), with the boxes above it where the view
/// shows them. Throws std::invalid_argument, saying what there is, if the picture is not of such an agent, the agent
/// has no such node or sample or is not there at the moment of the picture, or it is a node and the picture is of a
/// moment.
void add_selection(DrawList& list, const FittedScene& fitted, const ViewState& view, const NamedPart& named,
                   float scale);

}  // namespace mobbscope
