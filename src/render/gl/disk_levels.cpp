#include <render/gl/disk_levels.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

constexpr float kTolerance = 0.95f;      // pixels that a tube may be off
constexpr float kHighest = 1.8f;         // pixels of a disk's side: above it the edge that the shader draws is seen
constexpr float kWidestStep = 0.8f;      // pixels of a disk's face that its successor leaves free
constexpr float kColorStep = 0.04f;      // between neighbours; more is a hit, or an end of what is in focus
constexpr std::size_t kLongest = 32;     // disks in a tube, so that the colour follows
constexpr std::size_t kInBlock = 128;    // disks
constexpr float kLeap = 1.6f;            // times the mean step of its block: a longer step is a leap
constexpr float kSmallLeap = 1.25f;      // times what a tube may be off: it goes over leaps that are shorter
constexpr float kMostTimesUsual = 1.5f;  // the widest disk of a block counts as so many times the usual one at most
constexpr float kFinestLevel = 0.008f;   // metres that its tubes may be off
constexpr float kLevelsPerDoubling = 4;  // of the tolerance: tubes are nearly as long as they may be

glm::vec2 ground(glm::vec3 p) { return {p.x, p.y}; }

bool follows(const DiskInstance& next, const DiskInstance& disk) {
    return next.id.agent == disk.id.agent && next.id.index == disk.id.index + 1 &&
           std::abs(next.base.z - disk.top.z) <= 0.01f * disk.height();
}

/// What the successor of a disk leaves free of its face, metres; nothing where a linear clip goes on.
float step_between(const DiskInstance& disk, const DiskInstance& next) {
    return glm::length(ground(next.base - disk.top)) + std::abs(next.radius - disk.top_radius);
}

DiskBlock measured(const std::vector<DiskInstance>& disks, DiskBlock block) {
    glm::vec3 min(std::numeric_limits<float>::max());
    glm::vec3 max(std::numeric_limits<float>::lowest());
    const std::size_t end = block.first + block.count;
    for (std::size_t i = block.first; i < end; ++i) {
        const DiskInstance& disk = disks[i];
        const glm::vec3 around(disk.radius, disk.radius, 0);
        const glm::vec3 around_top(disk.top_radius, disk.top_radius, 0);
        min = glm::min(min, glm::min(disk.base - around, disk.top - around_top));
        max = glm::max(max, glm::max(disk.base + around, disk.top + around_top));
        block.widest = std::max({block.widest, disk.radius, disk.top_radius});
        block.most_lean = std::max(block.most_lean, disk.lean());
        block.usual_radius += disk.radius / static_cast<float>(block.count);
        block.tallest = std::max(block.tallest, disk.height());
    }
    block.usual_radius = std::max(block.usual_radius, block.widest / kMostTimesUsual);
    const std::size_t steps = block.continues ? block.count : block.count - 1;
    float sum = 0;
    for (std::size_t i = block.first; i < block.first + steps; ++i) sum += step_between(disks[i], disks[i + 1]);
    block.longest_step = kLeap * sum / static_cast<float>(std::max<std::size_t>(steps, 1));
    for (std::size_t i = block.first; i < block.first + steps; ++i) {
        const float step = step_between(disks[i], disks[i + 1]);
        if (step <= block.longest_step) block.widest_step = std::max(block.widest_step, step);
    }
    block.middle = 0.5f * (min + max);
    block.reach = 0.5f * glm::length(max - min);
    block.lowest = min.z;
    block.highest = max.z;
    return block;
}

std::vector<DiskBlock> blocks_of(const std::vector<DiskInstance>& disks) {
    std::vector<DiskBlock> out;
    for (std::size_t i = 0; i < disks.size(); ++i) {
        const bool goes_on = i > 0 && follows(disks[i], disks[i - 1]);
        if (!goes_on || out.back().count == kInBlock) {
            if (goes_on) out.back().continues = true;
            out.emplace_back().first = i;
        }
        ++out.back().count;
    }
    for (DiskBlock& block : out) block = measured(disks, block);
    return out;
}

