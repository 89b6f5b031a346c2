#include <cli/messages.h>
#include <import/error.h>
#include <import/text.h>

#include <iostream>
#include <string>

namespace mobbscope::cli {

namespace {

constexpr std::size_t kLongestMessage = 1000;  // names of files may be longer

}  // namespace

void complain(std::string_view message) {
    std::cerr << "mobbscope: " + shortened(cleaned(message), kLongestMessage) + '\n' << std::flush;
}

void say(std::string_view message) { complain(message); }

void warn(std::string_view message) { complain("warning: " + std::string(message)); }

void flush_results() {
    std::cout.flush();
    if (!std::cout) throw MachineError("standard output cannot be written; is the disk full or the reader gone?");
}

}  // namespace mobbscope::cli
