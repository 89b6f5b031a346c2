/// BVH, the motion capture format of Biovision: a hierarchy of joints, then one row of channel values a frame.
#pragma once

#include <base/budget.h>
#include <import/skeleton/motion.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mobbscope {

enum class BvhChannel : std::uint8_t {
    x_position,
    y_position,
    z_position,
    x_rotation,
    y_rotation,
    z_rotation,
    x_scale,  ///< of all below the joint, along its own axes
    y_scale,
    z_scale
};

inline constexpr std::size_t kMaxBvhChannels = 9;  ///< of one joint

/// How the values of a row move one joint. Beside the Joint of the same index.
struct BvhJoint {
    glm::dvec3 offset{0, 0, 0};  ///< from the parent, file units; a position channel replaces its coordinate
    std::array<BvhChannel, kMaxBvhChannels> channels{};  ///< in the order of the file, which is that of rotations
    std::size_t channel_count = 0;
    std::size_t first_value = 0;  ///< of its channels in a row
};

/// A file as it stands. Rotations in degrees, lengths in file units.
struct BvhData {
    std::vector<Joint> joints;  ///< parents before children; the first is the first ROOT
    std::vector<BvhJoint> moves;
    std::size_t row_length = 0;  ///< values in a row, > 0
    double frame_time = 0;       ///< seconds, > 0
    std::string time_doubt;      ///< why that is hardly meant, and what to do; else empty
    std::vector<double> values;  ///< row after row; at least one row
    std::vector<std::string> warnings;
    Spent spent;  ///< of the budget

    std::size_t frames() const { return values.size() / row_length; }
};

/// Reads the text of a file; `file` stands for it in messages. Takes any channel order, position channels on any
/// joint, several roots, names with blanks, any kind of line end, keywords in any case, comments behind #, decimal
/// commas where there are no points, rows that go over several lines. Takes the rows that are there: `warnings` tell if
/// Frames says another number. Throws InputError naming the line, or if it takes more than the budget.
BvhData parse_bvh(std::string_view text, const std::string& file);

/// The one animation of a file. Every ROOT is a character; those with a channel move. Which axis is up is guessed.
MotionFile bvh_motion(BvhData data);

}  // namespace mobbscope
