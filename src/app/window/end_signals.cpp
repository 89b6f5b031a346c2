#include <app/window/end_signals.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
constexpr int kEndPatience = 5000;  // milliseconds that a window has to end by itself

using SignalHandler = void (*)(int);

// What a handler of signals may touch.
std::atomic<int> received = 0;
std::atomic<int> pipe_end = -1;
std::array<std::atomic<SignalHandler>, kSignals.size()> handled_before{};
static_assert(std::atomic<SignalHandler>::is_always_lock_free);

void end_as_before(int number) {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        if (kSignals[i] != number) continue;
        std::signal(number, handled_before[i]);
        std::raise(number);
    }
}

void note_signal(int number) {
    const int error = errno;
    if (received.exchange(number) != 0) return end_as_before(number);
    const char one = 1;
    static_cast<void>(!::write(pipe_end, &one, 1));
    errno = error;
}

}  // namespace

EndSignals::EndSignals(std::function<void()> wake) : wake_(std::move(wake)) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    told_ = Descriptor(ends[0]);
    tells_ = Descriptor(ends[1]);
    pipe_end = tells_.get();
    received = 0;
    try {
        thread_ = std::thread([this] { wait_for_one(); });
    } catch (const std::system_error&) {
        return;
    }
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
        const SignalHandler before = std::signal(kSignals[i], note_signal);
        handled_before[i] = before;
        if (before == SIG_IGN) std::signal(kSignals[i], SIG_IGN);
    }
}

EndSignals::~EndSignals() {
    if (!thread_.joinable()) return;
    for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], handled_before[i]);
    tells_.close();
    thread_.join();
}

/// Until a signal has come, and the window has ended by it, or the pipe is closed.
void EndSignals::wait_for_one() const {
    char one = 0;
    ssize_t count = 0;
    while ((count = ::read(told_.get(), &one, 1)) < 0 && errno == EINTR) {
    }
    if (count <= 0) return;
    wake_();
    pollfd closed{told_.get(), POLLIN, 0};
    if (::poll(&closed, 1, kEndPatience) == 0) end_as_before(received);
}

bool EndSignals::any() { return received != 0; }

void EndSignals::end() {
    end_as_before(received);
    ::_exit(128 + received);
}

}  // namespace mobbscope::app
