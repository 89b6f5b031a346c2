/// What the reports say in the same words.
#pragma once

#include <guard/reports.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::guard {

/// "osmesa (llvmpipe)", or that nothing was drawn.
std::string drawn_by(const RunFacts& facts);

/// "1 passed, 2 different, 3 without a golden, 4 failed, 5 skipped"; what there is none of is left out.
std::string sum_of(const Summary& summary);

/// For each folder whose goldens are from elsewhere (reference.h) a sentence: that pixels of text are not compared, and
/// what is other here.
std::vector<std::string> not_compared(std::span<const CaseResult> results);

/// The command line that takes the pictures of these cases as their goldens, ready for a shell.
std::string update_command(const RunFacts& facts, std::span<const std::string_view> names);

}  // namespace mobbscope::guard
