#include <app/window/picture_clipboard.h>
#include <base/error.h>
#include <base/process.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// A program that takes a picture from its standard input, and stays in the background to give it to who asks.
struct ClipboardProgram {
    const char* name;
    const char* display;  ///< the variable that says where it shows something
    std::vector<const char*> arguments;
    std::string_view missing;
};

const std::array<ClipboardProgram, 2>& clipboard_programs() {
    static const std::array<ClipboardProgram, 2> table{{{"wl-copy",
                                                         "WAYLAND_DISPLAY",
                                                         {"--type", "image/png"},
                                                         "it needs the program wl-copy: sudo apt install wl-clipboard"},
                                                        {"xclip",
                                                         "DISPLAY",
                                                         {"-selection", "clipboard", "-target", "image/png", "-in"},
                                                         "it needs the program xclip: sudo apt install xclip"}}};
    return table;
}

bool has_its_display(const ClipboardProgram& program) {
    const char* display = std::getenv(program.display);
    return display && *display != '\0';
}

/// The first that is there and has a display; null: none.
const ClipboardProgram* usable_program() {
    for (const ClipboardProgram& program : clipboard_programs()) {
        if (has_its_display(program) && program_in_path(program.name)) return &program;
    }
    return nullptr;
}

[[noreturn]] void refuse_copy(const ClipboardProgram& program, const std::string& why) {
    throw MachineError(std::string("the picture cannot be copied: ") + program.name + ": " + why);
}

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// A file without a name that holds the bytes, at its beginning.
std::unique_ptr<std::FILE, FileCloser> nameless_file(const ClipboardProgram& program, std::string_view bytes) {
    std::unique_ptr<std::FILE, FileCloser> file(std::tmpfile());
    const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                         std::fflush(file.get()) == 0 && std::fseek(file.get(), 0, SEEK_SET) == 0;
    if (!written) refuse_copy(program, std::string("no temporary file can be written: ") + std::strerror(errno));
    return file;
}

/// Waits until it has read all and went to the background.
void wait_for_end(const ClipboardProgram& program, Process& process) {
    constexpr double kLongest = 5;  // seconds
    const std::optional<int> status = process.wait(kLongest);
    if (!status) refuse_copy(program, "it does not answer");
    if (*status != 0) refuse_copy(program, "it " + how_it_ended(*status));
}

}  // namespace

std::string_view why_no_picture_clipboard() {
    if (usable_program()) return "";
    for (const ClipboardProgram& program : clipboard_programs()) {
        if (has_its_display(program)) return program.missing;
    }
    return "there is no clipboard without a display";
}

void copy_picture_to_clipboard(std::string_view png) {
    const ClipboardProgram* program = usable_program();
    if (!program) throw MachineError("the picture cannot be copied: " + std::string(why_no_picture_clipboard()));
    const auto picture = nameless_file(*program, png);
    const std::vector<std::string> arguments(program->arguments.begin(), program->arguments.end());
    std::optional<Process> process;
    try {
        // It stays in the background when this program is gone, and must not hold its terminal.
        process.emplace(*program_in_path(program->name), arguments, Process::Streams{.in = ::fileno(picture.get())});
    } catch (const MachineError& error) {
        refuse_copy(*program, error.what());
    }
    wait_for_end(*program, *process);
}

}  // namespace mobbscope::app
