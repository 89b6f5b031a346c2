// Tables as people have them: names of columns, boxes, units, separators, comments; and the option columns.
#include "imported.h"

#include <import/clip/column_choice.h>
#include <import/import.h>
#include <import/tracks/text_rows.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

ImportOptions with_fps(double fps) {
    ImportOptions options;
    options.fps = fps;
    return options;
}

ImportOptions with_columns(const char* columns) {
    ImportOptions options;
    options.columns = columns;
    return options;
}

struct Place {
    double x, y, r;
    friend bool operator==(const Place&, const Place&) = default;
};

/// Where the second sample is.
Place second(const ImportedClip& clip) {
    const mobb::Disk& disk = clip.clip->samples()[1];
    return {disk.x, disk.y, disk.r};
}

TEST(TableKinds, ColumnsThatMeanNothingArePassedOverWithOneWarning) {
    const std::pair<const char*, const char*> tables[] = {
        {"id,t,x,y,r,vx,vy\n1,0,0,0,0.3,1,0\n1,0.1,0.1,0,0.3,1,0\n", "the columns 'vx' and 'vy' are ignored"},
        {",id,t,x,y,r\n0,1,0,0,0,0.3\n1,1,0.1,0.1,0,0.3\n", "a column without a name is ignored"},
        {"Unnamed: 0,id,t,x,y,r\n0,1,0,0,0,0.3\n1,1,0.1,0.1,0,0.3\n", "the column 'Unnamed: 0' is ignored"},
        {"id,t,x,y,r,who\n1,0,0,0,0.3,\"Ann, B\"\n1,0.1,0.1,0,0.3,\n", "the column 'who' is ignored"},
        {"speed,id,kind,t,x,y,r\nfast,1,,0,0,0,0.3\nnan,1,car,0.1,0.1,0,0.3\n", "'speed' and 'kind' are ignored"},
        {",id,t,x,y,r,a\n0,1,0,0,0,0.3,1\n1,1,0.1,0.1,0,0.3,1\n", "'a' and a column without a name are ignored"},
    };
    for (const auto& [text, warning] : tables) {
        const auto read = csv_clips(text);
        ASSERT_EQ(read.size(), 1u) << text;
        EXPECT_EQ(read[0].clip->count(), 2);
        EXPECT_DOUBLE_EQ(second(read[0]).x, 0.1) << text;
        ASSERT_EQ(read[0].facts.warnings.size(), 1u) << text;
        EXPECT_TRUE(warns(read[0], warning)) << read[0].facts.warnings[0].text;
    }
}

TEST(TableKinds, ManyColumnsAreCountedInTheWarning) {
    std::string header = "t,x,y,r", row = "0,0,0,1", next = "1,2,0,1";
    for (int i = 0; i < 100; ++i) {
        header += ",c" + std::to_string(i);
        row += ",text";
        next += ",";
    }
    const auto read = csv_clips(header + '\n' + row + '\n' + next + '\n');
    EXPECT_TRUE(warns(read[0], "'c7' and 92 more are ignored")) << read[0].facts.warnings[0].text;
    EXPECT_EQ(second(read[0]).x, 2);
}

TEST(TableKinds, ColumnsGoByTheirUsualNames) {
    for (const char* header :
         {"id,t,x,y,r", "ID,T,X,Y,R", "trackId,time,xCenter,yCenter,radius", "Track_ID,Time,x_center,y_center,Radius",
          "pedID,time,posX,posY,r", "agent_id,seconds,x_pos,y_pos,radius", "Person ID,time [s],x [m],y [m],r [m]",
          "vehicle_id,timestamp_s,x_m,y_m,radius_m", "objid,sec,centre_x,centre_y,r", "PersID,t/s,X/m,Y/m,r/m",
          "ped,simTime,position_x,position_y,r", "traj_id,secs,Easting,Northing,r",
          "uid,elapsed_time_s,world_x,y_world,r", "pid,time,utm_x,y_utm,r"}) {
        const auto read =
            csv_clips(std::string(header) + "\n7,0,1,2,0.25\n7,0.5,3,4,0.25\n8,1,0,0,0.5\n8,1.5,0,0,0.5\n");
        ASSERT_EQ(read.size(), 2u) << header;
        EXPECT_EQ(read[0].id, "7");
        EXPECT_EQ(read[0].clip->dt(), 0.5) << header;
        EXPECT_EQ(second(read[0]), (Place{3, 4, 0.25})) << header;
        EXPECT_EQ(read[1].start, 1) << header;
        EXPECT_TRUE(read[0].facts.warnings.empty()) << header << read[0].facts.warnings[0].text;
    }
}

