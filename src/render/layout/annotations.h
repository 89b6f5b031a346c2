/// What a picture says about single places: rings, gaps with their numbers, names.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/query/proof_walls.h>
#include <render/query/query_boxes.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>

#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// Rings around the disks that matter.
void add_rings(DrawList& list, std::span<const DrawnAgent> agents, const Emphasis& emphasis, float scale);

/// The gap that the test under way found, and the hit; returns the numbers to stand beside them. Needs the projection.
std::vector<LabelRequest> add_findings(DrawList& list, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                                       const QueryProgress& progress, const Metrics& metrics);

/// The number beside a gap across a wall of the proof, and the words in the free region, if they can be seen.
void add_gap_note(std::vector<LabelRequest>& notes, const DrawList& list, const WallGap& gap, const Metrics& metrics);
void add_region_note(std::vector<LabelRequest>& notes, const DrawList& list, const DrawnAgent& b, glm::vec3 middle,
                     const Metrics& metrics);

/// Places those numbers, each with a line to its place.
void add_notes(DrawList& list, LabelLayout& layout, std::span<const LabelRequest> notes, float scale);

/// More names than this hide the scene and one another.
bool names_fit(std::size_t agents);

/// Whether they are few enough, and none is in the foreground alone.
bool all_are_named(std::span<const DrawnAgent> agents);

/// A name beside `top` (drawn space), the upper end of a path or body of that radius. None where that is not seen.
std::optional<LabelRequest> name_label(const DrawList& list, const DrawnAgent& agent, glm::vec3 top, double radius,
                                       float text_size);

/// How many are not hidden.
std::size_t shown_count(std::span<const DrawnAgent> agents);

/// Under each cell of a grid the name of who is in it. `floor`: the time at which cells lie on the floor.
void add_cell_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, double floor,
                    const Metrics& metrics);

/// A name on a plate beside where somebody is, at that height (drawn space).
std::optional<LabelRequest> plate_at(const DrawList& list, const DrawnAgent& agent, const mobb::Disk& disk,
                                     double height, const Rgba& border, const Metrics& metrics);

/// The plates of who is DrawnAgent::named, at a time in space-time; they need no other name then.
std::vector<LabelRequest> names_at(const DrawList& list, std::span<DrawnAgent> agents, double time,
                                   const Metrics& metrics);

/// Names at the upper ends of paths, of many those of DrawnAgent::named; a single path is named by the legend.
void add_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, const Metrics& metrics);

}  // namespace mobbscope
