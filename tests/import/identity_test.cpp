// Who is who and when: ids within recordings, rows that stand twice, times as dates and by the size of Unix clocks.
#include "imported.h"

#include <import/import.h>
#include <import/tracks/clock_text.h>
#include <support/folders.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

namespace mobbscope {
namespace {

std::set<std::string> names_of(const std::vector<ImportedClip>& clips) {
    std::set<std::string> out;
    for (const ImportedClip& clip : clips) out.insert(clip.id);
    return out;
}

TEST(Identity, IdsAreOnesWithinARecording) {
    for (const char* scope : {"recordingId", "scene_id", "case_id"}) {
        const std::string head = std::string(scope) + ",trackId,t,x,y\n";
        const auto read = csv_clips(head + "0,17,0,0,0\n0,17,1,1,0\n1,17,0,50,0\n1,17,1,51,0\n");
        EXPECT_EQ(names_of(read), (std::set<std::string>{"0/17", "1/17"})) << scope;
        EXPECT_TRUE(warns(read[0], "ids are one's within '" + std::string(scope) + "' alone"));
        EXPECT_FALSE(warns(read[0], "ignored"));
        EXPECT_EQ(csv_clips(head + "0,17,0,0,0\n0,17,1,1,0\n")[0].id, "17") << "one recording needs no name";
    }
    EXPECT_EQ(names_of(csv_clips("scene,recording,id,t,x,y\na,0,1,0,0,0\na,0,1,1,1,0\nb,0,1,0,5,0\nb,0,1,1,6,0\n")),
              (std::set<std::string>{"a/0/1", "b/0/1"}));
    // A room that somebody leaves is no recording; but one where there are two of an id is.
    EXPECT_EQ(csv_clips("id,t,x,y,location\n1,0,0,0,hall\n1,1,1,0,stairs\n").size(), 1u);
    for (const char* place : {"location", "camera", "file"}) {
        const std::string rows = std::string("id,t,x,y,") + place + "\n1,0,0,0,hall\n1,1,1,0,hall\n";
        EXPECT_EQ(csv_clips(rows + "1,0,9,9,stairs\n").size(), 2u) << place;
    }
    EXPECT_EQ(csv_clips("id,t,x,y,camera,scene\n1,0,0,0,a,s\n1,1,1,0,b,s\n1,0,9,9,a,u\n").size(), 2u)
        << "within a recording one is seen by several cameras";
    EXPECT_NE(csv_refusal("id,t,x,y\n1,0,0,0\n1,0,9,9\n").find("stands already in line 2; remove one"),
              std::string::npos);
    ImportOptions chosen;
    chosen.columns = "id=trackId";
    EXPECT_NE(csv_refusal("scene,trackId,t,x,y\na,1,0,0,0\nb,1,0,5,0\n", chosen).find("stands already"),
              std::string::npos);
}

TEST(Identity, RecordingsAreApartLikeFloors) {
    const auto read =
        csv_clips("take,location,id,t,x,y\na,1/2,1,0,0,0\na,1/2,1,1,1,0\nb,1/2,1/1,0,5,0\nb,1/2,1/1,1,6,0\n");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].floor, "a/1/2");
    EXPECT_EQ(read[1].floor, "b/1/2");
    EXPECT_TRUE(warns(read[0], "who is in different ones was never there together and does not meet"));
    EXPECT_EQ(csv_clips("id,t,x,y\n1,0,0,0\n1,1,1,0\n")[0].floor, "");
}

