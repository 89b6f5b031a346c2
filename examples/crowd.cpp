// A small crowd. Every two seconds each person chooses, at random, among a few clips: the first that collides with
// nobody else is played, from where the person stands. Every answer is checked by measuring all samples; one that is
// wrong is captured, and the last questions are captured if the program crashes. README.md says how to look at the
// captures.
#include <mobb/capture.h>
#include <mobb/query.h>
#include <mobb/trace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double kDt = 1.0 / 30;  // seconds from sample to sample
constexpr int kSamples = 60;      // of a clip, which so lasts two seconds
constexpr double kRadius = 0.3;   // metres

/// A walk that begins at the origin along x and turns evenly. A speed of 0 stands.
mobb::Tree walk(double speed, double turn_deg) {
    std::vector<mobb::Disk> path;
    double x = 0, y = 0;
    for (int i = 0; i < kSamples; ++i) {
        path.push_back({x, y, kRadius});
        const double heading = turn_deg * i / kSamples * std::numbers::pi / 180;
        x += speed * kDt * std::cos(heading);
        y += speed * kDt * std::sin(heading);
    }
    return {std::make_shared<const mobb::Clip>(kDt, path), {.tree = mobb::TreeKind::mobb, .leaf = 10}};
}

struct Options {
    unsigned seed = 1;
    bool fault = false;  ///< a bug in may_meet
    bool crash = false;  ///< an assertion fails after 20 seconds
};

class Crowd {
  public:
    Crowd(int people, const Options& options) : options_(options), random_(options.seed) {
        for (const double turn : {0.0, 45.0, -45.0, 110.0, -110.0}) clips_.push_back(walk(1.3, turn));
        clips_.push_back(walk(0, 0));
        // Everybody stands on a grid, and looks anywhere.
        const int side = static_cast<int>(std::ceil(std::sqrt(people)));
        for (int i = 0; i < people; ++i) {
            const mobb::Placement here{.translate = {2.0 * (i % side), 2.0 * (i / side)}, .rotate_deg = degrees()};
            plays_.emplace_back(clips_.back(), here);
        }
    }

    /// Everybody chooses once, for the two seconds from `start` on. False if an answer was wrong.
    bool choose(double start) {
        // Until it is somebody's turn he is taken to stand where he is.
        for (mobb::PlacedTree& play : plays_) play = {clips_.back(), end_of(play, start)};
        for (std::size_t who = 0; who < plays_.size(); ++who) {
            std::vector<const mobb::Tree*> candidates;
            for (const mobb::Tree& clip : clips_) candidates.push_back(&clip);
            std::shuffle(candidates.begin(), candidates.end() - 1, random_);  // standing comes last
            for (const mobb::Tree* clip : candidates) {
                const mobb::PlacedTree candidate(*clip, plays_[who].placed_clip().placement());
                const std::optional<bool> free = is_free(candidate, who);
                if (!free) return false;
                if (!*free) continue;
                plays_[who] = candidate;
                break;
            }
        }
        return true;
    }

    const mobb::CaptureRing& asked() const { return asked_; }

  private:
    /// Whether a candidate collides with nobody else; nothing if an answer was wrong.
    std::optional<bool> is_free(const mobb::PlacedTree& candidate, std::size_t who) {
        for (std::size_t other = 0; other < plays_.size(); ++other) {
            if (other == who) continue;
            std::optional<mobb::Contact> answer;
            if (may_meet(candidate, plays_[other])) answer = asked_.query(candidate, plays_[other]);
            if (!is_right(candidate, plays_[other], answer)) return std::nullopt;
            if (answer) return false;
        }
        return true;
    }

    /// A cheap test before the query: circles around where the two clips begin.
    bool may_meet(const mobb::PlacedTree& a, const mobb::PlacedTree& b) const {
        const auto from_a = a.placed_clip().placement().translate, from_b = b.placed_clip().placement().translate;
        const double distance = std::hypot(from_a.x - from_b.x, from_a.y - from_b.y);
        // The fault: B is taken to stand still.
        const double reach_b = options_.fault ? kRadius : b.tree().clip().reach();
        return distance < a.tree().clip().reach() + reach_b;
    }

    /// Compares an answer with the direct search's. Where they differ, captures the query with the answer that was
    /// wrong and what the tree tested.
    static bool is_right(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                         const std::optional<mobb::Contact>& answer) {
        if (answer == mobb::direct_search(a.placed_clip(), b.placed_clip())) return true;
        mobb::Capture capture = mobb::capture(a, b, answer);
        mobb::TraceRecorder recorder;
        mobb::query(a, b, recorder);
        capture.trace = std::make_shared<const mobb::Trace>(recorder.take());
        mobb::write_capture("wrong.json", capture);
        return false;
    }

    /// Where somebody stands at the end of a play, looking as he walked.
    static mobb::Placement end_of(const mobb::PlacedTree& play, double start) {
        const mobb::PlacedClip& clip = play.placed_clip();
        const mobb::Disk before = clip.disk(clip.end() - 2), last = clip.disk(clip.end() - 1);
        mobb::Placement out = clip.placement();
        out.translate = {last.x, last.y};
        out.start = start;
        if (before.x != last.x || before.y != last.y)
            out.rotate_deg = std::atan2(last.y - before.y, last.x - before.x) * 180 / std::numbers::pi;
        return out;
    }

    double degrees() { return std::uniform_real_distribution<double>(0, 360)(random_); }

    Options options_;
    std::mt19937 random_;
    std::vector<mobb::Tree> clips_;  ///< the last one stands
    std::vector<mobb::PlacedTree> plays_;
    mobb::CaptureRing asked_{64};
};

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        options.fault = options.fault || option == "--fault";
        options.crash = options.crash || option == "--crash";
        if (option == "--seed" && i + 1 < argc) options.seed = static_cast<unsigned>(std::atoi(argv[++i]));
    }
    Crowd crowd(36, options);
    const mobb::CrashCapture crash(crowd.asked(), "crash.json");
    for (int turn = 0; turn < 30; ++turn) {
        if (!crowd.choose(2.0 * turn)) {
            std::printf("at %d s an answer is wrong: see wrong.json\n", 2 * turn);
            return 1;
        }
        // In place of your assertion that fails.
        if (options.crash && turn == 10) std::abort();
    }
    crowd.asked().write("last.json");
    std::puts("every answer is right; last.json has the last questions");
}
