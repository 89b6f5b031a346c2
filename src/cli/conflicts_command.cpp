#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/conflict_listing.h>
#include <cli/options.h>
#include <cli/program.h>
#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>
#include <conflicts/plan_conflicts.h>
#include <crowd/simulation/simulate.h>
#include <import/import.h>
#include <mobb_tracks/encounter.h>
#include <mobb_tracks/parts.h>
#include <scene/scene_edits.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct ConflictsCommandArguments : FittedArguments {
    bool check = false;
    bool csv = false;
    bool strict_motion = false;
    std::optional<double> within;         ///< metres
    std::optional<double> least_seconds;  ///< see mobb::ConflictSearch
    std::optional<ListedPart> part;
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

/// Whether a file is tracks, or a table, of which no scene need be made.
bool is_tracks(const std::filesystem::path& file) {
    if (is_scene_file(file)) return false;
    const std::optional<Contents> contents = contents_of(file);
    return contents && *contents != Contents::skeletons;
}

Crowd crowd_of_tracks(const ConflictsCommandArguments& arguments) {
    Crowd out(arguments.file);
    ClipWarnings warnings;
    each_scene_clip(arguments.file, arguments.import_options, [&](const SceneClip& clip, const Agent& agent) {
        warnings.add(clip);
        out.add(clip, agent);
    });
    warnings.print(shown_name(arguments.file));
    return out;
}