/// The bits of a coordinate with two free bits after each.
std::uint32_t spread(std::uint32_t bits) {
    std::uint32_t out = 0;
    for (unsigned i = 0; i < 10; ++i) out |= (bits >> i & 1u) << (3 * i);
    return out;
}

/// Along a curve that fills space: neighbours in the list are neighbours in the scene, and so are drawn alike.
void sort_by_place(std::vector<DiskBlock>& blocks) {
    glm::vec3 min(std::numeric_limits<float>::max());
    glm::vec3 max(std::numeric_limits<float>::lowest());
    for (const DiskBlock& block : blocks) {
        min = glm::min(min, block.middle);
        max = glm::max(max, block.middle);
    }
    const glm::vec3 extent = glm::max(max - min, glm::vec3(1e-6f));
    std::vector<std::pair<std::uint32_t, DiskBlock>> keyed;
    for (const DiskBlock& block : blocks) {
        const glm::uvec3 cell((block.middle - min) / extent * 1023.0f);
        keyed.emplace_back(spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, block);
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(keyed.begin(), keyed.end(), blocks.begin(), [](const auto& one) { return one.second; });
}

/// Whether the disks between two lie on the tube from one to the other.
bool is_straight(const std::vector<DiskInstance>& disks, std::size_t first, std::size_t last, float most) {
    const DiskInstance& a = disks[first];
    const DiskInstance& b = disks[last];
    for (std::size_t i = first + 1; i < last; ++i) {
        const DiskInstance& disk = disks[i];
        const float t = static_cast<float>(i - first) / static_cast<float>(last - first);
        const float aside = glm::length(ground(disk.base - glm::mix(a.base, b.base, t)));
        if (aside + std::abs(disk.radius - glm::mix(a.radius, b.radius, t)) > most) return false;
    }
    return true;
}

DiskPiece piece_of(const DiskInstance& disk) {
    return {disk.base, disk.radius, disk.top, disk.top_radius, {disk.id.r(), disk.id.g()}};
}

bool differ_in_shape(const DiskInstance& a, const DiskInstance& b) {
    return a.base != b.base || a.radius != b.radius || a.top != b.top || a.top_radius != b.top_radius || a.id != b.id;
}

}  // namespace

PixelScale::PixelScale(const ViewProjection& projection)
    : projection_(&projection),
      scale_(0.5f * static_cast<float>(projection.size.width) *
             (projection.clip_from_world * glm::vec4(projection.right, 0)).x) {}

float PixelScale::at_depth(float depth) const {
    return projection_->perspective ? scale_ / std::max(depth, projection_->near_depth) : scale_;
}

std::vector<DiskPiece> pieces_of(const std::vector<DiskInstance>& disks) {
    std::vector<DiskPiece> out;
    out.reserve(disks.size());
    for (std::size_t i = 0; i < disks.size(); ++i) {
        out.push_back(piece_of(disks[i]));
        if (i == 0 || !follows(disks[i], disks[i - 1])) continue;
        const glm::vec2 step = ground(disks[i].base - disks[i - 1].top);
        out[i - 1].above = glm::vec3(step, disks[i].radius);
        out[i].below = glm::vec3(-step, disks[i - 1].top_radius);
    }
    return out;
}

float DiskLevels::tolerance(int level) {
    return level == 0 ? 0 : kFinestLevel * std::exp2(static_cast<float>(level - 1) / kLevelsPerDoubling);
}

DiskLevels::DiskLevels(std::vector<DiskInstance> disks) : disks_(std::move(disks)), blocks_(blocks_of(disks_)) {
    sort_by_place(blocks_);
    for (const DiskBlock& block : blocks_) most_lean_ = std::max(most_lean_, block.most_lean);
    note_colors();
}

