#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/text_rows.h>
#include <conflicts/conflicts.h>
#include <conflicts/plan_conflicts.h>
#include <crowd/simulation/simulate.h>
#include <scene/scene_edits.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

struct ConflictsCommandArguments : FittedArguments {
    bool check = false;
    bool strict_motion = false;
};

/// Whether the clips of a motion file are of several characters. Throws InputError if one of them has several.
bool has_performers(const Scene& scene) {
    std::set<std::string> roots;
    std::string twice;
    for (const SceneClip& clip : scene.clips) {
        // Of several characters each clip says by its root whose it is.
        if (!clip.options.root) return false;
        if (!roots.insert(*clip.options.root).second) twice = *clip.options.root;
    }
    if (roots.size() > 1 && !twice.empty()) {
        throw InputError(scene.file, "",
                         "has several animations of " + in_quotes(twice) +
                             ", who cannot be in two at one time; choose one with --animation");
    }
    return roots.size() > 1;
}

/// The crowd of a scene: its agents, the people of a run, or the characters of a motion file; a CSV without ids is
/// somebody alone.
Scene crowd_in(Scene scene, const ConflictsCommandArguments& arguments) {
    if (scene.crowd) return scene_of_people(scene);
    const bool is_clips = !is_scene_file(arguments.file) && scene.agents.empty();
    if (is_clips && (scene.clips.front().facts.format == "csv" || has_performers(scene))) add_agents_for_clips(scene);
    if (scene.agents.empty())
        throw InputError(arguments.file,
                         "there are no agents who could meet; give a scene with agents, trajectories, a CSV with ids "
                         "or a motion of several characters");
    return scene;
}

/// The radius of every disk in metres, if it is one.
std::optional<double> common_radius(const Scene& scene) {
    std::optional<double> radius;
    for (const Agent& agent : scene.agents) {
        for (const mobb::Disk& disk : scene.clips[static_cast<std::size_t>(agent.clip)].clip->samples()) {
            if (radius && *radius != disk.r) return std::nullopt;
            radius = disk.r;
        }
    }
    return radius;
}

/// Who is who: a person of a run whose clips differ in dt, or are linear, is several agents of the scene.
class People {
  public:
    explicit People(const Scene& scene) {
        for (const Agent& agent : scene.agents) {
            const bool goes_on = agent.run_agent >= 0 && !of_.empty() && agent.run_agent == of_.back();
            if (!goes_on) {
                names_.push_back(agent.name);
                samples_ = 0;
            }
            of_.push_back(static_cast<int>(names_.size()) - 1);
            before_.push_back(samples_);
            samples_ += scene.clips[static_cast<std::size_t>(agent.clip)].clip->count();
        }
    }

    std::span<const int> of_agents() const { return of_; }  ///< by agent of the scene
    std::size_t count() const { return names_.size(); }
    const std::string& name(int person) const { return names_[static_cast<std::size_t>(person)]; }
    /// A sample of an agent, counted from the first of all that the person walks.
    int sample(int agent, int sample) const { return before_[static_cast<std::size_t>(agent)] + sample; }

  private:
    std::vector<std::string> names_;
    std::vector<int> of_;
    std::vector<int> before_;  ///< by agent: samples of the same person's earlier ones
    int samples_ = 0;
};

/// When nobody was seen to move as one of two agents does (SourceFacts::invented), global seconds.
class InventedMotion {
  public:
    InventedMotion(const Scene& scene, int a, int b) {
        for (const int index : {a, b}) {
            const Agent& agent = scene.agents[static_cast<std::size_t>(index)];
            for (const auto& [from, to] : scene.clips[static_cast<std::size_t>(agent.clip)].facts.invented)
                spans_.push_back({agent.placement.start + from, agent.placement.start + to});
        }
        std::ranges::sort(spans_, {}, &mobb::Interval::t0);
    }

    bool holds(double time) const { return covers({time, time}); }
    bool covers(const mobb::Interval& interval) const {
        double known = interval.t0;
        for (const mobb::Interval& span : spans_) {
            if (span.t0 > known + mobb::kMinOverlap) break;
            if (span.t1 < known) continue;
            known = span.t1;
            if (known + mobb::kMinOverlap >= interval.t1) return true;
        }
        return false;
    }

  private:
    std::vector<mobb::Interval> spans_;
};

/// Whether a conflict rests on it: where the two overlap deepest, or all the
/// time.
bool is_invented(const Scene& scene, const PeopleConflict& conflict) {
    const InventedMotion invented(scene, conflict.deepest.a, conflict.deepest.b);
    return invented.holds(conflict.deepest.time) ||
           std::ranges::all_of(conflict.intervals, [&](const mobb::Interval& of) { return invented.covers(of); });
}

