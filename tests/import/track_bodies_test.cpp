// What files say of bodies becomes disks along the heading, and what they say of floors and heights keeps people apart.
#include "imported.h"

#include <import/clip/road_users.h>
#include <import/import.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Two rows of one track, with more columns.
std::string two_rows(const std::string& columns, const std::string& cells) {
    return "id,t,x,y," + columns + "\n1,0,0,0," + cells + "\n1,1,3,0," + cells + "\n";
}

std::string floors_of(const std::vector<ImportedClip>& clips) {
    std::string out;
    for (const ImportedClip& clip : clips)
        out += clip.id + ':' + clip.floor + '@' + brief(clip.start) + '+' + brief(clip.clip->duration()) + ' ';
    return out;
}

TEST(TrackBodies, LengthAndWidthBecomeDisksInARow) {
    const ImportedClip car = csv_clips(two_rows("length,width", "4.6,1.9"))[0];
    EXPECT_EQ(car.body, mobb::rectangle_body(4.6, 1.9));
    EXPECT_EQ(car.clip->samples()[1].r, mobb::body_reach(car.body));
    EXPECT_TRUE(car.headings.empty()) << "it looks where it goes";
    EXPECT_TRUE(warns(car, "1 body is of 4.6 x 1.9 m, as the columns 'length' and 'width' say"));
    EXPECT_TRUE(warns(car, "along the direction of motion; give radius for a plain disk"));
    EXPECT_FALSE(warns(car, "ignored"));
    EXPECT_EQ(csv_clips(two_rows("length_cm,width [cm]", "460,190"))[0].body, car.body);
    EXPECT_EQ(csv_clips(two_rows("l,w", "4.6,1.9"))[0].body, car.body);
    ImportOptions plain;
    plain.radius = 0.5;
    EXPECT_TRUE(csv_clips(two_rows("length,width", "4.6,1.9"), plain)[0].body.empty());
    EXPECT_TRUE(csv_clips(two_rows("length,width,r", "4.6,1.9,1"))[0].body.empty()) << "a radius is one";
    // Without ids a size is as good as a radius.
    EXPECT_EQ(csv_clips("t,x,y,length,width\n0,0,0,4.6,1.9\n1,3,0,4.6,1.9\n")[0].body, car.body);
}

TEST(TrackBodies, WhoStandsInThePartThatIsTakenKeepsItsHeading) {
    std::string text = "id,t,x,y,length,width\n";
    for (int t = 0; t < 6; ++t)
        text += "1," + std::to_string(t) + ",0," + std::to_string(std::min(t, 2)) + ",4.6,1.9\n";
    ImportOptions trimmed;
    trimmed.trim = {3, 5};
    const ImportedClip car = csv_clips(text, trimmed)[0];
    ASSERT_EQ(car.headings.size(), 3);
    for (const double heading : car.headings) EXPECT_NEAR(heading, 90, 1e-9);
}

/// A vehicle of a size that drives by so many metres from second to second.
std::string driven(std::initializer_list<int> steps, const std::string& columns = ",length,width",
                   const std::string& cells = ",4.6,1.9") {
    std::string text = "id,t,x,y" + columns + "\n";
    int t = 0, x = 0;
    text += "1,0,0,0" + cells + '\n';
    for (const int step : steps)
        text += "1," + std::to_string(++t) + ',' + std::to_string(x += step) + ",0" + cells + '\n';
    return text;
}

TEST(TrackBodies, WhoReversesInThePartThatIsTakenDoesNotTurnRound) {
    ImportOptions trimmed;
    trimmed.trim = {2, 5};
    const std::string there_and_back = driven({3, 3, 3, -3, -3, -3});
    EXPECT_EQ(csv_clips(there_and_back, trimmed)[0].headings, (std::vector<double>{0, 0, 0, 0}));
    // Of a body whose front is told from its back the direction counts.
    trimmed.body = {{1, 0, 1}, {-1, 0, 0.5}};
    const ImportedClip lorry = csv_clips(there_and_back, trimmed)[0];
    EXPECT_EQ(lorry.headings, (std::vector<double>{0, 180, 180, 180}));
    EXPECT_EQ(lorry.body, *trimmed.body) << "the body that is given goes over the columns";
    // A heading of the file is its heading.
    const std::string said = driven({3, -3}, ",length,width,heading", ",4.6,1.9,90");
    EXPECT_EQ(csv_clips(said)[0].headings, (std::vector<double>{90, 90, 90}));
}

