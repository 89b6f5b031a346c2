// Graphs cut out of recordings: what they promise holds at every transition.
#include "walker_moves.h"

#include <base/error.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/graph_figures.h>
#include <crowd/graph/pose_distance.h>
#include <crowd/graph/rigs.h>
#include <crowd/simulation/move_set.h>
#include <import/skeleton/warp.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>
#include <support/folders.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <tbb/global_control.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// The project's own walkers, to be cut into a graph in `folder`.
const Scene& own_recordings(const std::filesystem::path& folder) {
    static const Scene scene = load_recordings(clip_files({kClips}), folder / "graph.json", {}, true).scene;
    return scene;
}

/// Metres that the root goes in a move, from its first sample to its exit.
double way_of(const mobb::Clip& clip, const GraphMove& move) {
    double way = 0;
    glm::dvec2 from(clip.samples().front().x, clip.samples().front().y);
    for (int i = 1; i <= clip.count(); ++i) {
        const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(std::min(i, clip.count() - 1))];
        const glm::dvec2 to = i < clip.count() ? glm::dvec2(disk.x, disk.y) : move.exit.position;
        way += glm::distance(from, to);
        from = to;
    }
    return way;
}

class OwnGraph : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TempFolder>();
        built_ = std::make_unique<BuiltGraph>(build_graph(own_recordings(folder_->path()), {}, "clips"));
    }
    static void TearDownTestSuite() {
        built_.reset();
        folder_.reset();
    }
    static const Scene& scene() { return built_->scene; }
    static const MotionGraph& graph() { return *built_->scene.graph; }
    static const mobb::Clip& clip_of(int move) {
        return *scene().clips[static_cast<std::size_t>(graph().moves[static_cast<std::size_t>(move)].clip)].clip;
    }

    static std::unique_ptr<TempFolder> folder_;
    static std::unique_ptr<BuiltGraph> built_;
};

std::unique_ptr<TempFolder> OwnGraph::folder_;
std::unique_ptr<BuiltGraph> OwnGraph::built_;

TEST_F(OwnGraph, OffersWalksTurnsStopsAndRuns) {
    double fastest = 0;
    double slowest = 100;
    double left = 0;
    double right = 0;
    for (const GraphMove& move : graph().moves) {
        const mobb::Clip& clip = *scene().clips[static_cast<std::size_t>(move.clip)].clip;
        const double speed = way_of(clip, move) / clip.duration();
        const double turn = std::remainder(move.exit.heading_deg - move.entry.heading_deg, 360.0);
        fastest = std::max(fastest, speed);
        slowest = std::min(slowest, speed);
        left = std::max(left, turn);
        right = std::min(right, turn);
        EXPECT_GE(clip.duration(), 1 - 1e-9);
        EXPECT_LE(clip.duration(), 4 + 1e-9);
    }
    EXPECT_GT(fastest, 2);
    EXPECT_LT(slowest, 0.5);
    EXPECT_GT(left, 80);
    EXPECT_LT(right, -80);
    EXPECT_EQ(graph_figures(scene()).components.size(), 1u);
    EXPECT_GT(graph_figures(scene()).choices, 20);
}

TEST_F(OwnGraph, EveryHubIsLeftAndReached) {
    const GraphFigures figures = graph_figures(scene());
    for (const HubFigures& hub : figures.hubs) EXPECT_TRUE(hub.begin > 0 && hub.end > 0) << hub.name;
    for (const ComponentFigures& part : figures.components) EXPECT_GE(part.moves, 3u);
    std::size_t within = 0;
    for (const ComponentFigures& part : figures.components) within += part.moves;
    EXPECT_EQ(within, figures.moves);
}

TEST_F(OwnGraph, BoundsHoldAtEveryJoint) {
    const TransitionMeasures measured = measure_transitions(scene());
    EXPECT_EQ(measured.pose_distance.count, measured.count);
    EXPECT_LE(measured.pose_distance.largest, graph().bounds.pose_distance);
    EXPECT_LE(measured.root_speed.largest, graph().bounds.root_speed);
    EXPECT_GT(measured.pose_distance.largest, 0.02);
    EXPECT_GT(measured.root_speed.largest, 0.05);
}

