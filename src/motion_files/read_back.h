/// What is left of played motion in a file: the file read again.
#pragma once

#include <motion_files/formats.h>
#include <motion_files/played_motion.h>

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// Metres: a disk that is read again may be so far off.
inline constexpr double kSameDisk = 1e-3;

/// How far the disks of a file are from those that were played, metres. Infinite if there are more of them, or fewer.
struct DiskDifference {
    double place = 0;
    double radius = 0;
    std::optional<std::string> root{};  ///< disks are in place if this root is named, and the unit m
};

/// Imports what the format has written at the motion's own rate; with unit and root where what an
/// import guesses puts disks beyond kSameDisk. Throws InputError where an import would.
DiskDifference read_back(std::string_view bytes, const MotionFormat& format, const PlayedMotion& motion);

}  // namespace mobbscope
