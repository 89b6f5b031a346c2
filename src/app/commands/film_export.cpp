#include <app/commands/film_export.h>
#include <base/error.h>
#include <base/file.h>
#include <base/process.h>
#include <base/text.h>
#include <render/image/film.h>

#include <unistd.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kAskEvery = 0.1;  // seconds
constexpr std::string_view kSpeaks = "mobbscope: ";

/// The program, for a shell.
std::string program_word(const std::filesystem::path& program) {
    // Of the shell that would be the shell.
    if (program == "/proc/self/exe") return "/proc/" + std::to_string(::getpid()) + "/exe";
    return shell_word(program.string());
}

/// What a process says: how far it is, what to warn of, and its last word.
struct Said {
    std::size_t drawn = 0, all = 0;
    std::vector<std::string> warnings;
    std::string last;

    /// Takes whole lines out of what has come.
    void take(std::string& text) {
        for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
            hear(text.substr(0, end));
            text.erase(0, end + 1);
        }
    }

  private:
    void hear(std::string line) {
        if (line.starts_with(kSpeaks)) line.erase(0, kSpeaks.size());
        std::istringstream words(line);
        std::string drew, of;
        std::size_t done = 0, most = 0;
        if (words >> drew >> done >> of >> most && drew == "drew" && of == "of") {
            drawn = done;
            all = most;
        } else if (line.starts_with("warning: ")) {
            warnings.push_back(line.substr(line.find(' ') + 1));
        } else if (!line.starts_with("planned ")) {
            last = std::move(line);
        }
    }
};

/// Runs a command line until it ends. Throws MachineError with its last word unless it ends well; Cancelled.
Said run_line(const std::string& line, JobControl& control) {
    Connection talk = Connection::make();
    Process process("/bin/sh", {"-c", "exec " + line}, {-1, -1, talk.there.get()});
    talk.there.close();
    Said said;
    std::string text;
    bool more = true;
    for (std::optional<int> status; more || !status;) {
        status = process.wait(kAskEvery);
        more = read_some(talk.here, text) && !status;
        said.take(text);
        if (said.all > 0) control.step(said.drawn, said.all);
        if (!status || more) continue;
        if (*status != 0)
            throw MachineError(said.last.empty() ? "the film's process " + how_it_ended(*status) : said.last);
    }
    return said;
}

}  // namespace

void start_film(Session& session, const PictureOrder& order, const std::filesystem::path& file) {
    check_file_name(file);
    session.files.check_may_write(file);
    static_cast<void>(find_film_maker(file));
    const std::string line =
        render_line_with_scene(session.workspace, session.files, session.dialogs, order, file.string());
    const std::string command =
        program_word(session.options.program) + line.substr(std::string_view("mobbscope").size()) + " --progress";
    session.jobs.start("Drawing " + file.filename().string(),
                       [command, &notifications = session.notifications](JobControl& control) -> Job::Finish {
                           const Said said = run_line(command, control);
                           return [said, &notifications] {
                               for (const std::string& each : said.warnings)
                                   notifications.tell(MessageLevel::warning, each);
                               notifications.tell(MessageLevel::info, "Wrote " + said.last);
                           };
                       });
}

}  // namespace mobbscope::app
