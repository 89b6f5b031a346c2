/// This library beside others on the same queries, in turns, in one run. Every answer is compared with the direct
/// search's: one that differs ends it with status 1.
///
/// Usage: bench_peers [--queries N] [--rounds N] [long|short [CLIP.csv...]]
/// Without clips: built-in ones. They are placed as bench/compare does it.
#include <mobb/blocks.h>
#include <paper_tables/built_in_clips.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../clip_csv.h"
#include "peer.h"

namespace {

using namespace mobbscope;
using namespace mobbscope::bench;

constexpr std::size_t kSlices = 10;

/// Of all threads, as Embree may have some.
double processor_nanoseconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

/// This library: Source over each clip, placed as Placed, asked by Ask.
template <class Placed, class Source, class Ask>
class OwnPeer : public Peer {
  public:
    OwnPeer(std::vector<Source> sources, Ask ask) : sources_(std::move(sources)), ask_(ask) {}

    void place(std::span<const WorkloadQuery> queries) override {
        placed_.clear();
        for (const WorkloadQuery& query : queries) {
            placed_.emplace_back(*sources_[static_cast<std::size_t>(query.clip_a)], query.a);
            placed_.emplace_back(*sources_[static_cast<std::size_t>(query.clip_b)], query.b);
        }
    }
    void ask(std::span<char> answers) override {
        for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = ask_(placed_[2 * i], placed_[2 * i + 1]);
    }

  private:
    std::vector<Source> sources_;
    std::vector<Placed> placed_;
    Ask ask_;
};

template <class Placed, class Source, class Ask>
std::unique_ptr<Peer> own(std::vector<Source> sources, Ask ask) {
    return std::make_unique<OwnPeer<Placed, Source, Ask>>(std::move(sources), ask);
}

std::unique_ptr<Peer> direct_peer(const Clips& clips) {
    return own<mobb::PlacedClip>(clips, [](const auto& a, const auto& b) { return direct_search(a, b).has_value(); });
}

std::unique_ptr<Peer> tree_peer(const Clips& clips, const mobb::FitOptions& options) {
    std::vector<std::unique_ptr<const mobb::Tree>> trees;
    for (const mobb::ClipPtr& clip : clips) trees.push_back(std::make_unique<const mobb::Tree>(clip, options));
    return own<mobb::PlacedTree>(std::move(trees),
                                 [](const auto& a, const auto& b) { return query(a, b).has_value(); });
}

std::vector<std::unique_ptr<const mobb::Blocks>> blocks_of(const Clips& clips) {
    std::vector<std::unique_ptr<const mobb::Blocks>> out;
    for (const mobb::ClipPtr& clip : clips) out.push_back(std::make_unique<const mobb::Blocks>(clip));
    return out;
}
std::unique_ptr<Peer> blocks_peer(const Clips& clips) {
    return own<mobb::PlacedBlocks>(blocks_of(clips), [](const auto& a, const auto& b) { return intersects(a, b); });
}

/// A clip and where it is to be placed.
struct Place {
    const mobb::Blocks* blocks;
    mobb::Placement at;