TEST(Identity, WhereYPointsUpItIsSaid) {
    const auto walked = [](const char* header, double up, double along_y) {
        std::string text = header;
        for (int i = 0; i < 40; ++i) {
            text += "1," + format_double(0.1 * i) + ',' + format_double(0.02 * i) + ',' + format_double(along_y * i) +
                    ',' + format_double(up * i) + '\n';
        }
        return csv_clips(text);
    };
    EXPECT_TRUE(warns(walked("id,t,x,y,z\n", 0.14, 0)[0],
                      "the column 'y' hardly changes and 'z' does: if y points up, as in Unity, give columns (y=z)"));
    EXPECT_TRUE(warns(walked("id,t,PosX,PosY,PosZ\n", 0.14, 0.0001)[0], "give columns (y=PosZ)"));
    EXPECT_FALSE(warns(walked("id,t,x,y,z\n", 0.0001, 0)[0], "hardly changes")) << "who walks along x";
    EXPECT_FALSE(warns(walked("id,t,x,y,z\n", 0.14, 0.1)[0], "hardly changes")) << "stairs";
    // Floors are no way.
    EXPECT_FALSE(warns(csv_clips("id,t,x,y,z\n1,0,0,0,0\n2,0,0,0,3.5\n1,1,1,0,0\n2,1,1,0,3.5\n")[0], "hardly changes"));
}

TEST(Identity, ARowThatStandsTwiceCountsOnce) {
    const auto read = csv_clips("id,t,x,y\n1,0,0,0\n1,0,0,0\n1,1,1,0\n1,1,1,0\n1,1,1,0\n1,2,2,0\n");
    EXPECT_EQ(read[0].clip->count(), 3);
    EXPECT_TRUE(warns(read[0], "3 rows repeat others and count once"));
    EXPECT_NE(csv_refusal("id,t,x,y\n1,0,0,0\n1,1,0,0\n1,1,0,0.1\n").find("line 4: the time 1 of track '1' stands"),
              std::string::npos);
}

TEST(Identity, UnixTimesTellTheirUnitByTheirSize) {
    for (const char* name : {"timestamp", "time", "t"}) {
        for (const auto& [digits, unit] : std::initializer_list<std::pair<int, const char*>>{
                 {3, "milliseconds"}, {6, "microseconds"}, {9, "nanoseconds"}}) {
            std::string text = std::string("id,") + name + ",x,y\n";
            for (int i = 0; i <= 10; ++i) {
                text += "1," + std::to_string(16000000000 + i) +
                        std::string(static_cast<std::size_t>(digits - 1), '0') + ',' + std::to_string(0.1 * i) + ",0\n";
            }
            const auto read = csv_clips(text);
            EXPECT_NEAR(read[0].clip->dt(), 0.1, 1e-6) << name << ' ' << unit;
            EXPECT_EQ(read[0].clip->count(), 11);
            EXPECT_NEAR(read[0].facts.t0.value(), 1.6e9, 1e-3);
            EXPECT_TRUE(warns(read[0], std::string("is taken for ") + unit));
        }
    }
    EXPECT_NEAR(csv_clips("id,t_ns,x,y\n1,0,0,0\n1,100000000,0.1,0\n")[0].clip->dt(), 0.1, 1e-12);
    EXPECT_NEAR(csv_clips("id,time [us],x,y\n1,0,0,0\n1,100000,0.1,0\n")[0].clip->dt(), 0.1, 1e-12);
}

