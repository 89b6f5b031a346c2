// Captures written, and dumped by signal handlers. What a handler runs calls nothing but what POSIX allows there, and
// std::to_chars of int and of the shortest double, which needs no memory in libstdc++ and libc++.
#include <mobb/capture.h>

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace mobb {

std::uint64_t digest(double dt, std::span<const Disk> samples, Motion motion) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add_byte = [&hash](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001b3; };
    const auto add = [&](double number) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        for (int shift = 0; shift < 64; shift += 8) add_byte(bits >> shift & 0xff);
    };
    add(dt);
    for (const Disk& disk : samples) {
        add(disk.x);
        add(disk.y);
        add(disk.r);
    }
    for (const char letter : name(motion)) add_byte(static_cast<unsigned char>(letter));
    return hash;
}

namespace {

// --- a scene as text

/// Goes into a file piece by piece, or behind a text. Once that fails the rest is passed over.
class SceneText {
  public:
    explicit SceneText(int descriptor) : descriptor_(descriptor) {}
    explicit SceneText(std::string& text) : text_(&text) {}

    void add(std::string_view text) {
        while (!text.empty()) {
            if (used_ == buffer_.size()) flush();
            const std::size_t part = std::min(text.size(), buffer_.size() - used_);
            std::copy_n(text.begin(), part, buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
            used_ += part;
            text.remove_prefix(part);
        }
    }
    void add(std::int64_t number) { add_digits(number); }
    void add(int number) { add_digits(number); }
    void add(bool boolean) { add(std::string_view(boolean ? "true" : "false")); }
    /// As few digits as give the number back. A JSON reader takes "-0" for the integer 0 and loses the sign.
    void add(double number) {
        if (number == 0 && std::signbit(number)) return add(std::string_view("-0.0"));
        add_digits(number, std::chars_format::general);
    }
    /// A literal is no bool.
    void add(const char* text) { add(std::string_view(text)); }
    /// One after the other.
    template <class... Parts>
    requires(sizeof...(Parts) > 1) void add(const Parts&... parts) { (add(parts), ...); }

    /// Whether all of it was written; errno says why not.
    bool flush() {
        const char* at = buffer_.data();
        if (text_) text_->append(at, std::exchange(used_, 0));
        while (used_ > 0 && error_ == 0) {
            const ssize_t written = ::write(descriptor_, at, used_);
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) {
                error_ = written < 0 ? errno : EIO;
                break;
            }
            at += written;
            used_ -= static_cast<std::size_t>(written);
        }
        used_ = 0;
        errno = error_;
        return error_ == 0;
    }

  private:
    template <class... Arguments>
    void add_digits(Arguments... arguments) {
        std::array<char, 32> digits;
        const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), arguments...);
        add(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
    }

    int descriptor_ = -1;
    std::string* text_ = nullptr;
    int error_ = 0;
    std::size_t used_ = 0;
    std::array<char, 4096> buffer_;
};

void add_clip(SceneText& out, const Clip& clip) {
    out.add("{\n      \"dt\": ", clip.dt(), ",\n      \"motion\": \"", name(clip.motion()),
            "\",\n      \"digest\": \"");
    const std::uint64_t hash = digest(clip);
    for (int shift = 60; shift >= 0; shift -= 4)
        out.add(std::string_view("0123456789abcdef").substr(hash >> shift & 15, 1));
    out.add("\",\n      \"samples\": [");
    const char* separator = "";
    for (const Disk& disk : clip.samples()) {
        out.add(separator, "\n        [", disk.x, ", ", disk.y, ", ", disk.r, "]");
        separator = ",";
    }
    out.add("\n      ]\n    }");
}

/// A side of a query as an agent, so that pictures show it where it was placed.
void add_agent(SceneText& out, const char* name, int query, const Placement& placement, int clip) {
    out.add("{\"name\": \"", name, query, "\", \"clip\": \"clip ", clip, "\", \"translate\": [", placement.translate.x,
            ", ", placement.translate.y, "], \"rotate_deg\": ", placement.rotate_deg, ", \"start\": ", placement.start,
            "}");
}

void add_expectation(SceneText& out, bool collides, const std::optional<Contact>& contact) {
    out.add(",\n      \"expect\": {\"collides\": ", collides);
    // Without it any contact is right.
    if (contact) {
        out.add(", \"contact\": {\"time\": ", contact->time, ", \"a_sample\": ", contact->a_sample,
                ", \"b_sample\": ", contact->b_sample, ", \"distance\": ", contact->distance,
                ", \"radii\": ", contact->radii, "}");
    }
    out.add("}");
}

