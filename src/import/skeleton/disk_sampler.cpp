#include <import/clip/sampling.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/root_joint.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

DiskSampler::DiskSampler(const GroundedMotion& motion, int root)
    : motion_(motion), root_(static_cast<std::size_t>(root)), inside_(subtree(motion.joints(), root)) {}

void DiskSampler::sample(double t, PosedDisk& out) {
    const MotionTimes& times = motion_.times();
    if (!times.frames_only) return take(t, out);
    const double frame = std::clamp((t - times.first) / *times.dt, 0.0, times.frames - 1.0);
    const double before = std::floor(frame + kFrameTolerance);
    const double share = frame - before;
    const PosedDisk& a = stored(static_cast<std::size_t>(before));
    if (share <= kFrameTolerance) {
        out = a;
        return;
    }
    const PosedDisk& b = stored(static_cast<std::size_t>(before) + 1);
    out.disk = mix(a.disk, b.disk, share);
    out.positions.resize(a.positions.size());
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        out.positions[i] = a.positions[i] + share * (b.positions[i] - a.positions[i]);
    }
}

void DiskSampler::take(double t, PosedDisk& out) const {
    motion_.pose(t, out.positions);
    const glm::dvec3 centre = out.positions[root_];
    double radius = 0;
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        if (!inside_[i]) continue;
        const glm::dvec3 arm = out.positions[i] - centre;
        radius = std::max(radius, std::hypot(arm.x, arm.y));
    }
    out.disk = {centre.x, centre.y, radius};
}

const PosedDisk& DiskSampler::stored(std::size_t frame) {
    Slot& slot = slots_[frame % slots_.size()];
    if (slot.frame != frame) {
        take(motion_.times().first + static_cast<double>(frame) * *motion_.times().dt, slot.posed);
        slot.frame = frame;
    }
    return slot.posed;
}

}  // namespace mobbscope
