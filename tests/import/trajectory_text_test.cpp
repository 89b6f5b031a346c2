// Trajectories in columns: formats are told apart by content, and nothing is assumed in silence.
#include "imported.h"

#include <import/tracks/text_rows.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

const std::string kObsmat =
    "   1.0e+00   1.0e+00   -2.5   0.0   18.5   0.0   0.0   -1.3\n"
    "   1.1e+01   1.0e+00   -2.5   0.0   18.0   0.0   0.0   -1.3\n"
    "   1.1e+01   2.0e+00    4.0   0.0    6.0   0.0   0.0   -1.3\n"
    "   2.1e+01   2.0e+00    4.5   0.0    6.0   0.0   0.0   -1.3\n";
const std::string kTrajnet = "10 1 1.5 2\n20 1 1.5 2.5\n20 2 0 0\n30\t2\t0\t1\n";
const std::string kPetrack = "#framerate: 16\n# ID frame X/m Y/m Z/m\n3 8 0 0 1.7\n3 9 0.5 0 1.7\n4 16 1 1 1.8\n";
const std::string kHermes = "1 43 100 200 183\n1 44 110 200 183\n2 43 0 0 165\n2 44 0 10 165\n";
const std::string kSdd =
    "0 10 20 30 60 5 0 0 0 \"Pedestrian\"\n0 12 20 32 60 6 0 0 1 \"Pedestrian\"\n0 0 0 0 0 7 1 0 1 \"Pedestrian\"\n"
    "7 0 0 10 10 5 0 1 0 \"Golf Cart\"\n";

std::vector<ImportedClip> clips_of_text(const std::string& text, const ImportOptions& options = {}) {
    return track_clips(parse_text_tracks(text, "f.txt"), "f.txt", options);
}

std::string text_refusal(const std::string& text, const ImportOptions& options = {}) {
    return input_error([&] { clips_of_text(text, options); });
}

TEST(TrajectoryText, ObsmatHasFrameIdXZY) {
    const auto read = clips_of_text(kObsmat);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "obsmat");
    EXPECT_EQ(read[0].name, "1");
    EXPECT_EQ(read[0].id, "1");
    EXPECT_EQ(read[0].clip->dt(), 0.4) << "2.5 points a second";
    EXPECT_EQ(read[0].clip->samples()[1].x, -2.5);
    EXPECT_EQ(read[0].clip->samples()[1].y, 18);
    EXPECT_EQ(read[0].clip->samples()[1].r, kDefaultTrackRadius);
    EXPECT_EQ(read[0].start, 0);
    EXPECT_EQ(read[1].start, 0.4) << "10 frames of 25 a second later";
    EXPECT_TRUE(warns(read[0], "2.5 points a second are assumed"));
    EXPECT_TRUE(warns(read[0], "has no radii: 0.2 m are taken"));
}

TEST(TrajectoryText, TrajnetHasFramePedXY) {
    const auto read = clips_of_text(kTrajnet);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "trajnet");
    EXPECT_EQ(read[1].clip->samples()[1].y, 1);
    EXPECT_EQ(read[1].start, 0.4);
    EXPECT_EQ(read[1].clip->dt(), 0.4);
}