TEST(TrackBodies, WhoNeverMovesAndHasNoHeadingIsTold) {
    const std::string words = "never moves and nobody says its heading: it lies along x";
    EXPECT_TRUE(warns(csv_clips(driven({0, 0}))[0], words));
    EXPECT_FALSE(warns(csv_clips(driven({0, 1}))[0], words));
    EXPECT_FALSE(warns(csv_clips(driven({0, 0}, ",length,width,heading", ",4.6,1.9,90"))[0], words));
    EXPECT_FALSE(warns(csv_clips(driven({0, 0}, ",r", ",1"))[0], words)) << "a disk is the same from all sides";
    // It moved before the part that is taken.
    ImportOptions trimmed;
    trimmed.trim = {1, 2};
    EXPECT_FALSE(warns(csv_clips(driven({1, 0}), trimmed)[0], words));
    EXPECT_TRUE(warns(csv_clips(driven({0, 0}), trimmed)[0], words));
}

TEST(TrackBodies, ABodyThatIsGivenNeedsNoRadius) {
    ImportOptions options;
    options.body = {{1, 0, 0.5}, {-1, 0, 0.5}};
    for (const char* const text : {"t,x,y\n0,0,0\n1,3,0\n", "id,t,x,y\n1,0,0,0\n1,1,3,0\n"}) {
        const ImportedClip clip = csv_clips(text, options)[0];
        EXPECT_EQ(clip.body, *options.body);
        EXPECT_EQ(clip.clip->samples()[1].r, 1.5) << "around all of it";
        EXPECT_TRUE(clip.facts.warnings.empty()) << said(clip.facts.warnings.front());
    }
    EXPECT_EQ(csv_clips("t,x,y,r\n0,0,0,2\n1,3,0,2\n", options)[0].clip->samples()[1].r, 2);
    const ImportedClip headed = csv_clips("id,t,x,y,heading\n1,0,0,0,90\n1,1,3,0,90\n", options)[0];
    EXPECT_EQ(headed.headings, (std::vector<double>{90, 90}));
    options.radius = 0.25;
    EXPECT_TRUE(csv_clips("t,x,y\n0,0,0\n1,3,0\n", options)[0].body.empty()) << "a radius is everyone's";
}

TEST(TrackBodies, HeadingsThatNobodyCanReadAreTold) {
    const ImportedClip car = csv_clips(two_rows("length,width,heading", "4.6,1.9,north"))[0];
    EXPECT_TRUE(warns(car, "2 rows have no heading that can be read"));
    ImportOptions turned;
    turned.columns = "heading=0-psi";
    const ImportedClip other = csv_clips(two_rows("length,width,psi", "4.6,1.9,-1.5707963267948966"), turned)[0];
    ASSERT_EQ(other.headings.size(), 2);
    EXPECT_NEAR(other.headings[0], 90, 1e-9) << "worked out, it is in radians by its values";
    EXPECT_TRUE(warns(csv_clips(two_rows("length,width", "4600,1900"))[0], "check the unit of their sizes"));
}

TEST(TrackBodies, LevelsThatAreNoFloorsKeepNobodyApart) {
    const auto noise = csv_clips("id,t,x,y,level\n1,0,0,0,0.31\n2,0,1,0,0.72\n1,1,1,0,0.31\n2,1,2,0,0.72\n");
    EXPECT_EQ(noise[0].floor, "");
    EXPECT_TRUE(warns(noise[0], "the levels of the rows are no floors, such as '0.31'"));
    // Heights in centimetres, of people who stay on their floors and hardly move in y.
    std::string text = "id,t,x,y,z_cm\n";
    for (int t = 0; t < 9; ++t) {
        text += "1," + std::to_string(t) + ',' + std::to_string(t) + ",0,0\n";
        text += "2," + std::to_string(t) + ',' + std::to_string(9 - t) + ",0.1,350\n";
    }
    const auto apart = csv_clips(text);
    EXPECT_NE(apart[0].floor, apart[1].floor);
    EXPECT_FALSE(warns(apart[0], "points up"));
    EXPECT_TRUE(csv_clips("id,t,x_min,y_min,x_max,y_max\n1,0,0,0,2,2\n1,1,1,0,3,2\n")[0].clip->samples()[0].x == 1)
        << "the least x is no x in minutes";
}

TEST(TrackBodies, SizesAreOfWholeTracks) {
    const auto read = csv_clips(
        "id,t,x,y,length,width,class\n1,0,0,0,4,2,\n1,1,1,0,5,2,\n1,2,2,0,5,2,\n2,0,0,9,0,0,pedestrian\n"
        "2,1,1,9,,nan,pedestrian\n");
    EXPECT_EQ(read[0].body, mobb::rectangle_body(5, 2));
    EXPECT_TRUE(read[1].body.empty());
    EXPECT_EQ(read[1].clip->samples()[0].r, 0.2);
    EXPECT_TRUE(warns(read[0], "of sizes that vary along a track the median is taken"));
    EXPECT_TRUE(warns(read[0], "of others by class 'pedestrian' 0.2 m (1 track) are taken"));
}

