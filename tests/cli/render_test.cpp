#include "render_runs.h"

#include <support/folders.h>

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

const std::string kSize = "320x240";

/// The arguments of a small picture of a scene, and more.
std::vector<std::string> arguments(const std::string& scene, const std::string& out,
                                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"render", scene, "-o", out, "--size", kSize};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// Draws, which needs a context.
class RenderTest : public ::testing::Test {
  protected:
    void SetUp() override { has_or_skip(Backend::automatic); }

    const TempFolder folder;
    const std::string out = folder.path() / "out.png";

    Image picture(const std::string& scene, const std::vector<std::string>& more) {
        const Result run = run_program(arguments(scene, out, more));
        EXPECT_EQ(run.status, 0) << run.err;
        return run.status == 0 ? read_png(out) : Image();
    }
};

TEST_F(RenderTest, TheWholeWindowIsDrawnFromTheSameScene) {
    const Image window = picture(kCrossing, {"--ui", "--theme", "dark"});
    const Image light = picture(kCrossing, {"--ui", "--theme", "light", "--ui-scale", "1.5"});
    ASSERT_EQ(window.width, 320);
    ASSERT_EQ(light.height, 240);
    EXPECT_LT(*window.at(2, 238), 60);
    EXPECT_GT(*light.at(2, 238), 200);
    expect_refused(run_program(arguments(kCrossing, out, {"--ui-scale", "2"})), 2, "only with --ui");
    expect_refused(run_program(arguments(kCrossing, out, {"--ui", "--ui-scale", "5"})), 2, "from 0.5 to 4");
}

TEST_F(RenderTest, AScriptRunsWithoutADisplay) {
    const std::string good = folder.write("good", "expect /file \"" + kCrossing + "\"\nstate\n");
    const Result done = run_program({kCrossing, "--script", good, "--headless"});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_NE(done.out.find("\"agents\""), std::string::npos);
    expect_refused(run_program({"--script", folder.write("fails", "expect /modified true"), "--headless"}), 1,
                   "fails: line 1: /modified is false, expected true");
    expect_refused(run_program({"--script", folder.write("bad", "\nclik"), "--headless"}), 2, "bad: line 2");
    expect_refused(run_program({"--script", folder.path() / "none", "--headless"}), 2, "none");
    expect_refused(run_program({"--headless"}), 2, "--script");
    expect_refused(run_program({"--script", folder.path(), "--headless"}), 2, "is a directory");
    expect_refused(run_program({"--script", folder.write("nul", std::string_view("state\nsta\0te", 12)), "--headless"}),
                   2, "nul: line 2");
    expect_refused(run_program({"--script", folder.write("many", "size 999999999x999999999"), "--headless"}), 2,
                   "many: line 1");
    expect_refused(run_program({"--script", folder.write("click", "click no.widget"), "--headless"}), 2,
                   "there is no 'no.widget' in the window now");
    expect_refused(run_program({"--script", folder.write("picture", "picture " + kCrossing + "/a.png"), "--headless"}),
                   3, "cannot be written");
    // What a script's command cannot do ends it: nothing is lost that a person could save.
    expect_refused(
        run_program({"--script", folder.write("save", "run file.save_as " + kCrossing + "/a.json"), "--headless"}), 3,
        "save: line 1");
}

TEST_F(RenderTest, ABareNameIsAFileInTheWorkingFolder) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const Result run = run_program(arguments(kCrossing, "bare.png"));
    std::filesystem::current_path(before);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "bare.png"));
}

TEST_F(RenderTest, WritesAPictureAndSaysNothing) {
    const Result run = run_program(arguments(kCrossing, out));
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_EQ(read_png(out).width, 320);
    const std::string capitals = folder.path() / "OUT.PNG";
    EXPECT_EQ(run_program(arguments(kCrossing, capitals)).status, 0);
    EXPECT_EQ(read_png(capitals).height, 240);
}

TEST(Render, NothingThatItReadsIsReplaced) {
    const TempFolder folder;
    const std::string clip = folder.write("clip.csv", "t,x,y,r\n0,0,0,0.4\n0.5,0.1,0,0.4\n");
    const std::string text = R"({"clips": {"c": {"source": "clip.csv"}}})";
    const std::string scene = folder.write("scene.json", text);
    std::filesystem::create_symlink("scene.json", folder.path() / "to_scene.png");
    std::filesystem::create_symlink("clip.csv", folder.path() / "to_clip.png");
    std::filesystem::create_hard_link(scene, folder.path() / "same.png");
    for (const char* out : {"to_scene.png", "to_clip.png", "same.png"}) {
        expect_refused(run_program(arguments(scene, folder.path() / out)), 2, "would replace");
    }
    // A clip is a scene of its own.
    expect_refused(run_program(arguments(clip, folder.path() / "to_clip.png")), 2, "would replace");
    EXPECT_EQ(slurp(scene), text);
    EXPECT_TRUE(slurp(clip).starts_with("t,x,y,r"));
}

