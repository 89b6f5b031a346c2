// The one place that knows which reader takes which motion file.
#include <base/error.h>
#include <base/file.h>
#include <import/bvh/bvh.h>
#include <import/nodes/fbx.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion.h>

#include <array>
#include <utility>

namespace mobbscope {

namespace {

std::unique_ptr<MotionFile> read_bvh(const std::filesystem::path& file) {
    return bvh_motion(parse_bvh(read_file(file), file.string()));
}

using MotionReader = std::unique_ptr<MotionFile> (*)(const std::filesystem::path&);
constexpr std::array<std::pair<std::string_view, MotionReader>, 4> kReaders{
    {{".bvh", read_bvh}, {".gltf", read_gltf}, {".glb", read_gltf}, {".fbx", read_fbx}}};

MotionReader reader_for(std::string_view extension) {
    for (const auto& [name, reader] : kReaders) {
        if (name == extension) return reader;
    }
    return nullptr;
}

}  // namespace

bool is_motion_extension(const std::string& extension) { return reader_for(extension) != nullptr; }

std::unique_ptr<MotionFile> read_motion(const std::filesystem::path& file) {
    const MotionReader reader = reader_for(lower_extension(file));
    if (!reader) throw InputError(file.string(), "", "is no motion file; give .bvh, .gltf, .glb or .fbx");
    return reader(file);
}

}  // namespace mobbscope
