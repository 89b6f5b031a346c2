#include <base/sentences.h>
#include <base/text.h>
#include <scene/clip_turn.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <array>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kJoint = 1e-6;  // metres, seconds, degrees: more than rounding, far less than a sample
constexpr std::array<std::string_view, 3> kKinds{"chosen", "pivoted", "forced"};

PlayKind read_kind(const JsonPlace& place) {
    if (const auto kind = enumerator_named<PlayKind>(kKinds, place.string())) return *kind;
    place.fail(in_quotes(place.string()) + " is not a kind of play; give " + listed(kKinds));
}

/// Where the body stands and faces in the first sample's place, in the world.
Stance placed(const Stance& stance, const mobb::Placement& placement) {
    return {placement.rotation()(stance.position) + placement.translate, stance.heading_deg + placement.rotate_deg};
}

class CrowdReader {
  public:
    CrowdReader(const JsonPlace& place, const Scene& scene) : place_(place), scene_(scene) {}

    CrowdRun read() {
        if (!scene_.graph) place_.fail("a crowd plays the moves of a graph; add the key graph");
        if (!scene_.agents.empty() || !scene_.queries.empty()) {
            place_.fail("a scene has a crowd, or agents and queries, not both; remove one");
        }
        place_.allow_only({"area", "seconds", "seed", "ahead", "grace", "plan", "turn_rate", "agents"});
        const JsonPlace area = place_.require("area");
        area.require_size(2, "[width, depth] in metres");
        run_.area = {positive(area[0], mobb::kMaxLength), positive(area[1], mobb::kMaxLength)};
        run_.seconds = positive(place_.require("seconds"), mobb::kMaxTime);
        run_.seed = read_seed(place_.require("seed"));
        if (const auto ahead = place_.find("ahead")) run_.ahead = ahead->number(0, mobb::kMaxTime);
        if (const auto grace = place_.find("grace")) run_.grace = grace->number(0, mobb::kMaxTime);
        if (const auto plan = place_.find("plan")) run_.plan = plan->number(0, mobb::kMaxTime);
        if (const auto rate = place_.find("turn_rate")) run_.turn_rate = rate->number(0, kMaxTurnRate);
        const JsonPlace agents = place_.require("agents");
        if (agents.size() == 0) agents.fail("there is no agent; add one");
        for (int i = 0; i < agents.size(); ++i) run_.agents.push_back(read_agent(agents[i]));
        return std::move(run_);
    }

  private:
    static double positive(const JsonPlace& place, double most) {
        const double value = place.number(0, most);
        if (value == 0) place.fail("must be over 0");
        return value;
    }

    static std::uint64_t read_seed(const JsonPlace& place) {
        // Beyond 2^53 a double no longer tells whole numbers apart.
        const double seed = place.number(0, static_cast<double>(kMaxSeed));
        if (seed != std::floor(seed)) place.fail(format_double(seed) + " is not a seed; give a whole number");
        return static_cast<std::uint64_t>(seed);
    }

    CrowdAgent read_agent(const JsonPlace& place) {
        place.allow_only({"name", "plays"});
        const JsonPlace name = place.require("name");
        if (name.string().empty()) name.fail("an agent needs a name");
        if (!names_.insert(name.string()).second) {
            name.fail("another agent is named " + in_quotes(name.string()) + "; rename one");
        }
        CrowdAgent agent{name.string(), {}};
        const JsonPlace plays = place.require("plays");
        if (plays.size() == 0) plays.fail("an agent plays one move at least; add one");
        agent.plays.reserve(static_cast<std::size_t>(plays.size()));
        for (int i = 0; i < plays.size(); ++i) {
            const JsonPlace at = plays[i];
            const Play play = read_play(at);
            if (i > 0) check_joint(at, agent.plays.back(), play);
            agent.plays.push_back(play);
        }
        return agent;
    }

