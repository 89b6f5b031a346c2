// Graphs cut out of recordings: what they promise holds at every transition.
#include "walker_moves.h"

#include <crowd/graph/build_graph.h>
#include <crowd/graph/graph_figures.h>
#include <crowd/graph/pose_distance.h>
#include <scene/motion_graph.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

namespace mobbscope {
namespace {

const std::filesystem::path kClips = std::filesystem::path(MOBBSCOPE_SOURCE_DIR) / "assets/clips";

/// The project's own walkers, to be cut into a graph in `folder`.
const Scene& own_recordings(const std::filesystem::path& folder) {
    static const Scene scene = load_recordings(clip_files({kClips}), folder / "graph.json", {});
    return scene;
}

class OwnGraph : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<testing::TempFolder>();
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

    static std::unique_ptr<testing::TempFolder> folder_;
    static std::unique_ptr<BuiltGraph> built_;
};

std::unique_ptr<testing::TempFolder> OwnGraph::folder_;
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
        const mobb::Placement after = testing::following(scene(), move, placed, next);
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
    Rigs rigs;
    const auto by_hub = moves_by_hub(graph());
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
        const GraphMove& a = graph().moves[random() % graph().moves.size()];
        const auto& choices = by_hub[static_cast<std::size_t>(a.to)];
        const GraphMove& b = graph().moves[static_cast<std::size_t>(choices[random() % choices.size()])];
        const SceneClip& clip_a = scene().clips[static_cast<std::size_t>(a.clip)];
        const SceneClip& clip_b = scene().clips[static_cast<std::size_t>(b.clip)];
        const PoseTrack track_a = rigs.track(*whole_of(clip_a).clip, *whole_of(clip_a).skeleton);
        const PoseTrack track_b = rigs.track(*clip_b.clip, *clip_b.skeleton);
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
    const testing::TempFolder folder;
    const auto csv = folder.write("a.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n");
    const Scene flat = load_recordings({csv}, folder.path() / "g.json", {});
    EXPECT_NE(testing::input_error([&] { build_graph(flat, {}, "a.csv"); }).find("a.csv: no clip has joints"),
              std::string::npos);
    const Scene shortest = load_recordings({kClips / "run.glb"}, folder.path() / "g.json", {});
    GraphOptions strict;
    strict.bounds.pose_distance = 0;
    EXPECT_NE(testing::input_error([&] { build_graph(shortest, strict, "run"); }).find("no pose comes again"),
              std::string::npos);
    strict.bounds.pose_distance = -1;
    EXPECT_THROW(build_graph(shortest, strict, "run"), std::invalid_argument);
    EXPECT_NE(testing::input_error([&] { clip_files({folder.path() / "x.json"}); }).find("from clip files"),
              std::string::npos);
    std::filesystem::create_directory(folder.path() / "empty");
    folder.write("empty/readme.txt", "no motion");
    EXPECT_NE(testing::input_error([&] { clip_files({folder.path() / "empty"}); }).find("no clips in this folder"),
              std::string::npos);
}

TEST(GraphBuild, MovesKeepTheMotionOfTheirRecordings) {
    const testing::TempFolder folder;
    ImportOptions linear;
    linear.motion = mobb::Motion::linear;
    const Scene recordings = load_recordings(clip_files({kClips}), folder.path() / "graph.json", linear);
    const BuiltGraph built = build_graph(recordings, {}, "clips");
    ASSERT_FALSE(built.scene.clips.empty());
    for (const SceneClip& clip : built.scene.clips) {
        EXPECT_EQ(clip.clip->motion(), mobb::Motion::linear) << clip.name;
        EXPECT_EQ(clip.options.motion, mobb::Motion::linear) << "and when it is read from its file";
    }
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

/// The real recordings below a folder of the shared data; the test is skipped where there are none.
class RealRecordings : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(kData)) GTEST_SKIP() << "no data at " << kData;
    }
    Scene load(const std::filesystem::path& place) const {
        return load_recordings(clip_files({kData / place}), folder_.path() / "graph.json", {});
    }

    const std::filesystem::path kData = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "bvh";
    const testing::TempFolder folder_;
};

TEST_F(RealRecordings, ALongWalkBecomesAGraphWhoseBoundsHold) {
    const BuiltGraph built = build_graph(load("long/lafan1_walk4_subject1.bvh"), {}, "walk");
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

TEST_F(RealRecordings, TPosesBeforeAMotionAreNoCuts) {
    const Scene recordings = load("short");
    Rigs rigs;
    int with_t_pose = 0;
    for (const Recording& recording : recordings_of(recordings, rigs)) {
        const std::string& source = *recordings.clips[static_cast<std::size_t>(recording.clip)].source;
        if (source.find("cmu_0") == std::string::npos || source.find("120hz") == std::string::npos) continue;
        ++with_t_pose;
        EXPECT_GE(recording.first, 15) << source;
    }
    EXPECT_EQ(with_t_pose, 12);
}

TEST_F(RealRecordings, WholeClipsMakeAGraphOfOneHub) {
    Scene scene = load("short");
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const TransitionMeasures measured = measure_transitions(scene);
    EXPECT_EQ(measured.count, 51u * 51);
    EXPECT_GT(measured.pose_distance.count, 1000u);
    EXPECT_FALSE(exceeds(measured.pose_distance, scene.graph->bounds.pose_distance));
}

}  // namespace
}  // namespace mobbscope
