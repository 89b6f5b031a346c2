// Tracks of a table or a trajectory file: when they start, their step, what lies in gaps, what trim takes.
#include "imported.h"

#include <base/text.h>
#include <import/import.h>
#include <import/tracks/text_rows.h>
#include <import/tracks/track_steps.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

std::string all_said(const ImportedClip& clip) {
    std::string out;
    for (const ImportWarning& warning : clip.facts.warnings) out += said(warning) + "\n";
    return out;
}

/// A row a number of `steps`, at first + step * dt as printf writes it; x is step * dt, a metre a second.
std::string rows_of_track(const std::string& id, double first, double dt, const std::vector<int>& steps,
                          const char* format) {
    std::string out;
    for (const int step : steps) {
        char time[64];
        std::snprintf(time, sizeof time, format, first + step * dt);
        out += id + ',' + time + ',' + format_double(step * dt) + ",0,0.2\n";
    }
    return out;
}

std::vector<int> steps_up_to(int last) {
    std::vector<int> out;
    for (int i = 0; i <= last; ++i) out.push_back(i);
    return out;
}

const std::string kTracksHead = "id,t,x,y,r\n";

TEST(TrackClips, StartWithTheirFirstRowOnTheClockOfTheFile) {
    const auto read =
        csv_clips("t,r,x,id,y\n15,0.2,1,late,0\n12.5,0.2,0,early,0\n13,0.2,1,early,0\n15.5,0.2,2,late,0\n");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].id, "late");
    EXPECT_EQ(read[0].start, 2.5);
    EXPECT_EQ(read[1].start, 0);
    for (const ImportedClip& clip : read) EXPECT_EQ(clip.facts.t0, 12.5);
    EXPECT_EQ(csv_clips("t,x,y,r\n12,0,0,1\n13,0,0,1\n")[0].facts.t0, std::nullopt) << "no track";
    EXPECT_EQ(csv_clips("t,x,y,r\n12,0,0,1\n13,0,0,1\n")[0].start, 0);
}

TEST(TrackClips, TheStepIsFoundHoweverTimesAreRounded) {
    const struct {
        double first, dt;
        const char* format;
    } clocks[] = {
        {0, 0.1, "%.17g"},          {0, 0.1, "%.1f"},      {0, 1.0 / 30, "%.3f"},     {0, 1.0 / 30, "%.17g"},
        {1.7e9, 0.04, "%.17g"},     {1.7e9, 0.1, "%.1f"},  {1.7e9, 1.0 / 30, "%.4f"}, {-5, 0.4, "%.17g"},
        {0.2, 1.0 / 25, "%.17g"},   {3, 1.0 / 3, "%.17g"}, {86400, 1.0 / 16, "%.4f"}, {0, 2, "%g"},
        {1.7e9, 1.0 / 120, "%.6f"}, {0, 1e-4, "%.17g"},    {0, 3600, "%g"},
    };
    for (const auto& [first, dt, format] : clocks) {
        SCOPED_TRACE(std::to_string(first) + ' ' + std::to_string(dt) + ' ' + format);
        const auto read = csv_clips(kTracksHead + rows_of_track("a", first, dt, steps_up_to(300), format) +
                                    rows_of_track("b", first, dt, {100, 101, 102, 110, 111, 130}, format) +
                                    rows_of_track("c", first, dt, {7}, format));
        ASSERT_EQ(read.size(), 3u);
        EXPECT_EQ(read[0].clip->count(), 301);
        EXPECT_EQ(read[0].facts.warnings.size(), 0u) << all_said(read[0]);
        EXPECT_NEAR(read[0].clip->dt(), dt, 1e-4 * dt);
        EXPECT_EQ(read[1].clip->count(), 31) << "gaps are filled at the file's step";
        EXPECT_NEAR(read[1].clip->dt(), dt, 1e-3 * dt);
        EXPECT_EQ(all_said(read[1]), "there are gaps, which are filled linearly (25 samples, line 306)\n");
        for (int i = 0; i < 31; ++i)
            EXPECT_NEAR(read[1].clip->samples()[static_cast<std::size_t>(i)].x / dt, 100 + i, 1e-9);
        EXPECT_NEAR(read[1].start, 100 * dt, 1e-3);
        EXPECT_EQ(read[2].clip->count(), 1);
        EXPECT_NEAR(read[2].clip->dt(), dt, 1e-3 * dt) << "a row alone takes the file's step";
        EXPECT_EQ(all_said(read[2]), "");
    }
}