/// Two who walk, a row a point in four columns: by frames, as TrajNet has them, or by ids.
TEST(TrajectoryText, WhetherIdsComeFirstIsToldByWhoWalks) {
    for (const bool by_id : {false, true}) {
        for (const bool frame_first : {false, true}) {
            for (const int people : {2, 9}) {
                std::string text;
                const int rows = 12;
                for (int row = 0; row < people * rows; ++row) {
                    const int id = by_id ? row / rows : row % people, frame = by_id ? row % rows : row / people;
                    const std::string place = std::to_string(0.1 * frame + 2 * id) + ' ' + std::to_string(3 * id % 7);
                    text += (frame_first ? std::to_string(frame) + ' ' + std::to_string(id)
                                         : std::to_string(id) + ' ' + std::to_string(frame)) +
                            ' ' + place + '\n';
                }
                SCOPED_TRACE(text.substr(0, 60));
                const auto read = clips_of_text(text);
                // By frames, ids in the first column are no walk from row to row: that is left to a comment.
                if (!frame_first && !by_id) continue;
                ASSERT_EQ(read.size(), static_cast<std::size_t>(people));
                EXPECT_EQ(read[1].clip->count(), rows);
                EXPECT_NEAR(read[1].clip->samples()[5].x, 2.5, 1e-12);
                EXPECT_EQ(read[0].facts.format, frame_first ? "trajnet" : "petrack");
                EXPECT_EQ(warns(read[0], "are taken as id frame x y"), !frame_first);
            }
        }
    }
    EXPECT_EQ(clips_of_text("1 0 1 2\n1 1 1.1 2\n1 2 1.2 2\n").size(), 1u) << "one who walks";
    EXPECT_EQ(clips_of_text("5 1 1 2\n5 2 4.1 2\n5 3 7.2 2\n").size(), 3u) << "three in one frame";
    EXPECT_EQ(clips_of_text("#framerate: 5\n# frame id x y\n1 0 1 2\n1 1 1.1 2\n1 2 1.2 2\n").size(), 3u) << "as said";
}

TEST(TrajectoryText, StepsCountWhateverTheFrameNumbers) {
    // ETH: every sixth frame of 15 a second.
    const auto read = clips_of_text("780 1 8 3\n786 1 9 3\n786 2 0 0\n792 2 1 0\n");
    EXPECT_EQ(read[0].clip->dt(), 0.4);
    EXPECT_EQ(read[1].start, 0.4);
}

TEST(TrajectoryText, PetrackHeaderTellsRateUnitAndColumns) {
    const auto read = clips_of_text(kPetrack);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "petrack");
    EXPECT_EQ(read[0].name, "3");
    EXPECT_EQ(read[0].clip->dt(), 1.0 / 16);
    EXPECT_EQ(read[1].start, 0.5);
    EXPECT_EQ(read[1].clip->count(), 1);
    EXPECT_EQ(read[1].clip->dt(), 1.0 / 16) << "a single point holds as long as the others";
    EXPECT_EQ(read[0].facts.unit, 1);
    EXPECT_EQ(read[0].facts.warnings.size(), 1u) << "only the radius is assumed";

    const auto other = clips_of_text("# framerate: 25.00 fps\n# PersID\tFrame\tX/cm\tY/cm\n1 0 100 50\n1 1 200 50\n");
    EXPECT_EQ(other[0].facts.unit, 0.01);
    EXPECT_EQ(other[0].clip->dt(), 0.04);
    EXPECT_EQ(other[0].clip->samples()[1].x, 2);
    EXPECT_EQ(clips_of_text("# frame id y x\n0 9 1 2\n1 9 3 4\n")[0].clip->samples()[0].x, 2)
        << "as the comment names them";
    EXPECT_EQ(clips_of_text("#framerate: 10\n7 0 1 2\n7 1 3 4\n")[0].id, "7") << "TrajNet has no header";
}

TEST(TrajectoryText, WithoutAHeaderHeadsTellTheUnit) {
    const auto read = clips_of_text(kHermes);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.unit, 0.01);
    EXPECT_EQ(read[0].clip->samples()[1].x, 1.1);
    EXPECT_EQ(read[0].clip->dt(), 1.0 / 16);
    EXPECT_NEAR(read[0].facts.guessed_from_height.value(), 1.83, 1e-12);
    EXPECT_TRUE(warns(read[0], "centimetres are assumed, as heads are 1.83 m high then"));
    EXPECT_TRUE(warns(read[0], "16 a second are assumed"));
    EXPECT_TRUE(warns(clips_of_text("1 0 1 2 0\n1 1 1 3 0\n")[0], "metres are assumed")) << "no heads";

    ImportOptions said;
    said.unit = "m";
    said.dt = 0.1;
    said.radius = 0.3;
    const auto told = clips_of_text(kHermes, said);
    EXPECT_EQ(told[0].facts.unit, 1);
    EXPECT_EQ(told[0].clip->samples()[1].x, 110);
    EXPECT_EQ(told[0].clip->samples()[1].r, 0.3);
    EXPECT_EQ(told[0].clip->dt(), 0.1);
    EXPECT_FALSE(warns(told[0], "assumed") || warns(told[0], "taken")) << "nothing was";
    EXPECT_FALSE(told[0].facts.guessed_from_height);
    said.unit = "auto";
    EXPECT_EQ(clips_of_text(kHermes, said)[0].facts.unit, 0.01);
}

