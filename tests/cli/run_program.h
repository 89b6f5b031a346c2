/// Runs mobbscope as a user does.
#pragma once

#include <nlohmann/json.hpp>

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

using nlohmann::json;

struct Result {
    int status = -1;  ///< exit status; 128 + the signal if one ended it
    std::string out;
    std::string err;
    std::int64_t peak_memory = 0;  ///< bytes
};

/// What standard input, output and error are.
struct ProgramFiles {
    std::filesystem::path in = "/dev/null", out = "/dev/null", err = "/dev/null";
};

/// The process of the program, which the caller waits for; `in_child`: what is done there before, such as setting a
/// limit.
pid_t start_program(const std::vector<std::string>& arguments, const ProgramFiles& files = {},
                    const std::function<void()>& in_child = {});

/// Waits for the program to end. `stdout_to`: a file to write results to instead of collecting them; `stdin_from`: one
/// that standard input comes from, which is empty else; `in_child` as above.
Result run_program(const std::vector<std::string>& arguments, const std::filesystem::path& stdout_to = {},
                   const std::filesystem::path& stdin_from = "/dev/null", const std::function<void()>& in_child = {});

/// Some arguments, and more.
std::vector<std::string> with(std::vector<std::string> all, const std::vector<std::string>& more);

/// What the program prints when it is asked for JSON; null, and a failure of the test, if it is not done.
json json_of(const std::vector<std::string>& arguments);

/// True if `err` is one whole line: what a refusal must be.
bool is_one_line(const std::string& err);

/// Fails the test unless the program ended with `status`, printed no results, and one line that holds `why`.
void expect_refused(const Result& run, int status, const std::string& why);

}  // namespace testing
}  // namespace mobbscope