TEST_F(OwnGraph, RandomWalksAreContinuous) {
    const auto by_hub = moves_by_hub(graph());
    std::mt19937 random(3);
    int move = 0;
    mobb::Placement placed{{5, -7}, 123, 2};
    double largest_step = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto& choices = by_hub[static_cast<std::size_t>(graph().moves[static_cast<std::size_t>(move)].to)];
        const int next = choices[random() % choices.size()];
        const mobb::Placement after = following(scene(), move, placed, next);
        const mobb::PlacedClip before_clip(clip_of(move), placed);
        const mobb::PlacedClip after_clip(clip_of(next), after);
        ASSERT_NEAR(after.start, before_clip.time(before_clip.count()), 1e-9);

        // The next clip begins just where this one's next frame would have been.
        const Stance& exit = graph().moves[static_cast<std::size_t>(move)].exit;
        const glm::dvec2 expected = before_clip.rotation()(exit.position) + placed.translate;
        const mobb::Disk first = after_clip.disk(0);
        ASSERT_NEAR(first.x, expected.x, 1e-9);
        ASSERT_NEAR(first.y, expected.y, 1e-9);

        const mobb::Disk last = before_clip.disk(before_clip.count() - 1);
        const mobb::Disk second = after_clip.disk(1);
        const double dt = clip_of(move).dt();
        const double change =
            std::hypot((second.x - first.x) - (first.x - last.x), (second.y - first.y) - (first.y - last.y)) / dt;
        ASSERT_LE(change, graph().bounds.root_speed + 1e-6);
        largest_step = std::max(largest_step, std::hypot(first.x - last.x, first.y - last.y) / dt);
        move = next;
        placed = after;
    }
    EXPECT_LT(largest_step, 4);  // no one is put elsewhere
}

TEST_F(OwnGraph, JointsOfBodiesStayWhereTheyAre) {
    // Of all joints, in world coordinates, from whole recordings: independent of how distances are found.
    const Scene& recordings = own_recordings(folder_->path());
    const auto whole_of = [&](const SceneClip& part) -> const SceneClip& {
        return *std::find_if(recordings.clips.begin(), recordings.clips.end(),
                             [&](const SceneClip& whole) { return whole.source == part.source; });
    };
    const auto joints = joints_of(graph().rigs.front(), *recordings.clips.front().skeleton);
    const auto by_hub = moves_by_hub(graph());
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
        const GraphMove& a = graph().moves[random() % graph().moves.size()];
        const auto& choices = by_hub[static_cast<std::size_t>(a.to)];
        const GraphMove& b = graph().moves[static_cast<std::size_t>(choices[random() % choices.size()])];
        const SceneClip& clip_a = scene().clips[static_cast<std::size_t>(a.clip)];
        const SceneClip& clip_b = scene().clips[static_cast<std::size_t>(b.clip)];
        const PoseTrack track_a = pose_track(*whole_of(clip_a).clip, *whole_of(clip_a).skeleton, 0, joints);
        const PoseTrack track_b = pose_track(*clip_b.clip, *clip_b.skeleton, 0, joints);
        const mobb::Placement next = following({}, a.exit, clip_a.clip->duration(), b.entry);
        const mobb::Rotation turn = mobb::Rotation::from_degrees(next.rotate_deg);
        const auto exit = static_cast<int>(std::lround((clip_a.options.trim->second + track_a.dt / 2) / track_a.dt));
        double squares = 0;
        for (std::size_t j = 0; j < track_a.joints; ++j) {
            const glm::dvec3 p = track_a.at(exit)[j];
            const glm::dvec3 q = track_b.at(0)[j];
            const glm::dvec2 at_p = glm::dvec2(p) + track_a.root[static_cast<std::size_t>(exit)];
            const glm::dvec2 at_q = turn(glm::dvec2(q) + track_b.root[0]) + next.translate;
            squares += (at_p.x - at_q.x) * (at_p.x - at_q.x) + (at_p.y - at_q.y) * (at_p.y - at_q.y) +
                       (p.z - q.z) * (p.z - q.z);
        }
        // One frame of five may have all of the moment's distance.
        ASSERT_LE(std::sqrt(squares / static_cast<double>(track_a.joints)),
                  std::sqrt(5.0) * graph().bounds.pose_distance);
    }
}

