// How clips of files move between their samples: defaults, the option, and the warning of long held steps.
#include <import/clip/held_steps.h>
#include <import/import.h>
#include <support/bvh_text.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope {
namespace {

constexpr const char* kTrackRows = "0 1 0 0\n10 1 0.1 0\n0 2 0 1\n10 2 0.1 1\n";
constexpr const char* kPlanRows = "schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 1, x: 1, y: 0}\n";

struct FileOf {
    const char* name;
    std::string text;
    mobb::Motion usual;
};

TEST(MotionBetweenSamples, IsLinearOfTracksAndHeldOfTheRest) {
    const TempFolder folder;
    for (const FileOf& of : {FileOf{"walk.bvh", kWalker, mobb::Motion::held},
                             FileOf{"one.csv", "t,x,y,r\n0,0,0,1\n1,0,0,1\n", mobb::Motion::held},
                             FileOf{"ids.csv", "id,t,x,y,r\na,0,0,0,1\na,1,0,0,1\n", mobb::Motion::linear},
                             FileOf{"crowd.txt", kTrackRows, mobb::Motion::linear},
                             FileOf{"plan.yaml", kPlanRows, mobb::Motion::linear}}) {
        const ParsedFile file = parse_clip_file(folder.write(of.name, of.text));
        EXPECT_EQ(file.clips({}).front().clip->motion(), of.usual) << of.name;
        EXPECT_EQ(file.offer({}).find("motion")->taken, name(of.usual)) << of.name;
        for (const mobb::Motion motion : {mobb::Motion::held, mobb::Motion::linear}) {
            ImportOptions options;
            options.motion = motion;
            const ImportedClip made = file.clips(options).front();
            EXPECT_EQ(made.clip->motion(), motion) << of.name;
        }
    }
}

TEST(MotionBetweenSamples, SurvivesTrimAndOtherRates) {
    const TempFolder folder;
    ImportOptions options;
    options.motion = mobb::Motion::linear;
    options.trim = {0.1, 0.3};
    EXPECT_EQ(import_clips(folder.write("walk.bvh", kWalker), options).front().clip->motion(), mobb::Motion::linear);
    ImportOptions resampled;
    resampled.fps = 25;
    const auto crowd = import_clips(folder.write("crowd.txt", kTrackRows), resampled);
    EXPECT_EQ(crowd.front().clip->count(), 11);
    EXPECT_EQ(crowd.front().clip->motion(), mobb::Motion::linear);
    resampled.origin = Origin::start_heading;
    const auto csv = import_clips(folder.write("ids.csv", "id,t,x,y,r\na,0,0,0,1\na,1,0,0,1\na,7,0,0,1\n"), resampled);
    EXPECT_EQ(csv.front().clip->motion(), mobb::Motion::linear);
}

TEST(HeldStep, TheOneThatExceedsItsRadiusMostIsFound) {
    const std::vector<mobb::Disk> samples{{0, 0, 1}, {1, 0, 0.5}, {1, 0.75, 2}, {1, 2.875, 2}, {0, 2.875, 2}};
    const auto step = longest_held_step({0.5, samples});
    ASSERT_TRUE(step);
    EXPECT_EQ(step->sample, 1) << "the first is as long as its radius; the third exceeds its own by less";
    EXPECT_EQ(step->length, 0.75);
    EXPECT_EQ(step->radius, 0.5);
}

TEST(HeldStep, NoneIsTooLongOfALinearClipNorOfOneThatStands) {
    EXPECT_FALSE(longest_held_step({1, {{0, 0, 0.1}, {9, 0, 0.1}}, mobb::Motion::linear}));
    EXPECT_FALSE(longest_held_step({1, {{3, 4, 0}, {3, 4, 0}}}));
    EXPECT_FALSE(longest_held_step({1, {{3, 4, 0}}}));
    EXPECT_TRUE(longest_held_step({1, {{0, 0, 0.1}, {9, 0, 0.1}}}));
}

TEST(HeldStep, OfAFileIsWarnedOfAtTheOptionThatMendsIt) {
    const TempFolder folder;
    const ParsedFile file = parse_clip_file(folder.write("a.csv", "t,x,y,r\n0,0,0,0.2\n0.4,0.56,0,0.2\n0.8,1,0,0.2\n"));
    const std::vector<ImportWarning> warnings = file.clips({}).front().facts.warnings;
    ASSERT_EQ(warnings.size(), 1u) << "once, though two steps are too long";
    EXPECT_EQ(warnings[0].option, "motion");
    EXPECT_EQ(warnings[0].text,
              "its disks are held, but it moves 0.56 m from sample 0 to the next, more than its radius of 0.2 m: what "
              "it meets in between goes unseen; give motion linear (--motion linear, or \"motion\": \"linear\" in the "
              "scene)");
    ImportOptions linear;
    linear.motion = mobb::Motion::linear;
    EXPECT_TRUE(file.clips(linear).front().facts.warnings.empty());
}

}  // namespace
}  // namespace mobbscope
