#include <base/error.h>
#include <import/fbx/fbx.h>

namespace mobbscope {

MotionFile parse_fbx(std::string_view /*bytes*/, const std::filesystem::path& file) {
    throw InputError(file.string(), "", "FBX is not read; export the clip as glTF or BVH");
}

}  // namespace mobbscope
