/// Completing the path of a file as it is typed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

struct PathEntry {
    std::string name;
    bool folder = false;
    std::uintmax_t size = 0;  ///< bytes, of a file
};

struct PathCompletion {
    std::filesystem::path folder;    ///< that is listed
    std::vector<PathEntry> entries;  ///< that go on as typed: folders first, by name; hidden ones only if asked for
    std::string completed;           ///< what was typed, as far as all entries agree
};

/// "~" and "~/..." in the person's home; nothing else changes.
std::string expanded(const std::string& typed);

/// `extensions`: of the files that are listed (".json"). A folder that cannot be read has no entries.
PathCompletion complete_path(const std::string& typed, std::span<const std::string_view> extensions);

/// What is typed when an entry is taken; a folder ends in a slash.
std::string with_entry(const std::string& typed, const PathEntry& entry);

}  // namespace mobbscope::app
