/// One run of bench/cliffs: settings that should cost alike, asked in turns. Usage: cliffs ROUNDS [PART], of rows with
/// that part of a name. Prints a line for each: name, how many units it has (tab), and its nanoseconds of processor
/// time in each round. Ends with status 1 where an answer is not the direct search's.
#include <mobb/blocks.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../walks.h"

namespace {

using namespace mobb;

double nanoseconds_now() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

/// What is measured: ask() answers everything once, and says what it found.
struct Row {
    std::string name;
    double units;  ///< that ask() answers
    std::function<std::size_t()> ask;
    std::vector<double> times{};  ///< ns a unit, of each round
};

/// The rows, and whatever they refer to.
struct Bench {
    std::vector<Row> rows;
    std::deque<Tree> trees;
    std::deque<std::vector<PlacedBlocks>> placed;
    bool right = true;
    std::string part{};  ///< of the names of rows that are wanted

    const Tree& tree_of(const ClipPtr& clip, TreeKind kind = TreeKind::blocks) {
        return trees.emplace_back(clip, FitOptions{.tree = kind, .leaf = 50});
    }
    /// Adds a row that is wanted, which must find as much as is known.
    void add(const std::string& name, std::size_t units, std::function<std::size_t()> ask, std::size_t known) {
        if (name.find(part) == std::string::npos) return;
        if (ask() != known) {
            std::fprintf(stderr, "cliffs: %s: found %zu, and the direct search %zu\n", name.c_str(), ask(), known);
            right = false;
        }
        rows.push_back({name, static_cast<double>(units), std::move(ask)});
    }
    void add_pairs(const std::string& name, std::vector<PlacedBlocks> sides, double units_a_pair = 1) {
        const std::vector<PlacedBlocks>& kept = placed.emplace_back(std::move(sides));
        std::size_t known = 0;
        for (std::size_t i = 0; i < kept.size(); i += 2) known += direct_search(kept[i], kept[i + 1]) ? 1U : 0U;
        const auto units = static_cast<std::size_t>(static_cast<double>(kept.size()) / 2 * units_a_pair);
        add(
            name, units,
            [&kept] {
                std::size_t found = 0;
                for (std::size_t i = 0; i < kept.size(); i += 2) found += intersects(kept[i], kept[i + 1]) ? 1U : 0U;
                return found;
            },
            known);
        add(
            name + ", contact", units,
            [&kept] {
                std::size_t found = 0;
                for (std::size_t i = 0; i < kept.size(); i += 2) found += query(kept[i], kept[i + 1]) ? 1U : 0U;
                return found;
            },
            known);
    }
};

/// Does a candidate meet any of its 20 neighbours, which share some time with it and lie within so many metres in x and
/// y? By intersects_any, and by a loop that stops. A unit is a candidate.
void add_any(Bench& bench, const std::string& name, double seconds, double metres) {
    static constexpr std::size_t kCandidates = 400, kNeighbours = 20;
    test::Random random(11);
    std::vector<const Tree*> trees;
    for (int i = 0; i < 32; ++i) trees.push_back(&bench.tree_of(bench::walk(random, seconds)));
    std::vector<PlacedBlocks>& all = bench.placed.emplace_back();
    all.reserve(kCandidates * (1 + kNeighbours));
    auto lists = std::make_shared<std::vector<std::vector<const PlacedBlocks*>>>();
    auto firsts = std::make_shared<std::vector<const PlacedBlocks*>>();
    const auto place = [&](double far, double later) {
        const Tree& tree = *trees[static_cast<std::size_t>(random.integer(0, 31))];
        return &all.emplace_back(*tree.blocks(),
                                 Placement{.translate = {random.real(-far, far), random.real(-far, far)},
                                           .rotate_deg = random.real(0, 360),
                                           .start = later});
    };
    std::size_t known = 0;
    for (std::size_t i = 0; i < kCandidates; ++i) {
        firsts->push_back(place(0, 0));
        std::vector<const PlacedBlocks*>& list = lists->emplace_back();
        while (list.size() < kNeighbours) list.push_back(place(metres, random.real(-0.9, 0.9) * seconds));
        std::size_t first = 0;
        while (first < kNeighbours && !direct_search(*firsts->back(), *list[first])) ++first;
        known += first;
    }
    bench.add(
        "any of 20, " + name, kCandidates,
        [lists, firsts] {
            std::size_t found = 0;
            for (std::size_t i = 0; i < lists->size(); ++i)
                found += intersects_any(*(*firsts)[i], (*lists)[i]).value_or(kNeighbours);
            return found;
        },
        known);
    bench.add(
        "loop over 20, " + name, kCandidates,
        [lists, firsts] {
            std::size_t found = 0;
            for (std::size_t i = 0; i < lists->size(); ++i) {
                const std::vector<const PlacedBlocks*>& list = (*lists)[i];
                std::size_t k = 0;
                while (k < list.size() && !intersects(*(*firsts)[i], *list[k])) ++k;
                found += k;
            }
            return found;
        },
        known);
}

ClipPtr with_spacing(const Clip& clip, double dt) {
    return std::make_shared<const Clip>(dt, std::vector(clip.samples().begin(), clip.samples().end()));
}

/// Pairs in a room, from such a start on, of samples of such a length; `aligned`: all begin at multiples of it.
void add_times(Bench& bench, const std::string& name, double seconds, double start, double dt, bool aligned,
               double ratio = 1) {
    test::Random random(12);
    std::vector<const Tree*> trees, others;
    for (int i = 0; i < 14; ++i) {
        const ClipPtr clip = bench::walk(random, seconds);
        trees.push_back(&bench.tree_of(with_spacing(*clip, dt)));
        others.push_back(&bench.tree_of(with_spacing(*clip, dt * ratio)));
    }
    const int samples = static_cast<int>(seconds * 30);
    std::vector<PlacedBlocks> sides;
    for (int i = 0; i < 4096; ++i) {
        Placement at = bench::somewhere(random, 0);
        const double later = i % 2 == 0 ? 0 : random.real(-1.2, 1.2) * samples;
        at.start = start + dt * (aligned ? std::round(later) : later);
        const std::size_t clip = static_cast<std::size_t>(random.integer(0, 13));
        sides.emplace_back(*(i % 2 == 0 ? trees : others)[clip]->blocks(), at);
    }
    bench.add_pairs(name, std::move(sides));
}

/// A walk of `seconds` straight ahead.
ClipPtr straight(test::Random& random, double seconds) {
    std::vector<Disk> samples;
    const double heading = random.real(0, 6.28), step = random.real(1, 1.6) / 30;
    for (int i = 0; i < static_cast<int>(seconds * 30); ++i)
        samples.push_back({i * step * std::cos(heading), i * step * std::sin(heading), 0.4});
    return std::make_shared<const Clip>(1.0 / 30, std::move(samples));
}

/// Two that walk the same way, with so much between their disks where these are largest. A unit is a sample.
void add_side_by_side(Bench& bench, double clearance, bool winding) {
    test::Random random(13);
    std::vector<PlacedBlocks> sides;
    std::vector<ClipPtr> clips;
    constexpr double kSeconds = 60;
    for (int i = 0; i < 8; ++i) clips.push_back(winding ? bench::wander(random, kSeconds) : straight(random, kSeconds));
    struct Pair {
        PlacedTree a, b;
    };
    auto trees = std::make_shared<std::vector<Pair>>();
    const std::string name =
        std::to_string(std::lround(clearance * 100)) + " cm, " + (winding ? "winding" : "straight");
    const double far = clearance + 2 * (winding ? 0.47 : 0.4);
    for (const ClipPtr& clip : clips) {
        // A path beside the path: as far to its left as leaves the clearance.
        std::vector<Disk> beside;
        const auto disks = clip->samples();
        for (std::size_t i = 0; i < disks.size(); ++i) {
            const Disk& from = disks[i > 0 ? i - 1 : i];
            const Disk& to = disks[i + 1 < disks.size() ? i + 1 : i];
            const double way = std::hypot(to.x - from.x, to.y - from.y);
            beside.push_back(
                {disks[i].x - far * (to.y - from.y) / way, disks[i].y + far * (to.x - from.x) / way, disks[i].r});
        }
        const auto other = std::make_shared<const Clip>(clip->dt(), std::move(beside));
        const Placement later{.start = 0.01};
        sides.emplace_back(*bench.tree_of(clip).blocks(), Placement{});
        sides.emplace_back(*bench.tree_of(other).blocks(), later);
        trees->push_back({{bench.tree_of(clip, TreeKind::mobb), {}}, {bench.tree_of(other, TreeKind::mobb), later}});
    }
    std::size_t known = 0;
    for (const Pair& pair : *trees) known += direct_search(pair.a.samples(), pair.b.samples()) ? 1U : 0U;
    bench.add_pairs("side by side, " + name, std::move(sides), kSeconds * 30);
    bench.add(
        "side by side, " + name + ", MOBB leaf 50", static_cast<std::size_t>(kSeconds * 30) * trees->size(),
        [trees] {
            std::size_t found = 0;
            for (const Pair& pair : *trees) found += query(pair.a, pair.b) ? 1U : 0U;
            return found;
        },
        known);
}

void measure(Bench& bench, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        for (Row& row : bench.rows) {
            row.ask();  // so that whatever was asked before leaves no mark on caches and predictors
            const double begin = nanoseconds_now();
            row.ask();
            row.times.push_back((nanoseconds_now() - begin) / row.units);
        }
    }
    for (const Row& row : bench.rows) {
        std::printf("%s", row.name.c_str());
        for (const double time : row.times) std::printf("\t%.4f", time);
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 20;
    Bench bench;
    if (argc > 2) bench.part = argv[2];
    add_any(bench, "2 s, within 12 m", 2, 12);
    add_any(bench, "2 s, within 6 m", 2, 6);
    add_any(bench, "2 s, within 4 m", 2, 4);
    add_any(bench, "2 s, within 2.5 m", 2, 2.5);
    add_any(bench, "42 s, within 6 m", 42, 6);
    constexpr double kUnixTime = 1.7e9, kFrame = 1.0 / 30;
    for (const double seconds : {2.0, 42.0}) {
        const std::string length = seconds > 10 ? "42 s" : "2 s";
        for (const bool aligned : {false, true}) {
            const std::string label = length + (aligned ? ", aligned" : "");
            add_times(bench, label + ", from 0 on", seconds, 0, kFrame, aligned);
            add_times(bench, label + ", from 1.7e9 s on", seconds, kUnixTime, kFrame, aligned);
            add_times(bench, label + ", 1 s a sample", seconds, 0, 1, aligned);
            add_times(bench, label + ", 2.5 s a sample", seconds, 0, 2.5, aligned);
        }
        add_times(bench, length + " and 1.25 times that, from 0 on", seconds, 0, kFrame, false, 1.25);
        add_times(bench, length + " and 1.25 times that, from 1.7e9 s on", seconds, kUnixTime, kFrame, false, 1.25);
        add_times(bench, length + " and 1.25 times that, 1 s a sample", seconds, 0, 1, false, 1.25);
        add_times(bench, length + " and 1.25 times that, 2.5 s a sample", seconds, 0, 2.5, false, 1.25);
    }
    for (const double clearance : {0.02, 0.05, 0.1}) {
        for (const bool winding : {false, true}) add_side_by_side(bench, clearance, winding);
    }
    if (bench.right) measure(bench, rounds);
    return bench.right ? 0 : 1;
}
