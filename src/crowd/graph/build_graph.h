/// A motion graph cut out of recordings, in the manner of Snap-Together Motion (Gleicher et al. 2003): common poses
/// become hubs, and what lies between two of them becomes a move.
#pragma once

#include <crowd/graph/cut_search.h>
#include <crowd/graph/hub_choice.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope {

/// What became of the recordings.
struct BuildReport {
    std::size_t recordings = 0;
    std::size_t without_joints = 0;  ///< of those; they cannot be cut
    std::size_t too_long = 0;        ///< of those with joints: too many samples to keep the joints of each
    std::size_t rigs = 0;            ///< each has hubs of its own
    double seconds = 0;              ///< that recordings with joints last
    std::size_t pieces = 0;          ///< found between the hubs
    std::size_t alike = 0;           ///< of those, left out: another goes the same way, or there were enough
    std::size_t dead_ends = 0;       ///< moves left out as they lead nowhere, or to too few others
    std::size_t dropped_hubs = 0;    ///< left out with those
    std::size_t rigs_left_out = 0;   ///< that no hub remains of
    std::size_t joints_checked = 0;  ///< by check_graph: each a move and one that may follow it
    std::size_t broken = 0;          ///< moves that check_graph took out as they break a bound
};

struct BuiltGraph {
    Scene scene;  ///< the moves' clips, parts of the recordings by `trim`, and the graph
    BuildReport report;
};

/// A file that recordings are read from.
struct ClipFile {
    std::filesystem::path path;
    bool in_folder = false;  ///< a folder was named, not this file: it may be left out if it is bad
    std::string why_not{};   ///< it is a folder that cannot be read
};

/// The clip files (no trajectories) among files and in folders and their subfolders, each once, by their paths, and
/// those subfolders that cannot be read. Throws InputError for a folder that cannot be read or holds none, and for a
/// scene file.
std::vector<ClipFile> clip_files(const std::vector<std::filesystem::path>& places);

struct Recordings {
    Scene scene;                        ///< all clips, whole and with their skeletons
    std::vector<std::string> left_out;  ///< of each file that was left out, what is wrong with it, in one line
};

/// Clips of the files as one scene, with sources relative to `scene_file`, which need not exist. They are in the order
/// of what they hold, and of their paths only where they hold the same. A bad file or folder that was found in a folder
/// is left out, unless `strict`. `progress` is told before each file. Throws InputError for another bad file, if all
/// are left out, and for motion of joints that is sampled more than 1000 times a second.
Recordings load_recordings(const std::vector<ClipFile>& files, const std::filesystem::path& scene_file,
                           const ImportOptions& options, bool strict, const Progress& progress = {});

/// The clips of a scene that was read, likewise: as they are in it, with their import options. Throws InputError as
/// load_recordings.
Scene recordings_of_clips(const Scene& scene, const std::filesystem::path& scene_file);

/// What is done on the way to a graph, for progress.
enum class GraphStage { comparing, measuring };
using GraphProgress = std::function<void(GraphStage stage, std::size_t done, std::size_t all)>;

/// All of the way: build_graph and check_graph, or of options.whole graph_of_whole_clips. No move may be left. Throws
/// as these do.
BuiltGraph make_graph(Scene recordings, const GraphOptions& options, const std::string& place,
                      const GraphProgress& progress = {});

/// Cuts a graph out of the scene's clips, which are whole recordings (load_recordings). Every joint of the graph is
/// within options.bounds: each cut is within half of them of its hub, and distances obey the triangle inequality. The
/// same for the same scene and options, whatever the number of threads. Hubs of different rigs are never joined.
/// `progress` is told while moments are compared; what it throws passes through. Throws InputError, in the name of
/// `place`, if no move comes out, and std::invalid_argument for options out of range.
BuiltGraph build_graph(const Scene& recordings, const GraphOptions& options, const std::string& place,
                       const Progress& progress = {});

/// Takes the moves out of a graph that break its bounds where they are joined, as `graph info` will measure them: the
/// scene is written, read again with the clips' files, and every transition measured (each_transition, joins_over). As
/// long as one breaks a bound, the move is taken out that most of those have, then whatever leads nowhere without them
/// or to fewer than `least_moves`. No move may be left. Counts in the report. Throws InputError if what was written
/// cannot be read.
void check_graph(BuiltGraph& built, int least_moves, const Progress& progress = {});

/// Picks pieces that differ, all of which join the same two hubs, at most `most`. The first is the one that is most
/// like its hubs; each next one differs most from those before (farthest-first traversal: Gonzalez 1985). Two are alike
/// if, laid upon each other at their begin, their paths stay within 0.15 m of each other, their headings end within 10
/// degrees and their durations are within 0.15 s. Gives indices into `pieces`, ascending.
std::vector<std::size_t> different_pieces(const std::vector<Recording>& recordings, const std::vector<Piece>& pieces,
                                          std::size_t most);

/// A graph without bounds: every clip of the scene whole, from one hub to itself, its stances read from its path
/// (facing the way it goes at either end, over at least 0.1 m), and the rigs of the clips. Throws InputError, naming
/// the clip, if one begins or ends beyond kMostStance.
MotionGraph graph_of_whole_clips(const Scene& scene);

}  // namespace mobbscope