    Play read_play(const JsonPlace& place) const {
        place.allow_only({"move", "translate", "rotate_deg", "start", "chosen_at", "kind", "plan"});
        Play play;
        const JsonPlace move = place.require("move");
        play.move = move.integer(0, static_cast<int>(scene_.graph->moves.size()) - 1);
        play.placement.translate = place.require("translate").vector<glm::dvec2>(mobb::kMaxLength, "[x, y] in metres");
        play.placement.rotate_deg = place.require("rotate_deg").number(-1e9, 1e9);
        const JsonPlace start = place.require("start");
        play.placement.start = start.number(-mobb::kMaxTime, mobb::kMaxTime);
        const mobb::Clip& clip = clip_of(scene_.graph->moves[static_cast<std::size_t>(play.move)]);
        start.attempt([&] { mobb::checked(play.placement, clip.most_start()); });
        const auto chosen_at = place.find("chosen_at");
        play.chosen_at = chosen_at ? chosen_at->number(-mobb::kMaxTime, play.placement.start) : play.placement.start;
        if (const auto kind = place.find("kind")) play.kind = read_kind(*kind);
        if (const auto plan = place.find("plan")) play.plan = read_plan(*plan, play);
        return play;
    }

    std::vector<PlannedMove> read_plan(const JsonPlace& place, const Play& play) const {
        std::vector<PlannedMove> out;
        int last = play.move;
        mobb::Placement at = play.placement;
        for (int i = 0; i < place.size(); ++i) {
            const JsonPlace pair = place[i];
            pair.require_size(2, "[move, turn in degrees]");
            const JsonPlace move = pair[0], turn = pair[1];
            const PlannedMove next{move.integer(0, static_cast<int>(scene_.graph->moves.size()) - 1),
                                   turn.number(-180, 180)};
            const GraphMove& from = scene_.graph->moves[static_cast<std::size_t>(last)];
            const GraphMove& to = scene_.graph->moves[static_cast<std::size_t>(next.move)];
            if (to.turned) move.fail("that move is turned itself; name the one that it is a variant of");
            if (from.to != to.from) {
                pair.fail("begins in hub " + hub(to.from) + ", but the move before ends in " + hub(from.to));
            }
            check_turn(turn, to);
            Stance exit = i == 0 ? from.exit : turned_exit(pair, out.back());
            if (run_.turn_rate == kTurnsAtOnce) exit.heading_deg += next.turn_deg;
            at = following(at, exit, clip_of(from).until_next(), to.entry);
            if (!mobb::is_valid(at, clip_of(to).most_start()))
                pair.fail("leads beyond what can be placed; leave it out");
            last = next.move;
            out.push_back(next);
        }
        return out;
    }

    /// A turn that the run's agents can make on the way of a move.
    void check_turn(const JsonPlace& place, const GraphMove& move) const {
        const double turn = place.number();
        if (std::remainder(turn, kTurnStep) != 0)
            place.fail(brief(turn) + " degrees are not a multiple of " + brief(kTurnStep));
        if (turn == 0 || run_.turn_rate == kTurnsAtOnce) return;
        const double seconds = turn_at_rate(turn, run_.turn_rate).seconds;
        const double lasts = clip_of(move).until_next();
        if (seconds <= lasts) return;
        const auto [has, takes] = told_apart(lasts, seconds, brief);
        place.fail("the move lasts " + has + " s, but at " + brief(run_.turn_rate) + " degrees/s a turn by " +
                   brief(turn) + " degrees takes " + takes + " s; turn less");
    }

    /// Where a planned move leads that turns on its way.
    Stance turned_exit(const JsonPlace& place, const PlannedMove& planned) const {
        const GraphMove& move = scene_.graph->moves[static_cast<std::size_t>(planned.move)];
        if (planned.turn_deg == 0 || run_.turn_rate == kTurnsAtOnce) return move.exit;
        const ClipTurn turn = turn_at_rate(planned.turn_deg, run_.turn_rate);
        return place.attempt([&] { return bent_exit(clip_of(move), *bent(clip_of(move), turn), move.exit, turn); });
    }

