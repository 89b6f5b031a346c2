/// Where the project's own files are that tests read.
#pragma once

#include <filesystem>
#include <string>

namespace mobbscope {
inline namespace testing {

inline const std::filesystem::path kSource = MOBBSCOPE_SOURCE_DIR;
inline const std::filesystem::path kClips = kSource / "assets/clips";
inline const std::filesystem::path kScenes = kSource / "assets/scenes";
/// Two people whose paths cross on the floor, but not in time.
inline const std::string kCrossing = kScenes / "crossing.json";
/// Data that the repository does not have: tests that need it are skipped where it is absent.
inline const std::filesystem::path kSharedData = MOBBSCOPE_SHARED_DATA;

}  // namespace testing
}  // namespace mobbscope
