// The real window, on a virtual display.
#include <render/image/png.h>
#include <support/temp_folder.h>

#include "review/three_cases.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

const std::string kHere = MOBBSCOPE_SOURCE_DIR "/tests/app/real_window/";
constexpr int kLacking = 77;

/// The exit status of a command line on a virtual display.
int under_xvfb(const std::string& command) {
    const int status = std::system(("'" + kHere + "under_xvfb.sh' " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(RealWindow, RunsAScript) {
    const TempFolder folder;
    const std::string picture = folder.path() / "window.png";
    const std::string script = folder.write(
        "a.script", "size 900x600\nexpect /title \"crossing\"\ndrag splitter.left 40 0\npicture " + picture + "\n");
    const int status = under_xvfb("'" MOBBSCOPE_PROGRAM "' --script '" + script + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb";
    ASSERT_EQ(status, 0);
    const Image image = read_png(picture);
    EXPECT_EQ(image.width, 900);
    EXPECT_EQ(image.height, 600);
}

TEST(RealWindow, AnExpectationThatFailsIsStatusOne) {
    const TempFolder folder;
    const std::string script = folder.write("a.script", "expect /title \"no\"\n");
    const int status = under_xvfb("'" MOBBSCOPE_PROGRAM "' --script '" + script + "' 2>/dev/null");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb";
    EXPECT_EQ(status, 1);
}

TEST(RealWindow, FollowsTheDisplaysMouse) {
    const TempFolder folder;
    const int status = under_xvfb("'" + kHere + "input.sh' '" MOBBSCOPE_PROGRAM "' '" + folder.path().string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    // The left border before and after, as the script printed it.
    std::istringstream out(slurp(folder.path() / "marks.txt"));
    std::vector<double> left;
    for (std::string line; std::getline(out, line);) {
        if (line.starts_with("splitter.left ")) left.push_back(std::stod(line.substr(14)));
    }
    ASSERT_EQ(left.size(), 2u);
    EXPECT_NEAR(left[1] - left[0], 60, 2);
}

using Json = nlohmann::ordered_json;

Json state(const std::filesystem::path& file) { return Json::parse(slurp(file)); }

/// What the document is, whatever is selected or said.
Json document(const Json& state) { return {state["title"], state["scene"], state["view"]}; }

// The whole of a session by hand. person.script asserts each state; pictures of them stay in the build tree.
TEST(RealWindow, APersonSeesEditsSavesAndReopensTheDemo) {
    const std::filesystem::path folder = MOBBSCOPE_PICTURES "/real_person";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::copy(MOBBSCOPE_SOURCE_DIR "/assets", folder / "assets", std::filesystem::copy_options::recursive);
    const std::filesystem::path scene = folder / "assets/scenes/crossing.json";
    const std::string before = slurp(scene);
    const int status = under_xvfb("'" + kHere + "person.sh' '" MOBBSCOPE_PROGRAM "' '" + kHere + "person.script' '" +
                                  folder.string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);

    const Json opened = state(folder / "opened.json");
    const Json edited = state(folder / "edited.json");
    EXPECT_NE(edited["scene"], opened["scene"]);
    EXPECT_NE(edited["view"], opened["view"]);
    EXPECT_LT(edited["scene"]["agents"][1]["start"], opened["scene"]["agents"][1]["start"]);
    const Json undone = state(folder / "undone.json");
    EXPECT_EQ(undone["scene"], opened["scene"]) << "undo brings back what was there";
    EXPECT_EQ(undone["view"]["query"], edited["view"]["query"]) << "and leaves where one looks";
    EXPECT_EQ(undone["modified"], false);
    EXPECT_EQ(document(state(folder / "redone.json")), document(edited)) << "and redo what was done";
    const Json saved = state(folder / "saved.json");
    EXPECT_EQ(document(saved), document(edited));
    EXPECT_NE(slurp(scene), before);
    EXPECT_EQ(document(state(folder / "reopened.json")), document(saved)) << "in the same window";

    // And by a program that knows nothing but the file.
    const std::string script = (folder / "anew.script").string();
    std::ofstream(script) << "state " << (folder / "anew.json").string() << '\n';
    ASSERT_EQ(
        std::system(("'" MOBBSCOPE_PROGRAM "' '" + scene.string() + "' --headless --script '" + script + "'").c_str()),
        0);
    EXPECT_EQ(document(state(folder / "anew.json")), document(saved));
}

// Menus, a dropdown and Escape by the keys of the display; keys.script asserts each state.
TEST(RealWindow, APersonWorksByKeysAlone) {
    const TempFolder folder;
    const int status = under_xvfb("'" + kHere + "keys.sh' '" MOBBSCOPE_PROGRAM "' '" MOBBSCOPE_SOURCE_DIR "/assets' '" +
                                  kHere + "keys.script' '" + folder.path().string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    EXPECT_EQ(status, 0);
}

// A clip in the wrong unit, mended by hand: import.script asserts each state.
TEST(RealWindow, APersonMendsAUnit) {
    const std::filesystem::path folder = MOBBSCOPE_PICTURES "/real_import";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scene.json") << R"({"clips": {"walk": {"source": "big.bvh", "unit": "m"}}})";
    std::ofstream bvh(folder / "big.bvh");
    bvh << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n"
           "JOINT Head\n{\nOFFSET 10 80 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 30 0 0\n}\n}\n"
           "JOINT Foot\n{\nOFFSET 0 -90 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 10 0 0\n}\n}\n}\n"
           "MOTION\nFrames: 90\nFrame Time: 0.0333333\n";
    for (int i = 0; i < 90; ++i) bvh << 4 * i << " 90 0\n";
    bvh.close();
    const int status = under_xvfb("'" + kHere + "import.sh' '" MOBBSCOPE_PROGRAM "' '" + kHere + "import.script' '" +
                                  (folder / "scene.json").string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    EXPECT_EQ(status, 0);
}

// Without a script, as only then settings are kept.
TEST(RealWindow, ThreeClipsAreOpenedByTheDialogAloneAndReopenedTheNextTime) {
    const TempFolder folder;
    std::filesystem::copy(MOBBSCOPE_SOURCE_DIR "/assets", folder.path() / "assets",
                          std::filesystem::copy_options::recursive);
    const int status = under_xvfb("'" + kHere + "files.sh' '" MOBBSCOPE_PROGRAM "' '" + folder.path().string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    const Json settings = state(folder.path() / "config/mobbscope/settings.json");
    const std::string clips = folder.path() / "assets/clips/";
    const Json opened{clips + "bend.glb", clips + "circle.glb", clips + "run.glb"};
    EXPECT_EQ(settings["last_session"]["files"], opened);
    EXPECT_EQ((Json{settings["recent"][0], settings["recent"][1], settings["recent"][2]}), opened);
    EXPECT_EQ(settings["folder"], clips.substr(0, clips.size() - 1));
    EXPECT_EQ(settings["window"]["width"], 1100);
    const std::string geometry = slurp(folder.path() / "geometry.txt");
    EXPECT_NE(geometry.find("WIDTH=1100\nHEIGHT=720"), std::string::npos) << geometry;
}

// However a window ends, the next one has what was not saved; lost.sh says how they end.
TEST(RealWindow, NothingIsLostWhenItEndsUnasked) {
    const TempFolder folder;
    std::filesystem::copy(MOBBSCOPE_SOURCE_DIR "/assets", folder.path() / "assets",
                          std::filesystem::copy_options::recursive);
    const int status = under_xvfb("'" + kHere + "lost.sh' '" MOBBSCOPE_PROGRAM "' '" + folder.path().string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    EXPECT_EQ(slurp(folder.path() / "ends.txt"),
              "killed 137\nterminated 143\nhung-up 129\nsecond 143\nwithout-display 3\n");
    EXPECT_EQ(
        slurp(folder.path() / "errors.txt"),
        "mobbscope: the display of the window has gone away; the next window offers the work that was not saved\n");
    // Saved after the first time; the others were not.
    EXPECT_EQ(state(folder.path() / "assets/scenes/crossing.json")["agents"].size(), 3u);
    const Json settings = state(folder.path() / "config/mobbscope/settings.json");
    const std::string assets = folder.path() / "assets/";
    EXPECT_EQ(settings["recent"], (Json{assets + "clips/walk.glb", assets + "scenes/crossing.json"}));
}

// The camera of a real window holds still; still.script says what was done between the states.
TEST(RealWindow, APersonsCameraMovesWhenItIsAskedTo) {
    const std::filesystem::path folder = MOBBSCOPE_PICTURES "/real_still";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::copy(MOBBSCOPE_SOURCE_DIR "/assets", folder / "assets", std::filesystem::copy_options::recursive);
    const int status = under_xvfb("'" + kHere + "still.sh' '" MOBBSCOPE_PROGRAM "' '" + kHere + "still.script' '" +
                                  folder.string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    const auto camera = [&](const std::string& name) {
        return Json(state(folder / (name + ".json"))["view"]["camera"]);
    };
    for (const char* name : {"query", "first", "third", "leaves", "time", "kind", "selected"}) {
        EXPECT_EQ(camera(name), camera("opened")) << name;
    }
    EXPECT_NE(camera("turned"), camera("opened"));
    EXPECT_EQ(camera("turned")["target"], camera("opened")["target"]) << "it turns about its target";
    EXPECT_EQ(camera("turned-step"), camera("turned"));
    EXPECT_EQ(camera("front")["target"], camera("turned")["target"]);
    EXPECT_EQ(camera("front")["distance"], camera("turned")["distance"]);
    EXPECT_NE(camera("framed")["target"], camera("front")["target"]);
    EXPECT_NE(camera("home")["target"], camera("framed")["target"]);
    EXPECT_EQ(camera("home")["yaw_deg"], camera("framed")["yaw_deg"]) << "the direction stays";
    EXPECT_NE(camera("resized")["distance"], camera("home")["distance"]) << "it frames the scene again";
    const auto height = [&](const std::string& name) {
        std::istringstream marks(slurp(folder / (name + ".txt")));
        for (std::string line; std::getline(marks, line);) {
            std::istringstream words(line);
            std::string mark;
            double left = 0, top = 0, right = 0, bottom = 0;
            if (words >> mark >> left >> top >> right >> bottom && mark == "viewport") return bottom - top;
        }
        return 0.0;
    };
    EXPECT_LT(height("resized"), height("home") - 50);
    EXPECT_LT(camera("near")["distance"], camera("resized")["distance"]);
    EXPECT_NE(camera("following")["target"], camera("near")["target"]) << "the pair had been cut off";
}

// Of a folder with 17 clips all but two are hidden, by the buttons in the lists; clips.script asserts each state.
TEST(RealWindow, APersonHidesAllButTwoOfSeventeenClips) {
    const std::filesystem::path folder = MOBBSCOPE_PICTURES "/real_clips";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "clips");
    for (int i = 1; i <= 17; ++i) {
        const std::string number = std::to_string(100 + i).substr(1);
        std::ofstream(folder / "clips" / ("clip" + number + ".csv"))
            << "t,x,y,r\n0,0,0,0.3\n0.5,1,0,0.3\n1,2,0.5,0.3\n";
    }
    const int status = under_xvfb("'" + kHere + "clips.sh' '" MOBBSCOPE_PROGRAM "' '" + kHere + "clips.script' '" +
                                  folder.string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    const Json two = state(folder / "two.json");
    EXPECT_EQ(two["view"]["hidden"].size(), 15u);
    EXPECT_EQ(two["modified"], false) << "how clips are seen is not an edit";
}

// Picture tests by hand: one of the failing is accepted and given back, and opened as a scene. review.script
// asserts each state.
TEST(RealWindow, APersonReviewsPictureTests) {
    const std::filesystem::path folder = MOBBSCOPE_PICTURES "/real_review";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const app::ThreeCases files(folder);
    const std::string golden = files.bytes("moved.png");
    const int status = under_xvfb("'" + kHere + "review.sh' '" MOBBSCOPE_PROGRAM "' '" + kHere + "review.script' '" +
                                  folder.string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    EXPECT_EQ(files.bytes("moved.png"), golden) << "the very bytes, given back";
    EXPECT_FALSE(std::filesystem::exists(files.file("missing.png")));
}

}  // namespace
}  // namespace mobbscope
