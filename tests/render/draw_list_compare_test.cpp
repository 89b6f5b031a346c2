// What is another in two draw lists, in words.
#include <render/compare/draw_list_compare.h>
#include <render/pictures/build_draw_list.h>

#include "render/pictures.h"
#include "render/scenes.h"
#include "support/input_error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

DrawListComparison compared(const std::string& actual, const std::string& golden, const DrawListTerms& terms = {}) {
    return compare_draw_lists(actual, "actual.json", golden, "golden.json", terms);
}

Words differences(const Json& actual, const Json& golden, const DrawListTerms& terms = {}) {
    return compared(actual.dump(), golden.dump(), terms).differences;
}

Json parsed(const std::string& text) { return Json::parse(text); }

/// A picture with all kinds of things; with an id picture's numbers of pixels.
Json small_list() {
    return parsed(R"({"size": [640, 360], "background": "#FFFFFFFF", "participants": ["A", "B"],
        "camera": {"eye": [1, 2, 3], "right": [1, 0, 0], "clip_from_world": [1, 2, 0, 0]},
        "disks": [{"id": 1, "participant": 0, "sample": 2, "base": [0, 0, 0], "radius": 1, "pixels": 200},
                  {"id": 2, "participant": 0, "sample": 3, "base": [1, 0, 0], "radius": 1, "pixels": 200},
                  {"id": 4, "participant": 1, "sample": 3, "base": [2, 0, 0], "radius": 1, "pixels": 200}],
        "boxes": [{"id": 3, "participant": 0, "node": 3, "center": [0, 0, 0], "extents": [[1, 2], [3, 4]], "fill": "#0"},
                  {"id": 5, "participant": 1, "node": 5, "center": [0, 0, 0], "extents": [[1, 2], [3, 4]], "fill": "#0"},
                  {"id": 0, "participant": null, "node": null, "state": "annotation", "center": [0, 0, 9], "fill": "#1"}],
        "lines": [{"layer": 0, "from": [0, 0, 0], "to": [1, 0, 0], "color": "#2", "width": 1},
                  {"layer": 0, "from": [0, 1, 0], "to": [1, 1, 0], "color": "#2", "width": 1},
                  {"layer": 8, "from": [0, 2, 0], "to": [1, 2, 0], "color": "#3", "width": 1}],
        "headline": "A meets B",
        "legend": [{"mark": "disk", "color": "#4", "text": "level 1"}, {"mark": "disk", "color": "#5", "text": "level 2"}],
        "overlays": [{"name": "legend", "min": [10, 300], "max": [100, 350], "folded": false},
                     {"name": "inset", "min": [500, 10], "max": [600, 80], "folded": false}],
        "panels": [{"min": [10, 300], "max": [100, 350], "radius": 4, "fill": "#6"},
                   {"min": [500, 10], "max": [600, 80], "radius": 4, "fill": "#6"}],
        "overlay_lines": [{"from": [510, 20], "to": [590, 20], "color": "#7", "width": 1},
                          {"from": [510, 70], "to": [590, 70], "color": "#7", "width": 1}],
        "marks": [{"min": [520, 40], "max": [530, 50], "radius": 5, "fill": "#8"}],
        "texts": [{"text": "level 1", "role": "legend", "at": [30, 310], "size": 11, "color": "#9", "on_screen": true},
                  {"text": "level 2", "role": "legend", "at": [30, 330], "size": 11, "color": "#9", "on_screen": true},
                  {"text": "floor at 1 s", "role": "map", "at": [505, 20], "size": 11, "color": "#9", "on_screen": true},
                  {"text": "20 s", "role": "tick", "at": [20, 100], "size": 9, "color": "#9", "on_screen": true},
                  {"text": "0", "role": "tick", "at": [50, 250], "size": 9, "color": "#9", "on_screen": true},
                  {"text": "0", "role": "tick", "at": [250, 250], "size": 9, "color": "#9", "on_screen": true},
                  {"text": "A", "role": "name", "at": [200, 100], "size": 11, "color": "#9", "on_screen": true}]})");
}

/// What is told of a list that is changed.
Words told(const std::function<void(Json&)>& change, const DrawListTerms& terms = {}) {
    Json list = small_list();
    change(list);
    return differences(list, small_list(), terms);
}

void erase(Json& list, const char* key, int index) { list[key].erase(list[key].begin() + index); }