TEST_F(OwnGraph, MovesOfAHubBeginInOnePose) {
    std::map<int, MovingPose> of_hub;
    double height = 0;
    for (const GraphMove& move : graph().moves) {
        const SceneClip& clip = scene().clips[static_cast<std::size_t>(move.clip)];
        ASSERT_TRUE(clip.warp);
        EXPECT_EQ(clip.warp->end.name, graph().hubs[static_cast<std::size_t>(move.to)].name);
        // Of one frame and the next, as there is none before.
        const MovingPose pose = moving_pose(*clip.clip, *clip.skeleton, 1, move.entry.heading_deg);
        const auto& [unused, first] = *of_hub.try_emplace(move.from, pose).first;
        EXPECT_NEAR(pose.height, first.height, 1e-5);
        EXPECT_LT(glm::distance(pose.velocity, first.velocity), 1e-4);
        // Second frames differ by what joints accelerate by.
        for (std::size_t i = 0; i < pose.joints.size(); ++i)
            EXPECT_GT(std::abs(glm::dot(pose.joints[i].rotation, first.joints[i].rotation)), 0.9999);
        height = pose.height;
    }
    EXPECT_GT(height, 0.5);
    EXPECT_EQ(of_hub.size(), graph().hubs.size());
}

TEST_F(OwnGraph, WithoutAWarpMovesAreAsRecorded) {
    GraphOptions options;
    options.warp = 0;
    const Scene& recordings = own_recordings(folder_->path());
    const BuiltGraph plain = build_graph(recordings, options, "clips");
    ASSERT_EQ(plain.scene.clips.size(), scene().clips.size());
    EXPECT_EQ(*plain.scene.graph, graph());
    for (const SceneClip& clip : plain.scene.clips) EXPECT_FALSE(clip.warp);
    const Transitions of_plain = each_transition(plain.scene);
    EXPECT_EQ(each_transition(scene()).pose_distance, of_plain.pose_distance) << "bounds are those of recordings";
    EXPECT_EQ(each_transition(scene()).root_speed, of_plain.root_speed);
    options.warp = -1;
    EXPECT_THROW(build_graph(recordings, options, "clips"), std::invalid_argument);
}

TEST_F(OwnGraph, TurnedMovesAreMeasuredAsWhatTheyAreVariantsOf) {
    const FittedScene fitted(scene(), {});
    const MoveSet moves(fitted, kDefaultTurnRate);
    constexpr int kMove = 3;
    const int turned = moves.turned({kMove, 30}).value();
    const Scene run = moves.extended(std::array{turned}).scene;
    const int variant = static_cast<int>(graph().moves.size());
    ASSERT_TRUE(run.graph->moves.at(static_cast<std::size_t>(variant)).turned);
    const Transitions all = each_transition(run);
    std::map<std::pair<int, int>, std::pair<double, double>> of;
    for (std::size_t i = 0; i < all.moves.size(); ++i) of[all.moves[i]] = {all.pose_distance[i], all.root_speed[i]};
    std::size_t joins = 0;
    for (const auto& [moves_of, measured] : of) {
        const auto recorded = [&](int move) { return move == variant ? kMove : move; };
        EXPECT_EQ(measured, of.at({recorded(moves_of.first), recorded(moves_of.second)}));
        if (moves_of.first == variant || moves_of.second == variant) ++joins;
    }
    EXPECT_GT(joins, 10u);
}

TEST_F(OwnGraph, ItsFileGivesTheSameSamples) {
    const auto file = folder_->write("graph.json", to_json(scene()));
    const Scene read = load_scene(file);
    EXPECT_EQ(*read.graph, graph());
    ASSERT_EQ(read.clips.size(), scene().clips.size());
    for (std::size_t i = 0; i < read.clips.size(); ++i) {
        const auto a = read.clips[i].clip->samples();
        const auto b = scene().clips[i].clip->samples();
        ASSERT_EQ(a.size(), b.size()) << read.clips[i].name;
        ASSERT_TRUE(read.clips[i].skeleton);
        for (std::size_t k = 0; k < a.size(); ++k) {
            ASSERT_NEAR(a[k].x, b[k].x, 1e-9);
            ASSERT_NEAR(a[k].y, b[k].y, 1e-9);
            ASSERT_NEAR(a[k].r, b[k].r, 1e-9);
        }
    }
    const TransitionMeasures measured = measure_transitions(read);
    EXPECT_FALSE(exceeds(measured.pose_distance, graph().bounds.pose_distance));
    EXPECT_NEAR(measured.pose_distance.largest, measure_transitions(scene()).pose_distance.largest, 1e-6);
}

