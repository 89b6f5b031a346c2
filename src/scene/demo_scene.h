/// The scene that comes with the program: two walkers whose paths cross, but not in time (the paper's Fig. 1).
#pragma once

#include <scene/scene.h>

namespace mobbscope {

/// Where it is: beside the installed program, else where it was built. Throws MachineError if it is in neither place.
std::filesystem::path demo_scene_file();

/// Throws MachineError if the program was installed without its scenes.
Scene demo_scene();

}  // namespace mobbscope
