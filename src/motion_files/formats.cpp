#include <base/file.h>
#include <import/bvh/bvh.h>
#include <import/clip/imported_clip.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion_clips.h>
#include <motion_files/formats.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <vector>

namespace mobbscope {

namespace {

MotionFile read_bvh_again(std::string_view bytes, const std::filesystem::path& file) {
    return bvh_motion(parse_bvh(bytes, file.string()));
}

constexpr MotionFormat kMotionFormats[] = {{".bvh", to_bvh, read_bvh_again}, {".glb", to_glb, parse_gltf}};

DiskDifference difference(const mobb::Clip& read, const std::vector<mobb::Disk>& played) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (read.samples().size() != played.size()) return {infinite, infinite};
    DiskDifference out;
    for (std::size_t i = 0; i < played.size(); ++i) {
        const mobb::Disk& disk = read.samples()[i];
        out.place = std::max(out.place, std::hypot(disk.x - played[i].x, disk.y - played[i].y));
        out.radius = std::max(out.radius, std::abs(disk.r - played[i].r));
    }
    return out;
}

}  // namespace

std::span<const MotionFormat> motion_formats() { return kMotionFormats; }

const MotionFormat* motion_format(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kMotionFormats, lower_extension(file), &MotionFormat::extension);
    return found == std::end(kMotionFormats) ? nullptr : found;
}

DiskDifference read_back(std::string_view bytes, const MotionFormat& format, const PlayedMotion& motion) {
    const std::string file = motion.name() + std::string(format.extension);
    const MotionFile motions = format.read(bytes, file);
    ImportOptions options;
    options.fps = 1 / motion.dt();
    const std::vector<mobb::Disk> played = motion.disks();
    const auto compare = [&] { return difference(*motion_clips(motions, file, options).front().clip, played); };
    const DiskDifference guessed = compare();
    if (guessed.place <= kSameDisk) return guessed;
    const std::shared_ptr<const Motion> written = motions.motion(0, 0);
    options.unit = "m";
    options.root = written->joints()[static_cast<std::size_t>(written->topmost())].name;
    DiskDifference told = compare();
    if (told.place > kSameDisk) return guessed;
    told.root = options.root;
    return told;
}

}  // namespace mobbscope