TEST_F(OwnGraph, IsTheSameOnAnyNumberOfThreads) {
    const Scene& recordings = own_recordings(folder_->path());
    const std::string text = to_json(scene());
    for (const std::size_t threads : {1u, 5u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_TRUE(to_json(build_graph(recordings, {}, "clips").scene) == text) << threads;
    }
    GraphOptions other;
    other.seed = 2;
    EXPECT_FALSE(to_json(build_graph(recordings, other, "clips").scene) == text);
}

TEST_F(OwnGraph, ABodyMovedInItsFileBreaksABound) {
    Scene broken = scene();
    auto changed = std::make_shared<MotionGraph>(graph());
    changed->moves[0].exit.heading_deg += 40;
    broken.graph = changed;
    EXPECT_TRUE(exceeds(measure_transitions(broken).pose_distance, graph().bounds.pose_distance));
    changed = std::make_shared<MotionGraph>(graph());
    changed->moves[0].exit.position += glm::dvec2(0.1, 0);
    broken.graph = changed;
    EXPECT_TRUE(exceeds(measure_transitions(broken).root_speed, graph().bounds.root_speed));
    changed = std::make_shared<MotionGraph>(graph());
    changed->moves[0].entry.position += glm::dvec2(0.1, 0);
    broken.graph = changed;
    EXPECT_TRUE(exceeds(measure_transitions(broken).root_speed, graph().bounds.root_speed)) << "a leap at each begin";
}

TEST_F(OwnGraph, ListsTheJointsThatCount) {
    ASSERT_EQ(graph().rigs.size(), 1u);
    const std::vector<std::string>& joints = graph().rigs.front().joints;
    EXPECT_GT(joints.size(), 5u);
    for (const GraphMove& move : graph().moves) EXPECT_EQ(move.rig, 0);
    // Moves are measured by these alone: with the root alone bodies are much alike.
    Scene by_root = scene();
    auto changed = std::make_shared<MotionGraph>(graph());
    changed->rigs.front().joints = {joints.front()};
    by_root.graph = changed;
    EXPECT_LT(measure_transitions(by_root).pose_distance.median, measure_transitions(scene()).pose_distance.median / 2);
    changed->rigs.front().joints = {"wing"};
    EXPECT_NE(input_error([&] { measure_transitions(by_root); }).find("there is no joint 'wing'"), std::string::npos);
    // An older file lists none: they are found anew.
    auto older = std::make_shared<MotionGraph>(graph());
    older->rigs.clear();
    for (GraphMove& move : older->moves) move.rig = -1;
    by_root.graph = older;
    EXPECT_EQ(measure_transitions(by_root).pose_distance.largest, measure_transitions(scene()).pose_distance.largest);
}

TEST_F(OwnGraph, TheCheckFindsNothingToDrop) {
    BuiltGraph built = *built_;
    check_graph(built, 3);
    EXPECT_EQ(built.report.broken, 0u);
    EXPECT_EQ(built.report.joints_checked, measure_transitions(scene()).count);
    EXPECT_EQ(*built.scene.graph, graph());
}

TEST_F(OwnGraph, TheCheckDropsMovesThatBreakABoundInTheirFiles) {
    // What is in memory is as it was; the file that two of the moves lead to holds another motion.
    BuiltGraph built = *built_;
    const std::string other = "elsewhere.glb";
    std::filesystem::copy_file(kClips / "wander.glb", folder_->path() / other,
                               std::filesystem::copy_options::overwrite_existing);
    std::vector<std::string> wrong;
    for (SceneClip& clip : built.scene.clips) {
        if (wrong.size() == 2 || clip.source->find("wander.glb") == std::string::npos) continue;
        const auto [begin, end] = *clip.options.trim;
        clip.source = other;
        clip.options.trim = {begin + 0.4, end + 0.4};
        wrong.push_back(clip.name);
    }
    ASSERT_EQ(wrong.size(), 2u);
    check_graph(built, 3);
    EXPECT_EQ(built.report.broken, 2u);
    EXPECT_EQ(built.scene.graph->moves.size(), graph().moves.size() - 2);
    EXPECT_EQ(built.scene.clips.size(), built.scene.graph->moves.size());
    for (const SceneClip& clip : built.scene.clips) EXPECT_NE(clip.source, other);
    for (std::size_t m = 0; m < built.scene.graph->moves.size(); ++m) {
        EXPECT_EQ(built.scene.graph->moves[m].clip, static_cast<int>(m));
    }
    const TransitionMeasures measured = measure_transitions(built.scene);
    EXPECT_EQ(measured.pose_distance.count, measured.count);
    EXPECT_FALSE(exceeds(measured.pose_distance, graph().bounds.pose_distance));
    EXPECT_FALSE(exceeds(measured.root_speed, graph().bounds.root_speed));
}

TEST_F(OwnGraph, OfAGraphWhoseFilesChangedNothingMayStay) {
    BuiltGraph built = *built_;
    auto changed = std::make_shared<MotionGraph>(graph());
    changed->bounds.pose_distance = 1e-9;
    built.scene.graph = changed;
    check_graph(built, 3);
    EXPECT_GT(built.report.broken, 0u);
    EXPECT_TRUE(built.scene.graph->moves.empty());
    EXPECT_TRUE(built.scene.graph->hubs.empty());
    EXPECT_TRUE(built.scene.clips.empty());
}

TEST_F(OwnGraph, OptionsAreKept) {
    GraphOptions options;
    options.bounds = {0.1, 0.3};
    options.least_seconds = 2;
    options.most_seconds = 3;
    options.hubs = 2;
    options.moves = 4;
    const BuiltGraph small = build_graph(own_recordings(folder_->path()), options, "clips");
    const MotionGraph& few = *small.scene.graph;
    EXPECT_LE(few.hubs.size(), 2u);
    EXPECT_LE(few.moves.size(), 2u * 2 * 4);
    EXPECT_EQ(few.bounds, options.bounds);
    for (const SceneClip& clip : small.scene.clips) {
        EXPECT_GE(clip.clip->duration(), 2 - 1e-9);
        EXPECT_LE(clip.clip->duration(), 3 + 1e-9);
    }
    const TransitionMeasures measured = measure_transitions(small.scene);
    EXPECT_LE(measured.pose_distance.largest, 0.1);
    EXPECT_LE(measured.root_speed.largest, 0.3);
}

TEST(GraphBuild, RefusesWhatCannotBeCut) {
    const TempFolder folder;
    const auto csv = folder.write("a.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n");
    const Scene flat = load_recordings(clip_files({csv}), folder.path() / "g.json", {}, true).scene;
    EXPECT_NE(input_error([&] { build_graph(flat, {}, "a.csv"); }).find("a.csv: no clip has joints"),
              std::string::npos);
    const Scene shortest = load_recordings(clip_files({kClips / "run.glb"}), folder.path() / "g.json", {}, true).scene;
    GraphOptions strict;
    strict.bounds.pose_distance = 0;
    EXPECT_NE(input_error([&] { build_graph(shortest, strict, "run"); }).find("no pose comes again"),
              std::string::npos);
    strict.bounds.pose_distance = -1;
    EXPECT_THROW(build_graph(shortest, strict, "run"), std::invalid_argument);
    EXPECT_NE(input_error([&] { clip_files({folder.path() / "x.json"}); }).find("from clip files"), std::string::npos);
    std::filesystem::create_directory(folder.path() / "empty");
    folder.write("empty/readme.txt", "no motion");
    EXPECT_NE(input_error([&] { clip_files({folder.path() / "empty"}); }).find("no clips in this folder"),
              std::string::npos);
}

TEST(GraphBuild, MovesKeepTheMotionOfTheirRecordings) {
    const TempFolder folder;
    ImportOptions linear;
    linear.motion = mobb::Motion::linear;
    const Scene recordings = load_recordings(clip_files({kClips}), folder.path() / "graph.json", linear, true).scene;
    const BuiltGraph built = build_graph(recordings, {}, "clips");
    ASSERT_FALSE(built.scene.clips.empty());
    for (const SceneClip& clip : built.scene.clips) {
        EXPECT_EQ(clip.clip->motion(), mobb::Motion::linear) << clip.name;
        EXPECT_EQ(clip.options.motion, mobb::Motion::linear) << "and when it is read from its file";
    }
}

/// Two folders of clips in one: "a" has walks and a file that is none, "b" a run.
class ClipFolders : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char* folder : {"a", "b"}) std::filesystem::create_directory(path(folder));
        std::filesystem::copy_file(kClips / "run.glb", path("b/run.glb"));
        folder_.write("a/bad.bvh", "HIERARCHY");
        folder_.write("a/straight.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n");
        folder_.write("a/bend.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n2,1,1,1\n");
    }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::vector<std::string> sources(const std::vector<std::filesystem::path>& places) const {
        std::vector<std::string> out;
        const Scene scene = load_recordings(clip_files(places), path("graph.json"), {}, false).scene;
        for (const SceneClip& clip : scene.clips) out.push_back(clip.name + " from " + *clip.source);
        return out;
    }

    const TempFolder folder_;
};

