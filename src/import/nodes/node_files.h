/// The readers of files of nodes: glTF and FBX.
#pragma once

#include <import/skeleton/motion.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// glTF 2.0, as text or GLB, through tinygltf: nodes, skin 0 and all animations. Meshes, materials and pictures are not
/// looked at: whether they are there does not matter. Buffers may lie in files beside this one or in folders below.
/// Throws InputError.
MotionFile read_gltf(const std::filesystem::path& file);

/// The same for the bytes of a file; `file` is where it would lie.
MotionFile parse_gltf(std::string_view bytes, const std::filesystem::path& file);

/// FBX through Assimp, which runs in a process of its own: whatever a file does to it, this program lives on. Throws
/// InputError if the file cannot be read (a crash or a hang of the reader included), MachineError if the reader cannot
/// be started.
MotionFile read_fbx(const std::filesystem::path& file);

enum class ChildEnd { exited, signalled, timed_out, too_much_output };

struct ChildResult {
    ChildEnd end = ChildEnd::exited;
    int code = 0;        ///< exit status, or the signal's number
    std::string output;  ///< what it wrote to standard output
};

/// Runs `program` with `arguments` until it ends; its standard input is empty, its standard error discarded. After
/// `seconds`, or beyond `most_output` bytes, it is killed. Throws std::system_error if it cannot be started. Safe from
/// any thread.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      std::size_t most_output);

}  // namespace mobbscope
