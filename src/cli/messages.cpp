#include <cli/messages.h>
#include <import/error.h>

#include <array>
#include <charconv>
#include <iostream>

namespace mobbscope::cli {

void complain(std::string_view message) {
    std::string line = "mobbscope: ";
    for (const char c : message) {
        const auto byte = static_cast<unsigned char>(c);
        line += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    std::cerr << line + '\n' << std::flush;
}

void warn(std::string_view message) { complain("warning: " + std::string(message)); }

void flush_results() {
    std::cout.flush();
    if (!std::cout) throw MachineError("standard output cannot be written; is the disk full or the reader gone?");
}

std::string brief(double value) {
    std::array<char, 32> buffer;
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
    return {buffer.data(), end};
}

std::string counted(long long count, std::string_view singular, std::string_view plural) {
    return std::to_string(count) + ' ' + std::string(count == 1 ? singular : plural);
}

}  // namespace mobbscope::cli