TEST(TableKinds, TwoColumnsForOneAreRefusedWithAHint) {
    EXPECT_EQ(csv_refusal("id,trackId,t,x,y\n1,1,0,0,0\n"),
              "f.csv: line 1, column 2: 'id' and 'trackId' may both be id; say which by the option columns, such as "
              "id=trackId");
    EXPECT_NE(csv_refusal("id,t,x,y,xCenter,yCenter\n1,0,0,0,0,0\n").find("'x' and 'xCenter' may both be x"),
              std::string::npos);
    EXPECT_NE(csv_refusal("id,t,time,x,y\n1,0,0,0,0\n").find("'t' and 'time' may both be t"), std::string::npos);
    EXPECT_NE(csv_refusal("x,X,y,t,r\n1,0,0,0,0\n").find("'x' and 'X' may both be x"), std::string::npos);
    EXPECT_NE(csv_refusal("t,x,y,r,radius\n1,0,0,0,0\n").find("'r' and 'radius' may both be r"), std::string::npos);
    // One that may mean something else gives way.
    EXPECT_EQ(csv_clips("id,agent,t,timestamp,x,y,r\n1,car,0,1e9,0,0,1\n1,car,2,1e9,0,0,1\n")[0].clip->dt(), 2);
    ImportOptions said = with_columns("id=trackId");
    EXPECT_EQ(csv_clips("id,trackId,t,x,y\n1,a,0,0,0\n2,a,1,0,0\n", said)[0].id, "a");
}

TEST(TableKinds, FramesBecomeTimesByFps) {
    const std::string text = "id,frame,x,y\n1,10,0,0\n1,11,1,0\n1,12,2,0\n2,20,0,0\n2,21,1,0\n";
    EXPECT_EQ(csv_refusal(text),
              "f.csv: line 1: the rows have frame numbers in place of times: give fps (frames a second), or dt "
              "(seconds from one frame to the next)");
    for (const bool by_dt : {false, true}) {
        ImportOptions options;
        (by_dt ? options.dt : options.fps) = by_dt ? 0.25 : 4;
        const auto read = csv_clips(text, options);
        ASSERT_EQ(read.size(), 2u);
        EXPECT_EQ(read[0].clip->dt(), 0.25);
        EXPECT_EQ(read[0].clip->count(), 3) << "fps is the file's, and resamples nothing";
        EXPECT_EQ(read[1].start, 2.5);
        EXPECT_EQ(read[0].clip->samples()[0].r, kDefaultTrackRadius);
        EXPECT_TRUE(warns(read[0], "the file has no radii: 0.2 m are taken"));
        EXPECT_EQ(read[0].facts.warnings.size(), 1u);
    }
    // A comment may tell it, and times of their own go before frames.
    EXPECT_EQ(csv_clips("# framerate: 8\n" + text)[0].clip->dt(), 0.125);
    EXPECT_EQ(csv_clips("frame,id,t,x,y\n0,1,0,0,0\n30,1,2,0,0\n")[0].clip->dt(), 2);
    // One motion.
    ImportOptions one = with_fps(10);
    one.radius = 0.5;
    EXPECT_NEAR(csv_clips("frame,x,y\n100,0,0\n101,1,0\n102,2,0\n", one)[0].clip->dt(), 0.1, 1e-12);
    EXPECT_NEAR(csv_clips("frame,x,y\n100,0,0\n", one)[0].clip->dt(), 0.1, 1e-12);
}

