// Numbered pictures: --frames, --play, --turntable.
#include "render_runs.h"

#include <support/folders.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace mobbscope {
namespace {

class RenderSequenceTest : public DrawingTest {
  protected:
    const TempFolder pictures;
    const std::string scene = short_scene(folder);
    const std::string out = pictures.path() / "walk.png";

    void draw(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {scene, "-o", out});
        const Result run = render_small(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.out + run.err, "");
    }
    Image read(const char* name) const { return read_png(pictures.path() / name); }
};

TEST_F(RenderSequenceTest, PicturesOfTheMotionAreNumbered) {
    draw({"--frames", "1:3", "--rate", "2"});
    EXPECT_EQ(files_in(pictures.path()), (Names{"walk_0001.png", "walk_0002.png", "walk_0003.png"}));
    // At half a second: the camera of the sequence apart, what --time 0.5 shows.
    EXPECT_NE(read("walk_0001.png").rgba, read("walk_0002.png").rgba);
}

TEST_F(RenderSequenceTest, PlayIsFromBeginningToEnd) {
    draw({"--play", "--rate", "2"});
    EXPECT_EQ(files_in(pictures.path()).size(), 6u) << "from 0 to 3 s";
    EXPECT_TRUE(files_in(pictures.path()).contains("walk_0005.png"));
}

TEST_F(RenderSequenceTest, StepsOfAQueryArePlayed) {
    const Result answer = run_program({"query", scene, "--json", "--trace"});
    const std::size_t steps = nlohmann::json::parse(answer.out)["results"][0]["trace"].size();
    draw({"--query", "0", "--play"});
    EXPECT_EQ(files_in(pictures.path()).size(), steps);
    expect_refused(render_small({scene, "-o", out, "--query", "0", "--frames", "0:" + std::to_string(steps)}), 2,
                   "query 0 has");
}

/// What never moves stays at its pixels.
TEST_F(RenderSequenceTest, TheCameraStays) {
    draw({"--play", "--rate", "2", "--no-labels"});
    const Image first = read("walk_0000.png");
    const Image last = read("walk_0005.png");
    // Nothing but the time cursor differs: most pixels are equal, which a camera that moves would not leave.
    std::size_t equal = 0;
    for (std::size_t i = 0; i < first.rgba.size(); ++i) equal += first.rgba[i] == last.rgba[i] ? 1u : 0u;
    EXPECT_GT(equal, first.rgba.size() / 2);
}

/// One camera for all times, near the agent.
TEST_F(RenderSequenceTest, TheCameraGoesAlongWithTheFollowed) {
    const std::vector<std::string> near{scene, "--show", "moment", "--follow", "A", "--time", "1"};
    const Image alone = picture(near);
    EXPECT_NE(alone.rgba, picture({scene, "--show", "moment", "--time", "1"}).rgba);
    draw({"--show", "moment", "--follow", "A", "--frames", "2:2", "--rate", "2"});
    EXPECT_EQ(read("walk_0002.png").rgba, alone.rgba);
    std::vector<std::string> above = near;
    above.insert(above.end(), {"--view", "top"});
    EXPECT_NE(picture(above).rgba, alone.rgba);
}

TEST_F(RenderSequenceTest, ACameraThatIsGivenStaysWhereItIs) {
    const std::string state = folder.write("camera.json", R"({"camera": {"target": [1, 0, 0], "distance": 70}})");
    const std::vector<std::string> from_afar{scene, "--show",   "moment", "--time",     "1", "--follow",
                                             "A",   "--target", "1,0,0",  "--distance", "70"};
    EXPECT_EQ(picture({scene, "--show", "moment", "--time", "1", "--follow", "A", "--view-state", state}).rgba,
              picture(from_afar).rgba);
    EXPECT_NE(picture({scene, "--show", "moment", "--time", "1", "--follow", "A"}).rgba, picture(from_afar).rgba);
    const std::vector<std::string> nobody{scene, "--show", "moment", "--time", "1", "--follow", "none"};
    EXPECT_EQ(picture(nobody).rgba, picture({scene, "--show", "moment", "--time", "1"}).rgba);
}

