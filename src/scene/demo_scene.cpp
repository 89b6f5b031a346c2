#include <import/error.h>
#include <scene/demo_scene.h>

#include <system_error>

namespace mobbscope {

std::filesystem::path demo_scene_file() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path name = "scenes/crossing.json";
    std::filesystem::path installed = (program.parent_path() / MOBBSCOPE_ASSETS_FROM_BIN / name).lexically_normal();
    if (!error && std::filesystem::exists(installed, error)) return installed;
    std::filesystem::path as_built = std::filesystem::path(MOBBSCOPE_ASSETS_AS_BUILT) / name;
    if (std::filesystem::exists(as_built, error)) return as_built;
    throw MachineError("the demo scene is neither at " + installed.string() + " nor at " + as_built.string() +
                       "; install the program again");
}

Scene demo_scene() { return load_scene(demo_scene_file()); }

}  // namespace mobbscope
