// Many pictures in one process.
#include "render_runs.h"

#include <support/folders.h>

namespace mobbscope {
namespace {

class RenderBatchTest : public DrawingTest {};

TEST_F(RenderBatchTest, EachLineIsAPictureAsItWouldBeAlone) {
    const TempFolder pictures;
    const std::string path = pictures.path();
    const std::string list = folder.write(
        "list", "# two views\r\n\n" + kCrossing + " --view top -o " + path + "/top.png\n  " + kCrossing +
                    " --query 0 --step 3 --background \"#102030\" -o \"" + path + "/a query.png\"  # why\n" +
                    kCrossing + " --ui --size 400x300 -o " + path + "/window.png\n" + kCrossing +
                    " --tree umobb --turntable 2 --draw-list " + path + "/t.json");
    const Result run = render_small({"--batch", list, "--theme", "light"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_EQ(files_in(pictures.path()), (Names{"top.png", "a query.png", "window.png", "t_0000.json", "t_0001.json"}));
    EXPECT_EQ(read_png(pictures.path() / "top.png").rgba,
              picture({kCrossing, "--view", "top", "--theme", "light"}).rgba);
    EXPECT_EQ(read_png(pictures.path() / "a query.png").rgba,
              picture({kCrossing, "--query", "0", "--step", "3", "--background", "#102030", "--theme", "light"}).rgba);
    EXPECT_EQ(read_png(pictures.path() / "window.png").width, 400) << "what a line says wins";
}

/// Also where the window's picture, which works in the scene's folder, follows a sequence that is still being written.
TEST_F(RenderBatchTest, NamesAreRelativeToTheWorkingFolder) {
    const TempFolder pictures, scenes;
    const std::string scene = scenes.write("s.json", kStandingScene);
    const std::string list = folder.write(
        "list", scene + " --turntable 3 --size 1280x720 -o p.png\n" + scene + " --ui --size 400x300 -o window.png\n");
    const Result run = run_program({"render", "--batch", list}, {}, "/dev/null",
                                   [&] { std::filesystem::current_path(pictures.path()); });
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(files_in(pictures.path()), (Names{"p_0000.png", "p_0001.png", "p_0002.png", "window.png"}));
    EXPECT_EQ(files_in(scenes.path()), Names{"s.json"});
}

TEST_F(RenderBatchTest, TheSceneMayStandBesideTheList) {
    const std::string list = folder.write("list", "-o " + std::string(folder.path() / "a.png") + "\n");
    EXPECT_EQ(render_small({kCrossing, "--batch", list}).status, 0);
    EXPECT_EQ(read_png(folder.path() / "a.png").rgba, picture({kCrossing}).rgba);
}

TEST_F(RenderBatchTest, WhatALineSaysTakesThePlaceOfWhatContradictsIt) {
    const std::string path = folder.path();
    const std::string list = folder.write("list", "--level 1 -o " + path + "/level.png\n--yaw 10 -o " + path +
                                                      "/yaw.png\n--turntable 1 -o " + path + "/turn.png\n");
    const Result run = render_small({kCrossing, "--batch", list, "--query", "0", "--step", "3", "--view", "top"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read_png(folder.path() / "level.png").rgba, picture({kCrossing, "--view", "top", "--level", "1"}).rgba);
    EXPECT_EQ(read_png(folder.path() / "yaw.png").rgba,
              picture({kCrossing, "--yaw", "10", "--query", "0", "--step", "3"}).rgba);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "turn_0000.png"));
}

TEST(RenderBatch, ABadLineIsNamedAndNothingIsWritten) {
    const TempFolder folder;
    const TempFolder pictures;
    const std::string good = kCrossing + " -o " + std::string(pictures.path() / "good.png") + "\n";
    const std::string out = " -o " + std::string(pictures.path() / "b.png");
    const auto refused = [&](const std::string& line, int status, const std::string& why) {
        const std::string list = folder.write("list", good + "\n" + line + "\n");
        expect_refused(render_small({"--batch", list}), status, "list:3: ");
        expect_refused(render_small({"--batch", list}), status, why);
        EXPECT_TRUE(files_in(pictures.path()).empty()) << line;
    };
    refused(kCrossing, 2, "--output");
    refused("-o a.png", 2, "FILE is required");
    refused("none.json" + out, 2, "none.json");
    refused(kCrossing + out + " --vew top", 2, "--vew");
    refused(kCrossing + out + " --help", 2, "--help");
    refused(kCrossing + out + " --batch list", 2, "--batch");
    refused(kCrossing + out + " --view \"top", 2, "a quote is not closed");
    refused(kCrossing + out + " --query 7", 2, "there is no query 7");
    refused(kCrossing + out + " --query 0 --step 100000", 2, "100000");
    refused(kCrossing + out + " --backend egl", 2, "beside --batch");
    refused(kCrossing + out + " --view top --yaw 3", 2, "contradict");
    refused(good, 2, "written twice");
    refused(kCrossing + " -o " + std::string(pictures.path() / "none" / "a.png"), 3, "there is no folder");
}

TEST(RenderBatch, WhatOneLineReadsNoOtherReplaces) {
    const TempFolder folder;
    const std::string text = R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}}})";
    const std::string scene = folder.write("scene.json", text);
    const std::string list = folder.write("list", kCrossing + " --draw-list " + scene + "\n" + scene + " --draw-list " +
                                                      std::string(folder.path() / "b.json") + "\n");
    expect_refused(render_small({"--batch", list}), 2, "list:1: ");
    EXPECT_EQ(slurp(scene), text);
    EXPECT_EQ(files_in(folder.path()), (Names{"list", "scene.json"}));
}

TEST(RenderBatch, TheListIsNotReplaced) {
    const TempFolder folder;
    const std::string list = folder.path() / "list.json";
    const std::string text = kCrossing + " --draw-list " + list;
    folder.write("list.json", text);
    expect_refused(render_small({"--batch", list}), 2, "would replace");
    EXPECT_EQ(slurp(list), text);
}

TEST(RenderBatch, ListsThatAreNoneAreRefused) {
    const TempFolder folder;
    expect_refused(render_small({"--batch", folder.path() / "none"}), 2, "none");
    expect_refused(render_small({"--batch", folder.path()}), 2, "");
    expect_refused(render_small({"--batch", folder.write("empty", "# nothing\n\n")}), 2, "asks for no picture");
    const std::string list = folder.write("list", kCrossing + " -o a.png");
    expect_refused(render_small({"--batch", list, "-o", folder.path() / "b.png"}), 2, "each line names its own");
}

}  // namespace
}  // namespace mobbscope
