#include <crowd/graph/foot_slide.h>
#include <import/skeleton/disk_sampler.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace mobbscope {

namespace {

constexpr std::size_t kCarryingShare = 10;  // one in so many frames
constexpr std::size_t kLowestShare = 20;
constexpr double kRoundedFrame = 1e-6;  // of a frame

glm::dvec3 in_clip(const mobb::Clip& clip, const Skeleton& skeleton, int frame, int joint) {
    const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(frame)];
    return glm::dvec3(disk.x, disk.y, 0) + glm::dvec3(skeleton.at(frame)[static_cast<std::size_t>(joint)]);
}

std::vector<int> carrying(const Skeleton& skeleton, int first, int end) {
    const std::vector<int> body = body_of(skeleton);
    std::vector<std::size_t> carries(skeleton.joints.size(), 0);
    for (int frame = first; frame < end; ++frame) {
        const auto pose = skeleton.at(frame);
        double lowest = std::numeric_limits<double>::infinity();
        for (const int joint : body) lowest = std::min<double>(lowest, pose[static_cast<std::size_t>(joint)].z);
        for (const int joint : body) {
            const auto at = static_cast<std::size_t>(joint);
            if (pose[at].z <= lowest + kCarries) ++carries[at];
        }
    }
    std::vector<int> out;
    for (const int joint : body) {
        const std::size_t frames = carries[static_cast<std::size_t>(joint)];
        if (frames > 0 && frames * kCarryingShare >= static_cast<std::size_t>(end - first)) out.push_back(joint);
    }
    return out;
}

double usual_lowest(const Skeleton& skeleton, int first, int end, int joint) {
    std::vector<double> heights;
    for (int frame = first; frame < end; ++frame)
        heights.push_back(skeleton.at(frame)[static_cast<std::size_t>(joint)].z);
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / kLowestShare);
    std::nth_element(heights.begin(), at, heights.end());
    return *at;
}

}  // namespace

std::vector<int> body_of(const Skeleton& skeleton) {
    const std::vector<bool> below = subtree(skeleton.joints, skeleton.root);
    std::vector<int> out;
    for (std::size_t i = 0; i < below.size(); ++i) {
        if (below[i]) out.push_back(static_cast<int>(i));
    }
    return out;
}

bool lasts(int frames, double dt) { return (frames - 1 + kRoundedFrame) * dt >= kLeastContact; }

std::vector<Contact> standing(const mobb::Clip& clip, const Skeleton& skeleton, int first, int end) {
    std::vector<Contact> out;
    for (const int joint : carrying(skeleton, first, end)) {
        const double low = usual_lowest(skeleton, first, end, joint) + kLow;
        bool stands = false;  // in the frame before
        for (int frame = first; frame < end; ++frame) {
            const glm::dvec3 place = in_clip(clip, skeleton, frame, joint);
            const bool is_low = place.z <= low;
            const bool goes_on =
                stands && is_low && glm::distance(place, in_clip(clip, skeleton, frame - 1, joint)) < kSlow * clip.dt();
            if (goes_on) {
                ++out.back().count;
            } else if (is_low) {
                out.push_back({joint, frame - first, 1});
            }
            stands = is_low;
        }
    }
    return out;
}

std::vector<glm::dvec2> places_of(const Contact& contact, const mobb::Clip& clip, const Skeleton& skeleton) {
    std::vector<glm::dvec2> out;
    for (int frame = contact.first; frame < contact.first + contact.count; ++frame)
        out.emplace_back(in_clip(clip, skeleton, frame, contact.joint));
    return out;
}

double slide_of(std::span<const glm::dvec2> places) {
    double slide = 0;
    for (const glm::dvec2& place : places) slide = std::max(slide, glm::distance(place, places.front()));
    return slide;
}

}  // namespace mobbscope
