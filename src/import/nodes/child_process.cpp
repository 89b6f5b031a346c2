#include <fcntl.h>
#include <import/nodes/child_process.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <system_error>

namespace mobbscope {

namespace {

[[noreturn]] void fail_call(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return value_; }
    void close() {
        if (value_ >= 0) ::close(value_);
        value_ = -1;
    }

  private:
    int value_;
};

class FileActions {
  public:
    FileActions() { ::posix_spawn_file_actions_init(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
    posix_spawn_file_actions_t* get() { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_{};
};

int wait_for(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        // Where the program ignores SIGCHLD there is no status to collect; the output says enough.
        if (errno != EINTR) return 0;
    }
    return status;
}

}  // namespace

ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments, double seconds,
                      std::size_t most_output) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_call(errno, "no pipe");
    Descriptor from(ends[0]);
    Descriptor to(ends[1]);

    FileActions actions;
    ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(actions.get(), to.get(), STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string name = program.string();
    std::vector<std::string> copies = arguments;  // the interface wants writable strings
    std::vector<char*> argv{name.data()};
    for (std::string& argument : copies) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const int error = ::posix_spawn(&child, name.c_str(), actions.get(), nullptr, argv.data(), environ);
    if (error != 0) fail_call(error, "cannot be started");
    to.close();

    ChildResult result;
    const auto kill_as = [&](ChildEnd end) {
        ::kill(child, SIGKILL);
        wait_for(child);
        result.end = end;
        return result;
    };
    using Clock = std::chrono::steady_clock;
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::array<char, 65536> buffer{};
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd wanted{from.get(), POLLIN, 0};
        const int ready = left <= 0 ? 0 : ::poll(&wanted, 1, static_cast<int>(std::min<long long>(left, 60'000)));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0 && Clock::now() < deadline) continue;
        if (ready <= 0) return kill_as(ChildEnd::timed_out);
        const ssize_t size = ::read(from.get(), buffer.data(), buffer.size());
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) break;
        result.output.append(buffer.data(), static_cast<std::size_t>(size));
        if (result.output.size() > most_output) return kill_as(ChildEnd::too_much_output);
    }
    const int status = wait_for(child);
    if (WIFSIGNALED(status)) {
        result.end = ChildEnd::signalled;
        result.code = WTERMSIG(status);
    } else {
        result.code = WEXITSTATUS(status);
    }
    return result;
}

}  // namespace mobbscope
