// Agents of a plan are where they begin from step 0 on, and where they ended until the plan's last moment.
#include <import/import.h>
#include <import/tracks/mapf_plan.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// The clips of the agents of a plan in flow style: "a: [{t: 0, x: 1, y: 2}]".
std::vector<ImportedClip> agents_of(const std::string& agents, const ImportOptions& options = {}) {
    return track_clips(parse_mapf_plan("schedule: {" + agents + "}", "f.yaml"), "f.yaml", options);
}

/// "(0,0) (1,0) ": where the samples are.
std::string cells_of(const ImportedClip& clip) {
    std::string out;
    for (const mobb::Disk& disk : clip.clip->samples()) out += '(' + brief(disk.x) + ',' + brief(disk.y) + ") ";
    return out;
}

const std::string kFiveSteps = "b: [{t: 0, x: 9, y: 0}, {t: 1, x: 9, y: 1}, {t: 2, x: 9, y: 2}, {t: 3, x: 9, y: 3}]";

TEST(PlanWaiting, WhoIsAtTheGoalStaysThere) {
    const auto read = agents_of("a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}], " + kFiveSteps);
    EXPECT_EQ(cells_of(read[0]), "(0,0) (1,0) (1,0) (1,0) ");
    EXPECT_EQ(cells_of(read[1]), "(9,0) (9,1) (9,2) (9,3) ");
    for (const ImportedClip& clip : read) {
        EXPECT_EQ(clip.start, 0);
        EXPECT_EQ(clip.clip->dt(), 1);
        EXPECT_EQ(clip.facts.warnings.size(), 3u) << "second, metre, radius: waiting is not a gap";
    }
}

TEST(PlanWaiting, WhoBeginsAtTheGoalNeverMoves) {
    const auto read = agents_of("a: [{t: 0, x: 5, y: 6}], " + kFiveSteps);
    EXPECT_EQ(cells_of(read[0]), "(5,6) (5,6) (5,6) (5,6) ");
    EXPECT_EQ(read[0].facts.warnings.size(), 3u) << "one row of an agent is not a lack";
}

TEST(PlanWaiting, WhoBeginsLateStandsThereFromTheStart) {
    const auto read = agents_of("a: [{t: 2, x: 1, y: 0}, {t: 3, x: 2, y: 0}], " + kFiveSteps);
    EXPECT_EQ(cells_of(read[0]), "(1,0) (1,0) (1,0) (2,0) ");
    EXPECT_EQ(read[0].start, 0);
    EXPECT_EQ(cells_of(agents_of("a: [{t: 2, x: 1, y: 0}, {t: 3, x: 2, y: 0}]")[0]), "(1,0) (1,0) (1,0) (2,0) ")
        << "steps count from 0";
    EXPECT_EQ(cells_of(agents_of("a: [{t: 1, x: 4, y: 0}], " + kFiveSteps)[0]), "(4,0) (4,0) (4,0) (4,0) ");
}

TEST(PlanWaiting, WhoLeavesAndComesBackGoesAsThePlanSays) {
    const auto read = agents_of("a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}, {t: 2, x: 0, y: 0}], " + kFiveSteps);
    EXPECT_EQ(cells_of(read[0]), "(0,0) (1,0) (0,0) (0,0) ");
}

TEST(PlanWaiting, StepsThatAreMissingAreFilledSilently) {
    const auto read = agents_of("a: [{t: 0, x: 0, y: 0}, {t: 3, x: 3, y: 0}], " + kFiveSteps);
    EXPECT_EQ(cells_of(read[0]), "(0,0) (1,0) (2,0) (3,0) ");
    EXPECT_EQ(read[0].facts.warnings.size(), 3u);
    // Whoever is written with few steps has all of them where others need them.
    const auto mixed = agents_of(
        "a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}, {t: 6, x: 1, y: 0}], b: [{t: 0, x: 0, y: 2}, {t: 4, x: 0, y: 2}]");
    EXPECT_EQ(mixed[0].clip->count(), 7);
    EXPECT_EQ(mixed[1].clip->count(), 7);
}

