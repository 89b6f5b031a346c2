/// The scene: clips, agents that play them, and the questions asked of them. Read from and written to `*.json`.
#pragma once

#include <base/error.h>
#include <import/clip/imported_clip.h>
#include <import/skeleton/warp.h>
#include <mobb/query.h>
#include <mobb/trace.h>
#include <mobb/tree.h>
#include <scene/clip_turn.h>
#include <scene/debug_state.h>
#include <scene/view_state.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

class Importer;   // import/import.h
class JsonPlace;  // base/json.h
struct CrowdRun;  // scene/crowd_run.h
struct Scene;
struct MotionGraph;  // scene/motion_graph.h

struct Color {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Color&, const Color&) = default;
};

/// "#E69F00", as in files; nothing for any other text.
std::optional<Color> color_from_text(std::string_view text);
std::string to_string(const Color& color);

struct SceneClip {
    std::string name;
    std::optional<std::string> source;           ///< relative to the scene file; none: the samples stand in the scene
    ImportOptions options;                       ///< of the source; empty for inline samples
    mobb::ClipPtr clip;                          ///< never null in a loaded scene
    SourceFacts facts{};                         ///< of the source; of inline samples the warnings alone
    std::shared_ptr<const Skeleton> skeleton{};  ///< null where the source has no joints, or too many samples for them
    double start = 0;  ///< seconds: when it starts among the tracks or takes of its source, see ImportedClip
    std::shared_ptr<const ClipWarp> warp{};  ///< of a part of a motion: `clip` and `skeleton` are warped; null: not
    std::optional<ClipTurn> turn{};  ///< of one with a source: by which clip and skeleton were bent after the import
    /// Of inline samples of a capture: mobb::digest of what was captured; none: nobody says. See kDigest.
    std::optional<std::uint64_t> digest{};
    std::vector<mobb::BodyDisk> body{};  ///< of who is more than one disk: in place of the disks of the samples
    std::vector<double> headings{};      ///< degrees, of a body, one a sample; empty: as it moves
    /// Of a body the path of each disk, see make_members: who plays the clip is where any of them is. Else empty.
    std::vector<mobb::ClipPtr> members{};
    friend bool operator==(const SceneClip&, const SceneClip&) = default;
};

/// Makes the members anew of clip, body and headings. Throws std::invalid_argument, as mobb::member_of does.
void make_members(SceneClip& clip);

/// Of a clip with a body: "6 disks along its headings", or "... along the way it moves".
std::string body_words(const SceneClip& clip);
/// Throws InputError if a clip has a body: "`what` is of single disks".
void refuse_bodies(const Scene& scene, const std::string& what);

/// ImportWarning::option of the warning that a clip's samples are not those of its digest.
inline constexpr std::string_view kDigest = "digest";

/// One side of a query: a clip and where it is placed.
struct PlacedAgent {
    std::string name;  ///< the agent's, or the clip's where the query places a clip itself
    int clip = 0;      ///< index into Scene::clips
    mobb::Placement placement;
    int agent = -1;   ///< index into Scene::agents, or -1
    int member = -1;  ///< of a clip with a body: index into SceneClip::members; -1: the clip itself
    friend bool operator==(const PlacedAgent&, const PlacedAgent&) = default;
};

struct Agent {
    std::string name;
    int clip = 0;  ///< index into Scene::clips
    mobb::Placement placement;
    std::optional<Color> color;  ///< default: the palette's, by index
    /// In a scene made from a run: the agent's index in the run, and its play if the scene shows a moment; else -1.
    int run_agent = -1;
    int play = -1;
    std::string floor{};  ///< of a building: agents of different floors are never asked about; empty: nobody says
    friend bool operator==(const Agent&, const Agent&) = default;
};

/// How many tests of each kind, by mobb::TestKind::index(); none: any number will do.
using ExpectedTests = std::array<std::optional<std::int64_t>, mobb::kTestKindCount>;

/// The answer that a capture recorded, or a person expects. Something of it is there.
struct Expectation {
    std::optional<bool> collides;          ///< none: either will do
    std::optional<mobb::Contact> contact;  ///< none: any will do
    ExpectedTests tests{};                 ///< of the trees of the fit in use
    friend bool operator==(const Expectation&, const Expectation&) = default;
};

struct SceneQuery {
    PlacedAgent a, b;
    std::optional<Expectation> expect;
    std::shared_ptr<const mobb::Trace> trace{};  ///< null: none; shared, so that a query is cheap to copy
    friend bool operator==(const SceneQuery&, const SceneQuery&) = default;
};

