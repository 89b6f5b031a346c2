/// Cases drawn by `mobbscope test` in a process of its own: its pictures are those of the command line, and a case that
/// crashes takes nothing with it.
#pragma once

#include <cases/case_file.h>
#include <cases/result_line.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// What draws the cases of a folder.
struct CaseDrawer {
    std::filesystem::path program = "/proc/self/exe";
    std::string backend = "auto";  ///< as `mobbscope test --backend` takes it
};

/// Draws the cases, in this order, and tells of each as it is there; of one that ends the process that it failed.
/// `go_on` is asked several times a second; when it throws, the process is ended and the exception goes on. Throws
/// MachineError if no process can be started.
void draw_cases(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::vector<CaseFile>& cases,
                const std::function<void(const NamedResult&)>& tell, const std::function<void()>& go_on);

/// The command line that draws a case as draw_cases does, ready for a shell.
std::string test_command_line(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::string& name);

}  // namespace mobbscope::picture_tests