TEST(PlanWaiting, ThePlansStepIsTheLongestOfWhichAllPointsAre) {
    const auto read =
        agents_of("a: [{t: 0, x: 0, y: 0}, {t: 10, x: 1, y: 0}], b: [{t: 0, x: 5, y: 0}, {t: 40, x: 6, y: 0}]");
    EXPECT_EQ(read[0].clip->dt(), 10);
    EXPECT_EQ(cells_of(read[0]), "(0,0) (1,0) (1,0) (1,0) (1,0) ");
    // Fractions: an agent's steps are as fine as they need to be.
    const auto fractions = agents_of(
        "a: [{t: 0, x: 0, y: 0}, {t: 1.5, x: 3, y: 0}], b: [{t: 0, x: 5, y: 0}, {t: 1, x: 6, y: 0}, {t: 2, x: 7, y: "
        "0}]");
    EXPECT_EQ(cells_of(fractions[0]), "(0,0) (1,0) (2,0) (3,0) (3,0) ");
    EXPECT_EQ(fractions[0].clip->dt(), 0.5);
    EXPECT_EQ(fractions[1].clip->dt(), 1);
}

TEST(PlanWaiting, EverybodyIsThereUntilTheLastMoment) {
    for (const std::string agents :
         {"a: [{t: 0, x: 0, y: 0}], ", "a: [{t: 3, x: 0, y: 0}], ", "a: [{t: 1, x: 0, y: 0}, {t: 2, x: 1, y: 0}], "}) {
        for (const ImportedClip& clip : agents_of(agents + kFiveSteps)) {
            EXPECT_EQ(clip.start, 0) << agents;
            EXPECT_EQ((clip.clip->count() - 1) * clip.clip->dt(), 3) << agents;
            EXPECT_EQ(clip.facts.duration, 3) << agents;
        }
    }
}

TEST(PlanWaiting, TrimTakesAPartOfThePlan) {
    ImportOptions options;
    options.trim = {2, 3};
    const auto read = agents_of("a: [{t: 0, x: 1, y: 0}], " + kFiveSteps, options);
    ASSERT_EQ(read.size(), 2u) << "who waits is there";
    EXPECT_EQ(cells_of(read[0]), "(1,0) (1,0) ");
    EXPECT_EQ(cells_of(read[1]), "(9,2) (9,3) ");
    EXPECT_EQ(read[0].start, read[1].start);
}

TEST(PlanWaiting, OfOneAgentThatIsNamedItsPlanIsTaken) {
    ImportOptions options;
    options.id = "a";
    EXPECT_EQ(cells_of(agents_of("a: [{t: 0, x: 1, y: 0}], " + kFiveSteps, options).at(0)), "(1,0) (1,0) (1,0) (1,0) ");
}

TEST(PlanWaiting, AStepFarAwayIsRefusedInOneLine) {
    for (const std::string agents : {"a: [{t: 1, x: 0, y: 0}], b: [{t: 9000000, x: 0, y: 0}]",
                                     "a: [{t: 0, x: 0, y: 0}, {t: 1, x: 0, y: 0}, {t: 9e15, x: 0, y: 0}]",
                                     "a: [{t: -9e15, x: 0, y: 0}, {t: 9e15, x: 0, y: 1}, {t: 1, x: 0, y: 0}]"}) {
        const std::string said = input_error([&] { agents_of(agents); });
        EXPECT_NE(said.find("f.yaml: line 1: agents stay where they are until the plan's last step, t = 9"),
                  std::string::npos)
            << said;
    }
    // Ten thousand agents of ten thousand steps are too many, a thousand of a thousand are not.
    const std::string file = "f";
    const auto plan = [&file](int agents, int last) {
        TrackCollector tracks(file);
        for (int i = 0; i < agents; ++i) tracks.add(std::to_string(i), {0, 0, double(i), 1});
        for (int t = 1; t <= last; ++t) tracks.add("0", {double(t), double(t), 0, t});
        return plan_of(tracks, file);
    };
    EXPECT_EQ(plan(1000, 1000).tracks.back().points.size(), 1001u);
    EXPECT_NE(input_error([&] { plan(10'000, 10'000); }).find("over 10000000; check t, or split the plan"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