TEST(TrajectoryText, DroneBoxesAreTakenByTheirCentresWhileInView) {
    const auto read = clips_of_text(kSdd);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "sdd");
    EXPECT_EQ(read[0].clip->count(), 2);
    EXPECT_EQ(read[0].clip->samples()[0].x, 20);
    EXPECT_EQ(read[0].clip->samples()[0].y, 40);
    EXPECT_EQ(read[0].clip->dt(), 1.0 / 30);
    EXPECT_EQ(read[1].name, "7");
    EXPECT_TRUE(warns(read[0], "1 row is marked as lost or not active and left out"));
    EXPECT_TRUE(warns(read[0], "pixels"));
    EXPECT_EQ(read[0].facts.label, "Pedestrian");
    EXPECT_EQ(read[1].facts.label, "Golf Cart");
}

TEST(TrajectoryText, ClassesHaveRadiiOfTheirOwnAndAreNamed) {
    std::string text;
    int id = 0;
    const std::pair<const char*, double> classes[] = {{"Pedestrian", 0.2}, {"Skater", 0.3}, {"Biker", 0.9},
                                                      {"Cart", 1.2},       {"Car", 2.25},   {"Bus", 6}};
    for (const auto& [name, radius] : classes) {
        const std::string row = std::to_string(id++) + " 0 0 10 10 5 0 0 0 \"" + name + "\"\n";
        text += row;
    }
    const auto read = clips_of_text(text + "6 0 0 10 10 5 0 0 0 \"Dog\"\n7 0 0 9 9 5 0 0 0 \"Car\"\n");
    ASSERT_EQ(read.size(), std::size(classes) + 2);
    for (std::size_t i = 0; i < std::size(classes); ++i)
        EXPECT_EQ(read[i].clip->samples()[0].r, classes[i].second) << classes[i].first;
    EXPECT_EQ(read[6].clip->samples()[0].r, kDefaultTrackRadius);
    EXPECT_EQ(read[7].clip->samples()[0].r, 2.25);
    for (const ImportedClip& clip : read) {
        EXPECT_TRUE(warns(clip, "by class 'Biker' 0.9 m (1 track)"));
        EXPECT_TRUE(warns(clip, "'Car' 2.25 m (2 tracks)"));
        EXPECT_TRUE(warns(clip, "'Dog' 0.2 m (1 track, a class without a usual radius)"));
    }
    ImportOptions given;
    given.radius = 0.5;
    for (const ImportedClip& clip : clips_of_text(text, given)) {
        EXPECT_EQ(clip.clip->samples()[0].r, 0.5);
        EXPECT_FALSE(warns(clip, "no radii"));
    }
}

