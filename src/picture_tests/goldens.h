/// What a run leaves on the disk: pictures to look at, and goldens that were taken.
#pragma once

#include <picture_tests/run_cases.h>

#include <filesystem>
#include <vector>

namespace mobbscope::picture_tests {

/// Makes the folder that a file goes to, if need be. Throws MachineError.
void make_folder_of(const std::filesystem::path& file);

/// Writes the pictures of a case into a folder that is made if need be: NAME.actual.png, NAME.golden.png and
/// NAME.heat.png, those that there are, none of a case that passed; what an earlier run left of the others goes.
/// Returns what it wrote. Throws MachineError.
std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder);

/// Makes the goldens of a case what is drawn now, each file whole; then the case has passed. Returns what it wrote.
/// Throws MachineError.
std::vector<std::filesystem::path> take(CaseResult& result);

}  // namespace mobbscope::picture_tests