void add_event(SceneText& out, int step, const Trace::Event& event) {
    out.add("{\"step\": ", step, ", \"parent\": ", event.parent, ", \"depth\": ", event.depth, ", \"a\": ", event.a,
            ", \"b\": ", event.b, ", \"test\": \"", name(event.test), "\", \"outcome\": \"", name(event.outcome), "\"");
    if (event.outcome == Outcome::separated) {
        out.add(", \"axis\": ", event.axis, ", \"gap\": ", event.gap);
    } else {
        out.add(", \"axis\": null, \"gap\": null");
    }
    out.add(", \"pairs\": [");
    const char* separator = "";
    for (const MeasuredPair& pair : event.pairs) {
        out.add(separator, "[", pair.i, ", ", pair.j, ", ", pair.distance, "]");
        separator = ", ";
    }
    out.add("]}");
}

void add_trace(SceneText& out, const Trace& trace) {
    out.add(",\n      \"trace\": [");
    for (int step = 0; step < trace.size(); ++step) {
        out.add(step == 0 ? "\n        " : ",\n        ");
        add_event(out, step, trace[step]);
    }
    out.add("\n      ]");
    if (trace.stopped()) out.add(",\n      \"events\": ", trace.events());
}

/// Writes a scene of captures, at least one: they have size(), operator[], and is_answered(i). False, and errno says
/// why, if not all of it could be written. Runs in signal handlers.
template <class Captures>
bool write_scene(SceneText out, const Captures& captures) {
    const int size = captures.size();
    // Each clip once, with the number of the first side that plays it.
    const auto clip_of = [&](int side) -> const ClipPtr& {
        const Capture& capture = captures[side / 2];
        return (side % 2 == 0 ? capture.a : capture.b).clip;
    };
    const auto number_of = [&](int side) {
        int first = 0;
        while (clip_of(first) != clip_of(side)) ++first;
        return first;
    };
    out.add("{\n  \"mobbscope\": 1,\n  \"clips\": {");
    const char* separator = "";
    for (int side = 0; side < 2 * size; ++side) {
        if (number_of(side) != side) continue;
        out.add(separator, "\n    \"clip ", side, "\": ");
        add_clip(out, *clip_of(side));
        separator = ",";
    }
    out.add("\n  },\n  \"agents\": [");
    separator = "";
    for (int i = 0; i < size; ++i) {
        out.add(separator, "\n    ");
        add_agent(out, "A", i, captures[i].a.placement, number_of(2 * i));
        out.add(",\n    ");
        add_agent(out, "B", i, captures[i].b.placement, number_of(2 * i + 1));
        separator = ",";
    }
    const FitOptions& fit = captures[size - 1].fit;
    out.add("\n  ],\n  \"fit\": {\"tree\": \"", name(fit.tree), "\", \"leaf\": ", fit.leaf,
            ", \"levels\": ", fit.levels, ", \"axes\": \"", name(fit.axes), "\", \"time_scale\": ", fit.time_scale,
            "},\n  \"queries\": [");
    separator = "";
    for (int i = 0; i < size; ++i) {
        const Capture& capture = captures[i];
        out.add(separator, "\n    {\n      \"a\": \"A", i, "\",\n      \"b\": \"B", i, "\"");
        if (captures.is_answered(i) && capture.collides) add_expectation(out, *capture.collides, capture.contact);
        // A trace is of its own fit.
        if (capture.trace && capture.fit == fit) add_trace(out, *capture.trace);
        out.add("\n    }");
        separator = ",";
    }
    out.add("\n  ]\n}\n");
    return out.flush();
}

struct AnsweredCaptures {
    std::span<const Capture> captures;

    int size() const { return static_cast<int>(captures.size()); }
    const Capture& operator[](int i) const { return captures[static_cast<std::size_t>(i)]; }
    static bool is_answered(int) { return true; }
};

/// A file that gets its name when it is whole. What has no name yet at its end is removed.
class UnnamedFile {
  public:
    /// Throws std::filesystem::filesystem_error.
    explicit UnnamedFile(const std::filesystem::path& file) : name_(file.native()) {
        static std::atomic<unsigned> made{0};
        do {
            unfinished_ = name_ + '.' + std::to_string(::getpid()) + '-' + std::to_string(made++) + ".part";
            descriptor_ = ::open(unfinished_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ < 0) fail();
    }
    UnnamedFile(const UnnamedFile&) = delete;
    UnnamedFile& operator=(const UnnamedFile&) = delete;
    ~UnnamedFile() {
        ::close(descriptor_);
        // In a child (fork) it is the parent's.
        if (!is_named_ && ::getpid() == process_) ::unlink(unfinished_.c_str());
    }

    int descriptor() const { return descriptor_; }
    pid_t process() const { return process_; }  ///< that made it
    /// False, and errno says why, if the bytes cannot be put on the disk or get their name. May run in a handler.
    bool take_name() noexcept {
        is_named_ = ::fsync(descriptor_) == 0 && ::rename(unfinished_.c_str(), name_.c_str()) == 0;
        return is_named_;
    }
    /// Throws for what errno says.
    [[noreturn]] void fail() const {
        const std::error_code error(errno, std::generic_category());
        throw std::filesystem::filesystem_error("cannot write captured queries", name_, error);
    }

  private:
    std::string name_, unfinished_;
    pid_t process_ = ::getpid();
    int descriptor_ = -1;
    bool is_named_ = false;
};

void check_all(std::span<const Capture> captures) {
    if (captures.empty()) throw std::invalid_argument("there is no captured query to write");
    for (const Capture& capture : captures) check(capture);
}

}  // namespace

