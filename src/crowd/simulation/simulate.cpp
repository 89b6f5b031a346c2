#include <base/error.h>
#include <base/random.h>
#include <base/text.h>
#include <base/threads.h>
#include <crowd/simulation/plan_search.h>
#include <crowd/simulation/simulate.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kLeastMove = 0.01;  // seconds: of shorter ones a run would have no end of choices
constexpr double kReports = 100;     // of progress in a run

struct Turn {
    double time;
    int agent;
    bool operator>(const Turn& other) const { return std::tie(time, agent) > std::tie(other.time, other.agent); }
};

class Simulator {
  public:
    Simulator(const MoveSet& moves, const SimulateOptions& options, QuerySample* sample,
              const SimulationProgress& progress)
        : moves_(moves),
          options_(options),
          sample_(sample),
          progress_(progress),
          reservations_(moves, options.area, options.grace) {
        simulation_.run = {options.area,  options.seconds, options.seed,      options.ahead,
                           options.grace, options.plan,    moves.turn_rate(), {}};
    }

    Simulation run() {
        refuse_unplayable();
        for (int agent = 0; agent < options_.agents; ++agent) {
            place(agent);
            if (is_time_to_tell()) tell(0);
        }
        while (!turns_.empty()) {
            const Turn turn = turns_.top();
            turns_.pop();
            reservations_.forget_before(turn.time);
            make_choice(turn);
            if (turn.time >= counts().simulated + options_.seconds / kReports || is_time_to_tell()) tell(turn.time);
        }
        tell(options_.seconds);
        return std::move(simulation_);
    }

  private:
    SimulationCounts& counts() { return simulation_.counts; }

    /// Whoever waits is not left without a word for long, however slow the run is.
    bool is_time_to_tell() const { return std::chrono::steady_clock::now() - told_ > std::chrono::seconds(1); }

    /// `looked_at`: in the midst of a choice.
    void tell(double time, std::int64_t looked_at = 0) {
        told_ = std::chrono::steady_clock::now();
        counts().simulated = time;
        counts().looked_at = looked_at;
        if (progress_) progress_(counts());
    }

    void refuse_unplayable() const {
        const std::string file = moves_.fitted().scene().file.string();
        if (moves_.unturned().empty()) throw InputError(file, "the graph has no move; add one");
        for (const int move : moves_.unturned()) {
            if (const mobb::Clip& clip = moves_.clip(move).clip(); options_.seconds > clip.most_start()) {
                throw InputError(file, "move " + std::to_string(move) + " of the graph has a dt of " +
                                           brief(clip.dt()) + " s: doubles tell its samples' times apart within " +
                                           figure(std::max(clip.most_start(), 0.0), 3) + " s; simulate fewer than " +
                                           brief(options_.seconds) + " s, or give a larger dt");
            }
            if (moves_.until_next(move) < kLeastMove) {
                throw InputError(file, "move " + std::to_string(move) + " of the graph lasts " +
                                           brief(moves_.until_next(move)) + " s; a crowd plays moves of " +
                                           brief(kLeastMove) + " s and more: remove it");
            }
            if (!moves_.after(move).empty()) continue;
            const GraphMove& last = moves_.move(move);
            throw InputError(file, "hub " + in_quotes(moves_.graph().hubs[static_cast<std::size_t>(last.to)].name) +
                                       " of the graph is a dead end: no move begins there; remove what leads to it");
        }
    }

    void place(int agent) {
        if (const auto play = first_play(moves_, reservations_, simulation_.run, agent, search_)) {
            simulation_.run.agents.push_back({std::to_string(agent + 1), {}});
            ++counts().agents;
            return commit(agent, *play);
        }
        throw InputError("there is no room for agent " + std::to_string(agent + 1) + " of " +
                         std::to_string(options_.agents) + " on a floor of " + brief(options_.area.x) + " x " +
                         brief(options_.area.y) + " m; give fewer agents or a larger area");
    }

    void make_choice(const Turn& turn) {
        const std::vector<Play>& plays = simulation_.run.agents[static_cast<std::size_t>(turn.agent)].plays;
        const ChoicePoint point{turn.agent, static_cast<int>(plays.size()), plays.back(), turn.time};
        asked_.clear();
        const bool records_asked = sample_ && sample_->recorded() == Recorded::asked;
        const Choice choice =
            choose(moves_, reservations_, simulation_.run, point, search_, records_asked ? &asked_ : nullptr);
        const Candidate& taken = choice.candidates[choice.taken];
        if (sample_) record(choice, point);
        count(choice);
        commit(turn.agent, {taken.played, taken.placement, turn.time, choice.kind, choice.plan});
    }

    void record(const Choice& choice, const ChoicePoint& point) {
        if (sample_->recorded() == Recorded::all) {
            for (const Candidate& candidate : choice.candidates) {
                const PlayedMove motion = moves_.motion(point.agent, point.play, candidate.played, candidate.placement);
                reservations_.motions().all_pairs(motion, sample_->range(), asked_);
                reservations_.plans().all_pairs(motion, sample_->range(), asked_);
            }
        }
        sample_->offer(asked_);
    }

    void count(const Choice& choice) {
        SimulationCounts& c = counts();
        ++c.choices;
        c.candidates += static_cast<std::int64_t>(choice.candidates.size());
        for (const Candidate& candidate : choice.candidates) {
            if (candidate.leaves_floor) {
                ++c.off_floor;
            } else if (candidate.met != Met::nobody) {
                ++c.colliding;
            } else if (candidate.no_way_on) {
                ++c.no_way_on;
            } else if (candidate.in_the_way) {
                ++c.in_the_way;
            }
        }
        c.queries += choice.queries;
        if (choice.kind == PlayKind::pivoted) ++c.pivots;
        if (choice.kind == PlayKind::forced) ++c.forced;
    }