TEST(TrajectoryText, RadiiComeFromAFileOfIdsOrClasses) {
    const TempFolder folder;
    const auto with = [&](const std::string& radii) {
        ImportOptions options;
        options.radius = radius_from_text(folder.write("radii.csv", radii).string());
        return options;
    };
    auto read = clips_of_text(kSdd, with("id,radius\n7,1.5\n0,0.25\n"));
    EXPECT_EQ(read[0].clip->samples()[0].r, 0.25);
    EXPECT_EQ(read[1].clip->samples()[0].r, 1.5);
    EXPECT_FALSE(warns(read[0], "radi")) << "nothing was assumed";
    read = clips_of_text(kSdd, with("class,r\n\"Golf Cart\",1.1\n*,0.3\nBus,5\n"));
    EXPECT_EQ(read[0].clip->samples()[0].r, 0.3);
    EXPECT_EQ(read[1].clip->samples()[0].r, 1.1);
    EXPECT_TRUE(warns(read[0], "has radii of 'Bus', which is not in the file"));
    EXPECT_NE(text_refusal(kSdd, with("id,radius\n7,1.5\n")).find("has no radius for id '0'; add a row"),
              std::string::npos);
    EXPECT_NE(text_refusal(kObsmat, with("class,radius\nBus,1.5\n")).find("has no classes"), std::string::npos);
    ImportOptions column;
    column.radius = RadiusColumn{"width"};
    EXPECT_NE(text_refusal(kSdd, column).find("names a column, as a CSV has"), std::string::npos);
    for (const auto& [text, complaint] :
         std::vector<std::pair<std::string, std::string>>{{"", "line 1: a file of radii begins with"},
                                                          {"x,y\n1,2\n", "line 1: a file of radii begins with"},
                                                          {"id,radius\n", "there is no row"},
                                                          {"id,radius\n1\n", "line 2: has no comma"},
                                                          {"id,radius\n1,2\n1,3\n", "line 3: '1' stands twice"},
                                                          {"id,radius\n*,2\n*,3\n", "line 3: '*' stands twice"},
                                                          {"id,radius\n1,-2\n", "line 2: '-2' is not a radius"},
                                                          {"id,radius\n1,nan\n", "line 2: 'nan' is not a radius"},
                                                          {"id,radius\n,2\n", "line 2: has no id"}}) {
        const std::string& table = text;  // no structured binding in a lambda
        const std::string said = input_error([&] { with(table); });
        EXPECT_NE(said.find(complaint), std::string::npos) << said;
        EXPECT_NE(said.find("radii.csv"), std::string::npos) << said;
    }
}

TEST(TrajectoryText, MissingFramesAreInterpolated) {
    const auto read = clips_of_text("0 1 0 0\n10 1 1 0\n40 1 4 3\n50 1 5 3\n");
    ASSERT_EQ(read[0].clip->count(), 6);
    EXPECT_EQ(read[0].clip->dt(), 0.4);
    EXPECT_NEAR(read[0].clip->samples()[2].x, 2, 1e-12);
    EXPECT_NEAR(read[0].clip->samples()[3].y, 2, 1e-12);
    EXPECT_EQ(read[0].facts.frames, 4);
    EXPECT_EQ(said(read[0].facts.warnings.back()), "there are gaps, which are filled linearly (2 samples, line 3)");
    EXPECT_FALSE(read[0].facts.dt);
}

TEST(TrajectoryText, PointsOutOfStepAreResampled) {
    const auto read = clips_of_text("#framerate: 10\n1 0 0 0 1.7\n1 10 1 0 1.7\n1 20 2 0 1.7\n1 25 3 0 1.7\n");
    EXPECT_EQ(read[0].clip->dt(), 1.0 / 30);
    EXPECT_EQ(read[0].clip->count(), 76);
    EXPECT_TRUE(warns(read[0], "resampled at 30 fps"));
}

TEST(TrajectoryText, FpsResamples) {
    ImportOptions ten;
    ten.fps = 10;
    const auto read = clips_of_text(kTrajnet, ten);
    EXPECT_EQ(read[0].clip->dt(), 0.1);
    EXPECT_EQ(read[0].clip->count(), 5);
    EXPECT_NEAR(read[0].clip->samples()[2].y, 2.25, 1e-12);
    EXPECT_EQ(read[0].facts.dt, 0.4) << "the file's";
}

