#include <app/document/settings.h>
#include <base/lock.h>

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

/// By a window that has not read what is there.
void save_settings(const std::filesystem::path& file, Settings settings) { SettingsFile(file).save(settings); }

Settings with_scale(double scale) {
    Settings out;
    out.ui_scale = scale;
    return out;
}

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
    settings.cost_of = QueryWorkload::Kind::queries;
    settings.bottom_tab = BottomTab::nodes;
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
    SettingsFile settings_file(old);
    Settings again = settings_file.load();
    again.remember("/a/b/");
    again.remember("/c/d");
    settings_file.save(again);
    EXPECT_EQ(again.recent, (std::vector<std::filesystem::path>{"/c/d", "/a/b", "/c", "/"}));
    EXPECT_EQ(load_settings(old), again);
}

TEST(Settings, JunkIsPassedOver) {
    const TempFolder folder;
    EXPECT_EQ(load_settings(folder.path() / "none.json"), Settings{});
    EXPECT_EQ(load_settings(folder.path()), Settings{});
    for (const char* text : {"",
                             "{",
                             "[1, 2]",
                             "null",
                             "\xff\xfe",
                             R"({"ui_scale": "big", "left_width": -3})",
                             R"({"ui_scale": 1e999})",
                             R"({"recent": {"a": 1}})",
                             R"({"recent": [1, null, "here"]})",
                             R"({"theme": "pink", "folder": "here"})",
                             R"({"window": {"x": 1}})",
                             R"({"window": {"x": 0, "y": 0, "width": 0, "height": 5}})",
                             R"({"window": {"x": 1e300, "y": 0, "width": 9, "height": 5}})",
                             R"({"folded": [true]})",
                             R"({"folded": {"clips": "yes"}})",
                             R"({"file_order": "colour"})",
                             R"({"cost_of": "colour"})",
                             R"({"bottom_tab": "colour"})",
                             R"({"shows_events": "yes"})",
                             R"({"last_session": [1]})",
                             R"({"last_session": {"files": "a", "view": {"query": -1}}})"}) {
        EXPECT_EQ(load_settings(folder.write("settings.json", text)), Settings{}) << text;
    }
    const Settings some =
        load_settings(folder.write("settings.json", R"({"ui_scale": 99, "right_width": 400, "recent": [3, "/a"]})"));
    EXPECT_EQ(some.ui_scale, 0);
    EXPECT_EQ(some.right_width, 400);
    EXPECT_EQ(some.recent, std::vector<std::filesystem::path>{"/a"});
}

TEST(Settings, OlderVersionsSaidOnlyWhetherEventsWereListed) {
    const TempFolder folder;
    const auto tab = [&](const char* text) { return load_settings(folder.write("settings.json", text)).bottom_tab; };
    EXPECT_EQ(tab(R"({"shows_events": true})"), BottomTab::events);
    EXPECT_EQ(tab(R"({"shows_events": false})"), BottomTab::recursion);
    EXPECT_EQ(tab(R"({"shows_events": true, "bottom_tab": "curves"})"), BottomTab::curves);
}

TEST(Settings, OfAnotherVersionStay) {
    const TempFolder folder;
    const std::string file = folder.write(
        "settings.json",
        R"({"wings": {"left": [1, 2]}, "ui_scale": 2, "last_session": {"files": ["/a"], "view": {"wings": 1}}})");
    SettingsFile kept(file);
    Settings settings = kept.load();
    EXPECT_EQ(settings.last.files, std::vector<std::filesystem::path>{"/a"});
    EXPECT_EQ(settings.last.view, ViewState{}) << "a view that cannot be read is as usual";
    settings.ui_scale = 3;
    kept.save(settings);
    EXPECT_EQ(load_settings(file), settings);
    const std::string text = slurp(file);
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
    EXPECT_EQ(slurp(folder.path() / "settings.json.unreadable"), R"({"ui_scale": 2,)");
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
    EXPECT_EQ(slurp(file), newer);
}

