/// Cases drawn by processes of `mobbscope test`: a case that crashes or does not end takes nothing with it. The command
/// and the window's review draw in this way alone, so that their pictures are the same.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// What draws the cases of a folder.
struct CaseDrawer {
    std::filesystem::path program = "/proc/self/exe";
    std::string backend = "auto";  ///< as `mobbscope test --backend` takes it
    int jobs = 0;                  ///< processes at a time; 0: default_jobs()
};

/// As many as there are processors for this program, at most 8.
int default_jobs();

struct CaseOrder {
    CaseFile file;
    RunOptions options{};
};

/// Draws the cases and tells of each as it is there, in any order; of one that ends its process or takes longer than
/// it may (CaseTerms::time_limit) that it failed, and the others go on in a new process. `go_on` is asked several times
/// a second; when it or `tell` throws, the processes are ended and the exception goes on. Returns what went wrong
/// outside of cases, one line each. Throws MachineError if no process can be started.
std::vector<std::string> draw_cases(const CaseDrawer& drawer, const std::filesystem::path& folder,
                                    std::span<const CaseOrder> orders,
                                    const std::function<void(const CaseResult&)>& tell,
                                    const std::function<void()>& go_on);

/// Draws cases as they come, one after the other, in a process that stays; after a case that ended it or took too long
/// in a new one.
class LastingDrawer {
  public:
    LastingDrawer(CaseDrawer drawer, std::filesystem::path folder);
    ~LastingDrawer();
    LastingDrawer(const LastingDrawer&) = delete;
    LastingDrawer& operator=(const LastingDrawer&) = delete;

    /// What goes wrong is the case's failure.
    CaseResult draw(const CaseOrder& order);

  private:
    struct Work;
    std::unique_ptr<Work> work_;
};

/// The command line that draws a case as draw_cases does, ready for a shell.
std::string test_command_line(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::string& name);

}  // namespace mobbscope::picture_tests
