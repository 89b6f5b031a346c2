#include <import/bvh/bvh_motion.h>
#include <import/bvh/up_axis.h>

#include <glm/ext/scalar_constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

int axis_of(BvhChannel channel) { return static_cast<int>(channel) % 3; }
bool is_position(BvhChannel channel) { return channel <= BvhChannel::z_position; }
bool is_scale(BvhChannel channel) { return channel >= BvhChannel::x_scale; }

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

/// A motion of each ROOT.
std::vector<std::shared_ptr<const BvhMotion>> characters_of(const std::shared_ptr<const BvhData>& data) {
    std::vector<std::shared_ptr<const BvhMotion>> out;
    const std::vector<Joint>& joints = data->joints;
    for (std::size_t first = 0; first < joints.size();) {
        std::size_t end = first + 1;
        while (end < joints.size() && joints[end].parent >= 0) ++end;
        out.push_back(std::make_shared<BvhMotion>(data, first, end));
        first = end;
    }
    return out;
}

}  // namespace

BvhMotion::BvhMotion(std::shared_ptr<const BvhData> data, std::size_t first, std::size_t end)
    : data_(std::move(data)), first_(first) {
    for (std::size_t i = first; i < end; ++i) {
        Joint joint = data_->joints[i];
        if (joint.parent >= 0) joint.parent -= static_cast<int>(first);
        joints_.push_back(std::move(joint));
    }
    times_.frames = static_cast<int>(data_->frames());
    times_.dt = data_->frame_time;
    times_.doubt = data_->time_doubt;
    times_.last = static_cast<double>(times_.frames - 1) * data_->frame_time;
    times_.frames_only = true;
}

void BvhMotion::pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations) const {
    const double nearest = std::clamp(std::round(seconds / data_->frame_time), 0.0, times_.frames - 1.0);
    const double* row = data_->values.data() + static_cast<std::size_t>(nearest) * data_->row_length;
    const std::span<const BvhJoint> moves = this->moves();
    std::vector<glm::dmat3> frames(positions.size());
    std::vector<glm::dvec3> scales(positions.size());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const BvhJoint& move = moves[i];
        const bool below = joints_[i].parent >= 0;
        const auto parent = static_cast<std::size_t>(std::max(joints_[i].parent, 0));
        glm::dmat3& frame = frames[i];
        frame = below ? frames[parent] : glm::dmat3(1);
        scales[i] = below ? scales[parent] : glm::dvec3(1);
        glm::dvec3 offset = move.offset;
        const double* value = row + move.first_value;
        for (std::size_t c = 0; c < move.channel_count; ++c, ++value) {
            const BvhChannel channel = move.channels[c];
            if (is_position(channel)) {
                offset[axis_of(channel)] = *value;
            } else if (is_scale(channel)) {
                scales[i][axis_of(channel)] *= *value;
            } else {
                rotate(frame, axis_of(channel), *value);
            }
        }
        positions[i] = below ? positions[parent] + frames[parent] * (scales[parent] * offset) : offset;
        if (!rotations.empty()) rotations[i] = glm::quat_cast(frame);
    }
}

bool BvhMotion::has_channels() const {
    return std::ranges::any_of(moves(), [](const BvhJoint& move) { return move.channel_count > 0; });
}

MotionFile bvh_motion(BvhData data) {
    const auto characters = characters_of(std::make_shared<const BvhData>(std::move(data)));
    MotionFile out;
    out.format = "bvh";
    GuessedUp up = guess_up(characters);
    out.ground = up.ground;
    out.up_why = std::move(up.why);
    out.up_doubt = std::move(up.doubt);
    out.animations = {"#0"};

    std::vector<std::string> names;
    MovedCharacters moved;
    std::vector<int> character_of;
    std::vector<std::size_t> first_joint;
    for (std::size_t i = 0; i < characters.size(); ++i) {
        if (characters[i]->has_channels()) moved.characters.push_back(i);
        first_joint.push_back(names.size());
        for (const Joint& joint : characters[i]->joints()) names.push_back(joint.end_site ? "" : joint.name);
        character_of.resize(names.size(), static_cast<int>(i));
    }
    names = distinct_names(std::move(names));
    for (std::size_t i = 0; i < names.size(); ++i) out.joints.push_back({std::move(names[i]), character_of[i]});
    for (const std::size_t first : first_joint) out.characters.push_back(out.joints[first].name);

    out.moved = [moved](std::size_t) { return moved; };
    out.motion = [characters](std::size_t, std::size_t character) { return characters[character]; };
    out.rooted = [characters, character_of, first_joint](std::size_t, std::size_t joint) {
        const auto character = static_cast<std::size_t>(character_of[joint]);
        return RootedMotion{characters[character], static_cast<int>(joint - first_joint[character])};
    };
    return out;
}

}  // namespace mobbscope