TEST(TableKinds, RowsOfTracksMayComeInAnyOrder) {
    const auto read = csv_clips("id,frame,x,y\n1,2,2,0\n2,0,9,0\n1,0,0,0\n1,1,1,0\n2,1,8,0\n", with_fps(1));
    EXPECT_EQ(second(read[0]).x, 1);
    EXPECT_EQ(second(read[1]).x, 8);
    EXPECT_EQ(csv_refusal("id,t,x,y\n1,2,2,0\n1,0,0,0\n1,2,1,0\n"),
              "f.csv: line 4: the time 2 of track '1' stands already in line 2; remove one");
}

TEST(TableKinds, OfBoxesTheCentresAreTaken) {
    const std::pair<const char*, const char*> tables[] = {
        // highD
        {"frame,id,x,y,width,height,xVelocity\n1,1,10,4,5,2,40\n2,1,12,4,5,2,40\n", "x+width/2, y+height/2"},
        {"id,frame,xmin,ymin,xmax,ymax\n1,1,10,4,15,6\n1,2,12,4,17,6\n", "(xmin+xmax)/2, (ymin+ymax)/2"},
        {"frame,id,bb_left,bb_top,bb_width,bb_height\n1,1,10,4,5,2\n2,1,12,4,5,2\n", "bb_left+bb_width/2"},
        {"frame,id,left,top,width,height\n1,1,10,4,5,2\n2,1,12,4,5,2\n", "left+width/2"},
        {"frame,track_id,x1,y1,x2,y2\n1,1,10,4,15,6\n2,1,12,4,17,6\n", "(x1+x2)/2"},
        {"Frame,ID,X,Y,Width,Height\n1,1,10,4,5,2\n2,1,12,4,5,2\n", "X+Width/2"},
    };
    for (const auto& [text, said] : tables) {
        const auto read = csv_clips(text, with_fps(25));
        EXPECT_EQ(second(read[0]).x, 14.5) << text;
        EXPECT_EQ(second(read[0]).y, 5) << text;
        EXPECT_TRUE(warns(read[0], said)) << text;
        EXPECT_TRUE(warns(read[0], "taken for boxes"));
    }
    // inD has centres, and a body has a length too.
    EXPECT_EQ(
        second(csv_clips("trackId,frame,xCenter,yCenter,width,length\n1,0,1,2,2,5\n1,1,3,2,2,5\n", with_fps(25))[0]).x,
        3);
    EXPECT_EQ(second(csv_clips("id,t,x,y,length,width,height\n1,0,1,2,2,5,1\n1,1,3,2,2,5,1\n")[0]).x, 3);
    ImportOptions corners = with_columns("x=x,y=y");
    corners.fps = 25;
    const auto read = csv_clips(tables[0].first, corners);
    EXPECT_EQ(second(read[0]).x, 12);
    EXPECT_FALSE(warns(read[0], "boxes"));
}

TEST(TableKinds, UnitsOfMinutesHoursAndInches) {
    EXPECT_EQ(csv_clips("t [min],x [in],y [in],r [in]\n0,0,0,10\n1,100,0,10\n")[0].clip->dt(), 60);
    EXPECT_EQ(csv_clips("t/h,x,y,r\n0,0,0,1\n1,1,0,1\n")[0].clip->dt(), 3600);
    EXPECT_DOUBLE_EQ(second(csv_clips("t,x [in],y [in],r [in]\n0,0,0,10\n1,100,0,10\n")[0]).x, 2.54);
    for (const char* header :
         {"t,x [km],y [km],r [km]\n", "t,x_km,y_km,r_km\n", "t,x/km,y/kilometres,r (kilometers)\n"})
        EXPECT_DOUBLE_EQ(second(csv_clips(header + std::string("0,0,0,0.0002\n1,0.001,0,0.0002\n"))[0]).x, 1);
    // What programs write of whole numbers where some are missing.
    EXPECT_EQ(csv_clips("id,t,x,y\n1,0,0,0\n1.0,1,1,0\n").size(), 1u);
    EXPECT_EQ(csv_clips("id,t,x,y\n1.0,0,0,0\n1.0,1,0,0\n1.05,1,1,0\n").size(), 2u);
}

