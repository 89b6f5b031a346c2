/// What the program says: results to standard output, everything else to standard error.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mobbscope::cli {

/// One line on standard error, "mobbscope: ...", whatever characters a file's name or text brings along, and however
/// many.
void complain(std::string_view message);
/// The same for how far long work is.
void say(std::string_view message);
/// The same for something that does not stop the program.
void warn(std::string_view message);

/// Hands everything written to std::cout to the system. Throws MachineError if it did not take it all, and
/// ReaderGone if that is because nobody reads it any more.
void flush_results();

enum ExitStatus : int {
    kDone = 0,
    kFailed = 1,     ///< the comparison or check asked for failed
    kBadInput = 2,   ///< bad usage or bad input
    kNoMachine = 3,  ///< the machine lacks something: no GL, cannot write
    kNotJudged = 4,  ///< tests of which some could not be judged, and none failed
};

/// Bad usage: the program says what is wrong, names --help, and exits with 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws InputError with this message unless the file has the extension; one that is not named passes.
void check_extension(const std::filesystem::path& file, std::string_view extension, const std::string& message);

/// Likewise unless it is called as a picture is.
void check_picture_output(const std::filesystem::path& file);

/// Throws InputError if a file is one that was read, and MachineError, saying why, if it cannot be written there; a
/// pipe or a device may be. Writes nothing. What writes a file asks this when all is read.
void check_output(const std::filesystem::path& output);

class Command;

void add_bench_command(Command& program);
void add_conflicts_command(Command& program);
void add_convert_command(Command& program);
void add_diff_command(Command& program);
void add_fit_command(Command& program);
void add_graph_command(Command& program);
void add_info_command(Command& program);
void add_map_command(Command& program);
void add_merge_command(Command& program);
void add_query_command(Command& program);
void add_render_command(Command& program);
void add_simulate_command(Command& program);
void add_sweep_command(Command& program);
void add_test_command(Command& program);
void add_verify_command(Command& program);

}  // namespace mobbscope::cli
