/// FBX files, binary and text, of version 7.1 and later: their nodes and animation stacks, no meshes.
#pragma once

#include <import/skeleton/motion.h>

#include <filesystem>
#include <string_view>

namespace mobbscope {

/// The whole transform chain is evaluated at each sample: curves with their tangents, layers, pivots and offsets,
/// rotation orders, inherited scale. Axes and unit are those of GlobalSettings. An animation is a stack: all of its
/// keys, and all of the time that the file has it play (LocalStart, LocalStop). Several skeletons are several
/// characters. `file` is named in messages. Throws InputError.
MotionFile parse_fbx(std::string_view bytes, const std::filesystem::path& file);

/// Whether bytes are FBX of any version, by their beginning: the name of binary files, or the record that every text
/// file begins with, behind comments.
bool looks_like_fbx(std::string_view head);

}  // namespace mobbscope