TEST_F(ClipFolders, WhatTheyHoldDecidesTheOrder) {
    const auto by_folders = sources({path("a"), path("b")});
    EXPECT_EQ(by_folders.size(), 3u);
    EXPECT_EQ(sources({path("b"), path("a")}), by_folders);
    EXPECT_EQ(sources({path("b/../b/./run.glb"), path("a/"), path("a/bend.csv"), path("b")}), by_folders);
    EXPECT_EQ(sources({path("a/bend.csv"), path("b/run.glb"), path("a/straight.csv")}), by_folders);
    EXPECT_EQ(sources({std::filesystem::relative(path("a")), std::filesystem::relative(path("b"))}), by_folders);
    // A link to a file is the file.
    std::filesystem::create_symlink(path("b/run.glb"), path("b/sprint.glb"));
    EXPECT_EQ(sources({path("b"), path("a")}), by_folders);
    // Other names, the same order.
    std::filesystem::rename(path("a/straight.csv"), path("a/z.csv"));
    std::filesystem::rename(path("a/bend.csv"), path("a/y.csv"));
    std::vector<std::string> renamed = by_folders;
    for (std::string& text : renamed) {
        if (text == "straight from a/straight.csv") text = "z from a/z.csv";
        if (text == "bend from a/bend.csv") text = "y from a/y.csv";
    }
    EXPECT_NE(renamed, by_folders);
    EXPECT_EQ(sources({path("a"), path("b")}), renamed);
    std::filesystem::rename(path("a/z.csv"), path("a/0.csv"));
    for (std::string& text : renamed) {
        if (text == "z from a/z.csv") text = "0 from a/0.csv";
    }
    EXPECT_EQ(sources({path("a"), path("b")}), renamed);
}

