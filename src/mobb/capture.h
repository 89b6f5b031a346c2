/// Queries of your own program as scene files, which Mobbscope opens: `mobbscope query FILE` asks each again and says
/// where its answer differs. One query at a time, or a ring of the last ones, also when the program crashes. POSIX
/// only.
///
/// A clip is written with its samples, held or linear, and a digest of them; the two sides of query 3 are called A3 and
/// B3. All queries of a file share one fit, that of the last query's A; answers do not depend on it. A chain is
/// captured as its `flattened` clip, the fastest query (PlacedBlocks) as its clip and placement: neither keeps the
/// angle at which it was placed, so you give it.
#pragma once

#include <mobb/query.h>
#include <mobb/trace.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobb {

/// The digest that a captured clip carries: FNV-1a of 64 bits over the little-endian bytes of dt, of x, y and r of each
/// sample, and the name of the motion. Allocates nothing.
std::uint64_t digest(double dt, std::span<const Disk> samples, Motion motion) noexcept;
inline std::uint64_t digest(const Clip& clip) noexcept { return digest(clip.dt(), clip.samples(), clip.motion()); }

/// A clip where a query places it. Keeps the clip alive.
struct CapturedSide {
    ClipPtr clip;
    Placement placement;
};

/// The same, of a tree where it is placed.
inline CapturedSide captured(const PlacedTree& placed) {
    return {placed.tree().shared_clip(), placed.placed_clip().placement()};
}

/// A query, with the answer that your program got.
struct Capture {
    CapturedSide a, b;
    FitOptions fit{};
    std::optional<bool> collides{};        ///< none: the file expects no answer
    std::optional<Contact> contact{};      ///< likewise, of a query that collides
    std::shared_ptr<const Trace> trace{};  ///< recorded of trees of that fit; null: none
};

/// The query of two placed trees, with its answer. The fit is a's.
Capture capture(const PlacedTree& a, const PlacedTree& b, const std::optional<Contact>& answer);

/// Throws std::invalid_argument if a clip is missing, a placement or the fit is not valid, or a contact is not one
/// of the clips' or comes without a collision.
void check(const Capture& capture);

/// The text of a scene file of these, numbers with all their digits: what EXPECT_PICTURE of <mobbscope/picture_tests.h>
/// draws. Throws std::invalid_argument as write_captures does.
std::string scene_text(std::span<const Capture> captures);
inline std::string scene_text(const Capture& capture) { return scene_text(std::span(&capture, 1)); }

/// Writes a scene file whole or not at all: what was there stays until the new one is on the disk. A trace whose fit is
/// not the file's is left out. Throws std::filesystem::filesystem_error, naming the file, if it cannot be written;
/// std::invalid_argument, and nothing is written, if there is no capture or one fails `check`.
void write_captures(const std::filesystem::path& file, std::span<const Capture> captures);
inline void write_capture(const std::filesystem::path& file, const Capture& capture) {
    write_captures(file, {&capture, 1});
}

/// The last queries of one thread: make one per thread (thread_local). They may be read and dumped from any thread and
/// any signal handler; what is pushed meanwhile is not kept.
///
/// A query is in the ring before it is asked, so that one that crashes is there too, without an answer. Asking
/// allocates nothing. A clip lives until its last query has left the ring, and may be freed by the push that ends it.
class CaptureRing {
  public:
    /// Throws std::invalid_argument unless size >= 1. Takes 192 bytes for each.
    explicit CaptureRing(int size);
    CaptureRing(const CaptureRing&) = delete;
    CaptureRing& operator=(const CaptureRing&) = delete;

