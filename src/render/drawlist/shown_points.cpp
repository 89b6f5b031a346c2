#include <render/drawlist/pen.h>
#include <render/drawlist/shown_points.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kInPointBlock = 64;
constexpr float kBoundRounding = 1e-5f;  // of a block's bounds: what they rule out is ruled out for good

}  // namespace

const std::array<glm::vec3, 8>& rim_directions() {
    static const std::array<glm::vec3, 8> directions = [] {
        std::array<glm::vec3, 8> out;
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = glm::vec3(glm::dvec3(on_circle(static_cast<double>(i), 8), 0));
        }
        return out;
    }();
    return directions;
}

ShownPoints::ShownPoints(SharedValues<DiskInstance> disks) : disks_(std::move(disks)) {
    std::vector<Block> blocks;
    blocks.reserve(disks_.size() / kInPointBlock + 1);
    for (std::size_t i = 0; i < disks_.size(); ++i) {
        const DiskInstance& disk = disks_[i];
        const glm::vec3 around(disk.radius, disk.radius, 0);
        const glm::vec3 around_top(disk.top_radius, disk.top_radius, 0);
        const glm::vec3 low = glm::min(disk.base - around, disk.top - around_top);
        const glm::vec3 high = glm::max(disk.base + around, disk.top + around_top);
        if (i % kInPointBlock == 0) blocks.push_back({low, high});
        blocks.back() = {glm::min(blocks.back().min, low), glm::max(blocks.back().max, high)};
    }
    blocks_ = std::make_shared<const std::vector<Block>>(std::move(blocks));
}

ShownPoints ShownPoints::of_like(SharedValues<DiskInstance> disks) const {
    ShownPoints out = *this;
    out.disks_ = std::move(disks);
    return out;
}

void ShownPoints::add(const ShownPoints& points) { others_.push_back(points); }

float ShownPoints::most(glm::vec3 along, glm::vec3 also, float factor) const {
    float most = std::numeric_limits<float>::lowest();
    for (const ShownPoints& other : others_) most = std::max(most, other.most(along, also, factor));
    const auto see = [&](glm::vec3 p) { most = std::max(most, glm::dot(p, along) + glm::dot(p, also) * factor); };
    for (const glm::vec3& point : points_) see(point);
    if (disks_.empty()) return most;
    const glm::vec3 way = along + also * factor;
    const auto bound = [&](const Block& block) {
        const glm::vec3 corner(way.x > 0 ? block.max.x : block.min.x, way.y > 0 ? block.max.y : block.min.y,
                               way.z > 0 ? block.max.z : block.min.z);
        const glm::vec3 terms = glm::abs(corner * way);
        return glm::dot(corner, way) + kBoundRounding * (terms.x + terms.y + terms.z);
    };
    const auto see_block = [&](std::size_t block) {
        const std::size_t end = std::min(disks_.size(), (block + 1) * kInPointBlock);
        for (std::size_t i = block * kInPointBlock; i < end; ++i) {
            const DiskInstance& disk = disks_[i];
            for (const glm::vec3& direction : rim_directions()) {
                see(disk.base + disk.radius * direction);
                see(disk.top + disk.top_radius * direction);
            }
        }
    };
    // The block that may reach farthest first: then most others cannot.
    const auto farthest = std::max_element(blocks_->begin(), blocks_->end(),
                                           [&](const Block& a, const Block& b) { return bound(a) < bound(b); });
    see_block(static_cast<std::size_t>(farthest - blocks_->begin()));
    for (std::size_t block = 0; block < blocks_->size(); ++block) {
        if (bound((*blocks_)[block]) > most) see_block(block);
    }
    return most;
}

}  // namespace mobbscope