TEST_F(ClipFolders, ABadFileIsLeftOutUnlessItWasNamed) {
    const auto load = [&](const std::vector<std::filesystem::path>& places, bool strict) {
        return load_recordings(clip_files(places), path("graph.json"), {}, strict);
    };
    const Recordings recordings = load({path("a"), path("b")}, false);
    EXPECT_EQ(recordings.scene.clips.size(), 3u);
    ASSERT_EQ(recordings.left_out.size(), 1u);
    EXPECT_NE(recordings.left_out.front().find("a/bad.bvh: "), std::string::npos) << recordings.left_out.front();
    const std::string why = input_error([&] { load({path("a"), path("b")}, true); });
    EXPECT_EQ(why, recordings.left_out.front());
    EXPECT_EQ(input_error([&] { load({path("a/bad.bvh"), path("b")}, false); }), why);
    EXPECT_EQ(input_error([&] { load({path("a"), path("a/bad.bvh")}, false); }), why);
    EXPECT_NE(input_error([&] {
                  load({path("a"), path("none.bvh")}, false);
              }).find("none.bvh: no such file"),
              std::string::npos);
    for (const char* name : {"a/straight.csv", "a/bend.csv"}) std::filesystem::remove(path(name));
    EXPECT_EQ(input_error([&] { load({path("a")}, false); }), why);
    folder_.write("a/also_bad.bvh", "HIERARCHY");
    EXPECT_NE(input_error([&] { load({path("a")}, false); }).find("; nor can 1 other file be read"), std::string::npos);
}

