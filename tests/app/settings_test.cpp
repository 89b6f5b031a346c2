#include <app/document/settings.h>

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

using mobbscope::testing::TempFolder;

TEST(Settings, AreReadBackAsTheyWereWritten) {
    const TempFolder folder;
    const std::filesystem::path file = folder.path() / "deep" / "settings.json";
    Settings settings;
    settings.ui_scale = 1.25;
    settings.left_width = 301.5;
    settings.remember(folder.path() / "a \"quoted\" näme.json");
    settings.remember(folder.path() / "b.json");
    settings.folder = folder.path() / "clips";
    settings.theme = Theme::light;
    settings.window = WindowPlace{-12, 40, 1280, 800, true};
    settings.folded = {{"clips", true}, {"tree", false}};
    settings.file_order = "-date";
    settings.last.files = {folder.path() / "b.json"};
    settings.last.view.query = 2;
    settings.last.view.camera.yaw_deg = 12.5;
    settings.last.view.theme = Theme::light;
    settings.picture_export = {.size = PictureSize{640, 360},
                               .keeps_shape = false,
                               .scale = 1.25,
                               .samples = 8,
                               .transparent = true,
                               .theme = Theme::dark,
                               .without = {"legend", "past"}};
    save_settings(file, settings);
    EXPECT_EQ(load_settings(file), settings);
    EXPECT_EQ(settings.recent.front().filename(), "b.json");
}

TEST(Settings, RememberTwentyEachOnce) {
    Settings settings;
    for (int i = 0; i < 30; ++i) settings.remember("/folder/" + std::to_string(i));
    settings.remember("/folder/15");
    ASSERT_EQ(settings.recent.size(), 20u);
    EXPECT_EQ(settings.recent[0], "/folder/15");
    EXPECT_EQ(settings.recent[1], "/folder/29");
    EXPECT_EQ(std::count(settings.recent.begin(), settings.recent.end(), "/folder/15"), 1);
}

TEST(Settings, AFolderHasItsNameWithOrWithoutASlashBehindIt) {
    Settings settings;
    settings.remember("/folder/scenes/");
    settings.remember("/folder/scenes");
    EXPECT_EQ(settings.recent, std::vector<std::filesystem::path>{"/folder/scenes"});
    // Older versions kept the slash.
    const TempFolder folder;
    const auto old = folder.write("settings.json", R"({"recent": ["/a/b/", "/c", "/a/b", "/"]})");
    EXPECT_EQ(load_settings(old).recent, (std::vector<std::filesystem::path>{"/a/b", "/c", "/"}));
}

TEST(Settings, JunkIsPassedOver) {
    const TempFolder folder;
    EXPECT_EQ(load_settings(folder.path() / "none.json"), Settings{});
    EXPECT_EQ(load_settings(folder.path()), Settings{});
    for (const char* text :
         {"", "{", "[1, 2]", "null", "\xff\xfe", R"({"ui_scale": "big", "left_width": -3})", R"({"ui_scale": 1e999})",
          R"({"recent": {"a": 1}})", R"({"recent": [1, null, "here"]})", R"({"theme": "pink", "folder": "here"})",
          R"({"window": {"x": 1}})", R"({"window": {"x": 0, "y": 0, "width": 0, "height": 5}})",
          R"({"window": {"x": 1e300, "y": 0, "width": 9, "height": 5}})", R"({"folded": [true]})",
          R"({"folded": {"clips": "yes"}})", R"({"file_order": "colour"})", R"({"last_session": [1]})",
          R"({"last_session": {"files": "a", "view": {"query": -1}}})"}) {
        EXPECT_EQ(load_settings(folder.write("settings.json", text)), Settings{}) << text;
    }
    const Settings some =
        load_settings(folder.write("settings.json", R"({"ui_scale": 99, "right_width": 400, "recent": [3, "/a"]})"));
    EXPECT_EQ(some.ui_scale, 0);
    EXPECT_EQ(some.right_width, 400);
    EXPECT_EQ(some.recent, std::vector<std::filesystem::path>{"/a"});
}

TEST(Settings, OfAnotherVersionStay) {
    const TempFolder folder;
    const std::string file = folder.write(
        "settings.json",
        R"({"wings": {"left": [1, 2]}, "ui_scale": 2, "last_session": {"files": ["/a"], "view": {"wings": 1}}})");
    Settings settings = load_settings(file);
    EXPECT_EQ(settings.last.files, std::vector<std::filesystem::path>{"/a"});
    EXPECT_EQ(settings.last.view, ViewState{}) << "a view that cannot be read is as usual";
    settings.ui_scale = 3;
    save_settings(file, settings);
    EXPECT_EQ(load_settings(file), settings);
    const std::string text = mobbscope::testing::slurp(file);
    EXPECT_NE(text.find("wings"), std::string::npos) << text;
}

TEST(Settings, WhereNothingCanBeWrittenNothingHappens) {
    save_settings("/proc/none/settings.json", {});
    save_settings({}, {});
}

TEST(Settings, WhatCannotBeReadIsKeptAndSaidOnce) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("settings.json", R"({"ui_scale": 2,)");
    const std::string said = keep_unreadable_settings(file);
    EXPECT_NE(said.find("settings.json cannot be read; it is kept as settings.json.unreadable"), std::string::npos)
        << said;
    save_settings(file, {});
    EXPECT_EQ(mobbscope::testing::slurp(folder.path() / "settings.json.unreadable"), R"({"ui_scale": 2,)");
    EXPECT_EQ(keep_unreadable_settings(file), "");
    folder.write("settings.json", "[1]");
    EXPECT_NE(keep_unreadable_settings(file).find("kept as settings.json.unreadable2"), std::string::npos);
    EXPECT_EQ(keep_unreadable_settings(file), "") << "there is none now";
    EXPECT_EQ(keep_unreadable_settings(folder.write("settings.json", "")), "") << "nothing is lost";
}

TEST(Settings, OfANewerVersionStayAsTheyAre) {
    const TempFolder folder;
    const std::string newer = R"({"version": 2, "ui_scale": 2, "left_width": {"panel": 1}})";
    const std::filesystem::path file = folder.write("settings.json", newer);
    EXPECT_NE(keep_unreadable_settings(file).find("is of a newer version"), std::string::npos);
    Settings settings = load_settings(file);
    EXPECT_EQ(settings.ui_scale, 2) << "what is understood counts";
    settings.ui_scale = 1;
    save_settings(file, settings);
    EXPECT_EQ(mobbscope::testing::slurp(file), newer);
}

}  // namespace
}  // namespace mobbscope::app