TEST(TrajectoryText, TrimTakesATimeOfTheCrowd) {
    const std::string text =
        "#framerate: 1\n1 10 0 0 1.7\n1 11 1 0 1.7\n1 12 2 0 1.7\n2 13 5 5 1.7\n2 14 6 5 1.7\n3 20 0 0 1.7\n";
    ImportOptions options;
    options.trim = {1, 3};
    const auto read = clips_of_text(text, options);
    ASSERT_EQ(read.size(), 2u) << "3 comes later";
    EXPECT_EQ(read[0].clip->count(), 2);
    EXPECT_EQ(read[0].clip->samples()[0].x, 1);
    EXPECT_EQ(read[0].start, 1) << "on the file's clock, which begins with its first frame";
    EXPECT_EQ(read[0].facts.t0, 10);
    EXPECT_EQ(read[1].clip->count(), 2) << "it begins to run";
    EXPECT_EQ(read[1].start, 3);
    options.id = "3";
    EXPECT_NE(text_refusal(text, options).find("track '3' has no point between 1 and 3 s"), std::string::npos);
    options.id.reset();
    options.trim = {5, 7};
    EXPECT_NE(
        text_refusal(text, options)
            .find("nobody is there between 5 and 7 s of trim, which counts from the earliest row; the file lasts 10 s"),
        std::string::npos);
}

TEST(TrajectoryText, OneTrackIsTakenById) {
    ImportOptions options;
    options.id = "2";
    const auto read = clips_of_text(kTrajnet, options);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].start, 0.4) << "on the clock of all";
    options.id = "5";
    EXPECT_NE(text_refusal(kTrajnet, options).find("has no track '5'"), std::string::npos);
}

TEST(TrajectoryText, RowsMayComeInAnyOrder) {
    const auto read = clips_of_text("20 1 2 0\n10 1 1 0\n30 1 3 0\n");
    EXPECT_EQ(read[0].clip->samples()[0].x, 1);
    EXPECT_EQ(read[0].clip->samples()[2].x, 3);
}

TEST(TrajectoryText, WhatFitsNoFormatIsRefusedWithTheFormats) {
    for (const char* text : {"hello world\n", "1 2 3\n", "1,2,3,4\n", "1 2 3 4 5 6\n", "a 1 2 3\n"}) {
        const std::string message = text_refusal(text);
        EXPECT_TRUE(message.starts_with("f.txt: line 1: is not a row of a trajectory file")) << message;
        for (const char* format : {"TrajNet", "PeTrack", "obsmat", "SDD"})
            EXPECT_NE(message.find(format), std::string::npos) << message;
    }
    for (const char* text : {"", "\n \n", "# nothing here\n"})
        EXPECT_NE(text_refusal(text).find("the file has no row"), std::string::npos);
    std::string million;
    for (int i = 0; i < 1'000'000; ++i) million += "1 ";
    EXPECT_NE(text_refusal(million).find("f.txt: line 1: has more than 1024 values"), std::string::npos);
}