    const mobb::Clip& clip_of(const GraphMove& move) const {
        return *scene_.clips[static_cast<std::size_t>(move.clip)].clip;
    }

    void check_joint(const JsonPlace& place, const Play& before, const Play& play) const {
        const GraphMove& from = scene_.graph->moves[static_cast<std::size_t>(before.move)];
        const GraphMove& to = scene_.graph->moves[static_cast<std::size_t>(play.move)];
        if (from.to != to.from) {
            place.require("move").fail("begins in hub " + hub(to.from) + ", but the move before ends in " +
                                       hub(from.to));
        }
        const double end = before.placement.start + clip_of(from).until_next();
        if (!(std::abs(play.placement.start - end) <= kJoint)) {
            place.require("start").fail("the play before ends at " + format_double(end) + " s; begin there");
        }
        if (play.chosen_at < before.chosen_at) {
            place.fail("chosen at " + format_double(play.chosen_at) + " s, before the play before it, at " +
                       format_double(before.chosen_at) + " s");
        }
        const Stance left = placed(from.exit, before.placement);
        const Stance taken = placed(to.entry, play.placement);
        const glm::dvec2 gap = taken.position - left.position;
        if (!(std::hypot(gap.x, gap.y) <= kJoint)) {
            place.require("translate")
                .fail("begins at (" + format_double(taken.position.x) + ", " + format_double(taken.position.y) +
                      "), but the play before ends at (" + format_double(left.position.x) + ", " +
                      format_double(left.position.y) + ")");
        }
        const double turn = std::remainder(taken.heading_deg - left.heading_deg, 360.0);
        const bool may_turn = run_.turn_rate == kTurnsAtOnce && play.kind != PlayKind::chosen;
        if (!may_turn && !(std::abs(turn) <= kJoint)) {
            place.require("rotate_deg")
                .fail("faces " + brief(turn) +
                      " degrees off the end of the play before; only a pivoted one may, in a "
                      "run without turn_rate");
        }
    }

    std::string hub(int index) const { return in_quotes(scene_.graph->hubs[static_cast<std::size_t>(index)].name); }

    const JsonPlace& place_;
    const Scene& scene_;
    CrowdRun run_;
    std::unordered_set<std::string> names_;
};

void write_play(JsonWriter& out, const Play& play) {
    out.begin_object(JsonWriter::Layout::row);
    const mobb::Placement& at = play.placement;
    out.members("move", play.move, "translate", at.translate, "rotate_deg", at.rotate_deg, "start", at.start);
    if (play.chosen_at != play.placement.start) out.member("chosen_at", play.chosen_at);
    if (play.kind != PlayKind::chosen) out.member("kind", name(play.kind));
    if (!play.plan.empty()) {
        out.list("plan", play.plan, [&](const PlannedMove& next) { out.tuple(next.move, next.turn_deg); });
    }
    out.end_object();
}

}  // namespace

std::string_view name(PlayKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::shared_ptr<const CrowdRun> read_crowd(const JsonPlace& place, const Scene& scene) {
    return std::make_shared<CrowdRun>(CrowdReader(place, scene).read());
}

void write_crowd(JsonWriter& out, const CrowdRun& crowd) {
    out.begin_object();
    out.members("area", crowd.area, "seconds", crowd.seconds, "seed", crowd.seed);
    out.members("ahead", crowd.ahead, "grace", crowd.grace);
    if (crowd.plan != 0) out.member("plan", crowd.plan);
    if (crowd.turn_rate != kTurnsAtOnce) out.member("turn_rate", crowd.turn_rate);
    out.list("agents", crowd.agents, [&](const CrowdAgent& agent) {
        out.begin_object();
        out.member("name", agent.name);
        out.list("plays", agent.plays, [&](const Play& play) { write_play(out, play); });
        out.end_object();
    });
    out.end_object();
}

}  // namespace mobbscope
