#include <base/error.h>
#include <base/text.h>
#include <cases/drawing_child.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

constexpr int kAskEvery = 50;                  // milliseconds
constexpr std::size_t kMostComplaint = 4096;   // bytes that are kept of standard error
constexpr std::size_t kMostLine = 1ull << 30;  // bytes of a result

class PipeEnd {
  public:
    explicit PipeEnd(int descriptor) : descriptor_(descriptor) {}
    ~PipeEnd() { close(); }
    PipeEnd(const PipeEnd&) = delete;
    PipeEnd& operator=(const PipeEnd&) = delete;
    int get() const { return descriptor_; }
    bool is_open() const { return descriptor_ >= 0; }
    void close() {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = -1;
    }
    /// False at the end of what comes.
    bool read_to(std::string& bytes) {
        std::array<char, 65536> buffer{};
        const ssize_t size = ::read(descriptor_, buffer.data(), buffer.size());
        if (size < 0 && errno == EINTR) return true;
        if (size <= 0) return false;
        bytes.append(buffer.data(), static_cast<std::size_t>(size));
        return true;
    }

  private:
    int descriptor_;
};

struct Pipe {
    PipeEnd from, to;
    static Pipe make() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
            throw MachineError(std::string("cases cannot be drawn: no pipe: ") + std::strerror(errno));
        }
        return {PipeEnd(ends[0]), PipeEnd(ends[1])};
    }
};

/// A process that ends with this at the latest.
class TestProcess {
  public:
    TestProcess(const std::filesystem::path& program, std::vector<std::string> arguments)
        : out_(Pipe::make()), complaints_(Pipe::make()) {
        posix_spawn_file_actions_t actions;
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, out_.to.get(), STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(&actions, complaints_.to.get(), STDERR_FILENO);
        std::string name = program.string();
        std::vector<char*> argv{name.data()};
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        const int error = ::posix_spawn(&child_, name.c_str(), &actions, nullptr, argv.data(), environ);
        ::posix_spawn_file_actions_destroy(&actions);
        if (error != 0) {
            throw MachineError(name + ": cases cannot be drawn: " + std::strerror(error));
        }
        out_.to.close();
        complaints_.to.close();
    }
    ~TestProcess() {
        if (child_ == 0) return;
        ::kill(child_, SIGKILL);
        wait();
    }
    TestProcess(const TestProcess&) = delete;
    TestProcess& operator=(const TestProcess&) = delete;

    /// The next line that it says; nothing at its end. `go_on`: see draw_cases.
    std::optional<std::string> next_line(const std::function<void()>& go_on) {
        for (;;) {
            go_on();
            if (const std::size_t end = said_.find('\n', looked_at_); end != std::string::npos) {
                std::string line = said_.substr(0, end);
                said_.erase(0, end + 1);
                looked_at_ = 0;
                return line;
            }
            looked_at_ = said_.size();
            if (!out_.from.is_open() || said_.size() > kMostLine) return std::nullopt;
            std::array<pollfd, 2> wanted{{{out_.from.get(), POLLIN, 0}, {complaints_.from.get(), POLLIN, 0}}};
            if (::poll(wanted.data(), wanted.size(), kAskEvery) <= 0) continue;
            if (wanted[1].revents != 0 && !complaints_.from.read_to(complaint_)) complaints_.from.close();
            if (wanted[0].revents != 0 && !out_.from.read_to(said_)) out_.from.close();
            if (complaint_.size() > kMostComplaint) complaint_.resize(kMostComplaint);
        }
    }

    /// How it ended: "crashed: ...", "ended with status 2 (...)". One that still talks is stopped.
    std::string end() {
        const bool talks = out_.from.is_open();
        if (talks) ::kill(child_, SIGKILL);
        while (complaints_.from.is_open() && complaints_.from.read_to(complaint_)) continue;
        const int status = wait();
        if (talks) return "said what is no result";
        std::string how = WIFSIGNALED(status) ? std::string("crashed: ") + ::strsignal(WTERMSIG(status))
                                              : "ended with status " + std::to_string(WEXITSTATUS(status));
        const std::string_view first = trimmed(std::string_view(complaint_).substr(0, complaint_.find('\n')));
        if (!first.empty()) how += " (" + cleaned(first) + ")";
        return how;
    }

  private:
    int wait() {
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
        child_ = 0;
        return status;
    }

    Pipe out_, complaints_;
    pid_t child_ = 0;
    std::string said_, complaint_;
    std::size_t looked_at_ = 0;  ///< of what it said, to here there is no end of a line
};

/// Names of files may begin as options do.
std::vector<std::string> arguments_of(const CaseDrawer& drawer, const std::filesystem::path& folder) {
    return {"test", "--backend", drawer.backend, "--json-lines", "--", folder.string()};
}

}  // namespace

void draw_cases(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::vector<CaseFile>& cases,
                const std::function<void(const NamedResult&)>& tell, const std::function<void()>& go_on) {
    std::vector<CaseFile> left = cases;
    const auto fail = [&](const CaseFile& file, std::string why) {
        NamedResult failed{file.name, {}};
        failed.result.outcome = CaseOutcome::failed;
        failed.result.message = std::move(why);
        tell(failed);
    };
    while (!left.empty()) {
        // One that is gone would be refused, and all others with it; of one whose name is no text no line could tell.
        std::erase_if(left, [&](const CaseFile& file) {
            std::error_code ignored;
            const bool is_there = std::filesystem::exists(file.file, ignored);
            if (!is_there) fail(file, file.file.string() + " is gone; draw all again");
            const bool is_text = is_utf8(file.name);
            if (is_there && !is_text) fail(file, file.file.string() + ": the name is not UTF-8; rename the file");
            return !is_there || !is_text;
        });
        if (left.empty()) return;
        std::vector<std::string> arguments = arguments_of(drawer, folder);
        for (const CaseFile& file : left) arguments.push_back(file.name);
        TestProcess process(drawer.program, std::move(arguments));
        while (!left.empty()) {
            const std::optional<std::string> line = process.next_line(go_on);
            if (!line) break;
            NamedResult result;
            try {
                result = read_result_line(*line, cases);
            } catch (const InputError&) {
                break;  // what it says is cut off
            }
            // A pattern in the name of one case may mean others too.
            if (std::erase_if(left, [&](const CaseFile& file) { return file.name == result.name; }) > 0) tell(result);
        }
        if (left.empty()) return;
        const CaseFile blamed = left.front();
        left.erase(left.begin());
        fail(blamed, "mobbscope test " + process.end());
    }
}

std::string test_command_line(const CaseDrawer& drawer, const std::filesystem::path& folder, const std::string& name) {
    std::string out = "mobbscope test";
    if (drawer.backend != "auto") out += " --backend " + drawer.backend;
    if (folder.string().starts_with('-') || name.starts_with('-')) out += " --";
    return out + ' ' + shell_word(folder.string()) + ' ' + shell_word(name);
}

}  // namespace mobbscope::picture_tests
