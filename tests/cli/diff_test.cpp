#include "run_program.h"

#include <render/image/png.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include "render/backends.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Image grey(int width, int height) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 255 : 100;
    return image;
}

class DiffTest : public ::testing::Test {
  protected:
    /// A grey picture of 100x50 in which this many pixels of the first rows are off by so many levels.
    std::string picture(const std::string& name, int pixels = 0, int by = 0) const {
        Image image = grey(100, 50);
        for (int i = 0; i < pixels; ++i) *image.at(i % 100, i / 100) = static_cast<std::uint8_t>(100 + by);
        return picture(name, image);
    }
    std::string picture(const std::string& name, const Image& image) const {
        write_png(folder.path() / name, image);
        return folder.path() / name;
    }
    /// Of a and b, and more arguments.
    static Result compare(const std::string& a, const std::string& b, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"diff", a, b};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    }
    const TempFolder folder;
    const std::string heat = folder.path() / "heat.png";
    const std::string strip = folder.path() / "strip.png";
    const std::string a = picture("a.png");
};

TEST_F(DiffTest, TheVerdictIsTheExitStatusAndASentence) {
    const Result enough = compare(a, picture("b.png", 4, 200));
    EXPECT_EQ(enough.status, 0);
    EXPECT_EQ(enough.out,
              "passes: 4 of 5000 pixels (0.08 %) differ by more than 3/255, up to 56/255, within 4x1 at (0, 0); "
              "allowed: 4\n");
    const Result different = compare(a, picture("c.png", 5, 87));
    EXPECT_EQ(different.status, 1);
    EXPECT_EQ(different.out,
              "different: 5 of 5000 pixels (0.1 %) differ by more than 3/255, up to 87/255, within 5x1 at (0, 0); "
              "allowed: 4\n");
    EXPECT_EQ(enough.err + different.err, "");
    EXPECT_EQ(compare(a, a).out, "same: none of 5000 pixels differs\n");
}

TEST_F(DiffTest, ThresholdsAreLevelsOrShares) {
    const std::string b = picture("b.png", 5000, 3);
    EXPECT_EQ(compare(a, b).status, 1) << "all of it is lighter";
    for (const char* enough : {"3", "3/255", "3.0", "0.012", "1.2%", "6/510", "255", "100%", "1/1"}) {
        EXPECT_EQ(compare(a, b, {"--threshold", enough}).status, 0) << enough;
    }
    for (const char* less : {"2", "2/255", "2.9", "1", "0", "0.011", "1.1%", "0%"}) {
        EXPECT_EQ(compare(a, b, {"--threshold", less}).status, 1) << less;
    }
    for (const char* bad : {"", "x", "-1", "256", "nan", "101%", "3/0", "300/255", "3/", "/255", "%", "3 %", "1/2/3"}) {
        expect_refused(compare(a, b, {"--threshold", bad}), 2, "--threshold");
    }
}

TEST_F(DiffTest, WhatIsAllowedIsANumberOfPixelsOrAShare) {
    const std::string b = picture("b.png", 50, 100);
    EXPECT_EQ(compare(a, b).status, 1);
    for (const char* enough : {"0.01", "1%", "100%", "0.5", "50px", "10000ppm"}) {
        EXPECT_EQ(compare(a, b, {"--allowed", enough}).status, 0) << enough;
    }
    for (const char* less : {"0", "0.0099", "0.99%", "0%", "49px", "9999ppm"}) {
        EXPECT_EQ(compare(a, b, {"--allowed", less}).status, 1) << less;
    }
    for (const char* bad : {"", "1", "50", "-0.1", "101%", "x", "inf", "1.5px", "-1px"}) {
        expect_refused(compare(a, b, {"--allowed", bad}), 2, "--allowed");
    }
}

