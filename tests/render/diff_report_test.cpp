// What a comparison found, as JSON and in words.
#include <render/image/image_diff.h>

#include "support/json_keys.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace mobbscope {
namespace {

/// Grey pictures of 640x360 of which some pixels of the first row differ.
ImageDiff report_difference(int pixels, int by, const DiffOptions& options = {}) {
    const Image reference(640, 360);
    Image actual = reference;
    for (int x = 0; x < pixels; ++x) actual.at(12 + x % 600, 3 + x / 600)[3] = static_cast<std::uint8_t>(by);
    return diff(actual, reference, options);
}

TEST(DiffJson, HasAllFigures) {
    std::ostringstream text;
    JsonWriter out(text);
    write_diff(out, report_difference(231, 87, {3, 0.001, 1}));
    const auto json = nlohmann::json::parse(text.str());
    EXPECT_EQ(
        testing::keys(json),
        (std::set<std::string>{"same",    "passes",    "same_size", "size_a",        "size_b",       "pixels",
                               "unequal", "failing",   "fraction",  "maximum",       "mean",         "unequal_bounds",
                               "bounds",  "histogram", "threshold", "allowed",       "least_pixels", "allowed_pixels",
                               "shift",   "tile_mean", "tile",      "tile_threshold"}));
    EXPECT_EQ(json["same"], false);
    EXPECT_EQ(json["same_size"], true);
    EXPECT_EQ(json["size_b"], nlohmann::json({640, 360}));
    EXPECT_EQ(json["pixels"], 230400);
    EXPECT_EQ(json["failing"], 231);
    EXPECT_DOUBLE_EQ(json["fraction"], 231 / 230400.0);
    EXPECT_EQ(json["maximum"], 87);
    EXPECT_DOUBLE_EQ(json["mean"], 231 * 87 / 230400.0);
    EXPECT_EQ(json["bounds"], nlohmann::json({{"x", 12}, {"y", 3}, {"width", 231}, {"height", 1}}));
    EXPECT_EQ(json["histogram"].size(), 256u);
    EXPECT_EQ(json["histogram"][87], 231);
    EXPECT_EQ(json["threshold"], 3);
    EXPECT_EQ(json["allowed"], 0.001);
    EXPECT_EQ(json["shift"], 1);
    EXPECT_EQ(json["tile_mean"], 0) << "pixels beyond the threshold are left out";
    EXPECT_TRUE(json["tile"].is_null());
    EXPECT_EQ(json["tile_threshold"], 0.3);
}

TEST(DiffJson, WithoutDifferencesThereAreNoBounds) {
    std::ostringstream text;
    JsonWriter out(text);
    write_diff(out, diff(Image(2, 3), Image(4, 5)));
    const auto json = nlohmann::json::parse(text.str());
    EXPECT_EQ(json["same_size"], false);
    EXPECT_EQ(json["size_a"], nlohmann::json({2, 3}));
    EXPECT_EQ(json["size_b"], nlohmann::json({4, 5}));
    EXPECT_TRUE(json["bounds"].is_null());
    EXPECT_EQ(json["pixels"], 0);
}

TEST(DiffSentence, SaysWhatWasFound) {
    EXPECT_EQ(diff_sentence(report_difference(412, 87)),
              "different: 412 of 230400 pixels (0.18 %) differ by more than 3/255, up to 87/255, within 412x1 at (12, "
              "3); allowed: 4");
    EXPECT_EQ(diff_sentence(report_difference(1, 87)),
              "passes: 1 of 230400 pixels (0.00043 %) differs by more than 3/255, up to 87/255, within 1x1 at (12, 3); "
              "allowed: 4");
    EXPECT_EQ(diff_sentence(report_difference(60000, 87, {2.5, 0, 0, 0})),
              "different: 60000 of 230400 pixels (26 %) differ by more than 2.5/255, up to 87/255, within 600x100 at "
              "(12, 3); allowed: 0");
    EXPECT_EQ(
        diff_sentence(report_difference(5, 2)),
        "passes: none of 230400 pixels differs by more than 3/255; 5 differ by up to 2/255, within 5x1 at (12, 3)");
    EXPECT_EQ(diff_sentence(report_difference(0, 0)), "same: none of 230400 pixels differs");
    EXPECT_EQ(diff_sentence(diff(Image(2, 3), Image(4, 5))), "different: the sizes are 2x3 and 4x5");
}

}  // namespace
}  // namespace mobbscope