TEST_F(ClipFolders, AFolderThatCannotBeReadIsLeftOutAndNamed) {
    std::filesystem::create_directory(path("b/closed"));
    folder_.write("b/closed/x.csv", "t,x,y,r\n0,0,0,0.4\n");
    std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
    std::filesystem::permissions(path("b/closed"), std::filesystem::perms::none);
    const bool was_root = ::geteuid() == 0;  // who may read everything
    if (was_root && ::seteuid(65534) != 0) GTEST_SKIP() << "root stays root";
    std::vector<ClipFile> files;
    std::string closed;
    try {
        files = clip_files({path("b")});
        closed = input_error([&] { clip_files({path("b/closed")}); });
    } catch (const InputError& error) {
        ADD_FAILURE() << error.what();
    }
    if (was_root && ::seteuid(0) != 0) std::abort();
    const std::string why = path("b/closed").string() + ": the folder cannot be read: Permission denied";
    EXPECT_EQ(closed, why);
    const Recordings recordings = load_recordings(files, path("graph.json"), {}, false);
    EXPECT_EQ(recordings.left_out, std::vector<std::string>{why});
    EXPECT_FALSE(recordings.scene.clips.empty());
    EXPECT_EQ(input_error([&] { load_recordings(files, path("graph.json"), {}, true); }), why);
}

TEST(GraphBuild, ClipsThatAreTooLongForTheirJointsAreNotSaidToHaveNone) {
    Scene scene = load_recordings(clip_files({kClips}), "graph.json", {}, true).scene;
    // As an import leaves them of which there would be too many positions.
    for (SceneClip& clip : scene.clips) clip.skeleton.reset();
    EXPECT_NE(input_error([&] { build_graph(scene, {}, "clips"); }).find("has too many samples"), std::string::npos);
}

TEST(GraphBuild, MoreSamplesASecondThanMotionHasAreRefused) {
    ImportOptions options;
    options.fps = 1000;
    EXPECT_NO_THROW(load_recordings(clip_files({kClips / "run.glb"}), "graph.json", options, true));
    options.fps = 1001;
    EXPECT_NE(input_error([&] {
                  load_recordings(clip_files({kClips / "run.glb"}), "graph.json", options, false);
              }).find("has 1001 samples a second; graphs are built from up to 1000: lower --fps"),
              std::string::npos);
}

TEST(GraphBuild, OnlyPiecesThatDifferAreKept) {
    // A walk along +x at 1 m/s and the same one later, and one that turns.
    PoseTrack track;
    track.dt = 0.1;
    track.joints = 1;
    for (int i = 0; i < 60; ++i) {
        track.root.emplace_back(0.1 * i, i < 40 ? 0 : 0.1 * (i - 40));
        track.points.emplace_back(0, 0, 1);
    }
    std::vector<Recording> recordings;
    recordings.push_back({0, track, PoseWindows(track), 0, 60});
    const auto piece = [](int begin, int end) { return Piece{0, 0, {0, begin, 0, 0.01}, {0, end, 0, 0.01}}; };
    const std::vector<Piece> pieces{piece(0, 15), piece(5, 20), piece(20, 35), piece(38, 53), piece(0, 30)};
    EXPECT_EQ(different_pieces(recordings, pieces, 10), (std::vector<std::size_t>{0, 3, 4}));
    EXPECT_EQ(different_pieces(recordings, pieces, 2), (std::vector<std::size_t>{0, 4}));
    EXPECT_EQ(different_pieces(recordings, {}, 2), (std::vector<std::size_t>{}));
}

/// The real recordings of the shared data; the test is skipped where there are none.
class RealRecordings : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(kSharedData)) GTEST_SKIP() << "no data at " << kSharedData;
    }
    Scene load(const std::vector<std::filesystem::path>& places) const {
        std::vector<std::filesystem::path> whole;
        for (const std::filesystem::path& place : places) whole.push_back(kSharedData / place);
        return load_recordings(clip_files(whole), folder_.path() / "graph.json", {}, false).scene;
    }

    const TempFolder folder_;
};

