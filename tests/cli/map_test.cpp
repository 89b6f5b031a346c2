// mobbscope map: numbers that query confirms, a finished picture, and one line for what is no map.
#include "run_program.h"

#include <render/image/png.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include "render/backends.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Result map_of(const std::vector<std::string>& more, const std::string& file = kCrossing) {
    return run_program(with({"map", file}, more));
}

TEST(MapCommand, JsonSaysWhatQueryDoes) {
    const TempFolder folder;
    const Result run = map_of({"--over", "dstart=-3:3,dx=-2:6", "--cells", "7x5", "--show", "tests", "--tree", "umobb",
                               "--query", "0", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto map = nlohmann::json::parse(run.out);
    EXPECT_EQ(map["query"], 0);
    EXPECT_EQ(map["show"], "tests");
    EXPECT_EQ(map["cells"], (nlohmann::json{7, 5}));
    EXPECT_EQ(map["over"], (nlohmann::json{{"dstart", {-3, 3}}, {"dx", {-2, 6}}}));
    ASSERT_EQ(map["values"].size(), 5U);
    ASSERT_EQ(map["values"][0].size(), 7U);
    std::ifstream file(kCrossing);
    const auto scene = nlohmann::json::parse(file);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(6, 1), std::pair(3, 4), std::pair(2, 2)}) {
        auto there = scene;
        for (auto& [name, clip] : there["clips"].items()) {
            if (clip.contains("source"))
                clip["source"] = (std::filesystem::path(kCrossing).parent_path() / clip["source"].get<std::string>());
        }
        auto& b = there["agents"][1];
        b["start"] = b.value("start", 0.0) + -3 + (x + 0.5) / 7 * 6;
        b["translate"][0] = b["translate"][0].get<double>() + -2 + (y + 0.5) / 5 * 8;
        const std::string moved = folder.path() / "moved.json";
        std::ofstream(moved) << there;
        const Result asked = run_program({"query", moved, "--json", "--tree", "umobb"});
        const auto tests = nlohmann::json::parse(asked.out)["results"][0]["tests"];
        int counted = 0;
        for (const auto& [kind, count] : tests.items()) counted += kind == "time" ? 0 : count.get<int>();
        EXPECT_EQ(map["values"][static_cast<std::size_t>(y)][static_cast<std::size_t>(x)], counted);
    }
}

TEST(MapCommand, WhereNoTimeIsSharedThereIsNoClearance) {
    const Result run =
        map_of({"--over", "dx=-1:1,dstart=-1000:1000", "--cells", "1x3", "--show", "clearance", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto values = nlohmann::json::parse(run.out)["values"];
    EXPECT_TRUE(values[0][0].is_null());
    EXPECT_TRUE(values[1][0].is_number_float());
    EXPECT_TRUE(values[2][0].is_null());
}

TEST(MapCommand, DrawsAPictureAndSaysHowManyCollide) {
    const TempFolder folder;
    const std::string out = folder.path() / "map.png";
    for (const std::string show : {"answer", "clearance", "tests"}) {
        const Result run = map_of({"--over", "dx=-5:5,dy=-5:5", "--cells", "40x30", "--show", show, "-o", out, "--size",
                                   "480x400", "--theme", "light", "--backend", "osmesa"});
        if (run.status == 3) GTEST_SKIP() << run.err;
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.out.rfind("0: B moved, A stays: 14.8 % of 1,200 placements collide", 0), 0U) << run.out;
        const Image picture = read_png(out);
        EXPECT_EQ(picture.width, 480);
        EXPECT_EQ(picture.height, 400);
        std::filesystem::remove(out);
    }
}

TEST(MapCommand, AVectorFileNeedsNoOpenGl) {
    const TempFolder folder;
    for (const char* name : {"map.svg", "map.pdf"}) {
        const std::string out = folder.path() / name;
        const Result run = map_of({"--over", "dx=-5:5,dy=-5:5", "--cells", "8x8", "--backend", "egl", "-o", out});
        ASSERT_EQ(run.status, 0) << run.err;
        std::ifstream file(out);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        EXPECT_TRUE(text.starts_with("<?xml") || text.starts_with("%PDF-"));
        if (out.ends_with(".svg")) {
            EXPECT_NE(text.find(">B now</text>"), std::string::npos);
        }
    }
}

TEST(MapCommand, RefusesWhatIsNoMapInOneLine) {
    const TempFolder folder;
    const std::string out = folder.path() / "map.png";
    const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
        const Result run = map_of(more);
        EXPECT_EQ(run.status, 2) << why << ": " << run.err;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
        EXPECT_EQ(run.out, "");
        EXPECT_FALSE(std::filesystem::exists(out));
    };
    const std::string good = "dx=-5:5,dy=-5:5";
    refused({"-o", out}, "--over");
    refused({"--over", good}, "give -o MAP.png or --json");
    for (const auto& [axes, why] : std::vector<std::pair<std::string, std::string>>{
             {"dx=5:-5,dy=-5:5", "dx must go from"},
             {"dx=-5:5,dy=1:1", "dy must go from"},
             {"dx=nan:5,dy=-5:5", "no range of two finite numbers"},
             {"dx=-5:inf,dy=-5:5", "no range of two finite numbers"},
             {"dx=-5:5,dx=-5:5", "both axes are dx"},
             {"dx=-5:5", "a map has two axes"},
             {"dx=-5:5,dy=-5:5,dstart=0:1", "a map has two axes"},
             {"dx=-5:5,dz=-5:5", "'dz' is not one of dx, dy, dheading, dstart"},
             {"dx,dy", "no range of two finite numbers"},
             {"", "a map has two axes"},
             {"dx=-5:5,dy=0:1e300", "where none may"}}) {
        refused({"--over", axes, "--json"}, why);
        refused({"--over", axes, "-o", out}, why);
    }
    for (const std::string cells : {"0x5", "5x0", "-1x5", "100000x100000", "5", "x", "5x5x5", "axb", ""})
        refused({"--over", good, "--cells", cells, "--json"}, "is not a number of cells");
    refused({"--over", good, "--show", "gaps", "--json"}, "not one of answer, clearance, tests");
    refused({"--over", good, "--query", "7", "--json"}, "there is no query 7; 0 is the only one");
    refused({"--over", good, "--query", "-1", "--json"}, "not a whole number");
    refused({"--over", good, "-o", std::string(folder.path() / "map.jpg")},
            "pictures are written as .png, .svg or .pdf");
    refused({"--over", good, "-o", out, "--size", "10x10"}, "10x10");
}

}  // namespace
}  // namespace mobbscope