TEST(Identity, DatesAndTimesOfDayAreTimes) {
    EXPECT_EQ(seconds_of_clock("1970-01-01T00:00:00"), 0);
    EXPECT_EQ(seconds_of_clock("2021-06-01T12:00:00Z"), 1622548800);
    EXPECT_EQ(seconds_of_clock("2021-06-01 14:00:00.25+02:00"), 1622548800.25);
    EXPECT_EQ(seconds_of_clock("2021-06-01 12:00:00 UTC"), 1622548800);
    EXPECT_EQ(seconds_of_clock("2021/06/01"), 1622505600);
    EXPECT_EQ(seconds_of_clock("01.06.2021"), 1622505600);
    const auto night = csv_clips("id,t,x,y\n1,23:59:59,0,0\n2,00:00:00,9,9\n1,00:00:00,1,0\n1,00:00:01,2,0\n");
    ASSERT_EQ(night.size(), 2u);
    EXPECT_EQ(night[0].clip->samples().size(), 3u);
    EXPECT_EQ(night[1].start, 1);
    EXPECT_TRUE(warns(night[0], "the clock goes over midnight"));
    EXPECT_EQ(csv_clips("t,x,y,r\n23:59:59,0,0,1\n00:00:00,1,0,1\n")[0].clip->dt(), 1);
    EXPECT_FALSE(warns(csv_clips("id,t,x,y\n1,01:00:00,0,0\n1,23:00:00,1,0\n1,12:00:00,1,0\n")[0], "midnight"));
    EXPECT_EQ(seconds_of_clock("01.06.2021 12:00"), 1622548800);
    EXPECT_EQ(seconds_of_clock("01-06-2021"), std::nullopt) << "day or month first";
    EXPECT_EQ(seconds_of_clock("12:00:30,5"), 43230.5);
    EXPECT_EQ(seconds_of_clock("23:59"), 86340);
    for (const char* bad : {"", "12", "25:00", "12:60", "12:00:", "12:00:00.", "2021-13-01", "2021-02-30",
                            "2021-06-01T", "2021-06-01T12:00:00X", "noon", "1:00", "12:00:00+1"})
        EXPECT_EQ(seconds_of_clock(bad), std::nullopt) << bad;
    for (const char* text : {"id,timestamp,x,y\n1,2021-06-01T12:00:00.0,0,0\n1,2021-06-01T12:00:00.5,0.5,0\n",
                             "id,time,x,y\n1,12:00:00.0,0,0\n1,12:00:00.5,0.5,0\n",
                             "id,date,time,x,y\n1,2021-06-01,23:59:59.75,0,0\n1,2021-06-02,00:00:00.25,0.5,0\n"}) {
        const auto read = csv_clips(text);
        EXPECT_NEAR(read[0].clip->dt(), 0.5, 1e-6) << text;
        EXPECT_EQ(read[0].facts.warnings.size(), 1u) << "the radius alone: " << read[0].facts.warnings[0].text;
    }
}

TEST(Identity, AChosenColumnOfFramesCountsByFps) {
    const std::string text = "id,frame,x,y\n1,0,0,0\n1,1,0.04,0\n1,2,0.08,0\n";
    ImportOptions options;
    options.columns = "t=frame";
    options.fps = 29.97;
    EXPECT_NEAR(csv_clips(text, options)[0].clip->dt(), 1 / 29.97, 1e-12);
    EXPECT_EQ(csv_clips(text, options)[0].clip->count(), 3);
    options.fps.reset();
    EXPECT_EQ(csv_clips(text, options)[0].clip->dt(), 1) << "else they are seconds";
    options.columns = "frame=time";
    options.fps = 20;
    EXPECT_EQ(csv_clips("id,time,x,y\n1,0,0,0\n1,10,0.5,0\n1,20,1,0\n", options)[0].clip->dt(), 0.5);
}

TEST(Identity, PublicReportsAreRead) {
    const auto folder = kSharedData / "public2";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    for (const char* name :
         {"clock_time.csv", "iso_time.csv", "timestamp_ms.csv", "timestamp_us.csv", "time_stamp_ns_from_zero.csv",
          "argoverse1.csv", "atc_header.csv", "bom.csv", "excel_quoted.csv", "pathfinder.csv", "sumo_emission.csv"}) {
        const auto read = import_clips(folder / name, {});
        ASSERT_EQ(read.size(), 2u) << name;
        EXPECT_NEAR(read[0].clip->dt(), 0.1, 1e-4) << name;
        EXPECT_NEAR(read[0].clip->duration(), 4, 0.11) << name;
        EXPECT_EQ(read[0].facts.doubt, "") << name;
    }
    EXPECT_EQ(import_clips(folder / "ngsim_locations.csv", {}).size(), 2u);
    EXPECT_NE(input_error([&] { import_clips(folder / "repeated_time_other_place.csv", {}); }).find("line 84"),
              std::string::npos);
    ImportOptions frames;
    frames.fps = 10;
    EXPECT_EQ(import_clips(folder / "several_recordings.csv", frames).size(), 2u);
    EXPECT_EQ(import_clips(folder / "gltf_starts_at_100.gltf", {})[0].facts.first_key, 100);
    EXPECT_EQ(import_clips(folder / "gltf_starts_at_0.5.gltf", {})[0].facts.first_key, 0.5);
}

}  // namespace
}  // namespace mobbscope
