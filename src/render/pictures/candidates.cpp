#include <base/sentences.h>
#include <base/text.h>
#include <explain/certificate.h>
#include <explain/clearance.h>
#include <explain/query_sentence.h>
#include <mobb/traversal.h>
#include <render/drawlist/pen.h>
#include <render/layout/annotations.h>
#include <render/layout/caption.h>
#include <render/layout/legend.h>
#include <render/parts/paths.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace mobbscope {

namespace {

constexpr float kThrough = 0.75f;   // opacity that is kept behind people
constexpr float kWayBeyond = 0.4f;  // ... and of a way behind the contact that rules it out
constexpr std::size_t kMostNamed = 3;

const std::string& agent_name(const Scene& run, int agent) {
    return run.crowd->agents[static_cast<std::size_t>(agent)].name;
}

/// "walk, turned by 30°".
std::string name_of(const Scene& run, const PlannedMove& move) {
    const int clip = run.graph->moves[static_cast<std::size_t>(move.move)].clip;
    const std::string& name = run.clips[static_cast<std::size_t>(clip)].name;
    return move.turn_deg == 0 ? name : name + formatted(", turned by %.0f\u00B0", move.turn_deg);
}

/// Draws one choice.
class Drawer {
  public:
    Drawer(DrawList& list, const FittedScene& fitted, const FollowedChoice& followed, const Metrics& metrics)
        : list_(list),
          scene_(fitted.scene()),
          choice_(followed.choice),
          metrics_(metrics),
          pen_(list, {DrawLayer::candidates}) {}

    std::vector<LabelRequest> draw() {
        std::vector<std::size_t> shown = shown_candidates(choice_);
        // What was taken lies above what was free, and that above the rest.
        std::stable_sort(shown.begin(), shown.end(),
                         [&](std::size_t a, std::size_t b) { return outcome_of(choice_, a) > outcome_of(choice_, b); });
        for (const std::size_t candidate : shown) add_way(candidate);
        std::vector<LabelRequest> labels;
        for (const auto& [agent, candidate] : first_met(shown)) add_contact(candidate, labels);
        return labels;
    }

  private:
    /// For each agent that rules out, the candidate that it meets first.
    std::map<int, std::size_t> first_met(const std::vector<std::size_t>& shown) const {
        std::map<int, std::size_t> out;
        for (const std::size_t i : shown) {
            const auto& blocker = choice_.candidates[i].blocker;
            if (!blocker || outcome_of(choice_, i) == CandidateOutcome::leaves_floor) continue;
            const auto [at, is_new] = out.try_emplace(blocker->agent, i);
            if (!is_new && blocker->contact.time < choice_.candidates[at->second].blocker->contact.time) at->second = i;
        }
        return out;
    }

    glm::vec3 point(const mobb::Disk& disk, double time) const {
        if (!list_.moment) return list_.space.point(disk.x, disk.y, time);
        return list_.space.point(disk.x, disk.y, 0);
    }

    /// Of what is drawn here, at the picture's scale.
    LineStyle seen_through(LineStyle style) const {
        style.hidden = kThrough;
        return scaled(style, metrics_.scale);
    }

    void add_way(std::size_t index) {
        const Candidate& candidate = choice_.candidates[index];
        const CandidateOutcome outcome = outcome_of(choice_, index);
        const LineStyle style = seen_through(outcome_style_of(outcome, list_.palette));
        LineStyle beyond = style;
        beyond.color.a *= kWayBeyond;
        const mobb::PlacedClip way(*candidate.clip, candidate.placement);
        int contact = way.count();
        if (outcome == CandidateOutcome::ruled_out)
            contact = candidate.blocker->before_candidate ? 0 : candidate.blocker->contact.a_sample;
        // Pieces as long as a dash and its gap, or the pattern would be cut short.
        const float pixels = list_.projection.pixels_per_metre(point(way.disk(0), way.time(0)));
        const float pattern = style.dash.x + style.dash.y + style.dash.z + style.dash.w;
        const float shortest = pixels > 0 ? std::max(pattern, 2 * metrics_.scale) / pixels : 0;
        glm::vec3 from = point(way.disk(0), way.time(0));
        for (int i = 1; i < way.count(); ++i) {
            const glm::vec3 to = point(way.disk(i), way.time(i));
            if (i != contact && i + 1 < way.count() && glm::length(to - from) < shortest) continue;
            pen_.line(from, to, i <= contact ? style : beyond);
            from = to;
        }
        // Where a way ends that could be walked there is a ring.
        const float at_end = list_.projection.pixels_per_metre(from);
        if (outcome == CandidateOutcome::ruled_out || at_end <= 0) return;
        const float radius = (outcome == CandidateOutcome::taken ? 4.5f : 3) * metrics_.scale / at_end;
        pen_.ring(from, radius, list_.projection.right, list_.projection.up, 12,
                  {.color = style.color, .width = style.width, .hidden = kThrough});
    }