TEST_F(RenderTest, AVectorFileHoldsTheSamePictureEveryTime) {
    const std::string svg = folder.path() / "a.svg", pdf = folder.path() / "a.pdf";
    for (const std::string& file : {svg, pdf}) {
        ASSERT_EQ(run_program(arguments(kCrossing, file)).status, 0);
        const std::string first = slurp(file);
        ASSERT_EQ(run_program(arguments(kCrossing, file)).status, 0);
        EXPECT_TRUE(first == slurp(file)) << file;
    }
    const std::string text = slurp(svg);
    EXPECT_NE(text.find(">crossing</text>"), std::string::npos);
    EXPECT_NE(text.find("data:image/png;base64,"), std::string::npos);
    EXPECT_TRUE(slurp(pdf).starts_with("%PDF-"));
}

TEST(Render, TheWholeWindowIsPngAlone) {
    const TempFolder folder;
    std::vector<std::string> window = arguments(kCrossing, folder.path() / "a.svg");
    window.emplace_back("--ui");
    expect_refused(run_program(window), 2, "the whole window is written as .png");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Render, OnlyPicturesAreWritten) {
    const TempFolder folder;
    const std::string scene = folder.path() / "scene.json";
    std::filesystem::copy_file(kCrossing, scene);
    for (const std::string& out :
         {scene, std::string(folder.path() / "a.jpg"), std::string(folder.path() / "a"), std::string("/dev/null")}) {
        expect_refused(run_program(arguments(scene, out)), 2, ".png");
    }
    expect_refused(run_program(arguments(scene, "")), 2, "");
    EXPECT_EQ(slurp(scene), slurp(kCrossing));
    const std::filesystem::directory_iterator files(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

/// The machine is not asked for OpenGL when the picture has nowhere to go.
TEST(Render, WhatCannotBeWrittenIsSaidFirst) {
    const TempFolder folder;
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const auto refusal = [&](const std::filesystem::path& out) { return run_program(arguments(kCrossing, out)); };
    expect_refused(refusal(folder.path() / "a.png"), 3, "no OpenGL 3.3");
    expect_refused(refusal(folder.path() / "none" / "a.png"), 3, "there is no folder");
    std::filesystem::create_directory(folder.path() / "folder.png");
    expect_refused(refusal(folder.path() / "folder.png"), 3, "is a folder");
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
}

TEST_F(RenderTest, ANameThatIsTooLongIsRefused) {
    expect_refused(run_program(arguments(kCrossing, folder.path() / (std::string(300, 'a') + ".png"))), 3,
                   "cannot be written");
}

TEST_F(RenderTest, PipesLinksAndDevicesStay) {
    const std::string target = folder.write("target.png", "old");
    const auto link = folder.path() / "link.png";
    const auto null = folder.path() / "null.png";
    const auto pipe = folder.path() / "pipe.png";
    std::filesystem::create_symlink("target.png", link);
    std::filesystem::create_symlink("/dev/null", null);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(run_program(arguments(kCrossing, link)).status, 0);
    EXPECT_EQ(run_program(arguments(kCrossing, null)).status, 0);
    // Open for reading and writing: nobody waits for the other side, and a picture this small fits into the pipe.
    std::fstream both(pipe, std::ios::in | std::ios::out | std::ios::binary);
    const Result piped = run_program({"render", kCrossing, "-o", pipe, "--size", "64x64"});
    ASSERT_EQ(piped.status, 0) << piped.err;
    std::string head(8, '\0');
    both.read(head.data(), 8);
    EXPECT_EQ(head, "\x89PNG\r\n\x1a\n");
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_TRUE(std::filesystem::is_symlink(null));
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    EXPECT_EQ(read_png(target).width, 320);
}

TEST(Render, OptionsThatContradictEachOtherAreNamed) {
    const TempFolder folder;
    const std::string out = folder.path() / "out.png";
    const struct {
        std::vector<std::string> options;
        std::string pair;
    } cases[] = {
        {{"--view", "top", "--yaw", "30"}, "--view top and --yaw"},
        {{"--view", "iso", "--pitch", "30"}, "--view iso and --pitch"},
        {{"--view", "front", "--fov", "30"}, "--view front and --fov"},
        {{"--ortho", "--fov", "30"}, "--ortho and --fov"},
        {{"--query", "0", "--level", "2"}, "--query and --level"},
    };
    for (const auto& [options, pair] : cases) {
        expect_refused(run_program(arguments(kCrossing, out, options)), 2, pair);
    }
    const std::string top = folder.write("top.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}},
                                     "view": {"camera": {"preset": "top"}}})");
    expect_refused(run_program(arguments(top, out, {"--fov", "30"})), 2, "--fov");
    expect_refused(run_program(arguments(kCrossing, out, {"--level", "2", "--step", "3"})), 2, "--query");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(RenderTest, ScaleAndColoursAreTaken) {
    const Image usual = picture(kCrossing, {});
    EXPECT_NE(picture(kCrossing, {"--scale", "2"}).rgba, usual.rgba);
    EXPECT_NE(picture(kCrossing, {"--color-by", "level"}).rgba, usual.rgba);
    EXPECT_EQ(picture(kCrossing, {"--color-by", "agent"}).rgba, usual.rgba);
    expect_refused(run_program(arguments(kCrossing, out, {"--scale", "9"})), 2, "from 0.5 to 8");
    expect_refused(run_program(arguments(kCrossing, out, {"--color-by", "node"})), 2, "agent, level");
}

TEST_F(RenderTest, BoxesAreColouredByAFigureInARange) {
    const Image usual = picture(kCrossing, {});
    const Image empty = picture(kCrossing, {"--color-by", "empty"});
    EXPECT_NE(empty.rgba, usual.rgba);
    EXPECT_NE(picture(kCrossing, {"--color-by", "empty", "--color-range", "0:5"}).rgba, empty.rgba);
    EXPECT_EQ(picture(kCrossing, {"--color-by", "empty", "--color-range", "auto"}).rgba, empty.rgba);
    EXPECT_NE(picture(kCrossing, {"--heat"}).rgba, usual.rgba);
    const std::string svg = folder.path() / "a.svg";
    ASSERT_EQ(run_program({"render", kCrossing, "-o", svg, "--color-by", "tests", "--color-range", "0:20"}).status, 0);
    const std::string text = slurp(svg);
    EXPECT_NE(text.find("boxes: number of tests"), std::string::npos);
    EXPECT_NE(text.find("20<"), std::string::npos) << "the value at an end";
    expect_refused(run_program(arguments(kCrossing, out, {"--color-range", "5:1"})), 2, "not a range");
}

/// A camera that was moved in the window and saved.
TEST_F(RenderTest, ASavedCameraIsTaken) {
    const std::string clips = R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1],[2,1,1],[3,1,1]]}},
        "view": {"camera": {"preset": "free", "yaw_deg": 20, "fov_deg": 0.5, "target": [1.5, 0.5, 2], "distance": 900)";
    const Image centred = picture(folder.write("a.json", clips + "}}}"), {});
    const Image shifted = picture(folder.write("b.json", clips + R"(, "shift": [0.2, -0.1]}}})"), {});
    EXPECT_NE(centred.rgba, shifted.rgba);
}

