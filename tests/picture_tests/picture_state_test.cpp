// What is told of two states: the cause of a difference, and each part of what is drawn.
#include <base/error.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/picture_state.h>
#include <picture_tests/test_case.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

using Lines = std::vector<std::string>;

class PictureStateTest : public ::testing::Test {
  protected:
    Shot shot(const std::string& more = "") const {
        const std::string keys = R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x360")";
        return read_case(cases.write("a", keys + (more.empty() ? "" : ", " + more) + "}").file).shot;
    }
    static std::string state(const Shot& of) { return picture_state(of, panel_lists(of)); }
    /// In the scene the first `from` becomes `to`.
    std::string with(const std::string& from, const std::string& to) const {
        std::string scene = mobbscope::testing::kSmallScene;
        const std::size_t at = scene.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        cases.folder().write("scene.json", scene.replace(at, from.size(), to));
        return state(shot());
    }
    static Lines told(const std::string& actual, const std::string& golden) {
        return compare_states(actual, golden, "a.state.json").lines;
    }
    /// What is told where what is drawn is changed.
    Lines told_of(const std::function<void(DrawList&)>& change, const std::string& more = "") const {
        const Shot of = shot(more);
        std::vector<DrawList> lists = panel_lists(of);
        const std::string golden = picture_state(of, lists);
        change(lists.front());
        return told(picture_state(of, lists), golden);
    }

    const CaseFolder cases;
};

TEST_F(PictureStateTest, IsTheSameOfTheSame) { EXPECT_EQ(told(state(shot()), state(shot())), Lines{}); }

TEST_F(PictureStateTest, ACauseIsToldAloneAndInWords) {
    const std::string golden = state(shot());
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& line) {
        EXPECT_EQ(told(with(from, to), golden), Lines{line}) << from;
    };
    expect("[1, -1]", "[1.1, -1]", "B moved by (0.1, 0)");
    expect("[1, -1]", "[1.001, -1]", "B moved by (0.001, 0)");
    expect("\"rotate_deg\": 90", "\"rotate_deg\": 93", "B turned by 3 degrees");
    expect("\"start\": 0.5", "\"start\": 0.25", "B's start moved by -0.25 s");
    expect("\"levels\": 1", "\"levels\": 1, \"theme\": \"light\"", "theme light was dark");
    expect("\"levels\": 1", "\"levels\": 1, \"floor\": false", "floor false was true");
}

TEST_F(PictureStateTest, WordsThatFollowStandBehindTheCause) {
    const std::string golden = state(shot());
    const Lines deeper = told(with("\"levels\": 1", "\"levels\": 2"), golden);
    ASSERT_EQ(deeper.size(), 3u);
    EXPECT_EQ(deeper[0], "level 2 was 1");
    EXPECT_EQ(deeper[1].find("caption 'MOBB, leaf 2  ·  level 2, "), 0u) << deeper[1];
    EXPECT_EQ(deeper[2], "legend 'level 2' was 'level 1'");
    EXPECT_EQ(told(with("\"levels\": 1", "\"levels\": \"leaves\""), golden).front(), "level leaves was 1");
}

TEST_F(PictureStateTest, OfAnotherClipOrFitItIsSaid) {
    const std::string golden = state(shot());
    const Lines clip = told(with("0.45]", "0.46]"), golden);
    ASSERT_GE(clip.size(), 2u);
    EXPECT_EQ(Lines(clip.begin(), clip.begin() + 2), (Lines{"A's clip is another", "B's clip is another"}));
    EXPECT_EQ(told(with("\"leaf\": 2", "\"leaf\": 4"), golden).front(), "the fit is another: leaf 4 was 2");
    const Lines renamed = told(with("\"name\": \"B\"", "\"name\": \"C\""), golden);
    ASSERT_GE(renamed.size(), 2u);
    EXPECT_EQ(renamed[0], "B is missing");
    EXPECT_EQ(renamed[1], "C is new");
}

TEST_F(PictureStateTest, AnotherStepSaysWhichItWas) {
    const std::string golden = state(shot(R"("view": {"query": 0, "step": 2})"));
    const Lines lines = told(state(shot(R"("view": {"query": 0, "step": 3})")), golden);
    ASSERT_GE(lines.size(), 2u);
    EXPECT_EQ(lines[0], "step 3 was 2");
    EXPECT_EQ(lines[1].find("sentence step 3 of 0.."), 0u) << lines[1];
}

TEST_F(PictureStateTest, WordsAreToldByTheirRole) {
    const auto tick = [](DrawList& list) -> TextRun& {
        return *std::ranges::find(list.texts, TextRole::tick, &TextRun::role);
    };
    std::string before;
    const Lines other = told_of([&](DrawList& list) {
        before = tick(list).text;
        tick(list).text = "7 parsecs";
    });
    EXPECT_EQ(other, Lines{"tick '7 parsecs' was '" + before + "'"});
    const Lines missing = told_of([&](DrawList& list) { list.texts.erase(list.texts.begin()); });
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_NE(missing[0].find("is missing"), std::string::npos) << missing[0];
}

