/// Floors of a building, and heights that keep people apart.
#pragma once

#include <import/tracks/tracks.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope {

/// On which floor the points of a file are.
struct Storeys {
    std::vector<std::string> names{};
    std::vector<int> by_detail{};  ///< of names, by TrackFile::details; -1: nobody says
    std::string remark{};          ///< what was taken; empty: there is nothing to say

    int of(const TrackPoint& point) const {
        return point.detail > 0 && !names.empty() ? by_detail[static_cast<std::size_t>(point.detail) - 1] : -1;
    }
};

/// Those that the file names; else its heights (z) are taken apart where nobody is in between: 2.2 m and more, 1 m of
/// who flies, and every layer of a plan. `metres`: per file unit.
Storeys storeys_of(const TrackFile& file, double metres);

}  // namespace mobbscope