TEST_F(RealRecordings, ALongWalkBecomesAGraphWhoseBoundsHold) {
    const BuiltGraph built = build_graph(load({"bvh/long/lafan1_walk4_subject1.bvh"}), {}, "walk");
    const GraphFigures figures = graph_figures(built.scene);
    EXPECT_GT(figures.moves, 50u);
    EXPECT_GT(figures.choices, 10);
    const auto file = folder_.write("graph.json", to_json(built.scene));
    const Scene read = load_scene(file);
    const TransitionMeasures measured = measure_transitions(read);
    EXPECT_EQ(measured.pose_distance.count, measured.count);
    EXPECT_FALSE(exceeds(measured.pose_distance, read.graph->bounds.pose_distance));
    EXPECT_FALSE(exceeds(measured.root_speed, read.graph->bounds.root_speed));
}

TEST_F(RealRecordings, GiveOneGraphInAnyOrder) {
    using Places = std::vector<std::filesystem::path>;
    const std::vector<Places> orders[] = {
        {{"bvh/short", "bvh/long"}, {"bvh/long", "bvh/short"}},
        {{"bvh/short", "bvh/long", "gltf"}, {"gltf", "bvh/long", "bvh/short"}, {"bvh/long", "gltf", "bvh/short"}}};
    for (const auto& of_same : orders) {
        std::string first;
        for (const Places& places : of_same) {
            BuiltGraph built = build_graph(load(places), {}, "recordings");
            check_graph(built, 3);
            EXPECT_EQ(built.report.broken, 0u) << "half of each bound towards a hub is a whole one between two moves";
            const std::string text = to_json(built.scene);
            EXPECT_TRUE(first.empty() || text == first) << "places from " << places.front();
            first = text;
        }
        const Scene read = load_scene(folder_.write("graph.json", first));
        const TransitionMeasures measured = measure_transitions(read);
        EXPECT_GT(measured.count, 1000u);
        EXPECT_EQ(measured.pose_distance.count, measured.count);
        EXPECT_FALSE(exceeds(measured.pose_distance, read.graph->bounds.pose_distance));
        EXPECT_FALSE(exceeds(measured.root_speed, read.graph->bounds.root_speed));
        // Rigs stay apart: no hub has moves of two.
        std::map<int, int> rig_of_hub;
        for (const GraphMove& move : read.graph->moves) {
            EXPECT_EQ(rig_of_hub.try_emplace(move.from, move.rig).first->second, move.rig);
            EXPECT_EQ(rig_of_hub.try_emplace(move.to, move.rig).first->second, move.rig);
        }
        EXPECT_GT(read.graph->rigs.size(), 2u);
        // Of every body legs, spine and arms count; the other models of glTF may have one joint.
        const auto is_body = [](const GraphRig& rig) { return rig.joints.size() >= 15; };
        EXPECT_GE(std::count_if(read.graph->rigs.begin(), read.graph->rigs.end(), is_body), 4);
    }
}

TEST_F(RealRecordings, TPosesBeforeAMotionAreNoCuts) {
    const Scene recordings = load({"bvh/short"});
    int with_t_pose = 0;
    for (const Recording& recording : recordings_of(recordings, rigs_of(recordings))) {
        const std::string& source = *recordings.clips[static_cast<std::size_t>(recording.clip)].source;
        if (source.find("cmu_0") == std::string::npos || source.find("120hz") == std::string::npos) continue;
        ++with_t_pose;
        EXPECT_GE(recording.first, 15) << source;
    }
    EXPECT_EQ(with_t_pose, 12);
}

TEST_F(RealRecordings, WholeClipsMakeAGraphOfOneHub) {
    Scene scene = load({"bvh/short"});
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const TransitionMeasures measured = measure_transitions(scene);
    EXPECT_EQ(measured.count, 51u * 51);
    EXPECT_GT(measured.pose_distance.count, 1000u);
    EXPECT_FALSE(exceeds(measured.pose_distance, scene.graph->bounds.pose_distance));
}

}  // namespace
}  // namespace mobbscope