/// 60 frames a second are 16 or 17 ms apart: 0.04 of a frame from where they were.
TEST(TrackClips, TimesInMillisecondsAreInStepFromWhicheverFrame) {
    for (const double rate : {24.0, 29.97, 30.0, 59.94, 60.0, 120.0}) {
        for (const double clock : {0.0, 1.7e9}) {
            std::string text = kTracksHead;
            for (int first = 0; first < 12; ++first) {
                const double start = clock + first / rate;
                text += rows_of_track("whole" + std::to_string(first), start, 1 / rate, steps_up_to(70), "%.3f");
                text += rows_of_track("gaps" + std::to_string(first), start, 1 / rate,
                                      {0, 1, 2, 3, 9, 10, 11, 12, 13, 14, 15, 16, 17, 40, 41, 43, 60}, "%.3f");
            }
            for (const ImportedClip& clip : csv_clips(text)) {
                SCOPED_TRACE(std::to_string(rate) + ' ' + clip.id);
                EXPECT_EQ(all_said(clip).find("not uniform"), std::string::npos) << all_said(clip);
                ASSERT_EQ(clip.clip->count(), clip.id.starts_with("gaps") ? 61 : 71);
                EXPECT_NEAR(clip.clip->dt(), 1 / rate, 2e-5);
                for (int i = 0; i < clip.clip->count(); ++i)
                    EXPECT_NEAR(clip.clip->samples()[static_cast<std::size_t>(i)].x * rate, i, 1e-9);
            }
        }
    }
    const auto alone = csv_clips("t,x,y,r\n0,0,0,1\n0.017,1,0,1\n0.033,2,0,1\n0.05,3,0,1\n0.067,4,0,1\n");
    EXPECT_EQ(alone[0].clip->count(), 5);
    EXPECT_EQ(all_said(alone[0]).find("not uniform"), std::string::npos) << all_said(alone[0]);
    // What was not rounded, or is a whole millisecond off, is out of step as ever.
    for (const char* const late : {"0.0205", "0.021"}) {
        const auto read = csv_clips(kTracksHead + "a,0,0,0,1\na," + late + ",1,0,1\na,0.04,2,0,1\n");
        EXPECT_NE(all_said(read[0]).find("not uniform"), std::string::npos) << late;
    }
}

TEST(TrackClips, TracksOfOneFileShareItsStepToTheLastBit) {
    const auto read = csv_clips(kTracksHead + rows_of_track("a", 0, 0.1, steps_up_to(50), "%.17g") +
                                rows_of_track("b", 17.3, 0.1, steps_up_to(9), "%.17g") +
                                rows_of_track("c", 171.7, 0.1, {0, 1, 4, 5}, "%.17g"));
    EXPECT_EQ(read[0].clip->dt(), read[1].clip->dt());
    EXPECT_EQ(read[0].clip->dt(), read[2].clip->dt());
}

TEST(TrackClips, WhoseRowsAreEquallyFarApartHasAStepOfItsOwn) {
    const auto read =
        csv_clips(kTracksHead + rows_of_track("a", 0, 0.1, steps_up_to(20), "%g") +
                  rows_of_track("b", 0, 0.25, steps_up_to(4), "%g") + rows_of_track("c", 0, 0.15, {0, 1, 2, 5}, "%g"));
    EXPECT_EQ(read[1].clip->dt(), 0.25);
    EXPECT_EQ(read[1].clip->count(), 5);
    EXPECT_NEAR(read[2].clip->dt(), 0.15, 1e-12);
    EXPECT_EQ(read[2].clip->count(), 6);
}

TEST(TrackClips, OtherTimesAreResampledFromTheirOwnStart) {
    const std::string text = kTracksHead + rows_of_track("a", 0, 0.1, steps_up_to(20), "%g") +
                             "b,1.03,0,0,.2\nb,1.21,1,0,.2\nb,1.33,2,0,.2\n";
    const auto read = csv_clips(text);
    EXPECT_EQ(read[1].clip->dt(), 1.0 / 30);
    EXPECT_EQ(read[1].clip->count(), 10);
    EXPECT_EQ(read[1].start, 1.03);
    EXPECT_EQ(all_said(read[1]), "the times are not uniform; the path is resampled at 30 fps (line 24)\n");
    EXPECT_FALSE(read[1].facts.dt);
    ImportOptions ten;
    ten.fps = 10;
    EXPECT_EQ(csv_clips(text, ten)[1].clip->count(), 4);
    EXPECT_EQ(csv_clips(text, ten)[0].clip->count(), 21);
    EXPECT_EQ(all_said(csv_clips(text, ten)[0]),
              "fps does not apply: the rows are uniform in time and are the samples\n");
}