TEST(TableKinds, DataSetsOfTrafficAreRead) {
    const auto ngsim = csv_clips(
        "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_length,Location\n"
        "2,13,437,1118846980200,10,30,6451137.641,1873344.962,14.5,us-101\n"
        "2,14,437,1118846980300,10,40,6451140.329,1873342.0,14.5,us-101\n"
        "2,15,437,1118846980400,10,50,6451143.018,1873339.04,14.5,us-101\n");
    EXPECT_NEAR(ngsim[0].clip->dt(), 0.1, 1e-7);
    EXPECT_DOUBLE_EQ(second(ngsim[0]).y, 40 * 0.3048);
    EXPECT_TRUE(warns(ngsim[0], "a unit of length is 0.3048 m, as the column 'Local_X' says"));
    EXPECT_NEAR(ngsim[0].facts.t0.value(), 1118846980.2, 1e-6);
    ImportOptions metres;
    metres.unit = "m";
    EXPECT_EQ(csv_clips("vehicle_id,t,local_x,local_y\n1,0,1,2\n1,1,3,4\n", metres)[0].clip->samples()[1].y, 4);

    const auto interaction = csv_clips(
        "case_id,track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n"
        "1,3,1,100,car,0,0,1,1,0,4,2\n1,3,2,200,car,1,0,1,1,0,4,2\n1,3,3,300,car,2,0,1,1,0,4,2\n");
    EXPECT_DOUBLE_EQ(interaction[0].clip->dt(), 0.1);
    EXPECT_EQ(interaction[0].facts.t0, 0.1);

    const auto argoverse = csv_clips(
        "TIMESTAMP,TRACK_ID,OBJECT_TYPE,X,Y,CITY_NAME\n315968000.1,0-1,AGENT,1,2,MIA\n315968000.2,0-1,AGENT,1.5,2,MIA\n"
        "315968000.3,0-1,AGENT,2,2,MIA\n");
    EXPECT_NEAR(argoverse[0].clip->dt(), 0.1, 1e-7);
    EXPECT_EQ(argoverse[0].id, "0-1");
    EXPECT_TRUE(warns(argoverse[0], "the column 'TIMESTAMP' is taken for seconds; give columns (t=TIMESTAMP/1000)"));

    const auto ind = csv_clips(
        "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,lonVelocity\n"
        "0,4,100,0,10,5,90,1.9,4.5,\n0,4,101,1,10.4,5,90,1.9,4.5,1\n",
        with_fps(25));
    EXPECT_EQ(second(ind[0]).x, 10.4);
    EXPECT_EQ(ind[0].clip->dt(), 0.04);
}

TEST(TableKinds, NamesRowsAndCommentsTellUnits) {
    for (const char* head :
         {"id,t,x/cm,y/cm,r/cm\n", "id,t,x [cm],y [cm],r [cm]\n", "id,t,x_cm,y_cm,r_cm\n", "id,t,x,y,r\n,s,cm,cm,cm\n",
          "# all lengths in cm\nid,t,x,y,r\n", "# unit: cm\nid,t,x,y,r\n"}) {
        const auto read = csv_clips(std::string(head) + "1,0,0,0,30\n1,1,100,50,30\n");
        EXPECT_EQ(read[0].facts.unit, 0.01) << head;
        EXPECT_EQ(second(read[0]), (Place{1, 0.5, 0.3})) << head;
        EXPECT_TRUE(warns(read[0], "a unit of length is 0.01 m")) << head;
    }
    ImportOptions said;
    said.unit = "m";
    EXPECT_EQ(second(csv_clips("id,t,x/cm,y/cm,r\n1,0,0,0,30\n1,1,100,50,30\n", said)[0]).x, 100);
    // A radius in metres beside places in centimetres.
    EXPECT_DOUBLE_EQ(second(csv_clips("id,t,x/cm,y/cm,r/m\n1,0,0,0,0.3\n1,1,100,50,0.3\n")[0]).r, 0.3);
    EXPECT_EQ(second(csv_clips("t [ms],x,y,r\n0,0,0,1\n500,1,0,1\n")[0]).x, 1);
    EXPECT_EQ(csv_clips("t [ms],x,y,r\n0,0,0,1\n500,1,0,1\n")[0].clip->dt(), 0.5);
}

