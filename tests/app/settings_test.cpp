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
    settings.folded = {"clips", "in time"};
    settings.remember(folder.path() / "a \"quoted\" näme.json");
    settings.remember(folder.path() / "b.json");
    save_settings(file, settings);
    EXPECT_EQ(load_settings(file), settings);
    EXPECT_EQ(settings.recent.front().filename(), "b.json");
}

TEST(Settings, RememberTwelveEachOnce) {
    Settings settings;
    for (int i = 0; i < 20; ++i) settings.remember("/folder/" + std::to_string(i));
    settings.remember("/folder/15");
    ASSERT_EQ(settings.recent.size(), 12u);
    EXPECT_EQ(settings.recent[0], "/folder/15");
    EXPECT_EQ(settings.recent[1], "/folder/19");
    EXPECT_EQ(std::count(settings.recent.begin(), settings.recent.end(), "/folder/15"), 1);
}

TEST(Settings, JunkIsPassedOver) {
    const TempFolder folder;
    EXPECT_EQ(load_settings(folder.path() / "none.json"), Settings{});
    EXPECT_EQ(load_settings(folder.path()), Settings{});
    for (const char* text :
         {"", "{", "[1, 2]", "null", "\xff\xfe", R"({"ui_scale": "big", "left_width": -3})", R"({"ui_scale": 1e999})",
          R"({"recent": {"a": 1}})", R"({"recent": [1, null, "here"], "folded": [3]})"}) {
        EXPECT_EQ(load_settings(folder.write("settings.json", text)), Settings{}) << text;
    }
    const Settings some =
        load_settings(folder.write("settings.json", R"({"ui_scale": 99, "right_width": 400, "recent": [3, "/a"]})"));
    EXPECT_EQ(some.ui_scale, 0);
    EXPECT_EQ(some.right_width, 400);
    EXPECT_EQ(some.recent, std::vector<std::filesystem::path>{"/a"});
}

TEST(Settings, WhereNothingCanBeWrittenNothingHappens) {
    save_settings("/proc/none/settings.json", {});
    save_settings({}, {});
}

}  // namespace
}  // namespace mobbscope::app
