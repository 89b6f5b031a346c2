#include <base/json.h>
#include <base/json_writer.h>
#include <scene/scene.h>
#include <scene/view_options.h>
#include <scene/view_state.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mobbscope {
namespace {

TEST(ViewState, LevelRangesAreReadAndWritten) {
    EXPECT_EQ(parse_level_range("2"), (LevelRange{2, 2, false}));
    EXPECT_EQ(parse_level_range("1:3"), (LevelRange{1, 3, false}));
    EXPECT_TRUE(parse_level_range("leaves").leaves);
    for (const char* text : {"2", "1:3", "leaves"}) EXPECT_EQ(to_string(parse_level_range(text)), text);
    for (const char* bad : {"", "-1", "3:1", "1:", ":1", "1:2:3", "x", "2 ", "1.5", "99999999999", "leave"}) {
        EXPECT_THROW(parse_level_range(bad), std::invalid_argument) << bad;
    }
}

TEST(ViewState, StepsAreReadAndWritten) {
    EXPECT_EQ(parse_step("12"), (Step{Step::Unit::event, 12}));
    EXPECT_EQ(parse_step("40%"), (Step{Step::Unit::percent, 40}));
    EXPECT_EQ(parse_step("end"), (Step{Step::Unit::end, 0}));
    EXPECT_EQ(parse_step("leaf:3"), (Step{Step::Unit::leaf, 3}));
    EXPECT_EQ(parse_step("separated:2"), (Step{Step::Unit::separated, 2}));
    EXPECT_EQ(parse_step("depth:0"), (Step{Step::Unit::depth, 0}));
    EXPECT_EQ(parse_step("overlap:1"), parse_step("overlap"));
    for (const char* text : {"0", "12", "40%", "33.5%", "end", "leaf:3", "leaf", "avoidable:3", "separated:2",
                             "overlap", "hit", "depth:0", "depth:1"}) {
        EXPECT_EQ(to_string(parse_step(text)), text);
    }
    for (const char* bad : {"", "-1", "101%", "-1%", "%", "nan%", "1.5", "last", "leaf:0", "leaf:", "leaf:-1", "depth",
                            "end:1", ":3", "hit:x"}) {
        EXPECT_THROW(parse_step(bad), std::invalid_argument) << bad;
    }
}

TEST(ViewState, NamesAreTheirOwnInverse) {
    for (const CameraPreset preset :
         {CameraPreset::iso, CameraPreset::top, CameraPreset::front, CameraPreset::side, CameraPreset::free}) {
        EXPECT_EQ(camera_preset(std::string(name(preset))), preset);
    }
    EXPECT_FALSE(camera_preset("below"));
    EXPECT_EQ(theme_from_name(name(Theme::light)), Theme::light);
    EXPECT_EQ(color_by_from_name(name(ColorBy::level)), ColorBy::level);
    EXPECT_FALSE(color_by_from_name("node"));
    EXPECT_FALSE(theme_from_name(""));
    for (const Past past : {Past::pair, Past::ancestors, Past::siblings, Past::all}) {
        EXPECT_EQ(past_from_name(name(past)), past);
    }
}

ViewState view_in(const std::string& json) {
    return parse_scene(R"({"clips": {"c": {"dt": 1, "samples": [[0, 0, 1]]}}, "view": )" + json + "}", "s.json", "")
        .view;
}

TEST(ViewState, ValueRangesAreThoseOfFiles) {
    EXPECT_EQ(parse_value_range("none"), std::nullopt);
    for (const char* text : {"0:2.5", "-3:-3", "-1e12:1e12"}) {
        ViewState view;
        view.slab = parse_value_range(text);
        std::ostringstream out;
        JsonWriter writer(out);
        write_view(writer, view);
        EXPECT_EQ(view_in(out.str()).slab, view.slab) << out.str();
    }
    for (const char* bad : {"", "1", "2:1", "0:1e300", "-1e13:0", "0:nan", "0:inf", "0:1:2"})
        EXPECT_THROW(parse_value_range(bad), std::invalid_argument) << bad;
}

/// A range belongs to the figure that it was chosen for.
TEST(ViewState, AnotherFigureHasARangeOfItsOwn) {
    const auto range_over = [](const std::string& text) {
        ViewState view;
        view.color_by = ColorBy::volume;
        view.color_range = ValueRange{0, 2.5};
        const std::string file = "view.json";
        const JsonText value = parse_json(text, file);
        return read_view(JsonPlace(value, file), view).color_range;
    };
    EXPECT_EQ(range_over(R"({"color_by": "fill"})"), std::nullopt);
    EXPECT_EQ(range_over(R"({"color_by": "volume"})"), (ValueRange{0, 2.5}));
    EXPECT_EQ(range_over(R"({"color_range": [1, 2], "color_by": "fill"})"), (ValueRange{1, 2}));
}

/// How the past was written before there was a choice.
TEST(ViewState, FilesThatSayTestedBeforeAreStillRead) {
    EXPECT_EQ(view_in("{}").past, Past::ancestors);
    EXPECT_EQ(view_in(R"({"tested_before": true})").past, Past::all);
    EXPECT_EQ(view_in(R"({"tested_before": false})").past, Past::pair);
    EXPECT_EQ(view_in(R"({"past": "siblings"})").past, Past::siblings);
    const std::string both = input_error([] { view_in(R"({"past": "pair", "tested_before": true})"); });
    EXPECT_NE(both.find("/view/tested_before: says the same as 'past' in an older way; leave it out"),
              std::string::npos)
        << both;
    const std::string other = input_error([] { view_in(R"({"past": "some"})"); });
    EXPECT_NE(other.find("give pair, ancestors, siblings or all"), std::string::npos) << other;
    EXPECT_NE(input_error([] { view_in(R"({"tested_before": "yes"})"); }), "");
    std::ostringstream out;
    JsonWriter writer(out);
    write_view(writer, view_in(R"({"tested_before": true})"));
    EXPECT_NE(out.str().find(R"("past": "all")"), std::string::npos) << out.str();
    EXPECT_EQ(out.str().find("tested_before"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