TEST(TableKinds, OtherSignsMayPartFields) {
    const auto plain = csv_clips("id,t,x,y,r\n1,0,0.5,0,1\n1,1,1.5,0,1\n");
    for (const char* text :
         {"id;t;x;y;r\n1;0;0.5;0;1\n1;1;1.5;0;1\n", "id\tt\tx\ty\tr\n1\t0\t0.5\t0\t1\n1\t1\t1.5\t0\t1\n",
          "id t x y r\n1 0 0.5 0 1\n1  1 1.5\t0 1\n", "id;t;x;y;r\n1;0;0,5;0;1\n1;1;1,5;0;1\n",
          "#id,t,x,y,r\n1,0,0.5,0,1\n1,1,1.5,0,1\n", "# made by hand\n# id, t, x, y, r\n1,0,0.5,0,1\n1,1,1.5,0,1\n",
          "\tid\tt\tx\ty\tr\tnote\n0\t1\t0\t0.5\t0\t1\t\n1\t1\t1\t1.5\t0\t1\t\n",
          "id|t|x|y|r\n1|0|0.5|0|1\n1|1|1.5|0|1\n", "sep=;\nid;t;x;y;r\n1;0;0.5;0;1\n1;1;1.5;0;1\n",
          "id,t,\"x\n[m]\",y,r\n1,0,0.5,0,1\n1,1,1.5,0,1\n"}) {
        const auto read = csv_clips(text);
        ASSERT_EQ(read.size(), 1u) << text;
        EXPECT_EQ(second(read[0]), second(plain[0])) << text;
    }
    EXPECT_TRUE(warns(csv_clips("t;x;y;r\n0;0,5;0;1\n1;1;0;1\n")[0], "commas within numbers"));
    EXPECT_NE(csv_refusal("t;x;y;r\n0;1.000,5;0;1\n").find("'1.000,5' is not a finite number"), std::string::npos);
}

TEST(TableKinds, BlanksPartNamesWhereNumbersStandBelow) {
    for (const char* text :
         {"who tick east north\n1 0 0.5 2\n1 1 0.6 2\n", "# made by\nwho\ttick\teast\tnorth\n1\t0\t0.5\t2\n"})
        EXPECT_TRUE(looks_like_table(text)) << text;
    for (const char* text : {"who walked where today\nand then went back\n", "who tick east north\n1 0 0.5\n",
                             "1 0 0.5 2\n1 1 0.6 2\n", "a b\n1 2\n", "who tick east north\n", ""})
        EXPECT_FALSE(looks_like_table(text)) << text;
}

TEST(TableKinds, WhatIsMissingIsSaid) {
    EXPECT_EQ(csv_refusal("1,0,0,0\n1,1,0,0\n"),
              "f.csv: line 1: there is no header; begin the file with a line that names the columns, such as t,x,y,r");
    EXPECT_NE(csv_refusal("1,0,0,car\n").find("there is no header"), std::string::npos);
    for (const char* places : {"lat,lon", "x [deg],y [deg]", "x_deg,y_deg"})
        EXPECT_NE(
            csv_refusal(std::string("id,t,") + places + "\n1,0,50,8\n").find("are degrees: turn them into metres"),
            std::string::npos)
            << places;
    EXPECT_NE(csv_refusal("id,t,east,north\n1,0,50,8\n").find("say what it is by the option columns, such as x=east"),
              std::string::npos);
    EXPECT_NE(csv_refusal("id,t,z,x [px],y [px]\n1,0,0,50,8\n").find("such as x=x [px]"), std::string::npos);
    EXPECT_NE(csv_refusal("id,timestep,x,y\n1,0,0,0\n").find("frame numbers in place of times"), std::string::npos);
    const std::string tracks = "who,t,x,y,r\na,0,0,0,1\na,1,0,0,1\nb,0,0,0,1\n";
    EXPECT_EQ(csv_refusal(tracks),
              "f.csv: line 4, column 2 (t): the time does not come after 1 of the row before; sort the rows and remove "
              "doubles, or, if these are several tracks, say which column names them, such as columns id=who");
    EXPECT_EQ(csv_clips(tracks, with_columns("id=who")).size(), 2u);
    EXPECT_NE(
        csv_refusal("id,time,x,y\n1,2024-05-41 12:00:00.1,0,0\n").find("0.25, or a time like 2021-06-01T12:00:00"),
        std::string::npos);
    EXPECT_NE(csv_refusal("# a\n# b\n").find("blank lines and comments"), std::string::npos);
}

