/// The words about a moment.
#pragma once

#include <render/caption.h>
#include <render/legend.h>
#include <render/moment.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Who is there, and who overlaps whom, or how near they come.
Caption moment_caption(const Palette& palette, std::span<const Subject> subjects, const Moment& moment);

/// What its colours and lines stand for. `radius`: that of a body is drawn as a line.
std::vector<LegendEntry> moment_legend(const Palette& palette, std::span<const Subject> subjects, const Moment& moment,
                                       bool paths, bool radius);

}  // namespace mobbscope
