/// Which import options mean something for which format.
#pragma once

#include <import/clip/imported_clip.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {

/// Options with those left out that mean nothing for a file of one format.
struct ApplicableOptions {
    ImportOptions options;
    std::vector<std::string> left_out;  ///< their keys in a scene: "up", "root", ...
};

/// Why an option was left out: "up does not apply to .csv files".
std::string does_not_apply(const std::string& key, const std::filesystem::path& file);

/// The format is told by the file's extension; what is no CSV and no trajectory file has a skeleton.
ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file);

}  // namespace mobbscope
