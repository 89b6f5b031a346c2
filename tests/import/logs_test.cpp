// Tracks as robots and VISSIM log them.
#include "imported.h"

#include <base/text.h>
#include <import/import.h>
#include <import/tracks/text_rows.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mobbscope {
namespace {

/// "robot @0 /0.1: (0,0) (1,0); ": who it is, from when on, how long a step is, and where; whatever the file's name.
std::string logged(const std::string& text) {
    const TempFolder folder;
    std::string out;
    for (const ImportedClip& clip : import_clips(folder.write("log.txt", text), {})) {
        EXPECT_EQ(clip.clip->motion(), mobb::Motion::linear);
        out += clip.id + " @" + brief(clip.start) + " /" + brief(clip.clip->dt()) + ':';
        for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
        out += "; ";
    }
    return out;
}

const std::string kSame = "robot @0 /0.1: (0,0) (0.5,1) (1,2); ";

TEST(Logs, PosesOfTumAreOfOneRobot) {
    const std::string rows =
        "1305031102.175304 0 0 0.5 0 0 0 1\n1305031102.275304 0.5 1 0.5 0 0 0.6 0.8\n1305031102.375304 1 2 0.5 0 0 0 "
        "1\n";
    EXPECT_EQ(logged(rows), kSame);
    EXPECT_EQ(logged("# timestamp tx ty tz qx qy qz qw\n" + rows), kSame);
    EXPECT_EQ(logged("0.0 0 0 0 0 0 0 1\n0.1\t0.5\t1 0 0 0 0 1\n0.2 1 2 0 0 0 0 1\n"), kSame);
    // Rows of UCY and ETH have eight columns too.
    EXPECT_EQ(logged("0 1 5 0 2 0 0 0\n10 1 6 0 2 0 0 0\n"), "1 @0 /0.4: (5,2) (6,2); ");
}

TEST(Logs, PosesOfKittiHaveNoTimes) {
    const std::string rows = "1 0 0 0 0 1 0 -1 0 0 1 0\n1 0 0 0.5 0 1 0 -1 0 0 1 1\n0 0 1 1 0 1 0 -1 -1 0 0 2\n";
    EXPECT_EQ(logged(rows), kSame);
    const ImportedClip robot = track_clips(parse_text_tracks(rows, "f"), "f", {})[0];
    EXPECT_TRUE(warns(robot, "10 a second are assumed, as in KITTI"));
    EXPECT_TRUE(warns(robot, "the ground is taken to be x and z of the camera, whose y points down"));
    ImportOptions options;
    options.dt = 0.5;
    EXPECT_EQ(track_clips(parse_text_tracks(rows, "f"), "f", options)[0].clip->dt(), 0.5);
    EXPECT_EQ(logged("1 0 0 0 0 1 0 0 0 0 1 7\n1 0 0 0.5 0 1 0 1 0 0 1 7\n1 0 0 1 0 1 0 2 0 0 1 7\n"), kSame);
}

TEST(Logs, HeadersOfRosAndEurocNamePlaces) {
    EXPECT_EQ(logged("#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x []\n"
                     "1403636580838555648,0,0,0.5,1,0\n1403636580938555648,0.5,1,0.5,1,0\n"
                     "1403636581038555648,1,2,0.5,1,0\n"),
              kSame);
    EXPECT_EQ(logged("#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m]\n0,0,0\n100000000,0.5,1\n200000000,1,2\n"), kSame);
    EXPECT_EQ(logged("Time,header.seq,header.stamp.secs,header.stamp.nsecs,header.frame_id,pose.position.x,"
                     "pose.position.y,pose.covariance\n1600000000.0,0,1600000000,0,map,0,0,\"(0, 1)\"\n"
                     "1600000000.1,1,1600000000,100000000,map,0.5,1,\"(0, 1)\"\n"
                     "1600000000.2,2,1600000000,200000000,map,1,2,\"(0, 1)\"\n"),
              kSame);
    EXPECT_EQ(logged("header.stamp.sec,header.stamp.nanosec,pose.pose.position.x,pose.pose.position.y\n"
                     "16,0,0,0\n16,100000000,0.5,1\n16,150000000,nan,nan\n16,200000000,1,2\n"),
              kSame);
    EXPECT_EQ(logged("%time,field.header.seq,field.pose.position.x,field.pose.position.y\n"
                     "1600000000000000000,0,0,0\n1600000000100000000,0,0.5,1\n1600000000200000000,0,1,2\n"),
              kSame);
    // Of units, clocks, places in cells of their own and several robots alike.
    EXPECT_EQ(logged("timestamp [us],p_RS_R_x [mm],p_RS_R_y [mm]\n0,0,0\n100000,500,1000\n200000,1000,2000\n"), kSame);
    EXPECT_EQ(logged("time,pose.position.x,pose.position.y\n12:00:00.0,0,0\n12:00:00.1,0.5,1\n12:00:00.2,1,2\n"),
              kSame);
    EXPECT_EQ(logged("t,r1/pose/position/x,r1/pose/position/y,r2/pose/position/x,r2/pose/position/y\n"
                     "0,0,0,,\n0.1,1,0,7,7\n0.2,,,8,7\n"),
              "r1 @0 /0.1: (0,0) (1,0); r2 @0.1 /0.1: (7,7) (8,7); ");
    EXPECT_EQ(logged("Time,poses[0].pose.position.x,poses[0].pose.position.y,poses[1].pose.position.x,"
                     "poses[1].pose.position.y\n0,0,0,9,9\n0.1,0.5,1,9,9\n0.2,1,2,9,9\n"),
              kSame)
        << "a path is one robot's";
    EXPECT_EQ(logged("t;id;/odom/pose/pose/position/x;/odom/pose/pose/position/y\n0;a;0;0\n0.1;b;3;3\n0.1;a;1;0\n"),
              "a @0 /0.1: (0,0) (1,0); b @0.1 /0.1: (3,3); ");
}

TEST(Logs, VissimAndViswalkNameTheirColumns) {
    EXPECT_EQ(logged("\xef\xbb\xbf$VISION\n* File: a.inpx\n* Date\n*\n*\n$VEHICLE:SIMSEC;NO;LANE\\LINK\\NO;COORDFRONT;"
                     "COORDREAR\n0.1;1;5;1 2 0;0 2 0\n0.1;2;5;9 2 0;8 2 0\n0.2;1;5;2 2 0;1 2 0\n"),
              "1 @0 /0.1: (1,2) (2,2); 2 @0 /0.1: (9,2); ");
    EXPECT_EQ(logged("$VISION\r\n* File\r\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY;COORDCENTZ\r\n1;0.2;1;2;0\r\n"
                     "1;0.4;2;2;0\r\n"),
              "1 @0 /0.2: (1,2) (2,2); ");
}

TEST(Logs, BadLogsAreNamed) {
    const std::string header = "Time,pose.position.x,pose.position.y\n";
    const struct {
        std::string text, message;
    } cases[] = {
        {header, "f: line 1: there is no row after the header; add samples"},
        {header + "0,1\n", "f: line 2: has 2 values but the header names 3; give every row all of them"},
        {header + "0,x,1\n", "f: line 2, column 2 (pose.position.x): 'x' is not a finite number; write it like 0.25"},
        {header + "0,1,1e10\n", "f: line 2, column 3 (pose.position.y): '1e10' is beyond 1e+09; check the units"},
        {header + "0,1,1\n0,2,1\n", "f: line 3: the time 0 of track 'robot' stands already in line 2; remove one"},
        {"$VISION\n$VEHICLE:SIMSEC;NO;LANE;POS\n1;2;3;4\n",
         "f: line 2: lacks one of SIMSEC, NO and coordinates; let VISSIM write them: CoordFront of vehicles, "
         "CoordCentX and CoordCentY of pedestrians"},
    };
    for (const auto& bad : cases) EXPECT_EQ(input_error([&] { parse_csv(bad.text, "f"); }), bad.message);
}

}  // namespace
}  // namespace mobbscope