    /// mobb::query, remembered.
    std::optional<Contact> query(const PlacedTree& a, const PlacedTree& b) {
        Slot* const slot = begin();
        if (slot) {
            const auto take = [](CapturedSide& side, const PlacedTree& placed) {
                // Counting owners is dear where other threads count too, and crowds ask about the same clips.
                const ClipPtr& clip = placed.tree().shared_clip();
                if (side.clip != clip) side.clip = clip;
                side.placement = placed.placed_clip().placement();
            };
            take(slot->capture.a, a);
            take(slot->capture.b, b);
            slot->capture.fit = a.tree().options();
            if (slot->capture.trace) slot->capture.trace.reset();
            end();
        }
        const std::optional<Contact> answer = mobb::query(a, b);
        if (slot) {
            slot->capture.collides = answer.has_value();
            slot->capture.contact = answer;
            slot->answered.store(true, std::memory_order_release);
        }
        return answer;
    }

    /// Remembers a query that was asked in another way. Throws as `check` does.
    void push(Capture capture) {
        check(capture);
        Slot* const slot = begin();
        if (!slot) return;
        slot->capture = std::move(capture);
        slot->answered.store(true, std::memory_order_release);
        end();
    }

    /// How many it holds at most.
    int size() const { return static_cast<int>(slots_.size()); }
    /// What it holds, the oldest first.
    std::vector<Capture> captures() const;
    /// Writes what it holds: write_captures(file, captures()).
    void write(const std::filesystem::path& file) const { write_captures(file, captures()); }

    /// The same into an open file, from a signal handler: it allocates nothing, takes no lock, and leaves out what the
    /// signal interrupted. It takes 8 KiB of stack. False if not all could be written, or nothing was there.
    bool dump(int descriptor) const noexcept;

  private:
    struct alignas(64) Slot {
        Capture capture;
        std::atomic<bool> answered{false};  ///< if not, the answer is not to be read
    };
    class Reading;

    /// The slot for the next query; null while somebody reads. Either this sees the reader or the reader sees that one
    /// is being written: each first says what it does, then looks what the other does.
    Slot* begin() noexcept {
        writing_.exchange(true);
        if (readers_.load() > 0) [[unlikely]] {
            writing_.store(false);
            return nullptr;
        }
        Slot& slot = slots_[next_];
        slot.answered.store(false, std::memory_order_relaxed);
        return &slot;
    }
    void end() noexcept {
        next_ = next_ + 1 == slots_.size() ? 0 : next_ + 1;
        pushed_.store(pushed_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
        writing_.store(false, std::memory_order_release);
    }

    std::vector<Slot> slots_;
    std::size_t next_ = 0;                  ///< slot
    std::atomic<std::uint64_t> pushed_{0};  ///< in all
    std::atomic<bool> writing_{false};      ///< the next slot
    mutable std::atomic<int> readers_{0};
};

/// In place of a ring where nothing is captured: not an instruction more than mobb::query.
struct NoCaptureRing {
    explicit NoCaptureRing(int /*size*/ = 0) {}
    static std::optional<Contact> query(const PlacedTree& a, const PlacedTree& b) { return mobb::query(a, b); }
};

/// While it lives: when SIGABRT (a failed assertion), SIGBUS, SIGFPE, SIGILL or SIGSEGV comes, to any thread, it writes
/// what a ring holds to a file, once; then what was installed for the signal before does its work, which mostly ends
/// the program. There may be 64, one for each thread's ring.
///
/// The file is opened before under another name (FILE.PID-N.part) and gets its own when it is whole. Where no signal
/// comes, nothing is left. A child process (fork) writes nothing.
class CrashCapture {
  public:
    /// The ring must outlive it. Gives this thread a stack of 64 KiB for signals, so that a stack that is full is
    /// captured too, unless it has one; so end it in the thread that made it. Throws
    /// std::filesystem::filesystem_error if the file cannot be made, std::length_error if there are 64.
    CrashCapture(const CaptureRing& ring, const std::filesystem::path& file);
    CrashCapture(const CrashCapture&) = delete;
    CrashCapture& operator=(const CrashCapture&) = delete;
    ~CrashCapture();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobb
