// TrajNet++ and plans of multi-agent path finding.
#include <import/tracks/tracks.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

const std::string kTrajnetpp = R"({"scene": {"id": 0, "p": 1, "s": 1, "e": 21, "fps": 2.0, "tag": [1, []]}}
{"track": {"f": 1, "p": 1, "x": -0.5, "y": 2}}
{"track": {"f": 11, "p": 1, "x": 0.5, "y": 2}}
{"track": {"f": 11, "p": "late", "x": 0, "y": 0}}
{"track": {"f": 21, "p": "late", "x": 0, "y": 1}}
{"track": {"f": 31, "p": "late", "x": 9, "y": 9, "prediction_number": 0, "scene_id": 0}}
)";
const std::string kPlan =
    "cost: 9\nschedule:\n  agent0:\n  - t: 0\n    x: 0\n    y: 0\n  - t: 1\n    x: 1\n    y: 0\n  agent1:\n"
    "  - {t: 2, x: 5, y: 5}\n  - {t: 3, x: 5, y: 4}\n";

std::vector<ImportedClip> trajnetpp(const std::string& text, const ImportOptions& options = {}) {
    return track_clips(parse_trajnetpp(text, "f.ndjson"), "f.ndjson", options);
}

std::vector<ImportedClip> plan(const std::string& text, const ImportOptions& options = {}) {
    return track_clips(parse_mapf_plan(text, "f.yaml"), "f.yaml", options);
}

TEST(Trajnetpp, TracksAreReadAndScenesGiveTheRate) {
    const auto read = trajnetpp(kTrajnetpp);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "trajnetpp");
    EXPECT_EQ(read[0].clip->dt(), 0.5);
    EXPECT_EQ(read[0].clip->samples()[0].x, -0.5);
    EXPECT_EQ(read[1].name, "late");
    EXPECT_EQ(read[1].start, 0.5);
    EXPECT_EQ(read[1].clip->count(), 2);
    EXPECT_EQ(read[0].facts.warnings.size(), 2u) << "the prediction, the radius";
}

TEST(Trajnetpp, WithoutASceneTheUsualRateIsAssumed) {
    const auto read = trajnetpp(R"({"track": {"f": 1, "p": 1, "x": 0, "y": 0}})"
                                "\n"
                                R"({"track": {"f": 11, "p": 1, "x": 0, "y": 0}})");
    EXPECT_EQ(read[0].clip->dt(), 0.4);
    EXPECT_NE(read[0].facts.warnings.at(0).text.find("2.5 points a second are assumed"), std::string::npos);
}

TEST(Trajnetpp, BadLinesAreNamed) {
    const std::string first = R"({"track": {"f": 1, "p": 1, "x": 0, "y": 0}})"
                              "\n";
    const struct {
        std::string text, message;
    } cases[] = {
        {"", "line 0: the file has no track"},
        {R"({"track": {"f": 1, "p": 1, "x": 0, "y": 0, "prediction_number": 0}})",
         "holds predictions of TrajNet++ alone, 1 point: give the file with the recorded tracks"},
        {first + "{", "line 2: is not JSON"},
        {first + "[1]", "line 2: is neither"},
        {first + R"({"track": 3})", "line 2: 'track' must be an object"},
        {first + R"({"track": {"f": 2, "p": 1, "x": 0}})", "line 2: there is no y"},
        {first + R"({"track": {"f": 2.5, "p": 1, "x": 0, "y": 0}})", "line 2: f is not a whole number"},
        {first + R"({"track": {"f": 2, "p": 1, "x": "0", "y": 0}})", "line 2: x must be a number"},
        {first + R"({"track": {"f": 2, "p": 1, "x": 1e10, "y": 0}})", "line 2: x is beyond"},
        {first + R"({"track": {"f": 1, "p": 1, "x": 1, "y": 0}})", "line 2: '1' is in frame 1 already in line 1"},
        {R"({"scene": {"fps": 2.5}})"
         "\n"
         R"({"scene": {"fps": 5}})",
         "line 2: the scene has 5 points a second"},
        {R"({"scene": {"fps": 0}})", "line 1: fps must be over 0"},
    };
    for (const auto& bad : cases) {
        const std::string said = input_error([&] { trajnetpp(bad.text); });
        EXPECT_NE(said.find(bad.message), std::string::npos) << bad.message << "\n" << said;
    }
}