Capture capture(const PlacedTree& a, const PlacedTree& b, const std::optional<Contact>& answer) {
    return {captured(a), captured(b), a.tree().options(), answer.has_value(), answer};
}

void check(const Capture& capture) {
    const auto refuse = [](const char* why) { throw std::invalid_argument(why); };
    if (!capture.a.clip || !capture.b.clip) refuse("a captured query needs two clips");
    for (const CapturedSide* side : {&capture.a, &capture.b}) checked(side->placement);
    check(capture.fit);
    if (const auto& contact = capture.contact) {
        if (!capture.collides.value_or(false)) refuse("a captured query has a contact, but does not collide");
        const auto is_of = [](const CapturedSide& side, int sample) {
            return sample >= 0 && sample < side.clip->count();
        };
        if (!is_of(capture.a, contact->a_sample) || !is_of(capture.b, contact->b_sample))
            refuse("the contact of a captured query is of samples that its clips do not have");
        // Written so that NaN fails it.
        const auto is_length = [](double metres) { return metres >= 0 && std::isfinite(metres); };
        if (!std::isfinite(contact->time) || !is_length(contact->distance) || !is_length(contact->radii))
            refuse("the contact of a captured query needs numbers of seconds and metres");
    }
}

std::string scene_text(std::span<const Capture> captures) {
    check_all(captures);
    std::string out;
    write_scene(SceneText(out), AnsweredCaptures{captures});
    return out;
}

void write_captures(const std::filesystem::path& file, std::span<const Capture> captures) {
    check_all(captures);
    UnnamedFile out(file);
    if (!write_scene(SceneText(out.descriptor()), AnsweredCaptures{captures}) || !out.take_name()) out.fail();
}

// --- the ring

/// While it lives the ring does not change: nothing is pushed, but for a query that is being written already. The slot
/// of that one, in place of the oldest query, is left out. Queries count from the oldest.
class CaptureRing::Reading {
  public:
    explicit Reading(const CaptureRing& ring) : ring_(ring) {
        ++ring.readers_;
        const bool writing = ring.writing_.load();
        end_ = ring.pushed_.load();
        const std::uint64_t slots = ring.slots_.size() - (writing ? 1 : 0);
        first_ = end_ - std::min(end_, slots);
    }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;
    ~Reading() { --ring_.readers_; }

    int size() const { return static_cast<int>(end_ - first_); }
    const Capture& operator[](int i) const { return slot(i).capture; }
    /// Of one that is not, `collides` and `contact` may be being written.
    bool is_answered(int i) const { return slot(i).answered.load(std::memory_order_acquire); }

  private:
    const Slot& slot(int i) const {
        return ring_.slots_[(first_ + static_cast<std::uint64_t>(i)) % ring_.slots_.size()];
    }

    const CaptureRing& ring_;
    std::uint64_t first_, end_;  ///< of all that were pushed
};

CaptureRing::CaptureRing(int size)
    : slots_(size >= 1 ? static_cast<std::size_t>(size)
                       : throw std::invalid_argument("a ring of captures holds one query at least")) {}

std::vector<Capture> CaptureRing::captures() const {
    const Reading reading(*this);
    std::vector<Capture> out;
    for (int i = 0; i < reading.size(); ++i) {
        const Capture& from = reading[i];
        Capture& to = out.emplace_back(Capture{from.a, from.b, from.fit, {}, {}, from.trace});
        if (!reading.is_answered(i)) continue;
        to.collides = from.collides;
        to.contact = from.contact;
    }
    return out;
}

bool CaptureRing::dump(int descriptor) const noexcept {
    const Reading reading(*this);
    return reading.size() > 0 && write_scene(SceneText(descriptor), reading);
}

// --- crashes

namespace {

constexpr std::array kCrashSignals{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
constexpr std::size_t kSignalStack = 64 * 1024;

}  // namespace

/// Several may stand in a process; a handler finds them in `all`.
struct CrashCapture::State {
    enum Progress : int { waiting, dumping, done };

