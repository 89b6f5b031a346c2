#include <render/drawlist/cut.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mobbscope {

namespace {

glm::vec3 at_height(glm::vec3 a, glm::vec3 b, float height) {
    glm::vec3 out = glm::mix(a, b, (height - a.z) / (b.z - a.z));
    out.z = height;
    return out;
}

}  // namespace

glm::vec2 heights_of(const BoxInstance& box) {
    const float half = std::abs(box.extents[0].z) + std::abs(box.extents[1].z) + std::abs(box.extents[2].z);
    return {box.center.z - half, box.center.z + half};
}

bool is_seen(const std::optional<DrawnSlab>& slab, const BoxInstance& box) {
    const glm::vec2 heights = heights_of(box);
    return !slab || heights.x == heights.y || slab->shows(heights.x, heights.y);
}

bool is_cut(const DrawnSlab& slab, const BoxInstance& box) {
    return slab.cuts_boxes || box.state == BoxState::annotation;
}

bool cut_line(const DrawnSlab& slab, glm::vec3& from, glm::vec3& to) {
    if (std::max(from.z, to.z) < slab.low || std::min(from.z, to.z) > slab.high) return false;
    const glm::vec3 a = from, b = to;
    if (a.z < slab.low) from = at_height(a, b, slab.low);
    if (a.z > slab.high) from = at_height(a, b, slab.high);
    if (b.z < slab.low) to = at_height(a, b, slab.low);
    if (b.z > slab.high) to = at_height(a, b, slab.high);
    return true;
}

void cut_lines(DrawList& list, std::size_t first) {
    if (!list.slab) return;
    const auto from = list.lines.begin() + static_cast<std::ptrdiff_t>(first);
    const auto gone = std::remove_if(from, list.lines.end(),
                                     [&](LineInstance& line) { return !cut_line(*list.slab, line.from, line.to); });
    list.lines.erase(gone, list.lines.end());
}

std::vector<glm::vec3> level_section(const BoxInstance& box, float height) {
    const std::array<glm::vec3, 8> corners = box_corners(box);
    std::vector<glm::vec3> out;
    glm::vec3 middle(0);
    for (const auto& [a, b] : kBoxEdges) {
        if ((corners[a].z > height) == (corners[b].z > height)) continue;
        out.push_back(at_height(corners[a], corners[b], height));
        middle += out.back();
    }
    if (out.size() < 3) return {};
    middle /= static_cast<float>(out.size());
    std::ranges::sort(out, {}, [&](const glm::vec3& p) { return std::atan2(p.y - middle.y, p.x - middle.x); });
    return out;
}

}  // namespace mobbscope