TEST(DrawListCompare, OfEqualListsThereIsNothingToTell) {
    const std::string list = testing::text_of(build_draw_list(testing::hit_scene(), {}, testing::kGoldenSize));
    EXPECT_TRUE(compared(list, list).same());
    EXPECT_TRUE(compared(list, list).pixels.empty());
    EXPECT_EQ(told([](Json&) {}), Words{});
    EXPECT_EQ(differences(parsed(R"({"a": [1, null, true, "x"], "b": {}})"),
                          parsed(R"({"b": {}, "a": [1.00005, null, true, "x"]})")),
              Words{});
}

TEST(DrawListCompare, WhatIsMissingIsNamed) {
    const auto check = [](const char* key, int index, const std::string& name) {
        EXPECT_EQ(told([&](Json& list) { erase(list, key, index); }), Words{"the " + name + " is missing"});
        Json less = small_list();
        erase(less, key, index);
        EXPECT_EQ(differences(small_list(), less), Words{"the " + name + " is not in the golden"});
    };
    check("disks", 1, "disk of A, sample 3");
    check("boxes", 1, "box of B, node 5");
    check("boxes", 2, "box 3 (annotation)");
    check("lines", 0, "line 1 of the surroundings from (0, 0, 0) to (1, 0, 0)");
    check("lines", 2, "line 3 of the time cursor from (0, 2, 0) to (1, 2, 0)");
    check("legend", 1, "row 'level 2' of the legend");
    check("overlays", 0, "panel of the legend");
    check("overlays", 1, "panel of the map");
    check("panels", 0, "panel 1 at (10, 300)");
    check("overlay_lines", 1, "line over the scene 2 from (510, 70) to (590, 70)");
    check("marks", 0, "mark 1 at (520, 40)");
    check("texts", 1, "row 'level 2' of the legend");
    check("texts", 2, "title 'floor at 1 s' of the map");
    check("texts", 3, "tick label '20 s'");
    check("texts", 4, "tick label '0'");
    check("texts", 6, "name 'A'");
    EXPECT_EQ(told([](Json& list) { list.erase("headline"); }), Words{"headline is missing: 'A meets B'"});
    EXPECT_EQ(told([](Json& list) { list.erase("marks"); }), Words{"the mark 1 at (520, 40) is missing"});
    EXPECT_EQ(told([](Json& list) { list["highlights"] = parsed(R"([{"role": "hover", "from": [1, 2]}])"); }),
              Words{"the highlight 1 (hover) from (1, 2) is not in the golden"});
    EXPECT_EQ(told([](Json& list) { erase(list, "legend", 1), erase(list, "texts", 1); }),
              Words{"the row 'level 2' of the legend is missing"})
        << "its words in the picture are the same row";
}

TEST(DrawListCompare, WhatDiffersIsNamedInOneLine) {
    const auto check = [](const std::function<void(Json&)>& change, const std::string& line) {
        EXPECT_EQ(told(change), Words{line});
    };
    check([](Json& list) { list["disks"][2]["radius"] = 1.1; }, "disk of B, sample 3, radius: 1.1 instead of 1");
    check([](Json& list) { list["disks"][2]["top"] = {1, 2}; }, "disk of B, sample 3, top: [1, 2] instead of nothing");
    check(
        [](Json& list) {
            list["boxes"][0]["extents"] = {{1.02, 3}, {3, 5}}, list["boxes"][0]["fill"] = "#9";
        },
        "box of A, node 3, extents: 1.02 instead of 1 (also fill)");
    check([](Json& list) { list["boxes"][2]["fill"] = "#9"; }, "box 3 (annotation), fill: '#9' instead of '#1'");
    check([](Json& list) { list["lines"][1]["color"] = "#9"; },
          "line 2 of the surroundings from (0, 1, 0) to (1, 1, 0), color: '#9' instead of '#2'");
    check([](Json& list) { list["lines"][2]["from"][1] = 2.5; },
          "line 3 of the time cursor from (0, 2, 0) to (1, 2, 0), from: y 2.5 instead of 2");
    check([](Json& list) { list["legend"][0]["color"] = "#9"; },
          "row 'level 1' of the legend, color: '#9' instead of '#4'");
    check([](Json& list) { list["overlays"][1]["folded"] = true; }, "panel of the map, folded: true instead of false");
    check([](Json& list) { list["panels"][1]["max"] = {600, 81}; }, "panel 2 at (500, 10), max: y 81 instead of 80");
    check([](Json& list) { list["marks"][0]["fill"] = "#9"; }, "mark 1 at (520, 40), fill: '#9' instead of '#8'");
    check([](Json& list) { list["texts"][3]["at"][0] = 21; }, "tick label '20 s', at: x 21 instead of 20");
    check([](Json& list) { list["texts"][5]["at"][0] = 251; }, "tick label '0', at: x 251 instead of 250");
    check([](Json& list) { list["texts"][3]["text"] = "25 s"; }, "tick label '20 s', text: '25 s' instead of '20 s'");
    check([](Json& list) { list["texts"][3]["role"] = "note"; }, "tick label '20 s', role: 'note' instead of 'tick'");
    check([](Json& list) { list["texts"][1]["text"] = "level 3", list["legend"][1]["text"] = "level 3"; },
          "row 'level 2' of the legend, text: 'level 3' instead of 'level 2'");
    check([](Json& list) { list["headline"] = "B"; }, "headline: 'B' instead of 'A meets B'");
    check([](Json& list) { list["size"] = {640, 361}; }, "size/1: 361 instead of 360");
    check([](Json& list) { std::swap(list["panels"][0], list["panels"][1]); },
          "panel 2 at (500, 10) comes before panel 1 at (10, 300)");
}

