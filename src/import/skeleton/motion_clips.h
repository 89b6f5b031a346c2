/// Skeletons in motion to clips of disks (contract, section 2), and what looks wrong about such clips.
#pragma once

#include <import/clip/import_options.h>
#include <import/clip/imported_clip.h>
#include <import/skeleton/motion.h>

#include <filesystem>
#include <optional>
#include <vector>

namespace mobbscope {

/// A clip of every animation in a file, or of the one that the options name. Throws InputError.
std::vector<ImportedClip> motion_clips(const MotionFile& motions, const std::filesystem::path& file,
                                       const ImportOptions& options);

/// What a file has for each option; see ParsedFile::offer (import/import.h).
ImportOffer motion_offer(const MotionFile& motions, const std::filesystem::path& file, const ImportOptions& options);

/// Whether the first sample is a pose that the motion does not begin with, such as a T-pose: a body far wider than in
/// the next pose and in the usual one.
bool begins_in_other_pose(const mobb::Clip& clip);

/// Adds to facts.warnings, one sentence each with sample numbers: a first sample in the T-pose, jumps, bodies below the
/// floor, sizes and speeds that no person has; of a whole file also that its path stays in place, which a piece that
/// somebody cut out may do. Published motion files hold much that was never a motion. `cut_at`: seconds from the first
/// key to the first sample of a piece; none: the whole file. `skeleton` may be null.
void add_motion_warnings(const mobb::Clip& clip, std::optional<double> cut_at, const Skeleton* skeleton,
                         SourceFacts& facts);

}  // namespace mobbscope
