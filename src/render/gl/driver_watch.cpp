#include <base/process.h>
#include <base/text.h>
#include <base/threads.h>
#include <render/gl/driver_crash.h>
#include <render/gl/driver_watch.h>

#include <glad/gl.h>

#include <malloc.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::array kPassedOn{SIGINT, SIGTERM, SIGHUP, SIGQUIT};
constexpr std::array<std::string_view, 10> kReadByMesa{"GALLIUM_", "GALLIVM_", "LP_",   "MESA_",    "LIBGL_",
                                                       "EGL_",     "__EGL_",   "DRAW_", "ST_DEBUG", "OSMESA_"};

/// What a child tells, even as it crashes.
struct Told {
    CrashNote crash;
    std::atomic<int> backend = 0;
    std::atomic<bool> has_drawn = false;
    std::atomic<bool> has_failed = false;
    std::array<char, 64> name{};    ///< the backend's
    std::array<char, 4096> text{};  ///< reasons, or what the work came to
};

template <std::size_t N>
void put(std::array<char, N>& to, std::string_view text) {
    to[std::min(text.copy(to.data(), N - 1), N - 1)] = '\0';
}

struct Watching {
    std::optional<DriverWatch> asked;
    Told* told = nullptr;      ///< not null in a child
    bool has_crashed = false;  ///< a driver, in a child before
    std::string notice;        ///< to say once something is drawn: why not by another
};
Watching watching;

std::atomic<pid_t> watched_child = 0;
void pass_on(int signal) { ::kill(watched_child, signal); }

/// The page that processes share; null where there is none.
Told* make_told() {
    void* page = ::mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return page == MAP_FAILED ? nullptr : new (page) Told;
}

void drop(Told* told) { ::munmap(told, sizeof(Told)); }

/// As fork. The child ends with its parent, and notes a driver's crash. -1 too where there are other threads, which a
/// child would not have.
pid_t fork_to_watch(Told* told) {
    if (!told || thread_count() != 1) return -1;
    note_program();
    std::cout.flush();
    std::cerr.flush();
    std::fflush(nullptr);
    const pid_t child = fork_tied();
    if (child == 0) note_crashes(told->crash);
    return child;
}

/// While it lives, signals that end a program go to the child.
class PassingOn {
  public:
    PassingOn() {
        sigset_t blocked;
        ::sigemptyset(&blocked);
        for (const int signal : kPassedOn) ::sigaddset(&blocked, signal);
        ::sigprocmask(SIG_BLOCK, &blocked, &mask_);
    }
    ~PassingOn() {
        for (std::size_t i = 0; is_parent_ && i < kPassedOn.size(); ++i) {
            ::sigaction(kPassedOn[i], &before_[i], nullptr);
        }
        ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
    }
    PassingOn(const PassingOn&) = delete;
    PassingOn& operator=(const PassingOn&) = delete;

    void to(pid_t child) {
        watched_child = child;
        is_parent_ = true;
        for (std::size_t i = 0; i < kPassedOn.size(); ++i) {
            ::sigaction(kPassedOn[i], nullptr, &before_[i]);
            if (before_[i].sa_handler == SIG_IGN) continue;
            struct sigaction action {};
            action.sa_handler = pass_on;
            action.sa_flags = SA_RESTART;
            ::sigaction(kPassedOn[i], &action, nullptr);
        }
        ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
    }

  private:
    sigset_t mask_{};
    std::array<struct sigaction, kPassedOn.size()> before_{};
    bool is_parent_ = false;
};

[[noreturn]] void end_by(int signal) {
    // One image of the memory is enough: the child's.
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::signal(signal, SIG_DFL);
    sigset_t one;
    ::sigemptyset(&one);
    ::sigaddset(&one, signal);
    ::sigprocmask(SIG_UNBLOCK, &one, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);
}

/// Ends as the child did, which has written and tidied up all; comes back if its driver crashed in time for another.
void end_as(int status, const Told& told) {
    if (WIFEXITED(status)) ::_exit(WEXITSTATUS(status));
    if (told.crash.signal == 0) end_by(WTERMSIG(status));
    if (!told.has_drawn) return;
    watching.asked->say("OpenGL (" + std::string(told.name.data()) + ") " + described(told.crash) + " while drawing" +
                        driver_advice());
    ::_exit(watching.asked->status_of_crash);
}

}  // namespace