/// Conflicts of a run in which no play was forced: the simulator was told that they do not collide. Of no run none.
std::optional<std::int64_t> unforced_in(const Scene& scene, const FitArguments& fit) {
    if (!scene.crowd) return std::nullopt;
    return std::ranges::count_if(conflicts_in(fitted(scene, fit)),
                                 [&](const SceneConflict& conflict) { return !was_forced(*scene.crowd, conflict); });
}

struct Findings {
    const Scene& scene;
    const People& people;
    const std::vector<mobb::PlacedTree>& crowd;
    const PeopleConflicts& conflicts;
    std::optional<std::int64_t> unforced;  ///< see unforced_in
    std::vector<std::size_t> listed{};     ///< indices of conflicts
    double seconds = 0;                    ///< of those

    void list(bool strict_motion) {
        for (std::size_t i = 0; i < conflicts.size(); ++i) {
            if (strict_motion && is_invented(scene, conflicts[i])) continue;
            listed.push_back(i);
            if (strict_motion) seconds += conflicts[i].seconds();
        }
        if (!strict_motion) seconds = conflicts.seconds();
    }
    /// Of the file's speeds; empty: none.
    std::string doubt() const { return scene.clips.front().facts.doubt; }

    const mobb::PlacedClip& clip(int agent) const { return crowd[static_cast<std::size_t>(agent)].placed_clip(); }
    /// Halfway between the two where they are closest.
    glm::dvec2 position(const Conflict& conflict) const {
        const mobb::Disk a = mobb::swept(clip(conflict.a), conflict.a_sample).at(conflict.time);
        const mobb::Disk b = mobb::swept(clip(conflict.b), conflict.b_sample).at(conflict.time);
        return {(a.x + b.x) / 2, (a.y + b.y) / 2};
    }
    /// Of tracks: time 0 on their file's own clock, seconds. The agents of a scene start when the scene says.
    std::optional<double> t0() const {
        const SceneClip& clip = scene.clips.front();
        if (is_scene_file(scene.file)) return std::nullopt;
        // Of takes each has its own.
        return clip.facts.first_key ? std::optional(*clip.facts.first_key - clip.start) : clip.facts.t0;
    }
    int a_sample(const Conflict& conflict) const { return people.sample(conflict.a, conflict.a_sample); }
    int b_sample(const Conflict& conflict) const { return people.sample(conflict.b, conflict.b_sample); }

    bool of_plan(const Conflict& conflict) const {
        const auto from_plan = [this](int agent) {
            return is_plan(scene.clips[static_cast<std::size_t>(scene.agents[static_cast<std::size_t>(agent)].clip)]);
        };
        return from_plan(conflict.a) && from_plan(conflict.b);
    }

    /// In the words of path finding; of agents of a plan.
    std::vector<PlanConflict> in_plan(const Conflict& conflict) const {
        return plan_conflicts(clip(conflict.a), clip(conflict.b));
    }
};

void write_plan_conflicts(JsonWriter& out, const std::vector<PlanConflict>& found) {
    out.list("plan", found, [&](const PlanConflict& conflict) {
        out.row("kind", name(conflict.kind), "t0", conflict.t0, "t1", conflict.t1, "a", conflict.a, "b", conflict.b);
    });
}

void write_json(const Findings& findings) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.members("file", shown_name(findings.scene.file), "t0", findings.t0(), "agents", findings.people.count());
    out.member("radius", common_radius(findings.scene));
    out.members("pairs", findings.conflicts.pairs(), "pairs_tested", findings.conflicts.pairs_tested());
    out.member("seconds", findings.seconds);
    if (!findings.doubt().empty()) out.member("doubt", findings.doubt());
    if (findings.unforced) out.member("unforced", *findings.unforced);
    out.begin_array("conflicts");
    for (const std::size_t i : findings.listed) {
        const PeopleConflict conflict = findings.conflicts[i];
        const Conflict& deepest = conflict.deepest;
        out.begin_object(Layout::row);
        out.members("a", findings.people.name(conflict.a), "b", findings.people.name(conflict.b));
        out.list("intervals", conflict.intervals, [&](const mobb::Interval& of) { out.tuple(of.t0, of.t1); });
        out.members("least_clearance", deepest.least_clearance, "time", deepest.time);
        out.members("a_sample", findings.a_sample(deepest), "b_sample", findings.b_sample(deepest));
        out.member("position", findings.position(deepest));
        if (is_invented(findings.scene, conflict)) out.member("invented", true);
        if (findings.of_plan(deepest)) write_plan_conflicts(out, findings.in_plan(deepest));
        out.end_object();
    }
    out.end_array();
    out.end_object();
}

std::string place_in_words(glm::dvec2 place) {
    return "(" + to_thousandth(place.x) + ", " + to_thousandth(place.y) + ")";
}

