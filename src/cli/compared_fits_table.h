/// Fits of a clip side by side, as text and as JSON.
#pragma once

#include <base/json_writer.h>
#include <explain/compared_fits.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::cli {

struct ClipComparison {
    std::string clip;
    std::vector<std::shared_ptr<const mobb::Tree>> trees;
    ComparedFits fits;
};

/// Fits them, and counts what queries of the clip against itself cost under standard placements, `most` at most. Throws
/// std::invalid_argument if an option is out of range.
ClipComparison comparison_of(const std::string& clip, const mobb::ClipPtr& samples,
                             std::span<const mobb::FitOptions> fits, std::size_t most);

void print_compared_fits(const ClipComparison& of);
void write_compared_fits(JsonWriter& out, const ClipComparison& of);

}  // namespace mobbscope::cli