TEST_F(DiffTest, AShiftOfAPixelMayBeForgiven) {
    Image image = grey(100, 50);
    for (int y = 0; y < 50; ++y) *image.at(20, y) = 255;
    const std::string left = picture("left.png", image);
    image = grey(100, 50);
    for (int y = 0; y < 50; ++y) *image.at(21, y) = 255;
    const std::string right = picture("right.png", image);
    EXPECT_EQ(compare(left, right).status, 1);
    EXPECT_EQ(compare(left, right, {"--shift", "0"}).status, 1);
    EXPECT_EQ(compare(left, right, {"--shift", "1"}).status, 0);
    EXPECT_EQ(compare(left, a, {"--shift", "1"}).status, 1);
    expect_refused(compare(left, right, {"--shift", "2"}), 2, "--shift");
}

TEST_F(DiffTest, OnlyTheMaskIsCompared) {
    const std::string b = picture("b.png", 100, 100);
    Image mask = grey(100, 50);
    std::fill_n(mask.rgba.begin(), 400, std::uint8_t{0});
    const std::string lower = picture("mask.png", mask);
    EXPECT_EQ(compare(a, b, {"--mask", lower}).out, "same: none of 4900 pixels differs\n");
    EXPECT_EQ(compare(a, b, {"--mask", a}).status, 1);
    expect_refused(compare(a, b, {"--mask", picture("small.png", grey(10, 50))}), 2, "small.png: the mask has 10x50");
    expect_refused(compare(a, b, {"--mask", picture("black.png", Image(100, 50))}), 2, "leaves nothing to compare");
    expect_refused(compare(a, b, {"--mask", folder.path() / "none.png"}), 2, "none.png");
}

TEST_F(DiffTest, WritesTheHeatMapAndTheStrip) {
    const std::string b = picture("b.png", 100, 100);
    EXPECT_EQ(compare(a, b, {"-o", heat, "--strip", strip}).status, 1);
    EXPECT_GT(read_png(heat).at(50, 0)[0], 200);
    EXPECT_LT(read_png(heat).at(50, 40)[0], 100);
    const Image side_by_side = read_png(strip);
    EXPECT_EQ(side_by_side.width, 3 * 100 + 2 * 4);
    EXPECT_EQ(*side_by_side.at(50, 0), 100);
    EXPECT_EQ(*side_by_side.at(154, 0), 200);
    EXPECT_EQ(*side_by_side.at(258, 0), read_png(heat).at(50, 0)[0]);
    std::filesystem::remove(heat);
    EXPECT_EQ(compare(a, a, {"--output", heat}).status, 0);
    EXPECT_EQ(read_png(heat).width, 100) << "also of equal pictures";
}

TEST_F(DiffTest, OfTwoSizesThereIsNoHeatMap) {
    const std::string b = picture("b.png", grey(100, 51));
    const Result run = compare(a, b, {"-o", heat, "--strip", strip});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.out, "different: the sizes are 100x50 and 100x51\n");
    EXPECT_NE(run.err.find("heat.png: not written"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(heat));
    EXPECT_EQ(read_png(strip).width, 204);
    EXPECT_EQ(read_png(strip).height, 51);
}