TEST(DrawListCompare, ParticipantsAreNamedWhateverTheirNumber) {
    Json list = small_list();
    list["participants"] = {"B"};
    erase(list, "boxes", 0);
    erase(list, "disks", 0), erase(list, "disks", 0);
    int id = 1;
    for (Json* object : {&list["disks"][0], &list["boxes"][0]}) (*object)["participant"] = 0, (*object)["id"] = id++;
    EXPECT_EQ(differences(list, small_list()),
              (Words{"the participant 'A' is missing", "the disk of A, sample 2 is missing",
                     "the disk of A, sample 3 is missing", "the box of A, node 3 is missing"}));
}

TEST(DrawListCompare, AParticipantThatIsCalledOtherwiseIsToldOnce) {
    EXPECT_EQ(told([](Json& list) { list["participants"][0] = "X"; }), Words{"participant 'A' is called 'X'"});
    EXPECT_EQ(told([](Json& list) {
                  list["participants"] = {"X", "Y"};
              }),
              (Words{"participant 'A' is called 'X'", "participant 'B' is called 'Y'"}));
    // What else differs is told by the name in the golden.
    EXPECT_EQ(told([](Json& list) {
                  list["participants"][0] = "X";
                  list["disks"][0]["radius"] = 2;
                  erase(list, "boxes", 0);
                  list["disks"][1]["sample"] = 9;
              }),
              (Words{"the disk of A, sample 3 is missing", "the disk of A, sample 9 is not in the golden",
                     "the box of A, node 3 is missing", "participant 'A' is called 'X'",
                     "disk of A, sample 2, radius: 2 instead of 1"}));
    // A name that is in both lists stands for the same one, whatever its number.
    EXPECT_EQ(told([](Json& list) {
                  list["participants"] = {"B", "X"};
                  erase(list, "disks", 0), erase(list, "disks", 0), erase(list, "boxes", 0);
                  list["disks"][0]["participant"] = 0, list["boxes"][0]["participant"] = 0;
              }),
              (Words{"the participant 'A' is missing", "the participant 'X' is not in the golden",
                     "the disk of A, sample 2 is missing", "the disk of A, sample 3 is missing",
                     "the box of A, node 3 is missing"}));
    Json more = small_list();
    more["participants"] = {"X", "B", "C"};
    EXPECT_EQ(differences(more, small_list()).front(), "the participant 'A' is missing");
}

TEST(DrawListCompare, NumbersAgreeWithinTheirLastDigits) {
    const auto line = [](double actual, double golden) {
        return differences(Json{{"a", actual}}, Json{{"a", golden}}).size();
    };
    for (const int sign : {-1, 1}) {
        // Two units of the sixth digit, and less than 1e-4 of what is small.
        EXPECT_EQ(line(sign * 1000.02, sign * 1000.0), 0u);
        EXPECT_EQ(line(sign * 1000.021, sign * 1000.0), 1u);
        EXPECT_EQ(line(sign * 30.0005, sign * 30.0), 0u);
        EXPECT_EQ(line(sign * 30.001, sign * 30.0), 1u);
        EXPECT_EQ(line(sign * 2.00009, sign * 2.0), 0u);
        EXPECT_EQ(line(sign * 2.00011, sign * 2.0), 1u);
    }
}

