/// What the program says: results to standard output, everything else to standard error.
#pragma once

#include <string_view>

namespace mobbscope::cli {

/// One line on standard error, "mobbscope: ...", whatever characters a file's name or text brings along, and however
/// many.
void complain(std::string_view message);
/// The same for how far long work is.
void say(std::string_view message);
/// The same for something that does not stop the program.
void warn(std::string_view message);

/// Hands everything written to std::cout to the system. Throws MachineError if it did not take it all.
void flush_results();

}  // namespace mobbscope::cli
