/// A NodeScene as bytes: what the FBX reader's process sends. The receiving end trusts nothing in it.
#pragma once

#include <import/nodes/node_scene.h>

#include <string>
#include <string_view>

namespace mobbscope {

/// What the other process has to say: a scene, or why there is none.
std::string pack(const NodeScene& scene);
std::string pack_error(std::string_view message);

/// The scene in a packet, `file` and `format` left empty. Throws std::runtime_error if the packet says that there is
/// none, with its message; std::length_error if the packet is cut off or holds what no scene can.
NodeScene unpack(std::string_view packet);

}  // namespace mobbscope