    /// The outline of a disk.
    void add_outline(const mobb::Disk& disk, double time, Rgba color) {
        pen_.ring(point(disk, time), static_cast<float>(disk.r), {1, 0, 0}, {0, 1, 0}, 32, seen_through({color, 1.2f}));
    }

    void add_contact(std::size_t index, std::vector<LabelRequest>& labels) {
        const Candidate& candidate = choice_.candidates[index];
        const Blocker& blocker = *candidate.blocker;
        const mobb::Contact& contact = blocker.contact;
        const mobb::PlacedClip way = blocker.before_candidate
                                         ? mobb::PlacedClip(*candidate.joint->clip, candidate.joint->placement)
                                         : mobb::PlacedClip(*candidate.clip, candidate.placement);
        const mobb::PlacedClip other(*blocker.clip, blocker.placement);
        const mobb::Disk a = mobb::swept(way, contact.a_sample).at(contact.time);
        const mobb::Disk b = mobb::swept(other, contact.b_sample).at(contact.time);
        const Rgba color = outcome_style_of(CandidateOutcome::ruled_out, list_.palette).color;
        add_outline(a, contact.time, color);
        PlacedAgent who;
        who.agent = blocker.agent;
        const Rgba whose = agent_color(scene_, who, blocker.agent);
        add_outline(b, contact.time, outlining(whose, list_.palette));
        // Where they touch first.
        const glm::dvec2 between(b.x - a.x, b.y - a.y);
        const double length = glm::length(between);
        const double share = length > 0 ? std::min(1.0, a.r / length) : 0;
        const glm::vec3 cross = point({a.x + share * between.x, a.y + share * between.y, 0}, contact.time);
        const float pixels = list_.projection.pixels_per_metre(cross);
        if (pixels <= 0) return;
        const float arm = 4.5f * metrics_.scale / pixels;
        for (const float side : {-1.0f, 1.0f}) {
            const glm::vec3 way_of_arm = arm * (list_.projection.right + side * list_.projection.up);
            pen_.line(cross - way_of_arm, cross + way_of_arm, seen_through({color, 2.4f}));
        }
        const auto anchor = list_.projection.project(cross);
        if (!anchor) return;
        LabelRequest label;
        label.text = agent_name(scene_, blocker.agent);
        label.role = TextRole::name;
        label.size = metrics_.text;
        label.color = readable(whose, list_.palette);
        label.border = color;
        label.anchor = *anchor;
        label.directions = {{1, -0.6f}, {-1, -0.6f}, {1, 0.6f}, {-1, 0.6f}, {0, -1}, {0, 1}};
        label.distance = 1.6f * metrics_.text;
        label.pill = true;
        labels.push_back(std::move(label));
    }

    DrawList& list_;
    const Scene& scene_;
    const Choice& choice_;
    const Metrics& metrics_;
    Pen pen_;
};

}  // namespace

CandidateOutcome outcome_of(const Choice& choice, std::size_t candidate) {
    if (candidate == choice.taken) return CandidateOutcome::taken;
    const Candidate& asked = choice.candidates[candidate];
    if (asked.leaves_floor) return CandidateOutcome::leaves_floor;
    if (asked.blocker) return CandidateOutcome::ruled_out;
    if (asked.no_way_on) return CandidateOutcome::no_way_on;
    return asked.in_the_way ? CandidateOutcome::in_the_way : CandidateOutcome::free;
}