/// "; vertex conflict at 3 s in (1, 2) and 2 more": the first of each kind.
std::string plan_conflicts_in_words(const std::vector<PlanConflict>& found) {
    std::string out;
    for (const PlanConflictKind kind : {PlanConflictKind::vertex, PlanConflictKind::swap}) {
        const auto first = std::ranges::find(found, kind, &PlanConflict::kind);
        if (first == found.end()) continue;
        out += kind == PlanConflictKind::vertex
                   ? "; vertex conflict at " + brief(first->t0) + " s in " + place_in_words(first->a)
                   : "; swap (edge) conflict from " + brief(first->t0) + " to " + brief(first->t1) + " s between " +
                         place_in_words(first->a) + " and " + place_in_words(first->b);
        const auto all = std::ranges::count(found, kind, &PlanConflict::kind);
        if (all > 1) out += " and " + std::to_string(all - 1) + " more";
    }
    return out;
}

void print_text(const Findings& findings) {
    const PeopleConflicts& conflicts = findings.conflicts;
    const std::size_t listed = std::min(findings.listed.size(), TextRows::kMost);
    for (std::size_t i = 0; i < listed; ++i) {
        const PeopleConflict conflict = conflicts[findings.listed[i]];
        const Conflict& deepest = conflict.deepest;
        const glm::dvec2 position = findings.position(deepest);
        std::cout << cleaned(findings.people.name(conflict.a)) << " and " << cleaned(findings.people.name(conflict.b))
                  << ": " << brief(conflict.seconds()) << " s, ";
        const char* separator = "";
        for (const mobb::Interval& interval : conflict.intervals) {
            std::cout << separator << brief(interval.t0) << " to " << brief(interval.t1);
            separator = ", ";
        }
        std::cout << " s; least clearance " << brief(deepest.least_clearance) << " m at " << brief(deepest.time)
                  << " s near " << place_in_words(position) << ", samples " << findings.a_sample(deepest) << " and "
                  << findings.b_sample(deepest)
                  << (is_invented(findings.scene, conflict) ? "; rests on invented motion" : "")
                  << (findings.of_plan(deepest) ? plan_conflicts_in_words(findings.in_plan(deepest)) : "") << '\n';
    }
    tell_left_out(std::cout, findings.listed.size() - listed);
    std::cout << conflict_count(findings.listed.size(), findings.people.count(), findings.seconds) << "; "
              << conflicts.pairs_tested() << " of " << counted(conflicts.pairs(), "pair", "pairs") << " tested\n";
    if (findings.listed.size() < conflicts.size()) {
        std::cout << counted(conflicts.size() - findings.listed.size(), "conflict rests", "conflicts rest")
                  << " on invented motion and is left out\n";
    }
    if (!findings.doubt().empty()) std::cout << "in doubt: " << cleaned(findings.doubt()) << '\n';
    if (findings.unforced.value_or(0) > 0)
        std::cout << counted(*findings.unforced, "contact", "contacts")
                  << " without a forced play: an answer was wrong, or the run was edited\n";
}

int run_conflicts(const ConflictsCommandArguments& arguments) {
    FitArguments fit = arguments.fit;
    if (!fit.tree) fit.tree = mobb::TreeKind::blocks;
    const Scene loaded = load(arguments.file, arguments.import_options, RadiusOf::every_clip);
    const std::optional<std::int64_t> unforced = unforced_in(loaded, fit);
    const FittedScene scene = fitted(crowd_in(loaded, arguments), fit);
    std::vector<mobb::PlacedTree> crowd;
    for (const PlacedAgent& who : scene.placed_agents()) crowd.push_back(scene.placed(who));
    const People people(scene.scene());
    const PeopleConflicts conflicts(crowd, people.of_agents(), arguments.fit.brute ? Search::direct : Search::trees,
                                    tell("tested", "pairs"));
    Findings findings{scene.scene(), people, crowd, conflicts, unforced};
    findings.list(arguments.strict_motion);
    arguments.json ? write_json(findings) : print_text(findings);
    flush_results();
    return arguments.check && !findings.listed.empty() ? kFailed : kDone;
}

void add_conflicts_options(Command& command, ConflictsCommandArguments& arguments) {
    add_fitted_options(command, arguments, "The same as JSON", Brute::allowed);
    command.add_flag("--check", arguments.check, "Status 1 if there is a conflict");
    command.add_flag("--strict-motion", arguments.strict_motion,
                     "Without conflicts that rest on gaps that were filled, or "
                     "on what is too fast");
}

}  // namespace

void add_conflicts_command(Command& program) {
    program.add_subcommand(
        "conflicts",
        "Every pair of agents whose disks overlap, the deepest overlap first: when, how deep and where; --tree brute "
        "searches directly",
        add_conflicts_options, run_conflicts);
}

}  // namespace mobbscope::cli