TEST_F(RenderTest, TheAngleThatIsNotGivenStays) {
    const std::string scene =
        folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1],[2,1,1],[3,1,1]]}}})");
    // The isometric view is free's -52 and 24 degrees.
    const Image iso = picture(scene, {"--view", "iso"});
    EXPECT_EQ(picture(scene, {"--yaw", "-52"}).rgba, iso.rgba);
    EXPECT_EQ(picture(scene, {"--pitch", "24"}).rgba, iso.rgba);
    EXPECT_NE(picture(scene, {"--pitch", "60"}).rgba, iso.rgba);
}

TEST_F(RenderTest, ALevelReplacesTheQueryOfTheScene) {
    const std::string clip = R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1],[2,0,1],[3,0,1]]}},
        "agents": [{"name": "A", "clip": "c"}, {"name": "B", "clip": "c", "translate": [1, 1]}])";
    // One name for both, as the caption tells it.
    const std::string scene = folder.write("s.json", clip + "}");
    const Image plain = picture(scene, {});
    const Image plain_level = picture(scene, {"--level", "1"});
    folder.write("s.json", clip + R"(, "view": {"query": 0}})");
    EXPECT_EQ(picture(scene, {"--level", "1"}).rgba, plain_level.rgba);
    EXPECT_NE(picture(scene, {}).rgba, plain.rgba);
}

TEST_F(RenderTest, CharactersWithoutGlyphsAreToldOnce) {
    const std::string scene = folder.write("s.json",
                                           "{\"clips\": {\"\u6F22\u5B57\u6F22\": {\"dt\": 1, \"samples\": "
                                           "[[0,0,1],[1,0,1]]}}}");
    const Result run = run_program(arguments(scene, out));
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find("2 characters"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace mobbscope