LineStyle outcome_style_of(CandidateOutcome outcome, const Palette& palette) {
    switch (outcome) {
        case CandidateOutcome::taken:
            return {palette.text, 3};
        case CandidateOutcome::free:
            return {palette.separated, 1.6f};
        case CandidateOutcome::in_the_way:
            return {palette.overlap, 1.5f, {10, 3, 2, 3}};
        case CandidateOutcome::no_way_on:
            return {palette.accent, 1.5f, {14, 4, 14, 4}};
        case CandidateOutcome::leaves_floor:
            return {palette.apart_in_time, 1.4f, {1.5f, 4, 1.5f, 4}};
        case CandidateOutcome::ruled_out:
            break;
    }
    return {palette.hit, 1.6f, {7, 4, 7, 4}};
}

std::string_view outcome_words(CandidateOutcome outcome) {
    constexpr std::array<std::string_view, 6> kWords{"taken",    "free", "in the way", "no way on", "leaves the floor",
                                                     "ruled out"};
    return kWords[static_cast<std::size_t>(outcome)];
}

std::vector<std::size_t> shown_candidates(const Choice& choice) {
    const double taken = choice.candidates[choice.taken].turn_deg;
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const double turn = choice.candidates[i].turn_deg;
        if (turn == 0 || turn == taken) out.push_back(i);
    }
    return out;
}

std::string candidate_sentence(const Scene& run, const Choice& choice, std::size_t candidate) {
    const Candidate& asked = choice.candidates[candidate];
    std::string text = name_of(run, {asked.move, asked.turn_deg}) + ": ";
    const auto meets = [&] {
        const std::string who = agent_name(run, asked.blocker->agent);
        return "meets " + (asked.blocker->planned > 0 ? "what " + who + " plans" : who) +
               at_time(asked.blocker->contact.time);
    };
    const CandidateOutcome outcome = outcome_of(choice, candidate);
    if (outcome == CandidateOutcome::ruled_out) return text + meets();
    text += outcome_words(outcome);
    if (outcome == CandidateOutcome::taken && asked.blocker) text += ", though it " + meets();
    return text;
}

std::string outcome_counts(const Scene& run, const Choice& choice) {
    int free = 0;
    int in_the_way = 0;
    int no_way_on = 0;
    int off_floor = 0;
    int ruled_out = 0;
    std::set<int> rulers;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const Candidate& candidate = choice.candidates[i];
        if (candidate.leaves_floor) {
            ++off_floor;
        } else if (candidate.no_way_on && i != choice.taken) {
            ++no_way_on;
        } else if (!candidate.blocker) {
            ++(candidate.in_the_way ? in_the_way : free);
        } else {
            ++ruled_out;
            rulers.insert(candidate.blocker->agent);
        }
    }
    std::string text;
    const auto add = [&](int number, const std::string& outcome) {
        text += (text.empty() ? "" : "; ") + std::to_string(number) + ' ' + outcome;
    };
    if (choice.kind != PlayKind::forced) add(free, "free");
    if (ruled_out > 0) {
        std::string names;
        std::size_t named = 0;
        for (const int ruler : rulers) {
            if (named == kMostNamed) break;
            names += (named++ > 0 ? ", " : "") + agent_name(run, ruler);
        }
        if (rulers.size() > named) names += " and " + std::to_string(rulers.size() - named) + " more";
        add(ruled_out, "ruled out by " + names);
    }
    if (in_the_way > 0) add(in_the_way, "in the way of others");
    if (no_way_on > 0) add(no_way_on, no_way_on == 1 ? "has no way on" : "have no way on");
    if (off_floor > 0) add(off_floor, off_floor == 1 ? "leaves the floor" : "leave the floor");
    return text;
}

