// The keys turn of a clip and turned of a move.
#include <base/random.h>
#include <base/text.h>
#include <import/skeleton/motion.h>
#include <scene/clip_import.h>
#include <scene/clip_turn.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// A clip of two seconds along +x from a file, and one that turns.
struct TurnFolder {
    TempFolder folder;
    TurnFolder() { folder.write("walk.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n2,2,0,1\n3,3,0,1\n"); }

    Scene read(const std::string& turn, const std::string& rest = "") const {
        return parse_scene(R"({"clips": {"walk": {"source": "walk.csv"},
"turned": {"source": "walk.csv", "turn": )" +
                               turn + "}}" + rest + "}",
                           "s.json", folder.path());
    }
    std::string refusal(const std::string& turn, const std::string& rest = "") const {
        return input_error([&] { read(turn, rest); });
    }
};

TEST(ClipTurn, BendsTheWayAndIsWrittenAgain) {
    const TurnFolder of;
    const Scene scene = of.read(R"({"deg": 90, "seconds": 2})");
    const auto samples = scene.clips[1].clip->samples();
    // Smoothstep at a quarter and at three quarters.
    const double early = 90 * 0.15625 * 3.14159265358979 / 180, late = 90 * 0.84375 * 3.14159265358979 / 180;
    EXPECT_NEAR(samples[1].x, std::cos(early), 1e-12);
    EXPECT_NEAR(samples[1].y, std::sin(early), 1e-12);
    EXPECT_NEAR(samples[2].x, std::cos(early) + std::cos(late), 1e-12);
    EXPECT_NEAR(samples[3].x, samples[2].x, 1e-12);
    EXPECT_NEAR(samples[3].y, samples[2].y + 1, 1e-12);
    EXPECT_EQ(samples[3].r, 1);
    const Scene again = parse_scene(to_json(scene), "s.json", of.folder.path());
    EXPECT_EQ(again.clips[1].turn, scene.clips[1].turn);
    EXPECT_EQ(again.clips[1].clip->samples()[3].y, samples[3].y);
    // Written with samples it is bent already.
    const Scene inlined = parse_scene(to_json(scene, true), "s.json", of.folder.path());
    EXPECT_FALSE(inlined.clips[1].turn);
    EXPECT_EQ(inlined.clips[1].clip->samples()[3].y, samples[3].y);
}

TEST(ClipTurn, IsKeptWhereAClipIsImportedAnew) {
    const TurnFolder of;
    Scene scene = of.read(R"({"deg": 90, "seconds": 2})");
    ImportOptions options;
    options.unit = "cm";
    const auto file = source_file(of.folder.path() / "walk.csv", nullptr);
    replace_clips(scene, reimport(scene, *file, {{1, options}}));
    EXPECT_EQ(scene.clips[1].turn, (ClipTurn{90, 2}));
    EXPECT_NEAR(scene.clips[1].clip->samples()[3].x, scene.clips[1].clip->samples()[2].x, 1e-12);
    options.trim = {0, 0.5};
    EXPECT_NE(input_error([&] {
                  reimport(scene, *file, {{1, options}});
              }).find("walk.csv: a turn of 2 s"),
              std::string::npos);
}

TEST(ClipTurn, TurnsTheSkeletonWithTheDisks) {
    SceneClip clip = load_scene(kClips / "walk.glb").clips.front();
    const SceneClip was = clip;
    bend(clip, {60, 1});
    const int last = clip.clip->count() - 1;
    const mobb::Rotation by = mobb::Rotation::from_degrees(60);
    for (std::size_t j = 0; j < was.skeleton->joints.size(); ++j) {
        EXPECT_EQ(clip.skeleton->at(0)[j], was.skeleton->at(0)[j]) << "nothing jumps at its begin";
        const glm::vec3 before = was.skeleton->at(last)[j];
        const glm::dvec2 expected = by({before.x, before.y});
        EXPECT_NEAR(clip.skeleton->at(last)[j].x, expected.x, 1e-5);
        EXPECT_NEAR(clip.skeleton->at(last)[j].y, expected.y, 1e-5);
        EXPECT_EQ(clip.skeleton->at(last)[j].z, before.z);
    }
}