struct Scene {
    std::filesystem::path file;  ///< where it was read from; empty for a scene made in memory
    std::vector<SceneClip> clips;
    std::vector<Agent> agents;
    mobb::FitOptions fit;
    std::vector<SceneQuery> queries;  ///< as in the file; see query_at
    ViewState view;
    DebugState debug{};
    std::shared_ptr<const MotionGraph> graph{};  ///< that joins the clips; null: none
    std::shared_ptr<const CrowdRun> crowd{};     ///< that plays the graph's moves; null: none
};

/// Whether two agents are on different floors, which both are known.
inline bool are_apart(const Agent& a, const Agent& b) {
    return !a.floor.empty() && !b.floor.empty() && a.floor != b.floor;
}

/// Names of floors as numbers from 1 on, 0 where nobody says; empty where nobody says of any.
std::vector<int> numbered_floors(std::span<const std::string> floors);
/// Those of the agents.
std::vector<int> floors_of(const Scene& scene);
/// Whether two such numbers are of different floors.
inline bool are_apart(int floor_a, int floor_b) { return floor_a != floor_b && floor_a != 0 && floor_b != 0; }

/// The pairs of so many agents that are asked, in the order (0,1) (0,2) ... (1,2) ...: all but those of two floors.
class AskedPairs {
  public:
    /// Of the agents of a scene; of a run none.
    explicit AskedPairs(const Scene& scene);

    std::size_t size() const { return before(agents_); }
    /// Of an index < size().
    std::pair<std::size_t, std::size_t> operator[](std::size_t index) const;
    /// Of a < b; none if they are not asked.
    std::optional<std::size_t> index_of(std::size_t a, std::size_t b) const;

  private:
    /// How many pairs come before those whose first agent is `a`.
    std::size_t before(std::size_t a) const {
        return before_.empty() ? (agents_ == 0 ? 0 : a * (2 * agents_ - a - 1) / 2) : before_[a];
    }

    std::size_t agents_;
    std::vector<int> floors_;
    std::vector<std::size_t> before_;  ///< by agent, and of the end; empty without floors
};

/// The number of queries: the scene's own; without any, all pairs of agents of one floor; without agents 0. A run has
/// none: its collisions are found by choices (crowd/simulation/choice.h) and conflicts (conflicts/conflicts.h).
std::size_t query_count(const Scene& scene);
/// The query with that index < query_count(scene). It is made when asked for: the pairs of a crowd would fill the
/// memory.
SceneQuery query_at(const Scene& scene, std::size_t index);
/// The same where AskedPairs(scene) are known.
SceneQuery query_at(const Scene& scene, const AskedPairs& pairs, std::size_t index);

/// The agents; of a scene without agents every clip, unplaced.
std::vector<PlacedAgent> placed_agents(const Scene& scene);
/// The same, those with bodies as each of their members: somebody else begins where the member is at most 0.
std::vector<PlacedAgent> placed_members(const Scene& scene);
/// " (disk 2)" of a member, else nothing.
std::string disk_words(const PlacedAgent& who);
/// The path of one of them: the clip, or its member.
const mobb::ClipPtr& path_of(const Scene& scene, const PlacedAgent& who);
/// One of them as each member of its clip's body; without a body as it is.
std::vector<PlacedAgent> members_of(const Scene& scene, const PlacedAgent& who);

/// Called during long work with how much is done, of how much in all. It may throw to end the work; the exception
/// passes through. It may be empty.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

/// Whether a file is a scene: by its name, standard input by its content.
bool is_scene_file(const std::filesystem::path& file);

/// Reads a scene, a capture, a clip file (a scene with its clips and no agents), or a file of tracks (a scene with an
/// agent for each, which starts when the track does; global time 0 is the file's earliest point, whatever trim takes).
/// `overrides` go over the import keys of every clip with a source, their motion and radius over those of every clip; a
/// radius is in place of a body.
/// `progress` is told before each clip; a clip file is read in one go. `importer` reads a scene's sources, and knows
/// them then. Throws InputError; all files are checked before it returns.
Scene load_scene(const std::filesystem::path& file, const ImportOptions& overrides = {}, const Progress& progress = {},
                 Importer* importer = nullptr);

/// Gives the clips of a file that is no scene one by one, each as load_scene has it with an agent that would play it,
/// and holds little more than them. Throws likewise.
void each_scene_clip(const std::filesystem::path& file, const ImportOptions& overrides,
                     const std::function<void(SceneClip&& clip, Agent&& agent)>& sink);

/// Parses the text of a scene. `name` stands for the file in messages; sources are taken relative to `folder`.
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  const ImportOptions& overrides = {}, const Progress& progress = {}, Importer* importer = nullptr);
/// The same of an object within another text.
Scene read_scene(const JsonPlace& place, const std::filesystem::path& folder);

/// The scene as JSON text, numbers with 17 digits. Clips with a source are written as their source; with
/// `inline_samples` every clip is written with its samples, so the file stands alone.
std::string to_json(const Scene& scene, bool inline_samples = false);

}  // namespace mobbscope
