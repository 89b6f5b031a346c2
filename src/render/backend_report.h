/// What this machine offers to draw with, without a display.
#pragma once

#include <string>
#include <vector>

namespace mobbscope {

struct BackendReport {
    std::string name;      ///< "osmesa" or "egl"
    bool works = false;    ///< can make pictures
    std::string version;   ///< OpenGL's, if it works
    std::string renderer;  ///< what OpenGL calls itself, if it works
    std::string why_not;   ///< else: the libraries that were tried, and what was wrong
};

/// In the order in which `auto` tries them.
std::vector<BackendReport> report_backends();

}  // namespace mobbscope