/// What the common framing kept free needs no panel: the words are as in a picture alone.
TEST_F(RenderSequenceTest, WordsBesideTheSceneLieOnNoPanel) {
    draw({"--frames", "2:2", "--rate", "2", "--background", "#123456"});
    const Image film = read("walk_0002.png");
    const Image alone = picture({scene, "--time", "1", "--background", "#123456"});
    for (int x = 0; x < 60; ++x) {
        for (int y = 0; y < 30; ++y) {
            const auto at = static_cast<std::size_t>(4 * (y * film.width + x));
            ASSERT_EQ(film.rgba[at], alone.rgba[at]) << x << ' ' << y;
        }
    }
}

TEST_F(RenderSequenceTest, ATurntableComesBackToWhereItBegan) {
    const std::vector<std::string> bare{"--no-labels", "--no-floor", "--no-time-axis"};
    const auto turned = [&](const char* count) {
        std::vector<std::string> all{"--turntable", count};
        all.insert(all.end(), bare.begin(), bare.end());
        draw(all);
    };
    turned("4");
    EXPECT_EQ(files_in(pictures.path()), (Names{"walk_0000.png", "walk_0001.png", "walk_0002.png", "walk_0003.png"}));
    const Image first = read("walk_0000.png");
    const Image second = read("walk_0001.png");
    EXPECT_NE(first.rgba, second.rgba);
    turned("8");
    EXPECT_EQ(read("walk_0000.png").rgba, first.rgba) << "the number of pictures does not move the camera";
    EXPECT_EQ(read("walk_0002.png").rgba, second.rgba);
}

TEST_F(RenderSequenceTest, AnExplicitCameraTurnsAboutItsTarget) {
    const std::vector<std::string> camera{"--pitch", "20", "--target", "1,1,1", "--distance", "40"};
    std::vector<std::string> still{scene, "--view", "free", "--yaw", "100"};
    still.insert(still.end(), camera.begin(), camera.end());
    const Image turned = picture(still);
    std::vector<std::string> turning{"--view", "free", "--yaw", "10", "--turntable", "4"};
    turning.insert(turning.end(), camera.begin(), camera.end());
    draw(turning);
    EXPECT_EQ(read("walk_0001.png").rgba, turned.rgba);
}

TEST(RenderSequence, WhatIsNoSequenceIsRefusedBeforeAnythingIsWritten) {
    const TempFolder folder;
    const TempFolder pictures;
    const std::string scene = short_scene(folder);
    const struct {
        std::vector<std::string> options;
        std::string why;
    } cases[] = {
        {{"--frames", "3:1"}, "0:59"},
        {{"--frames", "3"}, "0:59"},
        {{"--frames", "-1:3"}, "--frames"},
        {{"--frames", "0:9", "--rate", "2"}, "the motion has 6 pictures at 2 per second, counted from 0"},
        {{"--frames", "0:1", "--play"}, "--frames and --play"},
        {{"--turntable", "4", "--play"}, "--turntable and --play"},
        {{"--turntable", "0"}, "1 or more"},
        {{"--turntable", "100001"}, "at most 100000"},
        {{"--play", "--rate", "0"}, "--rate"},
        {{"--rate", "5"}, "--play or --frames"},
        {{"--play", "--time", "1"}, "--play and --time"},
        {{"--play", "--query", "0", "--step", "1"}, "--play and --step"},
        {{"--play", "--query", "0", "--rate", "5"}, "--play and --rate"},
        {{"--play", "--query", "9"}, "there is no query 9"},
    };
    for (const auto& [options, why] : cases) {
        std::vector<std::string> all{scene, "-o", pictures.path() / "walk.png"};
        all.insert(all.end(), options.begin(), options.end());
        expect_refused(render_small(all), 2, why);
    }
    const std::string slow =
        folder.write("slow.json", R"({"clips": {"c": {"dt": 1e4, "samples": [[0,0,1],[1,0,1]]}}})");
    expect_refused(render_small({slow, "-o", pictures.path() / "walk.png", "--play"}), 2, "at most 100000");
    std::filesystem::create_directory(pictures.path() / "walk_0003.png");
    expect_refused(render_small({scene, "-o", pictures.path() / "walk.png", "--turntable", "4"}), 3, "is a folder");
    EXPECT_EQ(files_in(pictures.path()), Names{"walk_0003.png"});
}

