/// What a file or a folder holds, in words for people.
#pragma once

#include <scene/scene.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

struct FileSummary {
    bool readable = true;
    std::string title;  ///< "Scene with 2 agents, 1 query"; else why it cannot be read
    std::vector<std::pair<std::string, std::string>> facts;  ///< of a single clip: "Joints", "24, root Hips"
    std::vector<std::pair<std::string, std::string>> clips;  ///< of several: name and duration, at most kMostListed
    std::size_t clip_count = 0;
    std::vector<std::string> warnings;  ///< each once
    static constexpr std::size_t kMostListed = 40;
};

/// Reads a file that can be opened, or looks through a folder. `progress` is told now and then and may throw to end it;
/// that passes through, nothing else is thrown.
FileSummary summary_of(const std::filesystem::path& file, const Progress& progress = {});

}  // namespace mobbscope
