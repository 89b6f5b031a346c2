#include <base/error.h>
#include <import/skeleton/motion.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace mobbscope {

void check_character_count(std::size_t count, const std::string& file) {
    if (count <= kMostCharacters) return;
    throw InputError(file, "",
                     "holds " + std::to_string(count) + " characters, but at most " + std::to_string(kMostCharacters) +
                         " are read; export fewer at a time");
}

std::vector<std::string> distinct_names(std::vector<std::string> names) {
    std::set<std::string> taken(names.begin(), names.end());
    std::map<std::string, int> count;
    for (std::string& name : names) {
        int& of_name = count[name];
        if (++of_name == 1 || name.empty()) continue;
        std::string numbered;
        do numbered = name + " #" + std::to_string(of_name);
        while (!taken.insert(numbered).second && ++of_name);
        name = std::move(numbered);
    }
    return names;
}

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
