// Forward kinematics of BVH: from the values of a row to where the joints are.
#include <import/bvh/bvh.h>

#include <glm/ext/scalar_constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

int axis_of(BvhChannel channel) { return static_cast<int>(channel) % 3; }
bool is_position(BvhChannel channel) { return channel <= BvhChannel::z_position; }

/// `frame` times the rotation about one of its own axes: two of its columns turn, the third stays.
void rotate(glm::dmat3& frame, int axis, double degrees) {
    const double angle = glm::radians(degrees);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    glm::dvec3& u = frame[(axis + 1) % 3];
    glm::dvec3& v = frame[(axis + 2) % 3];
    const glm::dvec3 turned = c * u + s * v;
    v = c * v - s * u;
    u = turned;
}

class BvhMotion : public Motion {
  public:
    explicit BvhMotion(BvhData data) : data_(std::move(data)) {
        times_.frames = static_cast<int>(data_.frames());
        times_.dt = data_.frame_time;
        times_.last = static_cast<double>(times_.frames - 1) * data_.frame_time;
        times_.frames_only = true;
    }

    std::span<const Joint> joints() const override { return data_.joints; }
    int topmost() const override { return 0; }
    const MotionTimes& times() const override { return times_; }

    void pose(double seconds, std::span<glm::dvec3> positions) const override {
        const double nearest = std::clamp(std::round(seconds / data_.frame_time), 0.0, times_.frames - 1.0);
        const double* row = data_.values.data() + static_cast<std::size_t>(nearest) * data_.row_length;
        std::vector<glm::dmat3> frames(data_.joints.size());
        for (std::size_t i = 0; i < data_.joints.size(); ++i) {
            const BvhJoint& move = data_.moves[i];
            const bool below = data_.joints[i].parent >= 0;
            const auto parent = static_cast<std::size_t>(std::max(data_.joints[i].parent, 0));
            glm::dmat3& frame = frames[i];
            frame = below ? frames[parent] : glm::dmat3(1);
            glm::dvec3 offset = move.offset;
            const double* value = row + move.first_value;
            for (std::size_t c = 0; c < move.channel_count; ++c, ++value) {
                const BvhChannel channel = move.channels[c];
                if (is_position(channel)) {
                    offset[axis_of(channel)] = *value;
                } else {
                    rotate(frame, axis_of(channel), *value);
                }
            }
            positions[i] = below ? positions[parent] + frames[parent] * offset : offset;
        }
    }

  private:
    BvhData data_;
    MotionTimes times_;
};

class BvhFile : public MotionFile {
  public:
    explicit BvhFile(BvhData data) : motion_(std::make_shared<BvhMotion>(std::move(data))) {}

    std::string format() const override { return "bvh"; }
    std::optional<double> unit() const override { return std::nullopt; }
    std::vector<std::string> animations() const override { return {"#0"}; }
    std::shared_ptr<const Motion> motion(std::size_t) const override { return motion_; }

  private:
    std::shared_ptr<const Motion> motion_;
};

}  // namespace

std::unique_ptr<MotionFile> bvh_motion(BvhData data) { return std::make_unique<BvhFile>(std::move(data)); }

}  // namespace mobbscope
