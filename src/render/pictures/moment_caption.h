/// The words about a moment.
#pragma once

#include <render/layout/caption.h>
#include <render/layout/legend.h>
#include <render/pictures/moment.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Who is there, of so many people, and who overlaps whom, or how near they come.
Caption moment_caption(const Palette& palette, std::span<const DrawnAgent> agents, const Moment& moment,
                       std::size_t people);

/// Radii of few are drawn as lines; those of more would be told apart by nobody.
bool may_show_radii(std::span<const DrawnAgent> agents);

/// What the picture's colours and lines stand for, whenever it is: the legend stays while time runs.
std::vector<LegendEntry> moment_legend(const Palette& palette, std::span<const DrawnAgent> agents,
                                       const ViewState& view);

}  // namespace mobbscope