TEST(Settings, ThatAreNestedDeepOrLargeCountAsUnreadable) {
    const auto nested = [](int deep) {
        std::string text;
        for (int i = 0; i < deep; ++i) text += "{\"a\":";
        return text + "1" + std::string(static_cast<std::size_t>(deep), '}');
    };
    const std::string large = R"({"ui_scale": 2, "other": ")" + std::string(SettingsFile::kMostBytes, 'x') + "\"}";
    for (const std::string& text : {nested(20'000), nested(100'000), nested(SettingsFile::kDeepest + 1), large}) {
        const TempFolder folder;
        const std::filesystem::path file = folder.write("settings.json", text);
        EXPECT_EQ(load_settings(file), Settings{});
        save_settings(file, with_scale(2));
        EXPECT_EQ(slurp(file).size(), text.size()) << "what was not set aside stays";
        EXPECT_NE(keep_unreadable_settings(file), "");
        EXPECT_EQ(slurp(folder.path() / "settings.json.unreadable").size(), text.size());
    }
    const TempFolder folder;
    const std::filesystem::path file = folder.write("settings.json", nested(SettingsFile::kDeepest));
    EXPECT_EQ(keep_unreadable_settings(file), "");
    static_assert(SettingsFile::kMostBytes == 1'048'576 && SettingsFile::kDeepest == 64);
    EXPECT_NE(slurp(kSource / "docs/limits.md").find("settings, nested 64 deep | 1,048,576 |"), std::string::npos);
}

TEST(Settings, AreNeverWrittenLargerThanTheyAreRead) {
    const TempFolder folder;
    std::string deep;
    for (int i = 0; i < 60; ++i) deep += "{\"a\":";
    deep += '[';
    for (int i = 0; i < 60'000; ++i) deep += "1,";
    deep += "1]" + std::string(60, '}');
    const std::filesystem::path file = folder.write("settings.json", R"({"wings": )" + deep + "}");
    save_settings(file, with_scale(2));
    EXPECT_EQ(load_settings(file).ui_scale, 2);
    EXPECT_LT(slurp(file).size(), 2 * deep.size()) << "no blanks where they would be most of it";
    Settings long_session = with_scale(3);
    for (int i = 0; i < 100'000; ++i) long_session.last.files.push_back("/a/folder/of/clips/" + std::to_string(i));
    save_settings(file, long_session);
    EXPECT_LE(slurp(file).size(), SettingsFile::kMostBytes);
    EXPECT_EQ(load_settings(file).ui_scale, 3) << "what is left finds room";
    EXPECT_TRUE(load_settings(file).last.files.empty());
}

// --- several windows

TEST(Settings, OfSeveralWindowsAreMerged) {
    const TempFolder folder;
    const std::filesystem::path file = folder.path() / "settings.json";
    Settings first = with_scale(2);
    first.recent = {"/old"};
    save_settings(file, first);
    SettingsFile one(file);
    SettingsFile other(file);
    Settings of_one = one.load();
    Settings of_other = other.load();
    of_one.remember("/one");
    one.save(of_one);
    of_other.remember("/other");
    of_other.remember("/old");
    of_other.folded["clips"] = true;
    other.save(of_other);
    EXPECT_EQ(load_settings(file).recent, (std::vector<std::filesystem::path>{"/old", "/other", "/one"}));
    EXPECT_EQ(of_other.recent, load_settings(file).recent) << "a window takes in what the other one has opened";
    of_one.left_width = 250;
    of_one.folded["tree"] = true;
    one.save(of_one);
    const Settings both = load_settings(file);
    EXPECT_EQ(both.recent, (std::vector<std::filesystem::path>{"/old", "/other", "/one"}))
        << "nothing was opened since";
    EXPECT_EQ(both.folded, (std::map<std::string, bool>{{"clips", true}, {"tree", true}}));
    other.save(of_other);
    EXPECT_EQ(load_settings(file).left_width, 250) << "who has not changed it leaves it";
}

TEST(Settings, AreMergedHoweverManyWindowsWriteAtOnce) {
    const TempFolder folder;
    const std::filesystem::path file = folder.path() / "settings.json";
    const auto window = [&](const std::string& name) {
        SettingsFile kept(file);
        Settings settings = kept.load();
        for (int i = 0; i < 5; ++i) {
            settings.remember("/" + name + std::to_string(i));
            kept.save(settings);
        }
    };
    std::vector<std::thread> windows;
    for (const char* name : {"a", "b", "c", "d"}) windows.emplace_back(window, name);
    for (std::thread& each : windows) each.join();
    EXPECT_EQ(load_settings(file).recent.size(), 20u);
}

TEST(Settings, AWindowThatHoldsTheLockStopsNoOther) {
    const TempFolder folder;
    const Descriptor held = lock_folder(folder.path(), {});
    ASSERT_TRUE(held.is_open());
    EXPECT_FALSE(lock_folder(folder.path(), {}).is_open());
    save_settings(folder.path() / "settings.json", with_scale(2));
    EXPECT_EQ(load_settings(folder.path() / "settings.json").ui_scale, 2);
}

}  // namespace
}  // namespace mobbscope::app
