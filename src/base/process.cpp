#include <base/error.h>
#include <base/process.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kNotStarted = 127;
constexpr int kNotEvenTold = 126;

/// The same above standard input, output and error, whose places are about to be taken; -1: it cannot be had. For the
/// child, as below.
int out_of_the_way(int descriptor) { return ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); }

/// The child between fork and exec: the program may have threads, so nothing is called here that takes a lock or
/// memory. `failed`: where the number of the error goes.
[[noreturn]] void become(char* const* argv, const Process::Streams& streams, int failed) {
    const int tell = out_of_the_way(failed);
    bool fits = true;
    std::array<int, 3> kept{};
    for (int i = 0; fits && i < 3; ++i) {
        const int wanted = i == STDIN_FILENO ? streams.in : i == STDOUT_FILENO ? streams.out : streams.err;
        const int source = wanted >= 0 ? wanted : ::open("/dev/null", i == STDIN_FILENO ? O_RDONLY : O_WRONLY);
        kept[static_cast<std::size_t>(i)] = out_of_the_way(source);
        fits = kept[static_cast<std::size_t>(i)] >= 0;
    }
    for (int i = 0; fits && i < 3; ++i) fits = ::dup2(kept[static_cast<std::size_t>(i)], i) == i;
    if (fits) ::execv(argv[0], argv);
    const int error = errno;
    ::_exit(::write(tell, &error, sizeof error) == sizeof error ? kNotStarted : kNotEvenTold);
}

/// The error that kept the child from becoming the program; 0: it has become it.
int error_told(const Descriptor& from) {
    int error = 0;
    ssize_t size = 0;
    do {
        size = ::read(from.get(), &error, sizeof error);
    } while (size < 0 && errno == EINTR);
    return size == sizeof error ? error : 0;
}

}  // namespace

std::optional<std::filesystem::path> program_in_path(std::string_view name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return file;
    }
    return std::nullopt;
}

Connection Connection::make() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw MachineError(std::string("no connection to another program can be made: ") + std::strerror(errno));
    }
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

bool read_some(const Descriptor& from, std::string& bytes) {
    std::array<char, 65536> buffer{};
    const ssize_t size = ::recv(from.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size < 0) return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
    bytes.append(buffer.data(), static_cast<std::size_t>(size));
    return size > 0;
}

bool send_all(const Descriptor& to, std::string_view bytes, std::optional<double> patience) {
    constexpr double kSlice = 1;  // seconds: those for which both programs are stopped count as one slice
    const int flags = MSG_NOSIGNAL | (patience ? MSG_DONTWAIT : 0);
    double left = patience.value_or(0);
    while (!bytes.empty()) {
        const ssize_t size = ::send(to.get(), bytes.data(), bytes.size(), flags);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0 && patience && (errno == EAGAIN || errno == EWOULDBLOCK)) {
            pollfd room{to.get(), POLLOUT, 0};
            const double slice = std::min(left, kSlice);
            const int found = ::poll(&room, 1, static_cast<int>(slice * 1000));
            if (found == 0) left -= slice;
            if (found > 0 || (found == 0 && left > 0) || (found < 0 && errno == EINTR)) continue;
        }
        if (size < 0) return false;
        left = patience.value_or(0);
        bytes.remove_prefix(static_cast<std::size_t>(size));
    }
    return true;
}

void send_end(const Descriptor& to) { ::shutdown(to.get(), SHUT_WR); }

Descriptor memory_file() {
    Descriptor out(::memfd_create("mobbscope", MFD_CLOEXEC));
    if (!out.is_open()) throw MachineError(std::string("no file in memory can be made: ") + std::strerror(errno));
    return out;
}

std::string beginning_of(const Descriptor& file, std::size_t most) {
    std::string out(most, '\0');
    const ssize_t size = ::pread(file.get(), out.data(), most, 0);
    out.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return out;
}

Process::Process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const Streams& streams) {
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const auto refuse = [&](int error) {
        throw MachineError(program.string() + ": cannot be started: " + std::strerror(error));
    };
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(errno);
    Descriptor told(ends[0]), telling(ends[1]);
    child_ = fork_tied();
    if (child_ == 0) become(argv.data(), streams, telling.get());
    if (child_ < 0) {
        const int error = errno;
        child_ = 0;
        refuse(error);
    }
    telling.close();
    if (const int error = error_told(told); error != 0) {
        wait(1);
        refuse(error);
    }
}

Process::~Process() {
    if (child_ == 0 || status_) return;
    kill();
    wait_for_child(child_);
}

void Process::kill() const {
    if (child_ != 0 && !status_) ::kill(child_, SIGKILL);
}

std::optional<int> Process::ended() {
    int status = 0;
    if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
    return status_;
}

std::optional<int> Process::wait(double seconds) {
    if (!status_) status_ = wait_for_child(child_, seconds);
    return status_;
}

pid_t fork_tied() {
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child != 0) return child;
    // Who has gone already would not end it any more.
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != parent) ::_exit(kNotStarted);
    return 0;
}

std::optional<int> wait_for_child(pid_t child, double seconds) {
    constexpr std::chrono::milliseconds kAskEvery(2);
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) != child) {
        if (std::chrono::steady_clock::now() >= until) return std::nullopt;
        std::this_thread::sleep_for(kAskEvery);
    }
    return status;
}

int wait_for_child(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
}

std::string how_it_ended(int status) {
    return WIFSIGNALED(status) ? std::string("crashed: ") + ::strsignal(WTERMSIG(status))
                               : "ended with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace mobbscope