TEST(DrawListCompare, IdsCountWhereNoObjectIsMissing) {
    EXPECT_EQ(told([](Json& list) { list["disks"][1]["id"] = 9; }), Words{"disk of A, sample 3, id: 9 instead of 2"});
    EXPECT_EQ(told([](Json& list) { list["disks"][1]["id"] = 9, erase(list, "disks", 0); }),
              Words{"the disk of A, sample 2 is missing"});
}

TEST(DrawListCompare, WhatFollowsFromTheCameraIsToldAlone) {
    const auto turn = [](Json& list) {
        list["camera"] = parsed(R"({"eye": [1, 5, 6], "right": [0, 1, 0],
                                                                   "clip_from_world": [2, 2, 0, 0]})");
    };
    EXPECT_EQ(told(turn), Words{"camera, eye: y 5 instead of 2 (also right)"});
    EXPECT_EQ(told([](Json& list) { list["camera"]["clip_from_world"][0] = 2; }),
              Words{"camera, clip_from_world: 2 instead of 1"});
    EXPECT_EQ(told([](Json& list) { list["camera"]["clip_from_world"][0] = 2, erase(list, "disks", 0); }),
              Words{"the disk of A, sample 2 is missing"});
}

TEST(DrawListCompare, DisksAndBoxesComeFirstAndManyAreCounted) {
    const auto change = [](Json& list) {
        list["disks"][0]["radius"] = 2;
        list["boxes"][0]["fill"] = "#9";
        list["marks"][0]["fill"] = "#9";
        erase(list, "texts", 3);
    };
    EXPECT_EQ(told(change, {.other_fonts = false, .most = 2}),
              (Words{"disk of A, sample 2, radius: 2 instead of 1", "box of A, node 3, fill: '#9' instead of '#0'",
                     "and 2 more"}));
    Json list = small_list();
    change(list);
    const DrawListComparison all = compared(list.dump(), small_list().dump(), {.other_fonts = false, .most = 2});
    EXPECT_EQ(all.count, 4u);
    EXPECT_FALSE(all.same());
}

TEST(DrawListCompare, OneThatIsGoneMakesNoOtherDiffer) {
    const PictureOptions options{.size = testing::kGoldenSize, .controls = true};
    const DrawList list = build_draw_list(testing::hit_scene(), {}, options);
    const Json golden = parsed(testing::text_of(list));
    for (const char* key : {"disks", "boxes", "lines", "legend", "overlays", "panels", "overlay_lines", "texts"}) {
        const int count = static_cast<int>(golden[key].size());
        ASSERT_GT(count, 0) << key;
        for (const int at : {0, count / 2, count - 1}) {
            Json less = golden;
            erase(less, key, at);
            EXPECT_EQ(differences(less, golden).size(), 1u) << key << ' ' << at;
            EXPECT_EQ(differences(golden, less).size(), 1u) << key << ' ' << at;
        }
    }
    // A block of them, one in another place and one in its stead.
    Json less = golden;
    ASSERT_GT(less["lines"].size(), 60u);
    less["lines"].erase(less["lines"].begin() + 5, less["lines"].begin() + 45);
    less["lines"][10]["width"] = 9;
    const DrawListComparison told = compared(less.dump(), golden.dump(), {.other_fonts = false, .most = 100});
    ASSERT_EQ(told.differences.size(), 41u);
    EXPECT_EQ(told.differences.front().substr(0, 11), "the line 6 ");
    EXPECT_EQ(told.differences.back().substr(0, 8), "line 51 ");
}

TEST(DrawListCompare, LinesThatDifferInTheirLastFigureAreStillFound) {
    const DrawList list = build_draw_list(testing::hit_scene(), {}, testing::kGoldenSize);
    const Json golden = parsed(testing::text_of(list));
    Json shaken = golden;
    for (const char* key : {"lines", "disks", "boxes"}) {
        for (Json& element : shaken[key]) {
            for (const char* place : {"from", "to", "base", "center"}) {
                if (element.contains(place)) element[place][0] = 1.00001 * element[place][0].get<double>() + 2e-5;
            }
        }
    }
    EXPECT_EQ(differences(shaken, golden), Words{});
    shaken["lines"].erase(shaken["lines"].begin() + 3, shaken["lines"].begin() + 43);
    EXPECT_EQ(compared(shaken.dump(), golden.dump()).count, 40u);
}

