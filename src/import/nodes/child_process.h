/// A program run for its output.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {

enum class ChildEnd { exited, signalled, timed_out, too_much_output };

struct ChildResult {
    ChildEnd end = ChildEnd::exited;
    int code = 0;        ///< exit status, or the signal's number
    std::string output;  ///< what it wrote to standard output
};

/// Runs `program` with `arguments` until it ends; its standard input is empty, its standard error discarded. After
/// `seconds`, or beyond `most_output` bytes, it is killed. Throws std::system_error if it cannot be started. Safe from
/// any thread.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      std::size_t most_output);

}  // namespace mobbscope