TEST(TrajectoryText, BadRowsAreNamed) {
    const struct {
        std::string text, message;
    } cases[] = {
        {kTrajnet + "40 2 0\n", "line 5: has 3 values but the rows before it have 4"},
        {kTrajnet + "40 2 far 0\n", "line 5, column 3 (x): 'far' is not a finite number"},
        {kTrajnet + "40 2.5 0 0\n", "line 5, column 2 (id): '2.5' is not a whole number"},
        {kTrajnet + "40 2 1e12 0\n", "line 5, column 3 (x): '1e12' is beyond 1e+09"},
        {kTrajnet + "20 1 0 0\n", "line 5: the frame 20 of track '1' stands already in line 2"},
        {"# id frame x y\n1 2 3\n", "line 2: has 3 values but a comment names 4"},
        {std::string("10 1 0 0\n\0", 10), "line 2: holds a NUL byte"},
        {"\xff\xfe\x31", "line 1: is UTF-16 text"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_NE(text_refusal(text).find(message), std::string::npos) << message << "\n" << text_refusal(text);
}

TEST(TrajectoryText, SemiAxesOfJupedsimAreRadii) {
    const std::string head =
        "#description: jpscore (0.8.4)\n#framerate: 8.00\n#ID: the agent ID\n#FR: the current frame\n"
        "#X,Y,Z: the agents coordinates (in metres)\n#A, B: semi-axes of the ellipse\n#V: speed (in m/s)\n\n";
    const auto read = clips_of_text(head +
                                    "#ID\tFR\tX\tY\tZ\tA\tB\tANGLE\tCOLOR\t\n1\t0\t1\t2\t0\t0.18\t0.25\t-90\t0\t\n"
                                    "1\t1\t1.5\t2\t0\t0.3\t0.2\t-90\t0\t\n2\t1\t9\t2\t0\t0.2\t0.2\t0\t0\t\n");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].clip->dt(), 0.125);
    EXPECT_EQ(read[0].facts.unit, 1);
    EXPECT_EQ(read[0].clip->samples()[0].r, 0.25);
    EXPECT_EQ(read[0].clip->samples()[1].r, 0.3);
    EXPECT_EQ(read[1].clip->samples()[0].r, 0.2);
    EXPECT_FALSE(warns(read[0], "has no radii"));
    EXPECT_TRUE(warns(read[0], "A and B are semi-axes of ellipses: people are disks of the larger one"));
    // In the file's unit, and only where names say so.
    EXPECT_DOUBLE_EQ(clips_of_text("# id frame x/cm y/cm a b\n1 0 0 0 20 30\n1 1 0 0 20 30\n")[0].clip->samples()[0].r,
                     0.3);
    EXPECT_EQ(clips_of_text("# id frame x y radius (all in m)\n1 0 0 0 0.5\n1 1 0 0 0.5\n")[0].facts.unit, 1);
    EXPECT_EQ(clips_of_text("# id frame x [m] y [m] r [m]\n1 0 0 0 0.5\n1 1 0 0 0.5\n")[0].clip->samples()[0].r, 0.5);
    ImportOptions said;
    said.radius = 0.4;
    EXPECT_EQ(clips_of_text("# id frame x y a b\n1 0 0 0 20 30\n1 1 0 0 20 30\n", said)[0].clip->samples()[0].r, 0.4);
    EXPECT_NE(text_refusal("# id frame x y a b\n1 0 0 0 -1 -3\n").find("the radius is negative"), std::string::npos);
}

TEST(TrajectoryText, RemarksAreNeverRefused) {
    const std::string rows = "# id frame x/m y/m z/m\n1 0 1 2 1.7\n1 1 1.1 2 1.7\n";
    EXPECT_EQ(clips_of_text("# The frame rate was 25 fps.\n" + rows)[0].clip->dt(), 0.04);
    for (const char* remark : {"#framerate: fast\n", "#framerate: 0\n", "# framerate: unknown\n"}) {
        const auto read = clips_of_text(remark + rows);
        EXPECT_EQ(read[0].clip->dt(), 1.0 / 16) << remark;
        EXPECT_TRUE(warns(read[0], "does not tell a frame rate and is ignored")) << remark;
        EXPECT_TRUE(warns(read[0], "16 a second are assumed")) << remark;
    }
    EXPECT_EQ(clips_of_text("# speed in m/s\n1 0 100 200 170\n1 1 110 200 170\n")[0].facts.unit, 0.01)
        << "by the heads";
    // Times in place of frames.
    const auto timed = clips_of_text("# id time x y\n1 0.5 0 0\n1 0.75 1 0\n2 1 4 4\n2 1.25 4 5\n");
    EXPECT_EQ(timed[0].clip->dt(), 0.25);
    EXPECT_EQ(timed[1].start, 0.5);
}

TEST(TrajectoryText, OptionsOfSkeletonsAreRefused) {
    ImportOptions options;
    options.up = "z";
    EXPECT_EQ(text_refusal(kTrajnet, options), "f.txt: up does not apply to trajectories; leave it out");
}

}  // namespace
}  // namespace mobbscope
