/// A motion graph in figures.
#pragma once

#include <import/import.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

struct HubFigures {
    std::string name;
    std::size_t begin = 0;  ///< moves that begin here: the choices
    std::size_t end = 0;    ///< moves that end here
    double speed = 0;       ///< of the root on average as moves begin and end here, metres per second
};

/// Hubs that all lead to each other, and the moves between them.
struct ComponentFigures {
    std::vector<int> hubs;
    std::size_t moves = 0;
    double seconds = 0;
};

/// What the graph takes from a file; from the scene's own samples if `file` is empty.
struct SourceFigures {
    std::string file;
    std::size_t moves = 0;
    double seconds = 0;
};

struct GraphFigures {
    std::vector<HubFigures> hubs;
    std::vector<ComponentFigures> components;
    std::vector<SourceFigures> sources;  ///< in the order of their first moves
    std::vector<int> dead_ends;          ///< hubs in which no move begins
    std::size_t moves = 0;
    double seconds = 0;                  ///< of all moves
    double choices = 0;                  ///< moves that may follow a move, on average
    double seconds_between_choices = 0;  ///< a move lasts so long on average
};

/// The scene has a graph.
GraphFigures graph_figures(const Scene& scene);

/// A move as its source has it, not warped, with some frames from before and after it where the source has them.
struct RecordedMove {
    mobb::ClipPtr clip;
    std::shared_ptr<const Skeleton> skeleton;
    int entry = 0;  ///< frames of the clip
    int exit = 0;
};

/// Throws InputError if the source cannot be read.
RecordedMove recorded_move(const Scene& scene, const GraphMove& move, Importer& importer);

/// All transitions of a graph, as pairs of indices into its moves: each a move and one that may follow it. Throws
/// InputError if there are more than can be measured.
std::vector<std::pair<int, int>> transitions_of(const MotionGraph& graph);

/// What was measured over all transitions: a transition is a move and one that may follow it.
struct TransitionSpread {
    std::size_t count = 0;  ///< transitions measured
    double median = 0;
    double largest = 0;
    int before = -1;  ///< the moves of the transition with the largest: indices into the graph's moves
    int after = -1;
};

struct TransitionMeasures {
    std::size_t count = 0;           ///< transitions of the graph
    TransitionSpread pose_distance;  ///< metres: joined_distance, as the stances join the bodies
    TransitionSpread root_speed;     ///< metres per second: change of the root's velocity between the last step before
                                     ///< and the first one after
};

/// Every transition of a graph, measured; one entry each.
struct Transitions {
    std::vector<std::pair<int, int>> moves;  ///< before and after: indices into the graph's moves
    std::vector<double> pose_distance;       ///< metres; negative: not measured
    std::vector<double> root_speed;          ///< metres per second
};

/// Of moves as they were recorded, not as they are warped or turned. Poses come from the clips' sources, a few frames
/// beyond each clip included; between clips without a skeleton, or of different rigs, there is no pose distance. The
/// joints that count are those that the graph lists; where it lists no rigs, those of rigs_of(scene). The scene has a
/// graph. `progress` is told before each clip's poses are read. Throws InputError.
Transitions each_transition(const Scene& scene, const Progress& progress = {});

/// The same in figures.
TransitionMeasures measure_transitions(const Scene& scene, const Progress& progress = {});

/// Whether what was measured exceeds a bound by more than rounding does.
bool exceeds(double measured, double bound);
bool exceeds(const TransitionSpread& measured, double bound);

}  // namespace mobbscope
