#include <import/skeleton/motion.h>

#include <cmath>

namespace mobbscope {

glm::dvec3 joint_place(const Skeleton& skeleton, const mobb::PlacedClip& clip, int sample, int joint) {
    const glm::dvec3 p(skeleton.at(sample)[static_cast<std::size_t>(joint)]);
    const mobb::Disk disk = clip.disk(sample);
    const glm::dvec2 turned = clip.rotation()({p.x, p.y});
    return {disk.x + turned.x, disk.y + turned.y, p.z};
}

glm::dquat about_up(const mobb::Rotation& rotation) {
    return glm::angleAxis(std::atan2(rotation.s, rotation.c), glm::dvec3(0, 0, 1));
}

}  // namespace mobbscope