    State(const CaptureRing& of, const std::filesystem::path& name) : ring(of), file(name) {}

    const CaptureRing& ring;
    UnnamedFile file;
    std::atomic<int> progress{waiting};
    pthread_t dumps{};                ///< the thread that does
    std::unique_ptr<char[]> stack{};  ///< for signals; null: the thread has one

    static constexpr std::size_t kMost = 64;
    static inline constinit std::array<std::atomic<State*>, kMost> all{};
    static inline constinit std::atomic<int> handlers{0};  ///< that look at them now
    static inline constinit std::mutex mutex{};            ///< for who adds and removes
    static inline std::array<struct sigaction, kCrashSignals.size()> former{};
    static inline std::array<bool, kCrashSignals.size()> installed{};

    void dump() noexcept {
        if (::getpid() != file.process()) return;
        int expected = waiting;
        if (progress.compare_exchange_strong(expected, dumping)) {
            dumps = ::pthread_self();
            if (ring.dump(file.descriptor())) file.take_name();
            progress = done;
            return;
        }
        // Another thread's crash would end the process; this thread's own came from the dump.
        for (int turn = 0; turn < 500 && progress == dumping && !::pthread_equal(dumps, ::pthread_self()); ++turn)
            ::poll(nullptr, 0, 10);
    }

    static void handle(int signal, siginfo_t* info, void* context) {
        const int error = errno;
        ++handlers;
        for (const std::atomic<State*>& state : all) {
            if (State* const found = state.load()) found->dump();
        }
        --handlers;
        errno = error;
        const std::size_t index = static_cast<std::size_t>(
            std::find(kCrashSignals.begin(), kCrashSignals.end(), signal) - kCrashSignals.begin());
        const struct sigaction& before = former[index];
        if ((before.sa_flags & SA_SIGINFO) != 0) return before.sa_sigaction(signal, info, context);
        if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) return before.sa_handler(signal);
        ::sigaction(signal, &before, nullptr);
        // It comes when this handler returns. A fault comes again by itself, also where it is ignored.
        if (before.sa_handler == SIG_DFL) ::raise(signal);
    }

    static void install() {
        struct sigaction action {};
        action.sa_sigaction = handle;
        action.sa_flags = SA_SIGINFO | SA_ONSTACK;
        ::sigemptyset(&action.sa_mask);
        for (std::size_t i = 0; i < kCrashSignals.size(); ++i) {
            if (!std::exchange(installed[i], true)) ::sigaction(kCrashSignals[i], &action, &former[i]);
        }
    }

    /// But for a signal for which somebody installed a handler since: that one may call ours.
    static void uninstall() {
        for (std::size_t i = 0; i < kCrashSignals.size(); ++i) {
            struct sigaction present {};
            ::sigaction(kCrashSignals[i], nullptr, &present);
            if ((present.sa_flags & SA_SIGINFO) == 0 || present.sa_sigaction != handle) continue;
            ::sigaction(kCrashSignals[i], &former[i], nullptr);
            installed[i] = false;
        }
    }

    void give_stack() {
        stack_t present{};
        if (::sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
        stack = std::make_unique<char[]>(kSignalStack);
        stack_t own{};
        own.ss_sp = stack.get();
        own.ss_size = kSignalStack;
        ::sigaltstack(&own, nullptr);
    }
    void take_stack() {
        stack_t present{};
        if (!stack || ::sigaltstack(nullptr, &present) != 0 || present.ss_sp != stack.get()) return;
        stack_t none{};
        none.ss_flags = SS_DISABLE;
        ::sigaltstack(&none, nullptr);
    }
};

CrashCapture::CrashCapture(const CaptureRing& ring, const std::filesystem::path& file)
    : state_(std::make_unique<State>(ring, file)) {
    const std::lock_guard lock(State::mutex);
    const auto is_free = [](const std::atomic<State*>& state) { return !state.load(); };
    const auto place = std::find_if(State::all.begin(), State::all.end(), is_free);
    if (place == State::all.end())
        throw std::length_error("no more than 64 rings can be captured when a program crashes");
    if (std::all_of(State::all.begin(), State::all.end(), is_free)) State::install();
    state_->give_stack();
    *place = state_.get();
}

CrashCapture::~CrashCapture() {
    const std::lock_guard lock(State::mutex);
    *std::find(State::all.begin(), State::all.end(), state_.get()) = nullptr;
    // A handler in another thread may have found it before.
    while (State::handlers > 0) ::poll(nullptr, 0, 1);
    if (std::none_of(State::all.begin(), State::all.end(), [](const auto& state) { return state.load(); }))
        State::uninstall();
    state_->take_stack();
}

}  // namespace mobb
