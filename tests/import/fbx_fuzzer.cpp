// libFuzzer: whatever the bytes are, parse_fbx reads them or throws InputError, and what it read can be posed.
#include <base/error.h>
#include <import/fbx/fbx.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

void read_and_pose(std::string_view bytes) {
    const MotionFile file = parse_fbx(bytes, "fuzzed.fbx");
    for (std::size_t animation = 0; animation < file.animations.size(); ++animation) {
        for (std::size_t character = 0; character < file.characters.size(); ++character) {
            const std::shared_ptr<const Motion> motion = file.motion(animation, character);
            std::vector<glm::dvec3> positions(motion->joints().size());
            std::vector<glm::dquat> rotations(positions.size());
            const MotionTimes& times = motion->times();
            for (const double share : {-1.0, 0.0, 0.3, 1.0, 2.0}) {
                motion->pose(times.first + share * (times.last - times.first), positions, rotations);
            }
            motion->rest();
        }
    }
}

}  // namespace
}  // namespace mobbscope

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        mobbscope::read_and_pose({reinterpret_cast<const char*>(data), size});
    } catch (const mobbscope::InputError&) {
    }
    return 0;
}
