// Names of a list on little room: what differs stays.
#include <base/name_list.h>
#include <base/text.h>

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// As if all letters were equally wide.
TextFits at_most(std::size_t letters) {
    return [letters](const std::string& text) { return code_points(text).size() <= letters; };
}

const std::vector<std::string> kRecordings{"cmu_07_05_30hz", "cmu_07_06_30hz", "cmu_08_05_30hz", "cmu_13_17_30hz"};

TEST(NameList, WhatFitsIsWhole) {
    const NameList names(kRecordings);
    EXPECT_EQ(names.shortened("cmu_07_05_30hz", at_most(14)), "cmu_07_05_30hz");
}

TEST(NameList, WhatAllHaveInCommonGoesFirst) {
    const NameList names(kRecordings);
    EXPECT_EQ(names.shortened("cmu_07_05_30hz", at_most(13)), "cmu_07_05\u20260hz");
    EXPECT_EQ(names.shortened("cmu_07_05_30hz", at_most(10)), "cmu_07_05\u2026");
    EXPECT_EQ(names.shortened("cmu_07_05_30hz", at_most(8)), "c\u202607_05\u2026");
    const NameList sessions({"cmu_walk_07_05_30hz", "cmu_walk_07_06_30hz"});
    EXPECT_EQ(sessions.shortened("cmu_walk_07_05_30hz", at_most(16)), "cmu_walk\u202605_30hz");
    EXPECT_EQ(sessions.shortened("cmu_walk_07_05_30hz", at_most(8)), "\u202605_30hz");
    EXPECT_EQ(sessions.shortened("cmu_walk_07_05_30hz", at_most(6)), "\u202605\u2026hz");
    EXPECT_EQ(sessions.shortened("cmu_walk_07_05_30hz", at_most(4)), "\u202605\u2026");
}

TEST(NameList, NumbersAndWordsStayWhole) {
    const NameList people({"person_102", "person_103"});
    EXPECT_EQ(people.shortened("person_103", at_most(6)), "pe\u2026103");
    const NameList turns({"walk_slow_left_turn", "walk_slow_light_turn"});
    EXPECT_EQ(turns.shortened("walk_slow_left_turn", at_most(11)), "w\u2026left_turn");
}

TEST(NameList, ThatNothingElseBeginsLikeItIsCutInItsMiddle) {
    const NameList names({"the long way round", "cmu_07_05_30hz", "cmu_07_06_30hz"});
    EXPECT_EQ(names.shortened("the long way round", at_most(9)), shortened("the long way round", 9));
    EXPECT_EQ(names.shortened("cmu_07_06_30hz", at_most(8)), "\u202606_30hz") << "whatever else is in the list";
    EXPECT_EQ(names.shortened("is not in the list", at_most(9)), shortened("is not in the list", 9));
}

TEST(NameList, EqualNamesAreCutInTheirMiddle) {
    const NameList names(std::vector<std::string>(3, "a walk of three metres"));
    EXPECT_EQ(names.shortened("a walk of three metres", at_most(9)), shortened("a walk of three metres", 9));
    const NameList nested({"a walk of three metres", "a walk of three metres 2"});
    EXPECT_EQ(nested.shortened("a walk of three metres 2", at_most(9)), "a walk\u2026 2");
}

TEST(NameList, WhatTellsItFromOthersStaysLongest) {
    const NameList names({"cmu_01_02_playground-climb_amc30hz", "cmu_01_03_playground_mbfriendly_120hz",
                          "cmu_01_05_playground-climb-under_amc30hz", "cmu_02_07_swordplay_30hz"});
    EXPECT_EQ(names.shortened("cmu_01_02_playground-climb_amc30hz", at_most(14)),
              "cmu_01_02\u2026"
              "30hz");
    EXPECT_EQ(names.shortened("cmu_01_02_playground-climb_amc30hz", at_most(10)), "cmu_01_02\u2026");
    EXPECT_EQ(names.shortened("cmu_01_03_playground_mbfriendly_120hz", at_most(7)), "\u202601_03\u2026");
    EXPECT_EQ(names.shortened("cmu_02_07_swordplay_30hz", at_most(5)), "c\u202602\u2026");
}

TEST(NameList, VeryLittleRoomTakesTheMiddleOfWhatDiffers) {
    const NameList names({"cmu_0705slow_30hz", "cmu_1317fast_30hz"});
    EXPECT_EQ(names.shortened("cmu_0705slow_30hz", at_most(5)), "0705");
    EXPECT_EQ(names.shortened("cmu_0705slow_30hz", at_most(1)), "0705") << "never nothing";
}

TEST(NameList, LettersOfUtf8StayWhole) {
    const NameList names(
        {"H\u00e4user-\u00dcberg\u00e4nge-\u00e9t\u00e9-01", "H\u00e4user-\u00dcberg\u00e4nge-\u00e8re-01"});
    for (std::size_t room = 1; room < 30; ++room) {
        const std::string text = names.shortened("H\u00e4user-\u00dcberg\u00e4nge-\u00e9t\u00e9-01", at_most(room));
        EXPECT_TRUE(is_utf8(text)) << room;
        if (room >= 5) {
            EXPECT_NE(text.find("\u00e9t\u00e9"), std::string::npos) << room;
            EXPECT_LE(code_points(text).size(), room);
        }
    }
    const NameList runners({"\U0001F3C3\U0001F3C3\U0001F3C3 links", "\U0001F3C3\U0001F3C3\U0001F3C3 rechts"});
    EXPECT_EQ(runners.shortened("\U0001F3C3\U0001F3C3\U0001F3C3 links", at_most(7)), "\U0001F3C3\u2026links");
}

TEST(NameList, ALongListIsToldApart) {
    const auto name_of = [](std::size_t i) {
        return formatted("recording_of_tuesday_%02d_%02d_fixed.bvh", static_cast<int>(i / 40),
                         static_cast<int>(i % 40));
    };
    const NameList names(1600, name_of);
    std::set<std::string> seen;
    for (std::size_t i = 0; i < 1600; ++i) seen.insert(names.shortened(name_of(i), at_most(9)));
    EXPECT_EQ(seen.size(), 1600u);
}

}  // namespace
}  // namespace mobbscope