void watch_drivers(DriverWatch watch) {
    if (std::getenv("MOBBSCOPE_NO_WATCH")) return;
    watching.asked = std::move(watch);
}

std::optional<DriverCrash> go_on_watched(int backend, const std::string& name, const std::string& reasons) {
    const auto tell = [&](Told& told) {
        told.backend = backend;
        put(told.name, name);
        put(told.text, reasons);
    };
    if (watching.told) tell(*watching.told);
    if (!watching.asked || watching.told) return std::nullopt;
    watching.asked->end_threads();
    Told* told = make_told();
    if (told) tell(*told);
    PassingOn signals;
    const pid_t child = fork_to_watch(told);
    if (child == 0) {
        watching.told = told;
        if (watching.has_crashed) watching.notice = reasons;
        return std::nullopt;
    }
    std::optional<DriverCrash> crash;
    if (child > 0) {
        signals.to(child);
#ifdef __GLIBC__
        // Memory that is free here too need not be copied before the child writes to it.
        ::malloc_trim(0);
#endif
        end_as(wait_for_child(child), *told);
        const std::string before = told->text.data();
        watching.has_crashed = true;
        crash = {told->backend,
                 (before.empty() ? "" : before + "; ") + told->name.data() + ": " + described(told->crash)};
    }
    if (told) drop(told);
    return crash;
}

void note_drawn() {
    if (!watching.told || watching.told->has_drawn) return;
    // Some of it may be drawn by other threads, and later.
    glFinish();
    watching.told->has_drawn = true;
    if (watching.notice.empty()) return;
    watching.asked->say("warning: OpenGL by " + std::string(watching.told->name.data()) +
                        " draws, as another cannot (" + watching.notice + ")" + driver_advice());
}

std::string done_in_child(const std::function<std::string()>& work, std::chrono::milliseconds longest) {
    Told* told = make_told();
    const pid_t child = fork_to_watch(told);
    if (child < 0) {
        if (told) drop(told);
        return work();
    }
    if (child == 0) {
        try {
            put(told->text, work());
        } catch (const std::exception& error) {
            put(told->text, error.what());
            told->has_failed = true;
        }
        ::_exit(0);
    }
    const std::optional<int> status = wait_for_child(child, std::chrono::duration<double>(longest).count());
    if (!status) {
        ::kill(child, SIGKILL);
        wait_for_child(child);
        drop(told);
        throw std::runtime_error("hangs: not done after " + std::to_string(longest.count()) + " ms" + driver_advice());
    }
    std::string text = told->text.data();
    const bool has_failed = told->has_failed;
    const std::string crash = told->crash.signal != 0 ? described(told->crash) : "";
    drop(told);
    if (!crash.empty()) throw std::runtime_error(crash + driver_advice());
    if (WIFSIGNALED(*status)) throw std::runtime_error(std::string("crashed (") + ::strsignal(WTERMSIG(*status)) + ")");
    if (has_failed) throw std::runtime_error(text);
    return text;
}

std::string driver_advice() {
    std::string found;
    for (char** variable = environ; *variable; ++variable) {
        const std::string_view text = *variable;
        const auto is_read = [&](std::string_view beginning) { return text.starts_with(beginning); };
        if (text.starts_with("LP_NUM_THREADS=") || text.starts_with("EGL_LOG_LEVEL=")) continue;  // may be our own
        if (std::any_of(kReadByMesa.begin(), kReadByMesa.end(), is_read)) {
            found += (found.empty() ? "" : ", ") + std::string(text);
        }
    }
    std::string out;
    if (!found.empty()) out += "; Mesa reads " + found + " from the environment: unset what is not needed";
    rlimit memory{};
    if (::getrlimit(RLIMIT_AS, &memory) == 0 && memory.rlim_cur != RLIM_INFINITY) {
        out += "; memory is limited to " + bytes_text(memory.rlim_cur) + ": raise it (ulimit -v)";
    }
    return out;
}

}  // namespace mobbscope
