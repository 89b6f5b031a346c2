#include <base/text.h>
#include <motion_files/formats.h>

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

constexpr int kMostIndented = 40;  // levels: of absurd hierarchies the blanks would fill the disk

/// Degrees about z, x and y; the rotations are done in the order y, x, z.
struct EulerAngles {
    double z = 0, x = 0, y = 0;
};

/// The same angle, give or take whole turns, nearest to another.
double unwound(double degrees, double near) { return near + std::remainder(degrees - near, 360.0); }

/// Angles of a rotation, of all that are the same the nearest to `near`: so that curves through frames are smooth.
EulerAngles euler_angles(const glm::dquat& rotation, const EulerAngles& near) {
    const glm::dmat3 m = glm::mat3_cast(rotation);  // m[column][row]
    const double level = std::hypot(m[0][2], m[2][2]);
    const double x = glm::degrees(std::atan2(m[1][2], level));
    if (level < 1e-9) {  // x is +-90 degrees: z and y turn about one axis, and y may be anything
        const double both = glm::degrees(std::atan2(m[0][1], m[0][0]));
        return {unwound(x > 0 ? both - near.y : both + near.y, near.z), unwound(x, near.x), near.y};
    }
    const double z = glm::degrees(std::atan2(-m[1][0], m[1][1]));
    const double y = glm::degrees(std::atan2(-m[0][2], m[2][2]));
    const EulerAngles one{unwound(z, near.z), unwound(x, near.x), unwound(y, near.y)};
    const EulerAngles other{unwound(z + 180, near.z), unwound(180 - x, near.x), unwound(y + 180, near.y)};
    const auto away = [&](const EulerAngles& a) {
        return std::abs(a.z - near.z) + std::abs(a.x - near.x) + std::abs(a.y - near.y);
    };
    return away(other) < away(one) ? other : one;
}

/// Six decimals: a thousandth of a millimetre.
void add_number(std::string& out, double value) {
    if (std::abs(value) < 5e-7) value = 0;  // no "-0.000000"
    std::array<char, 400> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), value, std::chars_format::fixed, 6).ptr;
    out.append(digits.begin(), end);
}

void add_vector(std::string& out, const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) {
        if (i > 0) out += ' ';
        add_number(out, v[i]);
    }
}

/// A name that stands on one line and ends no block.
std::string name_in_bvh(std::string_view name) {
    std::string out(trimmed(name));
    for (char& c : out) {
        if (static_cast<unsigned char>(c) < ' ' || c == '{' || c == '}') c = '_';
    }
    return out.empty() ? "joint" : out;
}

class BvhWriter {
  public:
    explicit BvhWriter(const PlayedMotion& motion)
        : motion_(motion), joints_(motion.joints()), bones_(motion.bones()), has_child_(joints_.size()) {
        for (const Joint& joint : joints_) {
            if (joint.parent >= 0) has_child_[static_cast<std::size_t>(joint.parent)] = true;
        }
    }

    std::string write() {
        add_hierarchy();
        text_ += "MOTION\nFrames: " + std::to_string(motion_.frames()) +
                 "\nFrame Time: " + format_double(motion_.dt()) + '\n';
        std::vector<EulerAngles> before(joints_.size());
        motion_.each_frame([&](std::span<const JointPose> pose) { add_row(pose, before); });
        return std::move(text_);
    }

  private:
    /// A tip whose bone varies needs channels, which an End Site cannot have.
    bool is_end_site(std::size_t j) const { return joints_[j].end_site && !bones_[j].varies; }

    void add_hierarchy() {
        text_ = "HIERARCHY\n";
        std::vector<int> open;
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            while (!open.empty() && open.back() != joints_[j].parent) close(open);
            begin_joint(j, static_cast<int>(open.size()));
            open.push_back(static_cast<int>(j));
        }
        while (!open.empty()) close(open);
    }

    void begin_joint(std::size_t j, int depth) {
        const bool is_tip = is_end_site(j);
        const std::string name =
            joints_[j].end_site ? joints_[static_cast<std::size_t>(joints_[j].parent)].name + "_tip" : joints_[j].name;
        add_line(depth, is_tip ? "End Site" : (depth == 0 ? "ROOT " : "JOINT ") + name_in_bvh(name));
        add_line(depth, "{");
        std::string offset = "OFFSET ";
        add_vector(offset, rest_offset(j));
        add_line(depth + 1, offset);
        if (is_tip) return;
        const std::string_view positions = "Xposition Yposition Zposition ",
                               rotations = "Zrotation Xrotation Yrotation";
        add_line(depth + 1, moves(j) ? "CHANNELS 6 " + std::string(positions) + std::string(rotations)
                                     : "CHANNELS 3 " + std::string(rotations));
        // Readers of other programs look for the end of every bone.
        if (has_child_[j]) return;
        add_line(depth + 1, "End Site");
        add_line(depth + 1, "{");
        add_line(depth + 2, "OFFSET 0 0 0");
        add_line(depth + 1, "}");
    }

    void close(std::vector<int>& open) {
        open.pop_back();
        add_line(static_cast<int>(open.size()), "}");
    }

    void add_line(int depth, const std::string& words) {
        text_.append(static_cast<std::size_t>(std::min(depth, kMostIndented)), '\t');
        text_ += words + '\n';
    }

    bool moves(std::size_t j) const { return j == 0 || bones_[j].varies; }

    /// Where a bone leads in the pose that all angles 0 stand for.
    glm::dvec3 rest_offset(std::size_t j) const {
        return j == 0 ? glm::dvec3(0) : motion_.rest()[above(j)] * bones_[j].offset;
    }

    std::size_t above(std::size_t j) const { return static_cast<std::size_t>(joints_[j].parent); }

    void add_row(std::span<const JointPose> pose, std::vector<EulerAngles>& before) {
        const auto from_rest = [&](std::size_t j) { return pose[j].rotation * glm::conjugate(motion_.rest()[j]); };
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            if (is_end_site(j)) continue;
            if (j > 0) text_ += ' ';
            if (moves(j)) {
                add_vector(text_,
                           j == 0 ? pose[j].position : motion_.rest()[above(j)] * bone_offset(pose[above(j)], pose[j]));
                text_ += ' ';
            }
            const glm::dquat local = j == 0 ? from_rest(j) : glm::conjugate(from_rest(above(j))) * from_rest(j);
            EulerAngles& angles = before[j];
            angles = euler_angles(local, angles);
            add_vector(text_, {angles.z, angles.x, angles.y});
        }
        text_ += '\n';
    }

    const PlayedMotion& motion_;
    const std::vector<Joint>& joints_;
    const std::vector<Bone> bones_;
    std::vector<bool> has_child_;
    std::string text_;
};

}  // namespace

std::string to_bvh(const PlayedMotion& motion) { return BvhWriter(motion).write(); }

}  // namespace mobbscope
