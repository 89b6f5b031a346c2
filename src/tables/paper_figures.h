/// The figures of the paper's Tables 1 and 2 (Section 5), to be set beside ours.
#pragma once

#include <optional>
#include <string_view>

namespace mobbscope {

struct PaperRow {
    double time_us = 0;  ///< Table 1: 3.0 GHz Athlon; Table 2: 3 GHz Pentium 4
    double obb2d = 0;
    double obb3d = 0;
    double samples = 0;
};

/// The row of a method ("mobb_1level", ...) in "table1" or "table2"; none for what the paper did not measure.
std::optional<PaperRow> paper_row(std::string_view table, std::string_view method);

}  // namespace mobbscope