/// Without OpenGL too.
TEST(RenderSequence, DrawListsAreNumberedAlike) {
    const TempFolder folder;
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const Result run = render_small({short_scene(folder), "--draw-list", folder.path() / "w.json", "--turntable", "2"});
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(files_in(folder.path()), (Names{"s.json", "w_0000.json", "w_0001.json"}));
}

/// The last one shows no boxes but the proof; the others have their boxes in the picture.
TEST(RenderSequence, AllStepsAreSeenFromOnePlace) {
    const TempFolder folder;
    const std::string list = folder.path() / "w.json";
    const auto eye = [&](const std::string& name) {
        return nlohmann::json::parse(slurp(folder.path() / name))["camera"]["eye"].dump();
    };
    ASSERT_EQ(render_small({kCrossing, "--query", "0", "--play", "--draw-list", list}).status, 0);
    const std::string first = eye("w_0000.json");
    for (const char* name : {"w_0010.json", "w_0019.json", "w_0020.json"}) EXPECT_EQ(eye(name), first) << name;
    ASSERT_EQ(render_small({kCrossing, "--query", "0", "--frames", "10:11", "--draw-list", list}).status, 0);
    EXPECT_EQ(eye("w_0010.json"), first) << "a part of the film is the same as in the whole";
    const auto alone = [&](const char* step) {
        const std::vector<std::string> arguments{kCrossing, "--query", "0", "--step", step, "--no-labels"};
        EXPECT_EQ(render_small(with(arguments, {"--draw-list", list})).status, 0);
        return eye("w.json");
    };
    EXPECT_EQ(alone("0"), alone("20")) << "without a sequence too";
}

/// Whether a disk's rim reaches into a rectangle of a picture of 320x240. `list`: of a file.
bool is_covered(const nlohmann::json& list, const nlohmann::json& disk, const nlohmann::json& rect) {
    const auto to_clip = list.at("camera").at("clip_from_world").get<std::vector<double>>();
    const auto base = disk.at("base").get<std::vector<double>>();
    const double top = base[2] + disk.at("height").get<double>();
    const auto radius = disk.at("radius").get<double>();
    for (int i = 0; i < 32; ++i) {
        const double turn = i / 16.0 * std::numbers::pi;
        const std::array<double, 2> p{base[0] + radius * std::cos(turn), base[1] + radius * std::sin(turn)};
        for (const double height : {base[2], top}) {
            const auto clip = [&](std::size_t row) {
                return to_clip[row] * p[0] + to_clip[4 + row] * p[1] + to_clip[8 + row] * height + to_clip[12 + row];
            };
            const double x = 160 * (1 + clip(0) / clip(3)), y = 120 * (1 - clip(1) / clip(3));
            const auto inside = [&](double at, std::size_t axis) {
                return at >= rect.at("min")[axis].get<double>() && at <= rect.at("max")[axis].get<double>();
            };
            if (inside(x, 0) && inside(y, 1)) return true;
        }
    }
    return false;
}

/// All pictures are seen from one place, or from one around the scene.
TEST(RenderSequence, CaptionAndLegendCoverNoPath) {
    for (const std::vector<std::string>& kind :
         std::vector<std::vector<std::string>>{{"--query", "0", "--play"},
                                               {"--play", "--rate", "2"},
                                               {"--show", "moment", "--play", "--rate", "2"},
                                               {"--turntable", "6"}}) {
        SCOPED_TRACE(kind.front());
        const TempFolder folder;
        ASSERT_EQ(render_small(with({kCrossing, "--draw-list", folder.path() / "w.json"}, kind)).status, 0);
        const auto names = files_in(folder.path());
        ASSERT_FALSE(names.empty());
        std::set<std::string> eyes;
        for (const std::string& name : names) {
            const nlohmann::json list = nlohmann::json::parse(slurp(folder.path() / name));
            eyes.insert(list.at("camera").at("eye").dump());
            ASSERT_FALSE(list.at("disks").empty());
            for (const nlohmann::json& overlay : list.at("overlays")) {
                for (const nlohmann::json& disk : list.at("disks"))
                    EXPECT_FALSE(is_covered(list, disk, overlay)) << name << ": " << overlay.at("name");
            }
        }
        EXPECT_EQ(eyes.size(), kind.front() == "--turntable" ? 6u : 1u);
    }
}

}  // namespace
}  // namespace mobbscope
