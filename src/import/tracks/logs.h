/// Tracks as robots and VISSIM log them.
#pragma once

#include <import/tracks/tracks.h>

#include <string>
#include <string_view>

namespace mobbscope {

/// Whether a text begins like a log that parse_log reads.
bool looks_like_log(std::string_view text);

/// A table whose header has places in the words of ROS ("pose.position.x") or EuRoC ("p_RS_R_x [m]"), or of VISSIM and
/// Viswalk ("$VEHICLE:SIMSEC;NO;COORDFRONTX"); or rows of poses, TUM (t x y z qx qy qz qw) and KITTI (twelve numbers of
/// a matrix). Without a column of ids it is one robot's. Throws InputError naming the line.
TrackFile parse_log(std::string_view text, const std::string& file);

}  // namespace mobbscope