TEST(TrackBodies, OneSideAloneIsNoBody) {
    const ImportedClip person = csv_clips(two_rows("width", "0.5"))[0];
    EXPECT_TRUE(person.body.empty());
    EXPECT_EQ(person.clip->samples()[0].r, 0.2);
    EXPECT_TRUE(warns(person, "'width' is ignored"));
    EXPECT_EQ(csv_clips(two_rows("diameter", "0.5"))[0].clip->samples()[0].r, 0.25);
    EXPECT_EQ(csv_clips(two_rows("diameter_cm", "50"))[0].clip->samples()[0].r, 0.25);
    EXPECT_EQ(csv_clips(two_rows("r,diameter", "0.3,0.5"))[0].clip->samples()[0].r, 0.3);
    // Boxes tell centres, and bodies to who says so.
    const std::string boxes = "frame,id,x,y,width,height\n0,1,0,0,4,2\n1,1,1,0,4,2\n";
    ImportOptions options;
    options.fps = 25;
    EXPECT_TRUE(csv_clips(boxes, options)[0].body.empty());
    EXPECT_TRUE(warns(csv_clips(boxes, options)[0], "(length=width,width=height) for bodies"));
    options.columns = "length=width,width=height";
    EXPECT_EQ(csv_clips(boxes, options)[0].body, mobb::rectangle_body(4, 2));
    EXPECT_EQ(csv_clips(boxes, options)[0].clip->samples()[0].x, 2);
}

TEST(TrackBodies, PlacesOfNgsimAreInFront) {
    const ImportedClip car = csv_clips(
        "Vehicle_ID,Global_Time,Local_X,Local_Y,v_Length,v_Width\n1,1118846980000,0,0,15,6\n1,1118846980100,0,3,15,6\n")
        [0];
    const double length = 15 * 0.3048;
    ASSERT_EQ(car.body.size(), mobb::rectangle_body(length, 6 * 0.3048).size());
    EXPECT_NEAR(car.body.front().forward, mobb::rectangle_body(length, 6 * 0.3048).front().forward - length / 2, 1e-12);
    EXPECT_LT(car.body.back().forward, 0);
    EXPECT_TRUE(warns(car, "x and y are the middle of the front"));
}

TEST(TrackBodies, HeadingsAreDegreesAtEachSample) {
    const auto heading = [](const std::string& name, const std::string& value) {
        const ImportedClip car = csv_clips(two_rows("length,width," + name, "4,2," + value))[0];
        EXPECT_EQ(car.headings.size(), 2u) << name;
        return car.headings.at(1);
    };
    EXPECT_NEAR(heading("psi_rad", "1.5707963267948966"), 90, 1e-9);
    EXPECT_NEAR(heading("yaw", "-1.5707963267948966"), -90, 1e-9);
    EXPECT_EQ(heading("heading", "90"), 90);
    EXPECT_EQ(heading("angle [deg]", "3"), 3);
    EXPECT_TRUE(warns(csv_clips(two_rows("length,width,theta", "4,2,0.5"))[0],
                      "the heading (the column 'theta', in radians by its values)"));
    // From 350 to 10 degrees by the shorter way, also where a row is filled in; and turned with the path.
    ImportOptions options;
    const std::string text =
        "id,t,x,y,length,width,heading\n1,0,0,0,4,2,350\n1,1,0,1,4,2,\n1,3,0,3,4,2,10\n1,4,0,4,4,2,10\n";
    EXPECT_EQ(csv_clips(text)[0].headings, (std::vector<double>{350, 350, 360, 370, 370}));
    options.origin = Origin::start_heading;
    EXPECT_NEAR(csv_clips(text, options)[0].headings[0], 260, 1e-9);
    // Nobody's heading matters who is a disk.
    EXPECT_TRUE(warns(csv_clips(two_rows("heading", "90"))[0], "'heading' is ignored"));
}