/// When nobody was seen to move as one of two agents does (SourceFacts::invented), global seconds.
class InventedMotion {
  public:
    InventedMotion(const Crowd& crowd, int a, int b) {
        for (const int path : {a, b}) {
            const CrowdWalker& walker = crowd.agent_of(path);
            for (const auto& [from, to] : walker.invented)
                spans_.push_back({walker.placement.start + from, walker.placement.start + to});
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

/// Whether a conflict rests on it: where the two overlap deepest, or all the time.
bool is_invented(const Crowd& crowd, const mobb::PeopleConflict& conflict) {
    const InventedMotion invented(crowd, conflict.deepest.a, conflict.deepest.b);
    return invented.holds(conflict.deepest.time) ||
           std::ranges::all_of(conflict.intervals, [&](const mobb::Interval& of) { return invented.covers(of); });
}

/// Conflicts of a run in which no play was forced: the simulator was told that they do not collide. Of no run none.
std::optional<std::int64_t> unforced_in(const Scene& scene) {
    if (!scene.crowd) return std::nullopt;
    return std::ranges::count_if(conflicts_in(scene),
                                 [&](const SceneConflict& conflict) { return !was_forced(*scene.crowd, conflict); });
}

struct Findings {
    const Crowd& crowd;
    const mobb::PeopleConflicts& conflicts;
    std::optional<std::int64_t> unforced;  ///< see unforced_in
    std::vector<std::size_t> listed{};     ///< indices of conflicts
    double seconds = 0;                    ///< of those

    void list(bool strict_motion) {
        for (std::size_t i = 0; i < conflicts.size(); ++i) {
            if (strict_motion && is_invented(crowd, conflicts[i])) continue;
            listed.push_back(i);
            if (strict_motion) seconds += conflicts[i].seconds();
        }
        if (!strict_motion) seconds = conflicts.seconds();
    }
    const mobb::PlacedClip& clip(int path) const { return conflicts.clip(path); }
    /// Those of a path's agent.
    std::span<const mobb::PlacedClip> paths_beside(int path) const {
        const auto [first, end] = crowd.paths_beside(path);
        return {&clip(first), static_cast<std::size_t>(end - first)};
    }
    /// Halfway between the two where they are closest.
    glm::dvec2 position(const mobb::Conflict& conflict) const {
        const mobb::Disk a = mobb::swept(clip(conflict.a), conflict.a_sample).at(conflict.time);
        const mobb::Disk b = mobb::swept(clip(conflict.b), conflict.b_sample).at(conflict.time);
        return {(a.x + b.x) / 2, (a.y + b.y) / 2};
    }
    /// A sample, counted from the first of all that the person walks.
    int a_sample(const mobb::Conflict& of) const { return crowd.path(of.a).samples_before + of.a_sample; }
    int b_sample(const mobb::Conflict& of) const { return crowd.path(of.b).samples_before + of.b_sample; }

    bool of_plan(const mobb::Conflict& conflict) const {
        return crowd.agent_of(conflict.a).of_plan && crowd.agent_of(conflict.b).of_plan;
    }
};

/// "3/8", or throws std::invalid_argument.
ListedPart parse_part(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto whole = whole_number_within(1, kMostParts);
    if (slash == std::string::npos) throw std::invalid_argument(in_quotes(text) + " is not like 3/8: part 3 of 8");
    const ListedPart out{whole(text.substr(0, slash)), whole(text.substr(slash + 1))};
    if (out.part > out.parts)
        throw std::invalid_argument(in_quotes(text) + ": there are " + std::to_string(out.parts) + " parts");
    return out;
}

ListedSeconds listed_seconds(const mobb::MaybeSeconds& of) {
    if (of.undefined.empty()) return {of.seconds, ""};
    return {std::nullopt, std::string(of.undefined)};
}

/// `within`: of encounters whose figures are asked.
ListedConflict listed_conflict(const Findings& findings, std::size_t index, std::optional<double> within) {
    const mobb::PeopleConflict conflict = findings.conflicts[index];
    const mobb::Conflict& deepest = conflict.deepest;
    ListedConflict out{conflict.a,
                       conflict.b,
                       findings.crowd.name(conflict.a),
                       findings.crowd.name(conflict.b),
                       conflict.intervals,
                       deepest.least_clearance,
                       deepest.time,
                       findings.a_sample(deepest),
                       findings.b_sample(deepest),
                       findings.position(deepest),
                       is_invented(findings.crowd, conflict),
                       std::nullopt,
                       std::nullopt,
                       std::nullopt};
    if (findings.of_plan(deepest)) out.plan = plan_conflicts(findings.clip(deepest.a), findings.clip(deepest.b));
    if (!within) return out;
    const mobb::Encounter encounter{findings.paths_beside(deepest.a), findings.paths_beside(deepest.b), *within,
                                    conflict.intervals.front().t0, deepest.least_clearance};
    out.time_to_collision = listed_seconds(mobb::time_to_collision(encounter));
    out.post_encroachment = listed_seconds(mobb::post_encroachment_time(encounter));
    return out;
}

/// Refers to the findings.
ConflictListing listing_of(const Findings& findings, const ConflictsCommandArguments& arguments) {
    const mobb::PeopleConflicts& found = findings.conflicts;
    const Crowd& crowd = findings.crowd;
    return {arguments.json  ? ListingFormat::json
            : arguments.csv ? ListingFormat::csv
                            : ListingFormat::text,
            shown_name(crowd.file()),
            crowd.t0(),
            crowd.people(),
            crowd.common_radius(),
            found.pairs(),
            found.pairs_tested(),
            findings.seconds,
            crowd.doubts(),
            findings.unforced,
            arguments.within,
            arguments.least_seconds,
            arguments.part,
            arguments.part ? crowd.digest() : 0,
            arguments.strict_motion ? std::optional(found.size() - findings.listed.size()) : std::nullopt,
            findings.listed.size(),
            [&findings, within = arguments.within](std::size_t i, bool figures) {
                return listed_conflict(findings, findings.listed[i], figures ? within : std::nullopt);
            }};
}

int run_conflicts(const ConflictsCommandArguments& arguments) {
    std::optional<Scene> scene;
    std::optional<std::int64_t> unforced;
    if (arguments.fit.tree || !is_tracks(arguments.file)) {
        Scene loaded = load(arguments.file, arguments.import_options);
        unforced = unforced_in(loaded);
        scene = crowd_in(std::move(loaded), arguments);
    }
    const Crowd crowd = scene ? Crowd(*scene) : crowd_of_tracks(arguments);
    std::vector<mobb::PlacedClip> clips = crowd.placed();
    const std::vector<int> floors = crowd.floor_of();
    mobb::ConflictSearch search;
    search.within = arguments.within.value_or(0);
    search.least_seconds = arguments.least_seconds.value_or(0);
    search.direct = arguments.fit.brute;
    search.floor_of = floors;
    if (arguments.fit.tree && arguments.within)
        throw InputError(arguments.file,
                         "trees find who collides and not who comes near; leave --tree or --within out");
    if (arguments.part) {
        if (search.direct) throw InputError(arguments.file, "--tree brute searches all; leave it or --part out");
        search.region = mobb::region_of_part(clips, arguments.part->part - 1, arguments.part->parts);
    }
    search.progress = tell("looked at", "paths");
    search.spend = spend_on_conflicts();
    // Trees are fitted for those who ask for them.
    std::optional<FittedScene> trees;
    std::vector<mobb::PlacedTree> placed;
    if (arguments.fit.tree) {
        trees = fitted(*scene, arguments.fit);
        for (const PlacedAgent& path : placed_members(*scene)) placed.push_back(trees->placed(path));
        search.trees = placed;
    }
    const mobb::PeopleConflicts conflicts(std::move(clips), crowd.person_of(), search);
    Findings findings{crowd, conflicts, unforced};
    findings.list(arguments.strict_motion);
    write_listing(listing_of(findings, arguments));
    flush_results();
    return arguments.check && !findings.listed.empty() ? kFailed : kDone;
}

void add_conflicts_options(Command& command, ConflictsCommandArguments& arguments) {
    const Option json = add_fitted_options(command, arguments, "The same as JSON", Brute::allowed);
    command.add_flag("--csv", arguments.csv, "The same as CSV, a row a pair").excludes(json);
    const auto within = number_within(0, mobb::kMaxLength), seconds = number_within(0, mobb::kMaxTime);
    command.add_option(
        "--within", [&arguments, within](const std::string& text) { arguments.within = within(text); },
        "Also who comes within so many metres, with time to collision, post-encroachment time and chains of contact",
        "D");
    command.add_option(
        "--min-duration", [&arguments, seconds](const std::string& text) { arguments.least_seconds = seconds(text); },
        "Only who stays so close for so many seconds at a time", "S");
    command.add_option(
        "--part", [&arguments](const std::string& text) { arguments.part = parse_part(text); },
        "One of N parts in space and time, as JSON; merge puts all of them together", "K/N");
    command.add_flag("--check", arguments.check, "Status 1 if there is a conflict");
    command.add_flag("--strict-motion", arguments.strict_motion,
                     "Without conflicts that rest on gaps that were filled, or on what is too fast");
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