TEST(TrackClips, RowsAloneNeedAStepFromSomewhere) {
    const std::string alone = "id,t,x,y,r\na,0,0,0,0.2\nb,3,1,0,0.2\n";
    EXPECT_EQ(input_error([&] { csv_clips(alone); }),
              "f.csv: every track has one row, which does not tell how long it lasts; give dt (seconds)");
    ImportOptions options;
    options.dt = 0.5;
    const auto read = csv_clips(alone, options);
    EXPECT_EQ(read[0].clip->dt(), 0.5);
    EXPECT_EQ(read[1].start, 3);
    EXPECT_EQ(all_said(read[1]), "");
    EXPECT_EQ(all_said(csv_clips(kTracksHead + rows_of_track("a", 0, 1, {0, 1}, "%g"), options)[0]),
              "dt does not apply: the rows have times\n");
}

TEST(TrackClips, WithoutTimesAllStartTogetherAndThatIsSaid) {
    const std::string text = "x,id,y,r\n0,a,0,0.2\n5,b,0,0.2\n1,a,0,0.2\n9,c,9,0.2\n2,a,0,0.2\n";
    EXPECT_EQ(input_error([&] { csv_clips(text); }),
              "f.csv: line 1: the header names no column t; name one or give dt (seconds between rows)");
    ImportOptions options;
    options.dt = 0.25;
    const auto read = csv_clips(text, options);
    ASSERT_EQ(read.size(), 3u);
    for (const ImportedClip& clip : read) {
        EXPECT_EQ(clip.start, 0);
        EXPECT_EQ(clip.clip->dt(), 0.25);
        EXPECT_EQ(all_said(clip),
                  "the rows have no times: all tracks start together, with a row every 0.25 s; name a column t if they "
                  "do not\n");
    }
    EXPECT_EQ(read[0].clip->count(), 3);
}

TEST(TrackClips, TrimIsOfTheFilesTimeAndStartsStay) {
    const std::string text = kTracksHead + rows_of_track("a", 100, 0.5, steps_up_to(10), "%g") +
                             rows_of_track("b", 103, 0.5, {0, 1, 6, 7}, "%g") +
                             rows_of_track("c", 120, 0.5, {0, 1}, "%g");
    const auto trimmed = [&](double from, double to) {
        ImportOptions options;
        options.trim = {from, to};
        return csv_clips(text, options);
    };
    const auto read = trimmed(4, 5.5);
    ASSERT_EQ(read.size(), 2u) << "c comes later";
    for (const ImportedClip& clip : read) {
        EXPECT_EQ(clip.start, 4) << "where the file has them";
        EXPECT_EQ(clip.facts.t0, 100);
    }
    EXPECT_EQ(read[0].clip->count(), 3);
    EXPECT_EQ(read[0].clip->samples()[0].x, 4);
    EXPECT_EQ(read[1].clip->count(), 4);
    EXPECT_EQ(read[1].clip->samples()[0].x, 1) << "within the gap";
    EXPECT_EQ(trimmed(4.2, 99)[0].start, 4) << "samples stay where they are, and what is between them is there";
    EXPECT_EQ(trimmed(4.2, 99)[0].clip->count(), 3);
    EXPECT_EQ(trimmed(0, 4.2)[0].clip->count(), 10);
    EXPECT_EQ(trimmed(4.2, 4.3)[0].clip->count(), 2);
    EXPECT_EQ(trimmed(19.999, 20.1)[0].start, 20);
    EXPECT_EQ(trimmed(19.999, 20.1).size(), 1u);
    EXPECT_EQ(
        input_error([&] { trimmed(7, 19); }),
        "f.csv: nobody is there between 7 and 19 s of trim, which counts from the earliest row; the file lasts 20.5 s");
}

TEST(TrackClips, TrimTakesAPartOfWhatIsResampledToo) {
    ImportOptions options;
    options.trim = {1, 2};
    options.fps = 10;
    const auto read = csv_clips(kTracksHead + "a,50,0,0,.2\na,50.7,7,0,.2\na,53,30,0,.2\n", options);
    EXPECT_EQ(read[0].clip->count(), 11);
    EXPECT_NEAR(read[0].start, 1, 1e-12);
    EXPECT_NEAR(read[0].clip->samples()[10].x, 20, 1e-9);
}