TEST(DrawListCompare, AGoldenWithoutRolesAgrees) {
    Json old = small_list();
    for (Json& text : old["texts"]) text.erase("role");
    EXPECT_EQ(differences(small_list(), old), Words{});
    Json list = small_list();
    erase(list, "texts", 3);
    list["texts"][0]["color"] = "#0";
    EXPECT_EQ(differences(list, old),
              (Words{"the text '20 s' is missing", "text 'level 1', color: '#0' instead of '#9'"}));
}

TEST(DrawListCompare, PixelsAreOnlyTold) {
    Json list = small_list();
    list["disks"][1]["pixels"] = 120;
    list["disks"][2]["pixels"] = 1;
    list["disks"][0]["pixels"] = 216;
    const DrawListComparison result = compared(list.dump(), small_list().dump());
    EXPECT_TRUE(result.same());
    EXPECT_EQ(result.differences, Words{});
    EXPECT_EQ(result.pixels,
              (Words{"disk of A, sample 3: 120 pixels instead of 200", "disk of B, sample 3: 1 pixel instead of 200"}));
    Json large = small_list(), larger = small_list();
    large["disks"][0]["pixels"] = 10000;
    for (const auto& [pixels, lines] : {std::pair(10090, 0u), std::pair(10200, 1u)}) {
        larger["disks"][0]["pixels"] = pixels;
        EXPECT_EQ(compared(larger.dump(), large.dump()).pixels.size(), lines) << pixels;
    }
    EXPECT_EQ(differences(parsed(R"({"pixels": 16})"), parsed(R"({"pixels": 0})")), Words{"/pixels: 16 instead of 0"})
        << "elsewhere it is a number like others";
}

TEST(DrawListCompare, SeveralPicturesAreCounted) {
    Json list = small_list();
    erase(list, "texts", 3);
    list["disks"][0]["pixels"] = 0;
    const Json golden = {small_list(), small_list()};
    EXPECT_EQ(differences({small_list(), list}, golden), Words{"picture 2, the tick label '20 s' is missing"});
    EXPECT_EQ(compared(Json{small_list(), list}.dump(), golden.dump()).pixels,
              Words{"picture 2, disk of A, sample 2: 0 pixels instead of 200"});
    EXPECT_EQ(differences(Json::array({small_list()}), golden), Words{"picture 2 is missing"});
    EXPECT_EQ(differences(golden, Json::array({small_list()})), Words{"picture 2 is not in the golden"});
    EXPECT_FALSE(differences(golden, small_list()).empty());
}

TEST(DrawListCompare, OfOtherFontsWordsMayStandElsewhere) {
    const DrawListTerms other{.other_fonts = true, .most = 12};
    const auto shift = [](Json& list, double by) {
        list["texts"][3]["at"][0] = 20 + by;
        list["texts"][3]["on_screen"] = false;
        list["overlays"][0]["max"][0] = 100 + by;
        list["panels"][0]["max"][0] = 100 + by;
        list["marks"][0]["min"][1] = 40 + by;
        list["overlay_lines"][0]["from"][0] = 510 + by;
    };
    EXPECT_EQ(told([&](Json& list) { shift(list, 25); }, other), Words{});
    EXPECT_EQ(told([&](Json& list) { shift(list, 26); }, other).size(), 5u) << "4 % of 640 are 25.6";
    EXPECT_EQ(told([&](Json& list) { shift(list, 25); }).size(), 5u);
    // Of two that read the same the nearer one is meant.
    EXPECT_EQ(told([](Json& list) { erase(list, "texts", 4), list["texts"][4]["at"][0] = 260; }, other),
              Words{"the tick label '0' is missing"});
    // An older list does not say which words are its caption.
    Json captioned = small_list(), old = small_list();
    captioned["texts"].push_back({{"text", "A"}, {"role", "caption"}, {"at", {30, 20}}, {"size", 12}});
    old["texts"].push_back({{"text", "A"}, {"at", {30, 20}}, {"size", 12}});
    for (Json& text : old["texts"]) text.erase("role");
    EXPECT_EQ(differences(captioned, old, other), Words{});
    const std::vector<std::function<void(Json&)>> seen{
        [](Json& list) { list["texts"][3]["color"] = "#0"; },
        [](Json& list) { list["texts"][3]["text"] = "25 s"; },
        [](Json& list) { erase(list, "texts", 3); },
        [](Json& list) { erase(list, "panels", 0); },
        [](Json& list) { erase(list, "marks", 0); },
        [](Json& list) { list["marks"][0]["fill"] = "#0"; },
        [](Json& list) { list["disks"][0]["base"][0] = 0.01; },
        [](Json& list) { list["boxes"][0]["extents"][0][0] = 1.01; },
        [](Json& list) { list["lines"][0]["from"][0] = 0.01; },
        [](Json& list) { list["camera"]["eye"][0] = 1.01; },
        [](Json& list) { list["legend"][0]["text"] = "level 3"; },
        [](Json& list) { list["headline"] = "A misses B"; },
    };
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(told(seen[i], other).size(), 1u) << i;
}