    void commit(int agent, const Play& play) {
        std::vector<Play>& plays = simulation_.run.agents[static_cast<std::size_t>(agent)].plays;
        reservations_.reserve(agent, static_cast<int>(plays.size()), play);
        plays.push_back(play);
        if (++counts().plays > kMostPlays) {
            throw InputError("by " + brief(std::max(0.0, play.placement.start)) + " s the run has more than " +
                             std::to_string(kMostPlays) + " plays; give fewer agents or seconds, or longer moves");
        }
        counts().most_held = std::max(counts().most_held, reservations_.motions().size());
        // The joint is part of the choice: it is made before that.
        const double end = play.placement.start + moves_.until_joint(play.move);
        if (end < options_.seconds) turns_.push({std::max(0.0, end - options_.ahead), agent});
    }

    const MoveSet& moves_;
    const SimulateOptions& options_;
    QuerySample* sample_;
    const SimulationProgress& progress_;
    ReservationTable reservations_;
    Simulation simulation_;
    PlanSearch search_{moves_, reservations_, simulation_.run, [this] {
                           if (is_time_to_tell()) tell(counts().simulated, search_.looks());
                       }};
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns_;
    std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
    std::vector<AskedPair> asked_;  ///< at the present choice point
};

void check_range(const char* option, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw std::invalid_argument(std::string(option) + " is " + brief(value) + "; give a number from " + brief(low) +
                                " to " + brief(high));
}

}  // namespace

void check(const SimulateOptions& options) {
    check_range("agents", options.agents, 1, kMaxAgents);
    check_range("the area's width", options.area.x, kMinArea, kMaxArea);
    check_range("the area's depth", options.area.y, kMinArea, kMaxArea);
    check_range("seconds", options.seconds, kMinSimulated, kMaxSimulated);
    check_range("seed", static_cast<double>(options.seed), 0, static_cast<double>(kMaxSeed));
    check_range("ahead", options.ahead, 0, kMaxSimulated);
    check_range("grace", options.grace, 0, kMaxSimulated);
    check_range("plan", options.plan, 0, kMaxSimulated);
    check_range("threads", options.threads, 0, kMaxThreads);
}

Simulation simulate(const MoveSet& moves, const SimulateOptions& options, QuerySample* sample,
                    const SimulationProgress& progress) {
    check(options);
    limit_worker_threads();
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    return arena.execute([&] { return Simulator(moves, options, sample, progress).run(); });
}

void QuerySample::offer(std::span<const AskedPair> pairs) {
    for (const AskedPair& pair : pairs) {
        if (pair.candidate.is_joint || pair.reserved.is_joint) continue;
        const std::uint64_t number = offered_++;
        if (size_ == 0 || kept_.size() < size_) {
            kept_.push_back({number, pair});
            continue;
        }
        const std::uint64_t place = CounterRandom(seed_, number, 0).next() % offered_;
        if (place < size_) kept_[place] = {number, pair};
    }
}

Scene QuerySample::workload(const MoveSet& moves) const {
    std::vector<Kept> ordered = kept_;
    std::ranges::sort(ordered, {}, &Kept::number);
    std::vector<int> used;
    for (const Kept& kept : ordered) {
        used.push_back(kept.pair.candidate.move);
        used.push_back(kept.pair.reserved.move);
    }
    MoveSet::Extended extended = moves.extended(used);
    Scene& out = extended.scene;
    const auto agent = [&](const PlayedMove& motion) {
        const int move = extended.index[static_cast<std::size_t>(motion.move)];
        const int clip = out.graph->moves[static_cast<std::size_t>(move)].clip;
        return PlacedAgent{out.clips[static_cast<std::size_t>(clip)].name, clip, motion.at, -1};
    };
    out.queries.reserve(ordered.size());
    for (const Kept& kept : ordered)
        out.queries.push_back({agent(kept.pair.candidate), agent(kept.pair.reserved), {}, {}});
    out.graph = nullptr;
    out.view = {};
    return std::move(out);
}

Scene scene_of_run(const MoveSet& moves, CrowdRun run, TurnedSkeletons skeletons) {
    std::vector<int> used;
    for (const CrowdAgent& agent : run.agents) {
        for (const Play& play : agent.plays) used.push_back(play.move);
    }
    auto [scene, index] = moves.extended(used, skeletons);
    for (CrowdAgent& agent : run.agents) {
        for (Play& play : agent.plays) play.move = index[static_cast<std::size_t>(play.move)];
    }
    scene.crowd = std::make_shared<const CrowdRun>(std::move(run));
    return std::move(scene);
}

void remove_run(Scene& scene) {
    scene.crowd = nullptr;
    MotionGraph graph = *scene.graph;
    std::erase_if(graph.moves, [](const GraphMove& move) { return move.turned.has_value(); });
    if (graph.moves.size() == scene.graph->moves.size()) return;
    std::vector<bool> turned(scene.clips.size(), false);
    for (const GraphMove& move : scene.graph->moves) {
        if (move.turned) turned[static_cast<std::size_t>(move.clip)] = true;
    }
    for (const GraphMove& move : graph.moves) turned[static_cast<std::size_t>(move.clip)] = false;
    std::vector<int> index(scene.clips.size());
    std::vector<SceneClip> kept;
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        index[i] = static_cast<int>(kept.size());
        if (!turned[i]) kept.push_back(std::move(scene.clips[i]));
    }
    for (GraphMove& move : graph.moves) move.clip = index[static_cast<std::size_t>(move.clip)];
    scene.clips = std::move(kept);
    scene.graph = std::make_shared<const MotionGraph>(std::move(graph));
}

}  // namespace mobbscope