TEST(TrackClips, OneTrackKeepsItsTimeAndStep) {
    const std::string text =
        kTracksHead + rows_of_track("a", 0, 0.5, steps_up_to(10), "%g") + rows_of_track("b", 3, 0.5, {0}, "%g");
    ImportOptions options;
    options.id = "b";
    const auto read = csv_clips(text, options);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].start, 3);
    EXPECT_EQ(read[0].clip->dt(), 0.5);
}

TEST(TrackClips, AskedForOneByOneTheyAreTheSame) {
    const TempFolder folder;
    const std::string file =
        folder.write("f.csv", kTracksHead + rows_of_track("a", 0, 0.5, {0, 1, 2, 4}, "%g") +
                                  rows_of_track("b", 3, 0.5, {0}, "%g") + rows_of_track("c", 9, 0.5, {0, 1}, "%g"));
    const auto all = import_clips(file, {});
    Importer importer;
    for (int round = 0; round < 2; ++round) {
        for (const ImportedClip& of_all : all) {
            ImportOptions options;
            options.id = of_all.id;
            const auto one = importer.clips(file, options);
            ASSERT_EQ(one.size(), 1u);
            EXPECT_EQ(one[0].name, of_all.name);
            EXPECT_EQ(one[0].start, of_all.start);
            EXPECT_EQ(one[0].clip->dt(), of_all.clip->dt());
            EXPECT_EQ(one[0].clip->count(), of_all.clip->count());
            EXPECT_EQ(one[0].facts.warnings, of_all.facts.warnings);
        }
    }
    ImportOptions late;
    late.trim = {9, 10};
    for (const std::string id : {"c", "a", "b"}) {
        late.id = id;
        const auto ask = [&] { return importer.clips(file, late); };
        if (id == "c") {
            EXPECT_EQ(ask()[0].start, 9);
        } else {
            EXPECT_NE(input_error([&] { ask(); }).find("track '" + id + "' has no point between 9 and 10 s"),
                      std::string::npos);
        }
    }
}

TEST(TrackSteps, TheMostFrequentOneCounts) {
    const auto step_of = [](const std::vector<double>& frames) {
        Track track{"a", {}};
        for (const double frame : frames) track.points.push_back({frame, 0, 0});
        return most_frequent_step(track.points);
    };
    EXPECT_EQ(step_of({5}), std::nullopt);
    EXPECT_EQ(step_of({0, 10, 20, 30, 60}), 10);
    EXPECT_EQ(step_of({0, 10, 40}), 10) << "the shorter of equals";
    EXPECT_EQ(step_of({0, 100, 200, 301}), 100) << "frame numbers are not rounded";
    std::vector<double> tenths, thirtieths;
    for (int i = 0; i < 5000; ++i) {
        tenths.push_back(2.6875 + i / 10.0);
        thirtieths.push_back(1e5 + i / 30.0);
    }
    EXPECT_EQ(step_of(tenths), 0.1) << "without what doubles add to it";
    EXPECT_EQ(step_of(thirtieths), 1.0 / 30);
    EXPECT_NEAR(*step_of({0, 0.033, 0.067, 0.1, 0.133, 0.167, 0.2, 0.9}), 1.0 / 30, 1e-12);
}

TEST(TrackSteps, PointsAreInStepOrNot) {
    const auto grid = [](const std::vector<double>& frames, double usual) {
        Track track{"a", {}};
        for (const double frame : frames) track.points.push_back({frame, 0, 0});
        return grid_of(track.points, usual);
    };
    EXPECT_TRUE(grid({0, 1, 2.019, 3}, 1).in_step);
    EXPECT_FALSE(grid({0, 1, 2.03, 3, 4}, 1).in_step);
    EXPECT_FALSE(grid({0, 1, 1.37, 7}, 1).in_step);
    EXPECT_EQ(grid({0, 1, 4, 5}, 1).steps, 5);
    EXPECT_TRUE(grid({0, 1, 4, 5}, 1).has_gaps);
    EXPECT_FALSE(grid({0, 3, 6, 9}, 1).has_gaps) << "as far apart as can be";
    EXPECT_FALSE(grid({0, 1e-300, 1e12}, 1e-300).in_step) << "more steps than can be counted";
}

}  // namespace
}  // namespace mobbscope