TEST(DrawListCompare, OfOtherFontsALabelMayFindNoRoom) {
    const DrawListTerms other{.other_fonts = true, .most = 12};
    // Beside another label, under a panel and at the edge there may be no room; elsewhere there is.
    for (const auto& [x, y, told] : {std::tuple(200, 108, false), std::tuple(104, 325, false),
                                     std::tuple(636, 200, false), std::tuple(400, 200, true)}) {
        Json golden = small_list();
        golden["texts"].push_back({{"text", "40 s"}, {"role", "tick"}, {"at", {x, y}}, {"size", 9}});
        const Words line = told ? Words{"the tick label '40 s' is missing"} : Words{};
        EXPECT_EQ(differences(small_list(), golden, other), line) << x << ' ' << y;
        EXPECT_EQ(differences(small_list(), golden), Words{"the tick label '40 s' is missing"});
    }
}

TEST(DrawListCompare, OfOtherFontsWordsMayBeCutOrBreakElsewhere) {
    const DrawListTerms other{.other_fonts = true, .most = 12};
    const auto captioned = [](const Words& lines, int bottom) {
        Json list = small_list();
        list["headline"] = "A meets B at last";
        list["overlays"].push_back({{"name", "caption"}, {"min", {10, 10}}, {"max", {200, bottom}}});
        int y = 20;
        for (const std::string& line : lines) {
            list["texts"].push_back({{"text", line}, {"role", "caption"}, {"at", {20, y += 15}}, {"size", 12}});
        }
        return list;
    };
    const Json golden = captioned({"A meets B", "at last", "leaf 10, 3 tests"}, 80);
    EXPECT_EQ(differences(captioned({"A meets B at last", "leaf 10, 3 tests"}, 65), golden, other), Words{});
    EXPECT_EQ(differences(captioned({"A meets", "B at last", "leaf 10, 3 te…"}, 80), golden, other), Words{});
    EXPECT_EQ(differences(captioned({"meets B", "last", "leaf 10, 3 tests"}, 80), golden, other), Words{});
    for (const Words& wrong :
         {Words{"A meets B", "at last", "leaf 11, 3 tests"}, Words{"A meets C", "at last", "leaf 10, 3 tests"},
          Words{"A meets B", "leaf 10, 3 tests"}, Words{}}) {
        EXPECT_EQ(differences(captioned(wrong, 80), golden, other).size(), 1u);
    }
    Json cut = small_list();
    cut["texts"][1]["text"] = "lev…2";
    EXPECT_EQ(differences(cut, small_list(), other), Words{});
    cut["texts"][1]["text"] = "lev…3";
    EXPECT_EQ(differences(cut, small_list(), other).size(), 1u);
    // A panel without room shows its header instead of what is in it.
    Json folded = small_list();
    folded["overlays"][0] = {
        {"name", "legend"}, {"min", {10, 330}}, {"max", {100, 350}}, {"folded", true}, {"no_room", true}};
    folded["panels"][0]["min"] = {10, 330};
    erase(folded, "texts", 0);
    folded["texts"][0] = {{"text", "no room"}, {"role", "header"}, {"at", {30, 345}}, {"size", 11}};
    EXPECT_EQ(differences(folded, small_list(), other), Words{});
    EXPECT_GT(differences(folded, small_list()).size(), 2u);
}

