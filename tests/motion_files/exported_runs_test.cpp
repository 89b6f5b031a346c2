// What agents of a run played, written and imported again: the same disks and joints within 1 mm.
#include "exported.h"

#include <crowd/graph/build_graph.h>
#include <crowd/simulation/simulate.h>
#include <import/skeleton/disk_sampler.h>
#include <motion_files/formats.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

enum class Moves { whole_clips, graph };

/// Some agents play the clips for a while, and all of it is written and read again.
void expect_same_again(const std::vector<std::filesystem::path>& places, Moves moves, const ImportOptions& options = {},
                       const GraphOptions& graph_options = {}, glm::dvec2 area = {40, 40}, bool needs_turns = false) {
    for (const std::filesystem::path& place : places) {
        if (!std::filesystem::exists(place)) GTEST_SKIP() << "no test data at " << place;
    }
    Scene scene = load_recordings(clip_files(places), "graph.json", options, false).scene;
    if (moves == Moves::graph) {
        scene = build_graph(scene, graph_options, "recordings").scene;
    } else {
        scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    }
    SimulateOptions run;
    run.agents = 6;
    run.area = area;
    run.seconds = 30;
    const FittedScene fitted(scene, {});
    const MoveSet set(fitted);
    scene = scene_of_run(set, simulate(set, run).run);
    if (needs_turns) {
        EXPECT_GT(std::ranges::count_if(scene.clips, [](const SceneClip& clip) { return clip.turn.has_value(); }), 0);
    }
    for (const CrowdAgent& agent : scene.crowd->agents) {
        const PlayedMotion motion(scene, agent.name);
        EXPECT_EQ(motion.plays(), agent.plays.size());
        EXPECT_GE(motion.begin() + motion.frames() * motion.dt(), run.seconds);
        for (const MotionFormat& format : motion_formats()) {
            EXPECT_LE(farthest_off(motion, format), 1e-4) << format.extension << " of agent " << agent.name;
        }
    }
}

TEST(ExportedRuns, OfWholeClips) { expect_same_again({kClips}, Moves::whole_clips); }
TEST(ExportedRuns, OfAGraph) { expect_same_again({kClips}, Moves::graph); }

TEST(ExportedRuns, OfMovesThatTurnOnTheWay) { expect_same_again({kClips}, Moves::graph, {}, {}, {8, 8}, true); }

TEST(ExportedRuns, OfManySamplesASecond) {
    ImportOptions options;
    options.fps = 60;
    expect_same_again({kClips / "walk.glb", kClips / "turn.glb"}, Moves::whole_clips, options);
}

TEST(ExportedRuns, OfBvhRecordings) {
    const auto folder = kSharedData / "bvh/short";
    expect_same_again(
        {folder / "cmu_07_01_walk_120hz.bvh", folder / "cmu_07_02_walk_120hz.bvh", folder / "cmu_09_01_run_120hz.bvh"},
        Moves::whole_clips);
}
TEST(ExportedRuns, OfAGraphOfBvhRecordings) { expect_same_again({kSharedData / "bvh/short"}, Moves::graph); }

TEST(ExportedRuns, OfGltfWithABodyThatIsScaledAndTurnedByNodesAbove) {
    expect_same_again({kSharedData / "gltf/CesiumMan.glb"}, Moves::whole_clips);
    expect_same_again({kSharedData / "gltf/derived_cmu_07_05_cm.glb"}, Moves::whole_clips);
}

TEST(ExportedRuns, OfFbx) { expect_same_again({kSharedData / "fbx/cmu_85_04_breakdance.fbx"}, Moves::whole_clips); }

TEST(ExportedRuns, OfAGraphOfFbx) {
    GraphOptions dance;
    dance.bounds = {0.5, 3};
    expect_same_again({kSharedData / "fbx/cmu_85_14_breakdance.fbx"}, Moves::graph, {}, dance);
}

TEST(ExportedRuns, EveryMotionFileOfTheDataSetAlone) {
    if (!std::filesystem::exists(kSharedData / "bvh")) GTEST_SKIP() << "no test data at " << kSharedData;
    int checked = 0;
    for (const char* folder : {"bvh/short", "bvh/quirks", "gltf", "fbx"}) {
        for (const ClipFile& file : clip_files({kSharedData / folder})) {
            Scene scene;
            try {
                scene = load_recordings({file}, "one.json", {}, true).scene;
            } catch (const InputError&) {
                continue;  // morph targets alone
            }
            const PlayedMotion motion(scene, scene.clips.front().name);
            for (const MotionFormat& format : motion_formats()) {
                const std::string bytes = format.write(motion);
                const DiskDifference off = read_back(bytes, format, motion);
                EXPECT_LE(off.place, kSameDisk) << file.path << format.extension;
                EXPECT_LE(off.radius, kSameDisk) << file.path << format.extension;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 60);
}

}  // namespace
}  // namespace mobbscope