TEST_F(PictureStateTest, EachPartOfWhatIsDrawnIsHeld) {
    const auto is_floor = [](const LineInstance& line) {
        return line.order.layer == DrawLayer::surroundings && line.order.level == 0;
    };
    EXPECT_EQ(told_of([&](DrawList& list) {
                  LineInstance& line = *std::ranges::find_if(list.lines, is_floor);
                  line.to = 0.95f * line.to + 0.05f * line.from;
              }),
              Lines{"lines of the floor and the axes: other places"});
    EXPECT_EQ(told_of([](DrawList& list) { list.boxes.front().fill.a *= 1.1f; }),
              Lines{"boxes of A, level 1: other colours"});
    EXPECT_EQ(told_of([](DrawList& list) { list.boxes.front().width *= 1.2f; }),
              Lines{"boxes of A, level 1: other sizes"});
    EXPECT_EQ(told_of([](DrawList& list) { list.disks.edit().pop_back(); }), Lines{"disks of B: 7, was 8"});
    EXPECT_EQ(told_of([](DrawList& list) { list.texts.back().baseline.x += 1; }).size(), 1u);
    const Lines over = told_of([](DrawList& list) { list.overlay_lines.pop_back(); });
    ASSERT_EQ(over.size(), 1u);
    EXPECT_EQ(over[0].find("lines over the scene: "), 0u) << over[0];
    EXPECT_EQ(told_of([](DrawList& list) { list.background = Rgba(1, 0, 0, 1); }), Lines{"background: other colours"});
}

TEST_F(PictureStateTest, TheOrderOfDrawingIsHeld) {
    const auto swap_levels = [](DrawList& list) {
        for (BoxInstance& box : list.boxes) box.order.level = 1 - box.order.level;
    };
    EXPECT_FALSE(told_of(swap_levels, R"("view": {"levels": "0:1"})").empty());
    const auto swap_lines = [](DrawList& list) { std::swap(list.lines[0].order, list.lines[3].order); };
    EXPECT_EQ(told_of(swap_lines), Lines{"lines of the floor and the axes: another order"});
    // The order of the list itself is none.
    EXPECT_EQ(told_of([](DrawList& list) { std::ranges::reverse(list.lines); }), Lines{});
}

TEST_F(PictureStateTest, ThePanelIsNamedWhereThereAreSeveral) {
    const std::string golden = state(shot(R"("panels": [{"view": {"levels": 0}}, {"view": {"levels": 1}}])"));
    const Lines lines = told(state(shot(R"("panels": [{"view": {"levels": 0}}, {"view": {"levels": 2}}])")), golden);
    EXPECT_EQ(lines.front(), "panel 1, level 2 was 1");
}

TEST_F(PictureStateTest, LastDigitsOfNumbersAreNotHeld) {
    EXPECT_EQ(told_of([](DrawList& list) {
                  for (BoxInstance& box : list.boxes) box.center *= 1 + 1e-6f;
                  for (TextRun& text : list.texts) text.baseline *= 1 + 1e-6f;
              }),
              Lines{});
    EXPECT_EQ(told(with("[1, -1]", "[1.000000000001, -1]"), with("[1, -1]", "[1, -1]")), Lines{});
}

TEST_F(PictureStateTest, OfAWindowItHasTheVersionThatDrewItsWords) {
    const std::string golden = R"({"mobbscope_state": 1, "imgui": "0.1", "panels": [{"scene": {"agents": [
        {"name": "B", "translate": [1, 2]}]}, "view": {}, "dialog": "none", "selection": {"kind": "node"}}]})";
    const std::string actual = window_state(R"({"scene": {"agents": [{"name": "B", "translate": [1, 2.5]}]},
        "view": {"levels": "3"}, "dialog": "help", "selection": {"kind": "none"}})");
    const StateDifferences found = compare_states(actual, golden, "w.state.json");
    EXPECT_EQ(found.lines,
              (Lines{"B moved by (0, 0.5)", "level 3 was 2", "dialog help was none", "selection kind none was node"}));
    EXPECT_NE(found.other_imgui.find(" for 0.1"), std::string::npos);
}

TEST_F(PictureStateTest, WhatIsNoStateIsRefused) {
    const std::string now = state(shot());
    for (const char* text : {"", "[]", "{}", R"({"mobbscope_state": 2, "panels": []})"}) {
        EXPECT_THROW(compare_states(now, text, "a.state.json"), InputError) << text;
    }
    EXPECT_FALSE(told(now, R"({"mobbscope_state": 1})").empty());
}

}  // namespace
}  // namespace mobbscope::picture_tests