TEST(TableColumns, TheOptionSaysOrWorksOutColumns) {
    const std::string text = "who;frame;east;north;wide\nAnn;0;1;2;0.6\nAnn;5;3;4;0.6\nBob;5;0;0;1\nBob;10;0;0;1\n";
    const auto read = csv_clips(text, with_columns("id=who,t=frame/25,x=east,y=north,r=wide/2"));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].id, "Ann");
    EXPECT_EQ(read[0].clip->dt(), 0.2);
    EXPECT_EQ(second(read[0]), (Place{3, 4, 0.3}));
    EXPECT_EQ(read[1].start, 0.2);
    EXPECT_TRUE(read[0].facts.warnings.empty());
    const auto turned =
        csv_clips(text, with_columns("id=WHO, t = frame * 0.04, x = -(north - 2*east)/2, y=\"east\", r=0.25"));
    EXPECT_EQ(second(turned[0]), (Place{1, 3, 0.25}));
    ImportOptions frames = with_columns("id=who,frame=frame,x=east,y=north");
    frames.fps = 5;
    EXPECT_EQ(csv_clips(text, frames)[0].clip->dt(), 1);
    // Names that look like something else.
    EXPECT_EQ(second(csv_clips("t,a-b,x+1,2,r\n0,1,2,3,1\n1,4,5,6,1\n", with_columns("x=a-b,y=x+1+\"2\""))[0]),
              (Place{4, 11, 1}));
    const auto refused = [&](const char* columns) { return csv_refusal(text, with_columns(columns)); };
    EXPECT_NE(refused("id=who,t=fram/25,x=east,y=north").find("names no column 'fram' (did you mean 'frame'?)"),
              std::string::npos);
    EXPECT_NE(refused("id=who+frame,x=east,y=north").find("id is one column"), std::string::npos);
    EXPECT_NE(refused("x=(east,y=north").find("lacks a ')'"), std::string::npos);
    EXPECT_NE(refused("x=east east,y=north").find("expects an operator"), std::string::npos);
    EXPECT_NE(refused("x=east+,y=north").find("ends where a column or a number is expected"), std::string::npos);
    EXPECT_NE(refused("id=who,t=frame/0,x=east,y=north,r=1").find("line 2, column 2 (frame): t becomes"),
              std::string::npos);
    EXPECT_NE(refused("id=who,t=who,x=east,y=north,r=1").find("'Ann' is not a finite number"), std::string::npos);
    EXPECT_NE(refused(("id=who,y=north,x=" + std::string(100, '(')).c_str()).find("too deep"), std::string::npos);
}

TEST(TableColumns, WhatIsNoChoiceIsRefusedWithoutAFile) {
    for (const char* bad : {"", "x", "x=", "=a", "q=a", "x=a,x=b", "x=a,,y=b", "t=a,frame=b", "x=a,"}) {
        EXPECT_THROW(chosen_columns(bad), std::invalid_argument) << bad;
    }
    EXPECT_EQ(chosen_columns(" x = a , y=\"b,c\" ").at(1).text, "\"b,c\"");
}

TEST(TableColumns, AFileIsReadAnewForOtherColumns) {
    const TempFolder folder;
    const ParsedFile file = parse_clip_file(folder.write("a.csv", "id,t,a,b\n1,0,1,2\n1,1,3,4\n"));
    EXPECT_EQ(second(file.clips(with_columns("x=a,y=b")).front()).x, 3);
    EXPECT_EQ(second(file.clips(with_columns("x=b,y=a")).front()).x, 4);
    EXPECT_EQ(second(file.clips(with_columns("x=a,y=b")).front()).x, 3);
    EXPECT_EQ(file.offer(with_columns("x=a,y=b")).find("columns")->taken, "");
    ImportOptions columns = with_columns("x=a,y=b");
    EXPECT_NE(input_error([&] {
                  import_clips(folder.write("a.txt", "0 1 0 0\n10 1 1 0\n"), columns);
              }).find("columns are for tables with a header"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
