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

/// What a process says: how far it is, what to warn of, and its last word. `of` is what it calls the scene, `name` what
/// people call it.
struct Said {
    std::string of, name;
    std::size_t planned = 0, drawn = 0, all = 0;
    std::vector<std::string> warnings{};
    std::string last{};

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
        for (std::size_t at = line.find(of); at != std::string::npos; at = line.find(of, at + name.size()))
            line.replace(at, of.size(), name);
        std::istringstream words(line);
        std::string verb, between;
        std::size_t done = 0, most = 0;
        const bool is_progress = words >> verb >> done >> between >> most && between == "of";
        if (is_progress && (verb == "planned" || verb == "drew")) {
            planned = verb == "planned" ? done : most;
            drawn = verb == "drew" ? done : 0;
            all = most;
        } else if (line.starts_with("warning: ")) {
            warnings.push_back(line.substr(line.find(' ') + 1));
        } else if (!line.starts_with("finishing ")) {
            last = std::move(line);
        }
    }
};

/// Runs a command line until it ends. Throws MachineError with its last word unless it ends well; Cancelled.
Said run_line(const std::string& line, Said said, JobControl& control) {
    constexpr std::size_t kDrawing = 4;  // of a picture takes so many times as long as planning it
    Connection talk = Connection::make();
    Process process("/bin/sh", {"-c", "exec " + line}, {-1, -1, talk.there.get()});
    talk.there.close();
    std::string text;
    bool more = true;
    for (std::optional<int> status; more || !status;) {
        status = process.wait(kAskEvery);
        more = read_some(talk.here, text) && !status;
        said.take(text);
        control.check();
        if (said.all > 0) control.step(said.planned + kDrawing * said.drawn, (1 + kDrawing) * said.all);
        if (!status || more) continue;
        if (*status != 0)
            throw MachineError(said.last.empty() ? "the film's process " + how_it_ended(*status) : said.last);
    }
    return said;
}

}  // namespace

void start_film(Session& session, const PictureOrder& order, const std::filesystem::path& file) {
    check_file_name(file);
    session.files.check_may_export(file);
    static_cast<void>(find_ffmpeg(file));
    const auto work = [fitted = session.workspace.document().fitted, title = session.workspace.title(), order, file,
                       program = program_word(session.options.program),
                       &notifications = session.notifications](JobControl& control) -> Job::Finish {
        // What is edited or saved meanwhile is not in the film.
        const SceneCopy copy(*fitted, title, order.view);
        const std::string line = copy.render_line(order, file.string());
        const std::string command = program + line.substr(std::string_view("mobbscope").size()) + " --progress";
        const Said said = run_line(command, {copy.file().string(), title}, control);
        return [said, &notifications] {
            for (const std::string& each : said.warnings) notifications.tell_of_window(MessageLevel::warning, each);
            notifications.tell_of_window(MessageLevel::info, "Wrote " + said.last);
        };
    };
    session.jobs.start_film(file, work);
}

}  // namespace mobbscope::app
