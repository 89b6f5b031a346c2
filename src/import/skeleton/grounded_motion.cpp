#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/skeleton/grounded_motion.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kSurveyRate = 30;
constexpr double kMaxSurvey = 10'000;

}  // namespace

void GroundedMotion::pose(double seconds, std::vector<glm::dvec3>& positions) const {
    positions.resize(joints().size());
    motion_.pose(seconds, positions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::dvec3& p = positions[i];
        if (!std::isfinite(p.x + p.y + p.z)) {
            throw std::invalid_argument("at " + short_double(seconds) + " s the joint " + in_quotes(joints()[i].name) +
                                        " is at no finite place; the file is damaged");
        }
        // 0 - z, as -z makes a negative zero of a path along an axis.
        if (up_ == UpAxis::y) p = {p.x, 0 - p.z, p.y};
    }
}

std::vector<double> GroundedMotion::survey() const {
    const MotionTimes& t = times();
    double step = t.frames_only ? *t.dt : 1 / kSurveyRate;
    double count = t.frames_only ? t.frames : sample_count(t.first, t.last, step);
    if (!t.frames_only && count > kMaxSurvey) {
        count = kMaxSurvey;
        step = (t.last - t.first) / (kMaxSurvey - 1);
    }
    std::vector<double> out(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = t.first + static_cast<double>(i) * step;
    return out;
}

}  // namespace mobbscope
