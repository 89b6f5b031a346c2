// Where radii come from on the command line: a number, a column, a file; and what classes have.
#include "run_program.h"

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

const std::string kDrone =
    "0 10 20 30 60 5 0 0 0 \"Pedestrian\"\n0 12 20 32 60 6 0 0 1 \"Pedestrian\"\n7 0 0 10 10 5 0 1 0 \"Car\"\n";

std::vector<double> radii_of(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"info", "--json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result run = run_program(all);
    EXPECT_EQ(run.status, 0) << run.err;
    std::vector<double> out;
    const json parsed = json::parse(run.out);
    for (const json& clip : parsed["clips"]) out.push_back(clip["max_radius"].get<double>());
    return out;
}

TEST(Radius, OfAClassIsSaidAloudOnce) {
    const TempFolder folder;
    const std::string file = folder.write("drone.txt", kDrone);
    EXPECT_EQ(radii_of({file}), (std::vector<double>{0.2, 2.25}));
    const std::string said = "by class 'Car' 2.25 m (1 track), 'Pedestrian' 0.2 m (1 track) are taken";
    for (const std::string command : {"info", "conflicts"}) {
        const Result run = run_program({command, file});
        const std::string& text = command == "info" ? run.out : run.err;
        const std::size_t at = text.find(said);
        ASSERT_NE(at, std::string::npos) << text;
        EXPECT_EQ(text.find(said, at + 1), std::string::npos) << "once: " << text;
    }
    const Result info = run_program({"info", file});
    EXPECT_NE(info.out.find("class        'Car'"), std::string::npos) << info.out;
    EXPECT_EQ(json::parse(run_program({"info", "--json", file}).out)["clips"][1]["class"], "Car");
}

TEST(Radius, IsANumberAColumnOrAFile) {
    const TempFolder folder;
    const std::string drone = folder.write("drone.txt", kDrone);
    const std::string radii = folder.write("radii.csv", "id,radius\n7,1.5\n*,0.3\n");
    EXPECT_EQ(radii_of({drone, "--radius", "0.5"}), (std::vector<double>{0.5, 0.5}));
    EXPECT_EQ(radii_of({drone, "--radius", radii}), (std::vector<double>{0.3, 1.5}));
    const std::string csv = folder.write("a.csv", "id,t,x,y,width\na,0,0,0,1\na,1,0,0,2\nb,0,9,9,3\nb,1,9,9,3\n");
    EXPECT_EQ(radii_of({csv, "--radius", "width"}), (std::vector<double>{2, 3}));
    const Result bad = run_program({"info", csv, "--radius", "length"});
    expect_refused(bad, 2, "names no column 'length' of radii");
}

TEST(Radius, OfAFileGoesIntoTheScene) {
    const TempFolder folder;
    const std::string drone = folder.write("drone.txt", kDrone);
    const std::string radii = folder.write("radii.csv", "class,radius\nCar,1.5\n*,0.3\n");
    const std::string scene = (folder.path() / "drone.json").string();
    ASSERT_EQ(run_program({"convert", drone, "-o", scene, "--radius", radii}).status, 0);
    EXPECT_EQ(radii_of({scene}), (std::vector<double>{0.3, 1.5}));
    // Clips with samples go by their names.
    const std::string by_id = folder.write("ids.csv", "id,radius\n0,4\n7,5\n");
    const Result run = run_program({"conflicts", scene, "--radius", by_id, "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(json::parse(run.out)["radius"].is_null());
    EXPECT_EQ(
        run_program({"conflicts", scene, "--radius", folder.write("none.csv", "id,radius\n7,5\n").string()}).status, 2);
}

TEST(Radius, OfAColumnIsAKeyOfAScene) {
    const TempFolder folder;
    folder.write("a.csv", "t,x,y,width\n0,0,0,1\n1,0,0,2\n");
    EXPECT_EQ(
        radii_of({folder.write("s.json", R"({"clips": {"a": {"source": "a.csv", "radius": "width"}}})").string()}),
        (std::vector<double>{2}));
}

}  // namespace
}  // namespace mobbscope