TEST_F(DiffTest, JsonHasAllFigures) {
    const Result run = compare(a, picture("b.png", 6, 87), {"--json", "--threshold", "2.5", "--allowed", "0.05%"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "");
    const auto report = nlohmann::json::parse(run.out);
    EXPECT_EQ(keys(report), (std::set<std::string>{
                                "same",    "passes",    "same_size", "size_a",        "size_b",       "pixels",
                                "unequal", "failing",   "fraction",  "maximum",       "mean",         "unequal_bounds",
                                "bounds",  "histogram", "threshold", "allowed",       "least_pixels", "allowed_pixels",
                                "shift",   "tile_mean", "tile",      "tile_threshold"}));
    EXPECT_EQ(report["same"], false);
    EXPECT_EQ(report["failing"], 6);
    EXPECT_EQ(report["maximum"], 87);
    EXPECT_EQ(report["bounds"]["width"], 6);
    EXPECT_EQ(report["threshold"], 2.5);
    EXPECT_EQ(report["allowed"], 0.0005);
    const auto sizes = nlohmann::json::parse(compare(a, picture("c.png", grey(7, 8)), {"--json"}).out);
    EXPECT_EQ(sizes["same_size"], false);
    EXPECT_EQ(sizes["size_b"], nlohmann::json({7, 8}));
}

TEST_F(DiffTest, BadPicturesAreRefusedAndNothingIsWritten) {
    const std::string whole = slurp(a);
    const std::string bad[] = {folder.path() / "missing.png",
                               folder.path(),
                               folder.write("empty.png", ""),
                               folder.write("text.png", "no picture"),
                               folder.write("cut.png", whole.substr(0, whole.size() / 2)),
                               folder.write("end.png", whole.substr(0, whole.size() - 12)),
                               "/dev/zero",
                               ""};
    for (const std::string& file : bad) {
        expect_refused(compare(a, file, {"-o", heat, "--strip", strip}), 2, "");
        expect_refused(compare(file, a, {"-o", heat, "--strip", strip, "--json"}), 2, "");
    }
    EXPECT_FALSE(std::filesystem::exists(heat));
    EXPECT_FALSE(std::filesystem::exists(strip));
}

TEST_F(DiffTest, OutputsReplaceNothingThatIsRead) {
    const std::string b = picture("b.png", 100, 100);
    const std::string mask = picture("mask.png");
    const std::string before = slurp(b);
    std::filesystem::create_symlink("b.png", folder.path() / "link.png");
    for (const std::string& out :
         {a, b, (folder.path() / "link.png").string(), (folder.path() / "." / "b.png").string(), mask}) {
        for (const char* option : {"-o", "--strip"}) {
            expect_refused(compare(a, b, {option, out, "--mask", mask}), 2, "would replace");
        }
    }
    EXPECT_EQ(slurp(b), before);
    expect_refused(compare(a, b, {"-o", heat, "--strip", folder.path() / "." / "heat.png"}), 2, "written twice");
    EXPECT_FALSE(std::filesystem::exists(heat));
    EXPECT_EQ(compare(a, b, {"-o", heat}).status, 1);
    EXPECT_EQ(compare(a, b, {"-o", heat}).status, 1) << "an earlier heat map is replaced";
}

TEST_F(DiffTest, BadUsageIsStatusTwo) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"diff"},
                                                      {"diff", a},
                                                      {"diff", a, a, a},
                                                      {"diff", a, a, "-o", folder.path() / "heat.jpg"},
                                                      {"diff", a, a, "-o", ""},
                                                      {"diff", a, a, "--strip", folder.path() / "strip"},
                                                      {"diff", a, a, "--mask", ""},
                                                      {"diff", a, a, "--fuzz", "3"}}) {
        expect_refused(run_program(arguments), 2, "");
    }
}

TEST_F(DiffTest, WhatCannotBeWrittenIsStatusThreeAndLeavesNothing) {
    expect_refused(compare(a, a, {"-o", "/nonexistent/heat.png", "--strip", strip}), 3, "/nonexistent");
    expect_refused(compare(a, a, {"-o", heat, "--strip", "/nonexistent/strip.png"}), 3, "/nonexistent");
    EXPECT_FALSE(std::filesystem::exists(heat));
    EXPECT_FALSE(std::filesystem::exists(strip));
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    EXPECT_EQ(run_program({"diff", a, a}, "/dev/full").status, 3);
}

/// Neither the number of threads nor the order in which they finish shows.
TEST_F(DiffTest, OneMoreCoreIsNoDifference) {
    if (!has_or_skip(Backend::automatic)) return;
    const auto render = [&](const char* threads, const char* name) {
        ::setenv("LP_NUM_THREADS", threads, 1);
        const std::string out = folder.path() / name;
        const Result run = run_program({"render", kCrossing, "-o", out, "--size", "640x360", "--level", "0:3"});
        ::unsetenv("LP_NUM_THREADS");
        EXPECT_EQ(run.status, 0) << run.err;
        return out;
    };
    const Result run = compare(render("1", "one.png"), render("2", "two.png"), {"--threshold", "0", "--allowed", "0"});
    EXPECT_EQ(run.out, "same: none of 230400 pixels differs\n");
}

}  // namespace
}  // namespace mobbscope