TEST(ClipTurn, BadKeysAreRefusedAtTheirPlace) {
    const TurnFolder of;
    const std::pair<std::string, const char*> cases[] = {
        {of.refusal(R"({"deg": 181, "seconds": 1})"), "/clips/turned/turn/deg: 181 is out of range"},
        {of.refusal(R"({"deg": 30, "seconds": 0})"), "/clips/turned/turn/seconds: must be greater than 0"},
        {of.refusal(R"({"deg": 30})"), "/clips/turned/turn: the key 'seconds' is missing"},
        {of.refusal(R"({"deg": 30, "second": 1})"), "unknown key 'second'"},
        {of.refusal(R"({"deg": 30, "seconds": 4.5})"),
         "/clips/turned/turn: a turn of 4.5 s does not fit into a clip of 4 s"},
        {input_error([] {
             parse_scene(R"({"clips": {"a": {"dt": 1, "samples": [[0,0,1]], "turn": {"deg": 1, "seconds": 1}}}})",
                         "s.json", "");
         }),
         "/clips/a/turn: only a clip with a source is turned"},
    };
    for (const auto& [message, expected] : cases) EXPECT_NE(message.find(expected), std::string::npos) << message;
}

TEST(ClipTurn, ATurnedMoveFitsTheOneThatItIsAVariantOf) {
    const TurnFolder of;
    const std::string turn = R"({"deg": 30, "seconds": 1})";
    const auto rest = [](const std::string& move) {
        return R"(, "graph": {"hubs": [{"name": "A"}, {"name": "B"}], "moves": [
{"clip": "walk", "from": 0, "to": 0, "entry": [0,0,0], "exit": [4,0,0]}, {)" +
               move + "}]}";
    };
    const auto graph = [&](const std::string& move) { return of.refusal(turn, rest(move)); };
    // Entry and exit are those of the walk, turned by 30 degrees, unless said otherwise.
    const auto variant = [](int of_move, int to = 0, int entry_x = 0, int heading = 30, const char* clip = "turned") {
        return formatted(
            R"("clip": "%s", "from": 0, "to": %d, "entry": [%d,0,0], "exit": [3,1,%d], "turned": {"move": %d, "deg": 30})",
            clip, to, entry_x, heading, of_move);
    };
    const Scene scene = of.read(turn, rest(variant(0)));
    EXPECT_EQ(scene.graph->moves[1].turned, (TurnedMove{0, 30}));
    EXPECT_EQ(*parse_scene(to_json(scene), "s.json", of.folder.path()).graph, *scene.graph);
    const std::pair<std::string, const char*> cases[] = {
        {graph(variant(0, 1)), "/graph/moves/1/turned/move: that move joins other hubs"},
        {graph(variant(0, 0, 1)), "/graph/moves/1/turned/move: that move has another entry"},
        {graph(variant(0, 0, 0, 31)), "/graph/moves/1/exit/2: a move that turns by 30 degrees ends at 30 degrees"},
        {graph(variant(1)), "/graph/moves/1/turned/move: that move is turned itself"},
        {graph(variant(2)), "/graph/moves/1/turned/move: 2 is out of range"},
        {graph(variant(0, 0, 0, 30, "walk")),
         "/graph/moves/1/clip: the clip 'walk' turns not at all, the move by 30 degrees"},
    };
    for (const auto& [message, expected] : cases) EXPECT_NE(message.find(expected), std::string::npos) << message;
}

TEST(MotionGraph, AMoveBeginsWithTheRemainderOfItsHeading) {
    CounterRandom random(1, 2, 3);
    std::vector<double> headings;
    for (const double turns : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}) {
        const double at = 360 * turns;
        for (const double heading : {at, std::nextafter(at, 0.0), std::nextafter(at, 2e3)}) {
            headings.push_back(heading);
            headings.push_back(-heading);
        }
    }
    for (int i = 0; i < 1000; ++i) headings.push_back(1500 * (random.unit() - 0.5));
    for (const double heading : headings) {
        const double begins = beginning_at({{1, 2}, heading, 3}, {}).rotate_deg;
        const double expected = std::remainder(heading, 360.0);
        EXPECT_EQ(begins, expected) << heading;
        EXPECT_EQ(std::signbit(begins), std::signbit(expected)) << heading;
    }
}

}  // namespace
}  // namespace mobbscope
