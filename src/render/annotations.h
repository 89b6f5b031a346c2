/// What a picture says about single places: rings, gaps with their numbers, names.
#pragma once

#include <render/draw_list.h>
#include <render/emphasis.h>
#include <render/label_layout.h>
#include <render/metrics.h>
#include <render/subject.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Rings around the disks that matter.
void add_rings(DrawList& list, std::span<const Subject> subjects, const Emphasis& emphasis, float scale);

/// The gap that the test under way found, and the hit; returns the numbers to stand beside them. Needs the lens.
std::vector<LabelRequest> add_findings(DrawList& list, std::span<const Subject> sides, const RecordedQuery& recorded,
                                       const QueryProgress& progress, const Metrics& metrics);

/// Places those numbers, each with a line to its place.
void add_notes(DrawList& list, LabelLayout& layout, std::span<const LabelRequest> notes, float scale);

/// More names than this hide the scene and one another.
bool names_fit(std::size_t subjects);

/// Names at the upper ends of paths; a single path is named by the legend.
void add_names(DrawList& list, LabelLayout& layout, std::span<const Subject> subjects, const Metrics& metrics);

}  // namespace mobbscope