TEST(MapfPlan, AgentsAreReadByName) {
    const auto read = plan(kPlan);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "mapf");
    EXPECT_EQ(read[0].name, "agent0");
    EXPECT_EQ(read[0].clip->dt(), 1);
    EXPECT_EQ(read[0].clip->samples()[1].x, 1);
    EXPECT_EQ(read[1].start, 0);
    EXPECT_EQ(read[1].clip->samples()[3].y, 4);
    EXPECT_EQ(read[0].facts.warnings.size(), 3u) << "second, metre, radius";
    ImportOptions options;
    options.unit = "0.5";
    options.dt = 0.25;
    options.radius = 0.1;
    const auto told = plan(kPlan, options);
    EXPECT_TRUE(told[0].facts.warnings.empty());
    EXPECT_EQ(told[1].clip->dt(), 0.25);
    EXPECT_EQ(told[1].clip->samples()[3].y, 2);
}

TEST(MapfPlan, HeightsAreFloors) {
    const auto read = plan(
        "schedule:\n  a:\n  - {t: 0, x: 0, y: 0, z: 1}\n  - {t: 1, x: 1, y: 0, z: 1}\n"
        "  b:\n  - {t: 0, x: 1, y: 0, z: 2}\n  - {t: 1, x: 1, y: 0, z: 1}\n");
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(read[0].floor, "z 1");
    EXPECT_EQ(read[1].floor, "z 2");
    EXPECT_EQ(read[2].id, "b#2");
    EXPECT_EQ(read[2].floor, "z 1");
    EXPECT_EQ(read[2].start, 0) << "on its way down it is on both";
    EXPECT_EQ(plan(kPlan)[0].floor, "");
}

TEST(MapfPlan, WhatStandsBeforeItsDocumentIsNone) {
    for (const std::string before :
         {"---\n", "\xef\xbb\xbf# by a solver\n---\n", "%YAML 1.2\n--- # plan\n", "  # a\n\n  \n---\n"}) {
        EXPECT_EQ(plan(before + kPlan).size(), plan(kPlan).size()) << before;
    }
}

/// Where the agents are: "a (0,0) (1,0); ".
std::string cells_in(const std::string& text) {
    std::string out;
    for (const ImportedClip& clip : plan(text)) {
        out += clip.id;
        for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
        out += "; ";
    }
    return out;
}

TEST(MapfPlan, IsReadInEveryStyleOfYaml) {
    const std::string same = "a (0,0) (1,0); b (2,5) (2,4); ";
    for (const std::string text :
         {"schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 1, x: 1, y: 0}\n  b: [{x: 2, y: 5, t: 0}, {x: 2, y: 4, t: "
          "1}]\n",
          "schedule:\n  \"a\":\n    -   t: \"0\"\n        x: '0'\n        y: !!int 0\n    - t: !!float 1\n      x: "
          "1.0\n"
          "      y: 0e0\n  b:\n    - {x: +2, y: 5, t: 0, z: 0.5, name: [q, {w: e}]}\n    - {x: 2, y: 4, t: 1}\n",
          "{schedule: {a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}],\n b: [{t: 1, x: 2, y: 4}, {t: 0, x: 2, y: 5}]}}",
          "schedule: !!map\n  ? a\n  : - &p {t: &zero 0, x: *zero, y: *zero}\n    - {t: 1, x: 1, y: *zero}\n  b: "
          "[{t: 0, x: 2, y: 5}, {t: 1, x: 2, y: 4}]\n...\n"}) {
        EXPECT_EQ(cells_in(text), same) << text;
    }
    EXPECT_EQ(cells_in("schedule:\n  a: &path [&p {t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}]\n  b: *path\n  c: [*p]\n"),
              "a (0,0) (1,0); b (0,0) (1,0); c (0,0) (0,0); ")
        << "as PyYAML writes what stands twice";
}

TEST(MapfPlan, AgentsWithoutAStepAreLeftOutAndSaid) {
    const auto read = plan("schedule: {a: [], b: [{t: 0, x: 0, y: 0}], c: []}");
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].facts.warnings.at(0).text, "2 agents have no step, such as 'a'; left out");
}

TEST(MapfPlan, AliasesMakeNoMoreThanTheFileCanHold) {
    std::string text = "schedule:\n  a: &a [";
    for (int t = 0; t < 100; ++t) text += "{t: " + std::to_string(t) + ", x: 0, y: 0}, ";
    text += "]\n";
    for (int i = 0; i < 1000; ++i) text += "  b" + std::to_string(i) + ": *a\n";
    const std::string said = input_error([&] { plan(text); });
    EXPECT_NE(said.find("there are more steps than the file can hold"), std::string::npos) << said;
}