void DiskLevels::note_colors() {
    for (DiskBlock& block : blocks_) {
        block.mixed = false;
        for (std::size_t i = block.first + 1; i < block.first + block.count && !block.mixed; ++i) {
            const glm::vec4 change = glm::abs(disks_[i].color - disks_[i - 1].color);
            block.mixed = std::max({change.r, change.g, change.b, change.a}) >= kColorStep;
        }
    }
}

bool DiskLevels::take_colors(const std::vector<const DiskInstance*>& disks) {
    if (disks.size() != disks_.size()) return false;
    for (std::size_t i = 0; i < disks.size(); ++i) {
        if (differ_in_shape(disks_[i], *disks[i])) return false;
    }
    for (std::size_t i = 0; i < disks.size(); ++i) disks_[i].color = disks[i]->color;
    note_colors();
    return true;
}

const DiskLevels::Level& DiskLevels::level(int index) {
    std::optional<Level>& made = levels_[static_cast<std::size_t>(index)];
    if (made) return *made;
    made.emplace();
    std::vector<DiskPiece> single;
    std::vector<std::uint32_t> of_single;
    // Where all are drawn one by one, each hides much of the next.
    const std::vector<DiskPiece> covered = index == 0 ? pieces_of(disks_) : std::vector<DiskPiece>();
    const float most = tolerance(index);
    for (const DiskBlock& block : blocks_) {
        made->tubes.push_back({made->pieces.size(), 0});
        made->disks.push_back({single.size(), 0});
        const std::size_t end = block.first + block.count;
        // A tube ends at the lower face of a disk: the last of a path is no part of one.
        const std::size_t limit = index == 0 ? block.first : block.continues ? end : end - 1;
        const float longest_step = std::max(block.longest_step, kSmallLeap * most);
        for (std::size_t first = block.first; first < end;) {
            std::size_t last = first;
            bool steps = false;
            while (last < limit && last - first < kLongest &&
                   step_between(disks_[last], disks_[last + 1]) <= longest_step &&
                   is_straight(disks_, first, last + 1, most)) {
                steps = steps || step_between(disks_[last], disks_[last + 1]) > 0;
                ++last;
            }
            // One that leans and has no step above it is a tube by itself, without a line around it.
            const bool smooth = last > first && !steps && disks_[first].lean() > 0;
            if (last < first + 2 && !smooth) {
                single.push_back(index == 0 ? covered[first] : piece_of(disks_[first]));
                of_single.push_back(static_cast<std::uint32_t>(first++));
                continue;
            }
            const DiskInstance& a = disks_[first];
            const DiskInstance& b = disks_[last];
            made->pieces.push_back({a.base, a.radius, b.base, b.radius, run_id(a.id.agent, !steps)});
            made->sources.push_back(static_cast<std::uint32_t>((first + last) / 2));
            first = last;
        }
        made->tubes.back().count = made->pieces.size() - made->tubes.back().first;
        made->disks.back().count = single.size() - made->disks.back().first;
    }
    for (Range& range : made->disks) range.first += made->pieces.size();
    made->pieces.insert(made->pieces.end(), single.begin(), single.end());
    made->sources.insert(made->sources.end(), of_single.begin(), of_single.end());
    return *made;
}

int DiskLevels::choose(const DiskBlock& block, float pixels, const ViewProjection& projection) {
    const float upwards = std::sqrt(std::max(0.0f, 1 - projection.back.z * projection.back.z));
    if (block.mixed || block.tallest * pixels * upwards + block.most_lean * pixels >= kHighest ||
        block.widest_step * pixels * std::abs(projection.back.z) >= kWidestStep) {
        return 0;
    }
    const float levels = std::floor(kLevelsPerDoubling * std::log2(kTolerance / (pixels * kFinestLevel)));
    return levels < 0 ? 0 : 1 + static_cast<int>(std::min(levels, static_cast<float>(kLevels - 2)));
}

}  // namespace mobbscope
