#include <base/file.h>
#include <import/bvh/bvh.h>
#include <import/nodes/gltf.h>
#include <motion_files/bvh_writer.h>
#include <motion_files/formats.h>
#include <motion_files/glb_writer.h>

#include <algorithm>
#include <iterator>

namespace mobbscope {

namespace {

MotionFile read_bvh_again(std::string_view bytes, const std::filesystem::path& file) {
    return bvh_motion(parse_bvh(bytes, file.string()));
}

constexpr MotionFormat kMotionFormats[] = {{".bvh", to_bvh, read_bvh_again}, {".glb", to_glb, parse_gltf}};

}  // namespace

std::span<const MotionFormat> motion_formats() { return kMotionFormats; }

const MotionFormat* motion_format(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kMotionFormats, lower_extension(file), &MotionFormat::extension);
    return found == std::end(kMotionFormats) ? nullptr : found;
}

}  // namespace mobbscope