TEST(MapfPlan, BadPlansAreRefused) {
    const struct {
        std::string text, message;
    } cases[] = {
        {"", "there is no schedule"},
        {"- 1\n", "line 1: there is no schedule"},
        {"schedule: 3\n", "there is no schedule"},
        {"schedule: {}\n", "the schedule has no step"},
        {"schedule:\n  a: 3\n", "line 2: 'a' must have a list"},
        {"schedule:\n  a:\n  - 3\n", "line 3: a step of the plan must be a map"},
        {"schedule:\n  a:\n  - t: 0\n    x: 1\n", "line 3: the step lacks one of t, x and y"},
        {"schedule:\n  a:\n  - t: 0\n    x: one\n    y: 1\n", "line 4: x is not a finite number"},
        {"schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 0, x: 0, y: 0}\n", "line 4: 'a' is in frame 0 already"},
        {"schedule:\n  a:\n  - {t: 0, x: 0, y: 0, x: 7}\n", "line 3: 'x' stands twice in a step"},
        {"schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\nschedule:\n  b: []\n", "line 4: 'schedule' stands twice"},
        {"schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n---\nschedule: {}\n", "holds several documents"},
        {"schedule: 3\nschedule:\n  b:\n  - {t: 0, x: 0, y: 0}\n", "line 1: there is no schedule"},
        {"schedule: [\n", "line 1: there is no schedule"},
        {"schedule: {a: [\n", "line 2: is not YAML: did not find expected node content, while parsing a flow node"},
        {"schedule: {a: [{t: 0, x: 0, y: 0}]\nb: ", "line 2: is not YAML: did not find expected ',' or '}'"},
        {"a: 3\n\t\nschedule: {}\n",
         "line 2: is not YAML: found a tab character that violates indentation (a tab; YAML is indented with blanks)"},
        {"schedule: {}\n\nb: \x01", "line 3: is not YAML: control characters are not allowed"},
        {"schedule: {}\n\nb: \xff", "line 3: is not YAML: invalid leading UTF-8 octet"},
        {"schedule:\n  a: [{t: 0, x: 0, y: 0}]\n  a: [{t: 1, x: 0, y: 0}]\n",
         "line 3: 'a' stands twice in the schedule"},
        {"schedule:\n  ? [a]\n  : [{t: 0, x: 0, y: 0}]\n", "line 2: an agent of the schedule needs a name"},
        {"schedule:\n  '': [{t: 0, x: 0, y: 0}]\n", "line 2: an agent of the schedule needs a name"},
        {"schedule:\n  a:\n  - &p {t: 0, x: 0, y: 0}\n  - <<: *p\n    t: 1\n",
         "line 4: merge keys ('<<') are not read"},
        {"schedule:\n  a:\n  - *p\n", "line 3: the alias '*p' stands for nothing"},
        {"p: &p {t: 0, x: 0, y: 0}\nschedule:\n  a: [*p]\n", "line 3: the alias '*p' stands for nothing"},
        {"schedule:\n  a: &a [{t: 0, x: 0, y: 0}]\n  b: [*a]\n",
         "line 3: the alias '*a' stands for nothing of its kind"},
        {"schedule:\n  a:\n  - {t: 0, x: [1], y: 0}\n", "line 3: x is not a finite number"},
        {"schedule:\n  a:\n  - {t: .inf, x: 1, y: 0}\n", "line 3: t is not a finite number"},
        {"schedule:\n  a:\n  - {t: 0, x: 1e12, y: 0}\n", "line 3: x is beyond"},
        {"schedule:\n  a:\n  - {t: 0, x: , y: 0}\n", "line 3: x is not a finite number"},
        {"schedule: {a: [{t: 0, x: 0, y: 0}]}\nz: " + std::string(100000, '['), "line 2: is nested deeper than 100"},
        {std::string("a\0b", 3), "NUL byte"},
        {std::string(100000, '['), "line 1: there is no schedule"},
    };
    for (const auto& bad : cases) {
        const std::string said = input_error([&] { plan(bad.text); });
        EXPECT_NE(said.find(bad.message), std::string::npos) << bad.message << "\n" << said;
    }
}

}  // namespace
}  // namespace mobbscope
