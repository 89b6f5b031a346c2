/// The motion files that are written, and what is left of played motion in them.
#pragma once

#include <import/skeleton/motion.h>
#include <motion_files/played_motion.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mobbscope {

/// The text of a BVH: metres, y up, Frame Time the motion's dt, rotations in the order Z X Y. All angles 0 are the pose
/// in which nothing is animated. The root has position channels, and so have bones whose length varies.
std::string to_bvh(const PlayedMotion& motion);

/// The bytes of a GLB: a node for each joint below one that stands where the motion begins, a skin of all joints, so
/// that programs show bones, and one animation, whose time 0 is when the first of all agents begins. Joints keep their
/// names and their own axes, so what was skinned to the source fits.
std::string to_glb(const PlayedMotion& motion);

struct MotionFormat {
    std::string_view extension;  ///< in lower case, with its dot
    std::string (*write)(const PlayedMotion&);
    /// The bytes of one again; `file` stands for it in messages. Throws InputError.
    MotionFile (*read)(std::string_view bytes, const std::filesystem::path& file);
};

std::span<const MotionFormat> motion_formats();

/// That of a file's extension; null if motion is not written so.
const MotionFormat* motion_format(const std::filesystem::path& file);

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