TEST(DrawListCompare, OfOtherJsonThePlaceIsNamed) {
    const auto check = [](const std::string& actual, const std::string& golden, const Words& lines) {
        EXPECT_EQ(differences(parsed(actual), parsed(golden)), lines) << actual;
    };
    check(R"({"view": {"levels": 2}})", R"({"view": {"levels": 3}})", {"/view/levels: 2 instead of 3"});
    check(R"({"a": 1})", R"({"a": 1, "b/c": 2})", {"/b~1c is missing: 2"});
    check(R"({"a": 1, "b": [1, "x"]})", R"({"a": 1})", {"/b is not in the golden: [1, 'x']"});
    check(R"({"a": 0.0002})", R"({"a": 0})", {"/a: 0.0002 instead of 0"});
    check(R"({"a": 10001, "b": 10000.19})", R"({"a": 10000, "b": 10000})", {"/a: 10001 instead of 10000"});
    check(R"({"a": -1})", R"({"a": 1})", {"/a: -1 instead of 1"});
    check(R"({"a": false})", R"({"a": true})", {"/a: false instead of true"});
    check(R"({"a": null})", R"({"a": 1})", {"/a: null instead of 1"});
    check(R"({"a": {}})", R"({"a": []})", {"/a: {} instead of []"});
    check(R"({"a": [1, 3, 5]})", R"({"a": [1, 2, 3]})", {"/a/1: 3 instead of 2"});
    check("[[1, 2]]", "[[1]]", {"/0/1 is not in the golden: 2"});
    check("1", "2", {"the whole: 1 instead of 2"});
    check(R"(["a", "c"])", R"(["a", "b", "c"])", {"/1 is missing: 'b'"});
    check(R"(["a", "x", "c"])", R"(["a", "b", "c"])", {"/1: 'x' instead of 'b'"});
    check(R"(["b", "a", "c"])", R"(["a", "b", "c"])", {"/1 comes before /0: 'b' before 'a'"});
    check(R"({"messages": [{"level": "info", "text": "b"}]})",
          R"({"messages": [{"level": "info", "text": "a"}, {"level": "info", "text": "b"}]})",
          {"/messages/0 is missing: {level: 'info', text: 'a'}"});
    check(R"({"messages": [{"level": "info", "text": "c"}]})", R"({"messages": [{"level": "info", "text": "a"}]})",
          {"/messages/0/text: 'c' instead of 'a'"});
    const std::string same(500, 'x');
    EXPECT_EQ(differences(Json{same + "a"}, Json{same + "b"}).size(), 1u) << "beyond what a message quotes";
    const Words lines = differences(parsed(R"({"a": 1})"), Json{{"a", 1}, {"b", std::vector<int>(9000, 7)}});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_LT(lines[0].size(), 100u);
}

TEST(DrawListCompare, OddListsAreCompared) {
    EXPECT_EQ(differences(parsed(R"({"boxes": [1, {"extents": [[1, 2], [1.02]]}]})"),
                          parsed(R"({"boxes": [1, {"extents": [[1, 2], [1]]}]})")),
              (Words{"the box 2 is missing", "the box 2 is not in the golden"}));
    EXPECT_EQ(differences(parsed(R"({"disks": 1})"), parsed(R"({"disks": [1]})")).size(), 1u);
    EXPECT_EQ(differences(parsed(R"({"disks": [{"participant": 7, "sample": 1}]})"),
                          parsed(R"({"disks": [{"participant": -1, "sample": 1}], "participants": [3]})"))
                  .empty(),
              false);
    EXPECT_EQ(differences(parsed("[1]"), parsed(R"([{"disks": []}])")), Words{"picture 1: 1 instead of {disks: []}"});
    EXPECT_EQ(differences(parsed(R"({"texts": [5, "x"]})"), parsed(R"({"texts": [5, {}]})")).empty(), false);
}

TEST(DrawListCompare, WhatIsNoJsonIsNamed) {
    EXPECT_NE(testing::input_error([] { compared("{", "{}"); }).find("actual.json"), std::string::npos);
    EXPECT_NE(testing::input_error([] { compared("{}", "{]"); }).find("golden.json"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
