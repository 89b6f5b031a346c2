/// What a clip's queries would cost if one node of its tree were other, as text and as JSON.
#pragma once

#include <base/json_writer.h>
#include <explain/what_if.h>

#include <string>

namespace mobbscope::cli {

/// Standard placements of a clip against itself, and what its tree's node would cost.
struct ClipWhatIf {
    std::string clip;
    QueryWorkload workload;
    WhatIf found;
};

/// Throws std::invalid_argument if there is no such node ("12", or "2.1": level and place), or of a tree of blocks.
ClipWhatIf what_if_of(const std::string& clip, const std::shared_ptr<const mobb::Tree>& tree, const std::string& node);

void print_what_if(const ClipWhatIf& of);
void write_what_if(JsonWriter& out, const ClipWhatIf& of);

}  // namespace mobbscope::cli