    Place(const mobb::Blocks& of, const mobb::Placement& placement) : blocks(&of), at(placement) {}
    mobb::PlacedBlocks placed() const { return {*blocks, at}; }
};
/// Both clips are placed anew in each query.
std::unique_ptr<Peer> placing_peer(const Clips& clips) {
    return own<Place>(blocks_of(clips),
                      [](const auto& a, const auto& b) { return intersects(a.placed(), b.placed()); });
}

/// The first one is what the others are compared with.
std::vector<NamedPeer> peers_of(const Clips& clips) {
    std::vector<NamedPeer> out;
    out.push_back({"MOBB, leaf 10", tree_peer(clips, {.leaf = 10})});
    out.push_back({"MOBB, leaf 50", tree_peer(clips, {.leaf = 50})});
    out.push_back({"blocks", blocks_peer(clips)});
    out.push_back({"blocks, placed in each query", placing_peer(clips)});
    out.push_back({"direct search", direct_peer(clips)});
    [[maybe_unused]] const auto add = [&](const char* name, auto make, std::initializer_list<int> sizes) {
        for (const int samples : sizes) {
            out.push_back(
                {std::string(name) + ", " + std::to_string(samples) + " samples a box", make(clips, samples)});
        }
    };
#ifdef MOBBSCOPE_BULLET
    add("Bullet btDbvt", bullet_peer, {1, 4, 16});
#else
    std::puts("skipped: Bullet (package libbullet-dev)");
#endif
#ifdef MOBBSCOPE_FCL
    add("FCL BVHModel<OBB>", fcl_peer, {1, 4, 16});
#else
    std::puts("skipped: FCL (package libfcl-dev)");
#endif
#ifdef MOBBSCOPE_EMBREE
    add("Embree rtcCollide", embree_peer, {4, 16});
#else
    std::puts("skipped: Embree (package libembree-dev)");
#endif
#ifdef MOBBSCOPE_BOOST
    add("Boost rtree", boost_peer, {4, 16});
#else
    std::puts("skipped: Boost.Geometry (package libboost-dev)");
#endif
    return out;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// False where an answer differs.
bool run(bool long_clips, const std::vector<std::string>& files, std::size_t queries, int rounds) {
    Clips clips;
    for (const std::string& file : files) clips.push_back(mobb::bench::clip_from_csv(file));
    // As bench/compare has them.
    const QueryDraw draw = long_clips ? QueryDraw{.range = 3.5, .offset = 1.2}
                                      : QueryDraw{.range = files.empty() ? 3.0 : 3.6, .offset = 1 / 0.45};
    if (clips.empty()) clips = long_clips ? walks_in_a_volume(14, 42, 1) : short_moves(51, 2.1, 1);
    const std::vector<WorkloadQuery> all = random_queries(clips, static_cast<int>(queries), draw);
    std::vector<NamedPeer> peers = peers_of(clips);

    const auto slice = [&](std::size_t i) {
        return std::span(all).subspan(all.size() * i / kSlices,
                                      all.size() * (i + 1) / kSlices - all.size() * i / kSlices);
    };
    std::vector<char> truth(all.size()), answers(all.size());
    const std::unique_ptr<Peer> direct = direct_peer(clips);
    direct->place(all);
    direct->ask(truth);
    for (const NamedPeer& peer : peers) {
        peer.peer->place(all);
        peer.peer->ask(answers);
        if (answers != truth) {
            std::printf("%s DIFFERS from the direct search\n", peer.name.c_str());
            return false;
        }
    }

    struct Times {
        std::vector<double> rounds, least = std::vector<double>(kSlices, 1e300);
    };
    std::vector<Times> times(peers.size());
    std::vector<std::size_t> turns(peers.size());
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = i;
    std::mt19937 engine(1);
    for (int round = 0; round < rounds; ++round) {
        for (Times& each : times) each.rounds.push_back(0);
        for (std::size_t s = 0; s < kSlices; ++s) {
            std::shuffle(turns.begin(), turns.end(), engine);
            for (const std::size_t p : turns) {
                peers[p].peer->place(slice(s));
                const double begin = processor_nanoseconds();
                peers[p].peer->ask(std::span(answers).first(slice(s).size()));
                const double taken = processor_nanoseconds() - begin;
                times[p].rounds.back() += taken;
                times[p].least[s] = std::min(times[p].least[s], taken);
            }
        }
    }
    const auto count = static_cast<double>(all.size());
    const auto least = [&](const Times& each) {
        double sum = 0;
        for (const double x : each.least) sum += x;
        return sum / count;
    };
    std::printf("\n%s clips: %zu queries, %.1f %% collide; all answers are the direct search's\n%-34s %12s %12s %12s\n",
                long_clips ? "long" : "short", all.size(),
                100 * static_cast<double>(std::count(truth.begin(), truth.end(), 1)) / count, "ns a query", "least",
                "median", "times MOBB's");
    for (std::size_t p = 0; p < peers.size(); ++p) {
        std::printf("%-34s %12.1f %12.1f %12.2f\n", peers[p].name.c_str(), least(times[p]),
                    median(times[p].rounds) / count, least(times[p]) / least(times[0]));
    }
    return true;
}

int run(int argc, char** argv) {
    std::size_t queries = 20000;
    int rounds = 5;
    std::string workload;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--queries" && i + 1 < argc) {
            queries = std::strtoull(argv[++i], nullptr, 10);
        } else if (word == "--rounds" && i + 1 < argc) {
            rounds = std::atoi(argv[++i]);
        } else if (workload.empty() && (word == "long" || word == "short")) {
            workload = word;
        } else if (!workload.empty() && !word.starts_with('-')) {
            files.emplace_back(word);
        } else {
            std::fprintf(stderr, "bench_peers: usage: [--queries N] [--rounds N] [long|short [CLIP.csv...]]\n");
            return 2;
        }
    }
    bool right = true;
    if (workload != "short") right = run(true, files, queries, rounds) && right;
    if (workload != "long") right = run(false, files, queries, rounds) && right;
    return right ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_peers: %s\n", error.what());
        return 2;
    }
}
