// What SUMO writes of who moved where, as XML and as tables.
#include <base/text.h>
#include <import/import.h>
#include <import/tracks/sumo.h>
#include <import/tracks/text_rows.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mobbscope {
namespace {

/// "p @0.1: (0,0) (1,0); ...": who is there, from when on, and where; and what is said of it.
std::string walks(const std::string& text) {
    const TempFolder folder;
    std::string out;
    const auto clips = import_clips(folder.write("fcd.csv", text), {});
    for (const ImportedClip& clip : clips) {
        EXPECT_EQ(clip.facts.format, "sumo");
        out += clip.id + " @" + brief(clip.start) + ':';
        for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
        out += "; ";
    }
    for (const ImportWarning& warning : clips[0].facts.warnings) {
        if (warning.option.empty()) out += warning.text + "; ";
    }
    return out;
}

std::string step(const std::string& time, const std::string& who) {
    return "<timestep time=\"" + time + "\">\n" + who + "</timestep>\n";
}

TEST(Sumo, VehiclesAndPersonsAreReadFromXml) {
    const std::string text =
        "<?xml version=\"1.0\"?>\n<!-- made by > SUMO\n<configuration> -->\n<fcd-export>\n" + step("0.00", "") +
        step("0.10",
             "<vehicle id=\"v\" x=\"0\" y=\"1\" type=\"car\" speed=\"1\"/>\n<person id=\"p\" x=\"5\" y=\"5\"/>") +
        step("0.20",
             "<vehicle id=\"v\" x=\"1\" y=\"1\" type=\"car\"/>\n<person id=\"v\" x=\"6\" y=\"6\"/>"
             "<person id=\"p\" x=\"1\" y=\"1\" vehicle=\"v\"/><vehicle id=\"w\" x=\"-1073741824.00\" y=\"0\"/>") +
        "</fcd-export>\n";
    EXPECT_EQ(walks(text),
              "v @0: (0,1) (1,1); p @0: (5,5); person v @0.1: (6,6); 1 row of somebody who rides in a vehicle are left "
              "out; 1 row has no place and is left out; fill x and y in if they count; ");
    const TrackFile read = parse_sumo(text, "f");
    EXPECT_EQ(read.tracks[0].label, "car");
    EXPECT_EQ(read.tracks[1].label, "person");
    EXPECT_EQ(read.tracks[0].points[1].line, 11);
}

TEST(Sumo, SizesAndAnglesMakeBodies) {
    const TempFolder folder;
    const std::string car = "<vehicle id=\"v\" x=\"0\" y=\"1\" angle=\"90\" length=\"5\" width=\"1.8\"/>";
    const auto xml =
        import_clips(folder.write("fcd.xml", "<fcd-export>\n" + step("0", car) + step("1", car) + "</fcd-export>"), {});
    const auto table = import_clips(
        folder.write(
            "fcd.csv",
            "\"timestep_time\";\"vehicle_id\";\"vehicle_x\";\"vehicle_y\";\"vehicle_angle\";\"vehicle_length\";"
            "\"vehicle_width\"\n0;\"v\";0;1;90;5;1.8\n1;v;0;1;90;5;1.8\n"),
        {});
    std::vector<mobb::BodyDisk> body = mobb::rectangle_body(5, 1.8);
    for (mobb::BodyDisk& disk : body) disk.forward -= 2.5;  // SUMO's places are in front
    for (const auto* const read : {&xml, &table}) {
        EXPECT_EQ(read->at(0).body, body);
        EXPECT_EQ(read->at(0).headings, (std::vector<double>{0, 0})) << "east";
    }
}

TEST(Sumo, TablesHaveColumnsForEachKind) {
    for (const char separator : {';', ','}) {
        std::string text =
            "timestep_time;person_id;person_x;person_y;person_vehicle;vehicle_id;vehicle_x;vehicle_y;vehicle_type\n"
            "0.00;;;;;;;;\n"
            "1.00;p;1;2;;;;;\n"
            "1.00;;;;;v;5;6;car\n"
            "2.00;p;2;2;v;v;6;6;car\r\n"
            "3.00;p;3;2;;;;;\n";
        std::ranges::replace(text, ';', separator);
        EXPECT_EQ(walks(text),
                  "p @0: (1,2) (3,2); v @0: (5,6) (6,6); 1 row of somebody who rides in a vehicle are left out; ");
    }
}

TEST(Sumo, BadFilesAreNamed) {
    const std::string first = step("0", "<vehicle id=\"v\" x=\"0\" y=\"1\"/>\n");
    const struct {
        std::string text, message;
    } xml[] = {
        {"<fcd-export>\n" + first, "f: line 4: is not XML: "},
        {"<fcd-export></fcd-export>",
         "f: line 1, <fcd-export>: nobody has a place in any timestep; let SUMO write x and y"},
        {"<fcd-export>\n" + step("0:00:01", "") + "</fcd-export>",
         "f: line 2, <timestep>: time is '0:00:01', a time of day; run SUMO without --human-readable-time"},
        {"<fcd-export>\n<timestep/></fcd-export>", "f: line 2, <timestep>: has no time; add it"},
        {"<fcd-export>\n" + step("0", "<vehicle x=\"0\" y=\"1\"/>") + "</fcd-export>",
         "f: line 3, <vehicle>: has no id; add it"},
        {"<fcd-export>\n" + step("0", "<vehicle id=\"v\" y=\"1\"/>") + "</fcd-export>",
         "f: line 3, <vehicle>: has no x; add it"},
        {"<fcd-export>\n" + step("0", "<vehicle id=\"v\" x=\"1e10\" y=\"1\"/>") + "</fcd-export>",
         "f: line 3, <vehicle>: x is '1e10', beyond 1073741824"},
        {"<fcd-export>\n" + first + step("0", "<vehicle id=\"v\" x=\"1\" y=\"1\"/>\n") + "</fcd-export>",
         "f: line 6: the time 0 of track 'v' stands already in line 3; remove one"},
    };
    for (const auto& bad : xml)
        EXPECT_EQ(input_error([&] { parse_sumo(bad.text, "f"); }).substr(0, bad.message.size()), bad.message);
    const std::string header = "timestep_time;vehicle_id;vehicle_x;vehicle_y\n";
    const struct {
        std::string text, message;
    } tables[] = {
        {"timestep_time;vehicle_id;vehicle_x\n",
         "f: line 1: the header names no vehicle_x or _y; let SUMO write x and y"},
        {header + "0;;;\n", "f: line 2: there is no row after the header; add samples"},
        {header + "0;v;1\n", "f: line 2: has 3 values but the header names 4; give every row all of them"},
        {header + "x;v;1;2\n",
         "f: line 2, column 1 (timestep_time): 'x' is not a finite number; write it like 0.25, or a time like "
         "2021-06-01T12:00:00"},
    };
    for (const auto& bad : tables) EXPECT_EQ(input_error([&] { parse_csv(bad.text, "f"); }), bad.message);
}

}  // namespace
}  // namespace mobbscope