TEST(TrackBodies, ClassesHaveUsualSizes) {
    const auto of = [](const std::string& label) { return csv_clips(two_rows("class", label))[0]; };
    EXPECT_EQ(of("car").body, mobb::rectangle_body(4.5, 1.8));
    EXPECT_EQ(of("Car").body, of("car").body);
    EXPECT_EQ(of("truck_bus").body, mobb::rectangle_body(10, 2.55));
    EXPECT_EQ(of("Bicyclist").body, mobb::rectangle_body(1.8, 0.6));
    EXPECT_EQ(of("ADULT").clip->samples()[0].r, 0.2);
    EXPECT_EQ(of("Skater").clip->samples()[0].r, 0.3);
    EXPECT_EQ(of("dog").clip->samples()[0].r, 0.2);
    EXPECT_TRUE(warns(of("car"), "by class 'car' 4.5 x 1.8 m (1 track) are taken"));
    EXPECT_TRUE(warns(of("dog"), "'dog' 0.2 m (1 track, a class without a usual radius)"));
    EXPECT_EQ(road_user("moped")->radius, 1) << "no pedestrian";
    EXPECT_EQ(road_user("scar"), nullptr);
}

TEST(TrackBodies, FloorsAreNamedOrFoundInHeights) {
    EXPECT_EQ(floors_of(csv_clips("id,t,x,y,level\n1,0,0,0,1\n2,0,0,0,2.0\n1,1,1,0,1.0\n2,1,1,0,2\n")),
              "1:1@0+1 2:2@0+1 ");
    const auto by_height = csv_clips("id,t,x,y,z\n1,0,0,0,0.1\n2,0,0,0,3.5\n1,1,1,0,0.2\n2,1,1,0,3.4\n");
    EXPECT_EQ(floors_of(by_height), "1:z 0.1@0+1 2:z 3.4@0+1 ");
    EXPECT_TRUE(warns(by_height[0], "heights (z) are on 2 floors at least 2.2 m apart"));
    // Children, stairs and ramps are no floors.
    EXPECT_EQ(floors_of(csv_clips("id,t,x,y,z\n1,0,0,0,0.9\n2,0,0,0,1.9\n1,1,1,0,0.9\n2,1,1,0,1.9\n")),
              "1:@0+1 2:@0+1 ");
    const auto stairs = csv_clips("id,t,x,y,z\n1,0,0,0,0\n1,1,1,0,1.5\n1,2,2,0,3\n2,0,0,1,3\n2,1,1,1,3\n2,2,2,1,3\n");
    EXPECT_EQ(floors_of(stairs), "1:@0+2 2:@0+2 ");
    EXPECT_TRUE(warns(stairs[0], "form no floors"));
    // Drones pass above each other.
    EXPECT_EQ(
        floors_of(csv_clips("id,t,x,y,z,class\n1,0,0,0,1,drone\n2,0,0,0,3,UAV\n1,1,1,0,1,drone\n2,1,1,0,3,UAV\n")),
        "1:z 1@0+1 2:z 3@0+1 ");
}

TEST(TrackBodies, WhoChangesFloorsIsOnBothMeanwhile) {
    const auto read = csv_clips("id,t,x,y,floor\n1,0,0,0,G\n1,1,1,0,G\n1,2,2,0,\n1,3,3,0,1\n1,4,4,0,1\n");
    EXPECT_EQ(floors_of(read), "1:G@0+3 1#2:1@2+2 ");
    EXPECT_TRUE(warns(read[0], "1 change of floors is seen: tracks are split there"));
}

TEST(TrackBodies, PublicFilesSayBodies) {
    const auto folder = kSharedData / "public2";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    ImportOptions fps;
    fps.fps = 25;
    for (const char* const name : {"cars_length_width.csv", "exid_overlap.csv"}) {
        for (const ImportedClip& car :
             import_clips(folder / name, std::string(name)[0] == 'e' ? fps : ImportOptions())) {
            EXPECT_EQ(car.body, mobb::rectangle_body(4.6, 1.9)) << name;
            EXPECT_EQ(car.facts.doubt, "") << "cars of 25 m/s";
        }
    }
    EXPECT_FALSE(import_clips(folder / "ngsim_overlap.csv", {})[0].body.empty());
    EXPECT_NE(import_clips(folder / "two_floors.csv", {})[0].floor,
              import_clips(folder / "two_floors.csv", {})[1].floor);
    EXPECT_EQ(import_clips(folder / "plan_three_dims.yaml", {})[1].floor, "z 3");
    for (const char* const name : {"sumo_fcd.xml", "people_height_only.csv", "atc_header.csv", "pathfinder.csv"}) {
        const auto read = import_clips(folder / name, {});
        EXPECT_TRUE(read[0].body.empty() && read[0].floor == read[1].floor) << name;
        EXPECT_EQ(read[0].clip->samples()[0].r, 0.2) << name;
    }
}

}  // namespace
}  // namespace mobbscope