std::string choice_sentence(const Scene& run, const FollowedChoice& followed) {
    const Choice& choice = followed.choice;
    const std::string count = std::to_string(choice.candidates.size());
    const bool one = choice.candidates.size() == 1;
    std::string text = agent_name(run, followed.agent);
    if (choice.kind == PlayKind::forced) {
        text += " was forced" + at_time(choice.time) + ", as " +
                (one ? "its only move was not free" : "none of its " + count + " moves was free");
    } else {
        text += " chose among " + count + (one ? " move" : " moves") + at_time(choice.time);
    }
    const std::string counts = outcome_counts(run, choice);
    return counts.empty() ? text : text + ": " + counts;
}

std::string edited_run_warning(const Scene& run, const FollowedChoice& followed) {
    if (followed.comes_out) return "";
    const Choice& choice = followed.choice;
    const Play& play =
        run.crowd->agents[static_cast<std::size_t>(followed.agent)].plays[static_cast<std::size_t>(followed.play)];
    const auto named = [&](const PlannedMove& move, PlayKind kind) {
        const std::string name = name_of(run, move);
        return kind == PlayKind::chosen ? name : name + " (" + std::string(mobbscope::name(kind)) + ')';
    };
    const std::optional<TurnedMove>& turned = run.graph->moves[static_cast<std::size_t>(play.move)].turned;
    const PlannedMove played = turned ? PlannedMove{turned->move, turned->deg} : PlannedMove{play.move, 0};
    std::string text = agent_name(run, followed.agent) + " plays " + named(played, play.kind) + at_time(choice.time) +
                       ", but made again the choice is ";
    if (choice.candidates.empty()) {
        text += "none, as there is no room";
    } else {
        const Candidate& taken = choice.candidates[choice.taken];
        text += named({taken.move, taken.turn_deg}, choice.kind);
        if (taken.played == play.move && choice.kind == play.kind) {
            if (candidate_played(play, choice) != choice.taken) text += ", elsewhere";
            if (choice.plan != play.plan) text += ", with another plan";
        }
    }
    return text +
           ": seed, grace, plays or clips were edited since, another version simulated it, or an answer was wrong";
}

DecidingTrace trace_of(const DecidingQuery& query, const mobb::FitOptions& fit) {
    DecidingTrace out{{std::make_shared<const mobb::Tree>(query.candidate.clip, fit),
                       std::make_shared<const mobb::Tree>(query.other.clip, fit)},
                      {}};
    const mobb::PlacedTree a(*out.trees[0], query.candidate.placement), b(*out.trees[1], query.other.placement);
    out.recorded = record(a, b);
    out.step = out.recorded.trace.size() - 1;
    const Clearance clearance = clearance_over_time(a.placed_clip(), b.placed_clip());
    if (out.recorded.contact || !clearance.least) return out;
    const double nearest = clearance.pieces[*clearance.least].least_at;
    for (const TraversalEnd& end : deciding_events(a, b, out.recorded.trace)) {
        if (end.t0 <= nearest) out.step = end.step;
    }
    return out;
}

std::string name_of(const MoveSet& moves, const AskedSide& side) {
    return (side.is_joint ? "joint to " : "") + name_of(moves.fitted().scene(), moves.origin(side.move));
}

