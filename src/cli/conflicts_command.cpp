#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <conflicts/conflicts.h>
#include <conflicts/plan_conflicts.h>
#include <crowd/simulation/simulate.h>
#include <scene/scene_edits.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

struct ConflictsCommandArguments : FittedArguments {
    bool check = false;
};

/// The crowd in the file: its agents, the people of a run, or the tracks of a CSV, each from the time of its first row.
Scene load_crowd(const ConflictsCommandArguments& arguments) {
    Scene scene = load(arguments.file, arguments.import_options, RadiusOf::every_clip);
    if (scene.crowd) return scene_of_people(scene);
    if (lower_extension(arguments.file) == ".csv") {
        add_agents_for_clips(scene);
        for (Agent& agent : scene.agents)
            agent.placement.start = scene.clips[static_cast<std::size_t>(agent.clip)].start;
    }
    if (scene.agents.empty())
        throw InputError(arguments.file.string(), "",
                         "there are no agents who could meet; give a scene with agents, "
                         "trajectories or a CSV with ids");
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

/// Whether two agents are one person, whose paths join: a hair of overlap in time is no meeting.
bool same_person(const Scene& scene, const Conflict& conflict) {
    const auto run_agent = [&scene](int agent) { return scene.agents[static_cast<std::size_t>(agent)].run_agent; };
    return run_agent(conflict.a) >= 0 && run_agent(conflict.a) == run_agent(conflict.b);
}

/// What is said of a crowd's conflicts.
struct Findings {
    const FittedScene& fitted;
    const std::vector<mobb::PlacedTree>& crowd;
    const Conflicts& conflicts;

    const std::string& name(int agent) const { return fitted.scene().agents[static_cast<std::size_t>(agent)].name; }
    /// Of paths of different people.
    std::size_t pairs() const {
        std::size_t count = crowd.size() * (crowd.size() - 1) / 2;
        std::map<int, std::size_t> paths;
        for (const Agent& agent : fitted.scene().agents) {
            if (agent.run_agent >= 0) count -= paths[agent.run_agent]++;
        }
        return count;
    }

    /// People: one may have several paths.
    std::size_t agents() const {
        const std::vector<Agent>& all = fitted.scene().agents;
        return all.empty() || all.back().run_agent < 0 ? all.size()
                                                       : static_cast<std::size_t>(all.back().run_agent) + 1;
    }

    /// Halfway between the two where they are closest.
    glm::dvec2 position(const Conflict& conflict) const {
        const auto disk = [this](int agent, int sample) {
            return crowd[static_cast<std::size_t>(agent)].placed_clip().disk(sample);
        };
        const mobb::Disk a = disk(conflict.a, conflict.a_sample);
        const mobb::Disk b = disk(conflict.b, conflict.b_sample);
        return {(a.x + b.x) / 2, (a.y + b.y) / 2};
    }

    bool of_plan(const Conflict& conflict) const {
        const Scene& scene = fitted.scene();
        const auto from_plan = [&scene](int agent) {
            return is_plan(scene.clips[static_cast<std::size_t>(scene.agents[static_cast<std::size_t>(agent)].clip)]);
        };
        return from_plan(conflict.a) && from_plan(conflict.b);
    }

    /// In the words of path finding; of agents of a plan.
    std::vector<PlanConflict> in_plan(const Conflict& conflict) const {
        const auto placed = [this](int agent) -> const mobb::PlacedClip& {
            return crowd[static_cast<std::size_t>(agent)].placed_clip();
        };
        return plan_conflicts(placed(conflict.a), placed(conflict.b));
    }

    double seconds() const {
        double sum = 0;
        for (const Conflict& conflict : conflicts.found) sum += duration(conflict);
        return sum;
    }

    static double duration(const Conflict& conflict) {
        double sum = 0;
        for (const mobb::Interval& interval : conflict.intervals) sum += interval.t1 - interval.t0;
        return sum;
    }
};

void write_plan_conflicts(JsonWriter& out, const std::vector<PlanConflict>& found) {
    out.list("plan", found, [&](const PlanConflict& conflict) {
        out.begin_object(Layout::row);
        out.member("kind", name(conflict.kind));
        out.member("t0", conflict.t0);
        out.member("t1", conflict.t1);
        out.member("a", {conflict.a.x, conflict.a.y});
        out.member("b", {conflict.b.x, conflict.b.y});
        out.end_object();
    });
}

void write_json(const Findings& findings) {
    const Scene& scene = findings.fitted.scene();
    JsonWriter out(std::cout);
    out.begin_object();
    out.member("file", scene.file.string());
    out.member("agents", findings.agents());
    out.member("radius", common_radius(scene));
    out.member("pairs", findings.pairs());
    out.member("pairs_tested", findings.conflicts.pairs_tested);
    out.member("seconds", findings.seconds());
    out.list("conflicts", findings.conflicts.found, [&](const Conflict& conflict) {
        const glm::dvec2 position = findings.position(conflict);
        out.begin_object(Layout::row);
        out.member("a", findings.name(conflict.a));
        out.member("b", findings.name(conflict.b));
        out.list("intervals", conflict.intervals, [&](const mobb::Interval& interval) {
            out.numbers({interval.t0, interval.t1});
        });
        out.member("least_clearance", conflict.least_clearance);
        out.member("time", conflict.time);
        out.member("a_sample", conflict.a_sample);
        out.member("b_sample", conflict.b_sample);
        out.member("position", {position.x, position.y});
        if (findings.of_plan(conflict)) write_plan_conflicts(out, findings.in_plan(conflict));
        out.end_object();
    });
    out.end_object();
}

/// In metres, to the millimetre.
std::string to_millimetres(double length) { return brief(std::round(length * 1000) / 1000); }

std::string place_in_words(glm::dvec2 place) {
    return "(" + to_millimetres(place.x) + ", " + to_millimetres(place.y) + ")";
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
    for (const Conflict& conflict : findings.conflicts.found) {
        const glm::dvec2 position = findings.position(conflict);
        std::cout << cleaned(findings.name(conflict.a)) << " and " << cleaned(findings.name(conflict.b)) << ": "
                  << brief(Findings::duration(conflict)) << " s, ";
        const char* separator = "";
        for (const mobb::Interval& interval : conflict.intervals) {
            std::cout << separator << brief(interval.t0) << " to " << brief(interval.t1);
            separator = ", ";
        }
        std::cout << " s; least clearance " << to_millimetres(conflict.least_clearance) << " m at "
                  << brief(conflict.time) << " s near " << place_in_words(position) << ", samples " << conflict.a_sample
                  << " and " << conflict.b_sample
                  << (findings.of_plan(conflict) ? plan_conflicts_in_words(findings.in_plan(conflict)) : "") << '\n';
    }
    std::cout << counted(findings.conflicts.found.size(), "conflict", "conflicts") << " among "
              << counted(findings.agents(), "agent", "agents") << ", " << brief(findings.seconds()) << " s in all; "
              << findings.conflicts.pairs_tested << " of " << counted(findings.pairs(), "pair", "pairs") << " tested\n";
}

void run_conflicts(const ConflictsCommandArguments& arguments, int& status) {
    const FittedScene scene = fitted(load_crowd(arguments), arguments.fit);
    std::vector<mobb::PlacedTree> crowd;
    for (const PlacedAgent& who : scene.placed_agents()) crowd.push_back(scene.placed(who));
    Conflicts conflicts = find_conflicts(crowd, arguments.fit.brute ? Search::direct : Search::trees);
    std::erase_if(conflicts.found, [&scene](const Conflict& conflict) { return same_person(scene.scene(), conflict); });
    const Findings findings{scene, crowd, conflicts};
    arguments.json ? write_json(findings) : print_text(findings);
    flush_results();
    if (arguments.check && !conflicts.found.empty()) status = kFailed;
}

}  // namespace

void add_conflicts_command(Command& program, int& status) {
    Command& command = program.add_subcommand(
        "conflicts",
        "Every pair of agents whose disks overlap: when, how deep and where; --tree brute searches directly");
    const auto arguments = std::make_shared<ConflictsCommandArguments>();
    add_fitted_options(command, *arguments, "The same as JSON", Brute::allowed);
    command.add_flag("--check", arguments->check, "Status 1 if there is a conflict");
    command.callback([arguments, &status] { run_conflicts(*arguments, status); });
}

}  // namespace mobbscope::cli
