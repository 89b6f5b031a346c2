#include <app/session/crowd_maker.h>
#include <base/error.h>
#include <base/text.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/build_words.h>
#include <crowd/simulation/move_set.h>
#include <scene/arrangement.h>
#include <scene/motion_graph.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Of the progress of a run: placing agents takes about so much of it.
constexpr std::size_t kPlacingShare = 100;
constexpr std::size_t kPlayingShare = 900;

std::size_t share(double part, std::size_t of) {
    return static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * static_cast<double>(of));
}

/// The two stages take about as long as each other.
GraphProgress progress_of_graph(JobControl& control) {
    return [&control](GraphStage stage, std::size_t done, std::size_t all) {
        control.step(done + (stage == GraphStage::measuring ? all : 0), 2 * all);
    };
}

SimulationProgress progress_of_run(JobControl& control, const SimulateOptions& options) {
    return [&control, options](const SimulationCounts& counts) {
        control.step(share(static_cast<double>(counts.agents) / options.agents, kPlacingShare) +
                         share(counts.simulated / options.seconds, kPlayingShare),
                     kPlacingShare + kPlayingShare);
    };
}

MadeScene made_graph(Notifications& notifications, BuiltGraph built) {
    const std::string said =
        "Built a graph of " + size_in_words(*built.scene.graph) + ", " + source_in_words(built.report);
    return {std::move(built.scene), [&notifications, said, warnings = warnings_of(built.report)] {
                notifications.tell(MessageLevel::info, said, {{"crowd.simulate", "", "Simulate a crowd..."}});
                for (const std::string& warning : warnings) notifications.tell(MessageLevel::warning, warning);
            }};
}

MadeScene made_run(Notifications& notifications, const MoveSet& moves, Simulation simulation) {
    const std::string said = "Simulated " + in_words(simulation.counts);
    const auto forced = simulation.counts.forced;
    return {scene_of_run(moves, std::move(simulation.run)), [&notifications, said, forced] {
                if (forced == 0) return notifications.tell(MessageLevel::info, said + ", none forced");
                notifications.tell(MessageLevel::warning,
                                   said + "; " + counted(forced, "play was", "plays were") +
                                       " forced, and may collide: fewer agents or a larger floor leave more room",
                                   {{"conflicts.find", "", "Find conflicts"}});
            }};
}

/// Each word of a text.
template <class Read>
void read_words(std::string text, const Read& read) {
    std::ranges::replace(text, ',', ' ');
    std::istringstream in(text);
    for (std::string word; in >> word;) read(word);
}

}  // namespace

std::string_view CrowdMaker::why_no_graph() const {
    if (workspace_.empty()) return "nothing is open";
    if (workspace_.in_excerpt()) return "this is an excerpt: go back to the whole scene first";
    if (workspace_.scene().graph) return "a motion graph is open already: open recordings";
    return "";
}

std::string_view CrowdMaker::why_no_crowd() const {
    if (workspace_.empty()) return "nothing is open";
    if (workspace_.in_excerpt()) return "this is an excerpt: go back to the whole scene first";
    if (!workspace_.scene().graph) return "there is no motion graph: build one first";
    return "";
}

std::string CrowdMaker::recordings_in_words() const {
    const std::vector<SceneClip>& clips = workspace_.scene().clips;
    double seconds = 0;
    for (const SceneClip& clip : clips) seconds += clip.clip->duration();
    const auto jointed = static_cast<std::size_t>(
        std::ranges::count_if(clips, [](const SceneClip& clip) { return clip.skeleton != nullptr; }));
    return "Cut out of " + counted(clips.size(), "open clip", "open clips") + ", " + brief(std::round(seconds)) +
           " s; " + (jointed == clips.size() ? "all have joints" : std::to_string(jointed) + " with joints");
}

std::string CrowdMaker::moves_in_words() const {
    return "Plays the open graph of " + size_in_words(*workspace_.scene().graph);
}

std::filesystem::path CrowdMaker::file_beside(const char* name) const {
    return workspace_.scene().file.parent_path() / name;
}

void CrowdMaker::build_graph(const GraphOptions& options) {
    if (const std::string_view why = why_no_graph(); !why.empty()) throw std::invalid_argument(std::string(why));
    const auto make = [&told = notifications_, open = workspace_.document().fitted->shared_scene(),
                       file = file_beside("graph.json"), place = workspace_.title(), options](JobControl& control) {
        BuiltGraph built = make_graph(recordings_of_clips(*open, file), options, place, progress_of_graph(control));
        if (built.scene.graph->moves.empty()) throw InputError(place + ": " + why_no_move(built.report));
        lay_out_clips(built.scene);
        return made_graph(told, std::move(built));
    };
    files_.open_made("Building a motion graph", make, Replaces::another);
}

void CrowdMaker::simulate(const CrowdOrder& order) {
    if (const std::string_view why = why_no_crowd(); !why.empty()) throw std::invalid_argument(std::string(why));
    const auto make = [&told = notifications_, open = workspace_.document().fitted->shared_scene(),
                       fit = workspace_.document().fitted->options(), file = file_beside("run.json"),
                       place = workspace_.title(), order](JobControl& control) {
        Scene scene = played_part(*open);
        check_moves(scene, *scene.graph, place);
        move_to_file(scene, file);
        scene.fit = fit;
        control.step(0, kPlacingShare + kPlayingShare);
        const FittedScene fitted(std::move(scene), fit);
        const MoveSet moves(fitted, order.turn_rate);
        return made_run(told, moves,
                        mobbscope::simulate(moves, order.options, nullptr, progress_of_run(control, order.options)));
    };
    // A run holds the graph that it plays.
    const bool is_graph_alone = !workspace_.crowd() && workspace_.scene().agents.empty();
    files_.open_made("Simulating a crowd", make, is_graph_alone ? Replaces::what_it_holds : Replaces::another);
}

GraphOptions parse_graph_options(const std::string& text) {
    GraphOptions out;
    read_words(text, [&](const std::string& word) {
        word == "whole" ? static_cast<void>(out.whole = true) : set_number(out, graph_options(), word);
    });
    return out;
}

CrowdOrder parse_crowd_order(const std::string& text) {
    CrowdOrder out;
    read_words(text, [&](const std::string& word) { set_number(out, crowd_options(), word); });
    return out;
}

}  // namespace mobbscope::app