std::vector<std::string> difference_lines(const MoveSet& moves, const RunDifference& difference) {
    const Scene& run = moves.fitted().scene();
    const FollowedChoice& remade = difference.remade;
    const Choice& choice = remade.choice;
    std::vector<std::string> out{edited_run_warning(run, remade)};
    // A first play is placed, not chosen.
    if (remade.play == 0) return out;
    out.push_back("then: " + (difference.played ? candidate_sentence(run, choice, *difference.played)
                                                : "what it plays is none of the candidates"));
    out.push_back("now: " + candidate_sentence(run, choice, choice.taken));
    out.push_back(choice_sentence(run, remade));
    if (difference.due) {
        const auto [then, now] = told_apart(choice.time, *difference.due, to_thousandth);
        out.push_back("chosen at " + then + " s, where the simulator chooses at " + now + " s");
    }
    if (difference.played == choice.taken) return out;
    if (!difference.query) {
        if (!difference.other) {
            out.push_back("no single other answer about a candidate leads to what it plays");
            return out;
        }
        const Candidate& about = choice.candidates[difference.other->candidate];
        out.push_back("decided by whether " + name_of(run, {about.move, about.turn_deg}) +
                      (difference.other->about_way ? " ends in somebody's way" : " collides with anybody"));
        return out;
    }
    const DecidingQuery& query = *difference.query;
    const DecidingTrace traced = trace_of(query, moves.fitted().options());
    const auto side = [&](const AskedSide& of) {
        return (of.is_planned ? "what " + agent_name(run, of.agent) + " plans" : agent_name(run, of.agent)) + " (" +
               name_of(moves, of) + at_time(of.placement.start) + ")";
    };
    std::string text = "decided by the query of " + side(query.candidate) + " against " + side(query.other) + ": they ";
    text += traced.recorded.contact ? "collide" + at_time(traced.recorded.contact->time) : "never collide";
    if (traced.step >= 0) {
        const auto named = [&](std::size_t i, const AskedSide& of) {
            const std::string& name = agent_name(run, of.agent);
            return DrawnAgent{.placed = {*traced.trees[i], of.placement}, .name = name, .label = name, .color = {}};
        };
        text += "; " + step_sentence(std::array{named(0, query.candidate), named(1, query.other)},
                                     traced.recorded.trace, traced.step);
    }
    out.push_back(difference.other ? text + "; with the other answer the simulator takes what the run plays" : text);
    return out;
}

std::vector<LabelRequest> add_candidates(DrawList& list, const FittedScene& fitted, const FollowedChoice& followed,
                                         const Metrics& metrics) {
    return Drawer(list, fitted, followed, metrics).draw();
}

std::vector<LabelRequest> add_followed(DrawList& list, const DrawnAgent& followed, double time, double height,
                                       const Metrics& metrics) {
    const std::optional<int> sample = sample_at(followed, time);
    if (!sample || followed.hidden) return {};
    const mobb::Disk disk = mobb::swept(followed.clip(), *sample).at(time);
    const double level = list.moment ? 0 : time;
    constexpr int kPieces = 48;
    Pen pen(list, {DrawLayer::candidates, 1});
    for (const auto& [radius, at_scale_1] : {std::pair(1.25, 2.2f), std::pair(1.5, 1.2f)}) {
        const auto at = [&, r = radius * disk.r](int i) {
            const glm::dvec2 rim = glm::dvec2(disk.x, disk.y) + r * on_circle<double>(i, kPieces);
            return list.space.point(rim.x, rim.y, level);
        };
        const float width = at_scale_1 * metrics.scale;
        pen.path(kPieces, at, {.color = list.palette.accent, .width = width, .hidden = kThrough, .cap = 0.3f * width});
    }
    const auto plate = plate_at(list, followed, disk, list.moment ? height : time, list.palette.accent, metrics);
    if (!plate) return {};
    return {*plate};
}

std::vector<LabelRequest> add_followed(DrawList& list, std::span<const DrawnAgent> paths, int run_agent, double time,
                                       double height, const Metrics& metrics) {
    for (const DrawnAgent& path : paths) {
        if (path.run_agent == run_agent && sample_at(path, time)) {
            return add_followed(list, path, time, height, metrics);
        }
    }
    return {};
}

std::vector<LegendEntry> candidate_legend(const Palette& palette, const Choice& choice) {
    std::vector<LegendEntry> out;
    for (const CandidateOutcome outcome :
         {CandidateOutcome::taken, CandidateOutcome::free, CandidateOutcome::in_the_way, CandidateOutcome::no_way_on,
          CandidateOutcome::ruled_out, CandidateOutcome::leaves_floor}) {
        bool any = false;
        for (const std::size_t i : shown_candidates(choice)) any = any || outcome_of(choice, i) == outcome;
        if (!any) continue;
        out.push_back(line_entry(outcome_style_of(outcome, palette), std::string(outcome_words(outcome))));
    }
    return out;
}

}  // namespace mobbscope
