#include <render/nearest_moment.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

mobb::Box rectangle_at(mobb::Box box, double wt) {
    if (box.half.z > 0) {
        const glm::dvec2 moved = box.drift * ((wt - box.center.z) / box.half.z);
        box.center += glm::dvec3(moved.x, moved.y, 0);
    }
    box.center.z = wt;
    box.half.z = 0;
    box.drift = {0, 0};
    return box;
}

}  // namespace

BoxPair at_nearest_moment(const BoxPair& boxes, glm::dvec3 axis) {
    const mobb::Box& a = boxes.a;
    const mobb::Box& b = boxes.b;
    const double begin = std::max(a.center.z - a.half.z, b.center.z - b.half.z);
    const double end = std::max(begin, std::min(a.center.z + a.half.z, b.center.z + b.half.z));
    const auto at = [&](double wt) { return BoxPair{rectangle_at(a, wt), rectangle_at(b, wt)}; };
    const auto apart = [&](double wt) {
        const BoxPair pair = at(wt);
        return glm::dot(pair.b.center - pair.a.center, axis);
    };
    const double first = apart(begin);
    const double last = apart(end);
    if ((first < 0) != (last < 0)) return at(begin + (end - begin) * (first / (first - last)));
    return at(std::abs(first) <= std::abs(last) ? begin : end);
}

}  // namespace mobbscope
