// conflicts --within, --min-duration, --csv and --part; merge.
#include "run_program.h"

#include <base/file.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

// ann and bob walk towards each other in y = 0 and 1 at 1 m/s each, so that they are 0.6 m apart where they pass; cid
// follows ann 1 m behind and 0.1 m aside, and dan stands far off.
const std::string kFour =
    "id,t,x,y,r\nann,0,0,0,0.2\nann,1,1,0,0.2\nann,2,2,0,0.2\nann,3,3,0,0.2\nbob,0,4,1,0.2\nbob,1,3,1,0.2\n"
    "bob,2,2,1,0.2\nbob,3,1,1,0.2\ncid,1,0,0.1,0.2\ncid,2,1,0.1,0.2\ncid,3,2,0.1,0.2\ndan,0,50,50,0.2\n"
    "dan,1,50,50,0.2\n";

std::vector<std::string> encounters(const std::string& file, const std::vector<std::string>& options = {}) {
    std::vector<std::string> out{"conflicts", file, "--within", "0.7"};
    out.insert(out.end(), options.begin(), options.end());
    return out;
}

TEST(EncountersCommand, JsonHasWhatTrafficEngineersAskAndChains) {
    const TempFolder folder;
    const std::string file = folder.write("four.csv", kFour);
    const json found = json_of(encounters(file));
    EXPECT_EQ(found["within"], 0.7);
    ASSERT_EQ(found["conflicts"].size(), 3u);
    const json& behind = found["conflicts"][1];
    EXPECT_EQ(behind["a"], "ann");
    EXPECT_EQ(behind["b"], "bob");
    EXPECT_EQ(keys(behind),
              (std::set<std::string>{"a", "b", "intervals", "least_clearance", "time", "a_sample", "b_sample",
                                     "position", "time_to_collision", "time_to_collision_undefined",
                                     "post_encroachment_time", "post_encroachment_time_undefined"}));
    EXPECT_TRUE(behind["time_to_collision"].is_null());
    EXPECT_EQ(behind["time_to_collision_undefined"], "they are on no course to collide");
    EXPECT_EQ(behind["post_encroachment_time_undefined"], "their paths share no place");
    const json& follower = found["conflicts"][2];
    EXPECT_EQ(follower["a"], "ann");
    EXPECT_EQ(follower["b"], "cid");
    EXPECT_NEAR(follower["post_encroachment_time"].get<double>(), 1 - 0.38729833462074170, 1e-6)
        << "cid comes where ann has been, and touches her where she was that much later";
    EXPECT_FALSE(follower.contains("post_encroachment_time_undefined"));
    EXPECT_EQ(found["chains"], json::parse(R"([{"agents": ["ann", "bob", "cid"]}])"));
    EXPECT_TRUE(json_of({"conflicts", file})["conflicts"].empty());
    EXPECT_EQ(json_of(encounters(file, {"--tree", "brute"}))["conflicts"], found["conflicts"]);
    EXPECT_EQ(json_of(encounters(file, {"--motion", "held"}))["conflicts"][0]["time_to_collision_undefined"],
              "a held path has no speed");
}

TEST(EncountersCommand, TextAndCsvSayTheSame) {
    const TempFolder folder;
    const std::string file = folder.write("four.csv", kFour);
    const std::string text = run_program(encounters(file)).out;
    EXPECT_NE(text.find("; no time to collision, as they are on no course to collide; no post-encroachment time, as "
                        "their paths share no place\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("ann and cid: 2 s, 1 to 3 s; least clearance 0.604988 m"), std::string::npos) << text;
    EXPECT_NE(text.find("; post-encroachment time 0.612702 s\n"), std::string::npos) << text;
    EXPECT_NE(text.find("3 encounters within 0.7 m among 4 agents, "), std::string::npos) << text;
    EXPECT_NE(text.find("; 1 chain of contact, the largest of 3: ann, bob, cid\n"), std::string::npos) << text;
    const std::string csv = run_program(encounters(file, {"--csv"})).out;
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "a,b,begin,end,seconds,longest,intervals,least_clearance,time,x,y,a_sample,b_sample,invented,"
              "time_to_collision,post_encroachment_time,undefined");
    EXPECT_NE(csv.find(",nan,nan,they are on no course to collide; their paths share no place\n"), std::string::npos)
        << csv;
    const std::string plain = run_program({"conflicts", file, "--csv", "--radius", "0.6"}).out;
    EXPECT_EQ(plain.substr(0, plain.find('\n')),
              "a,b,begin,end,seconds,longest,intervals,least_clearance,time,x,y,a_sample,b_sample,invented");
}

TEST(EncountersCommand, ShortOnesAreLeftOut) {
    const TempFolder folder;
    const std::string file = folder.write("four.csv", kFour);
    const json found = json_of(encounters(file, {"--min-duration", "1.5"}));
    EXPECT_EQ(found["min_duration"], 1.5);
    ASSERT_EQ(found["conflicts"].size(), 1u);
    EXPECT_EQ(found["conflicts"][0]["b"], "cid");
}

TEST(EncountersCommand, RefusesWhatCannotBe) {
    const TempFolder folder;
    const std::string file = folder.write("four.csv", kFour);
    expect_refused(run_program(encounters(file, {"--tree", "mobb"})), 2, "leave --tree or --within out");
    expect_refused(run_program({"conflicts", file, "--part", "1/2", "--tree", "brute"}), 2, "leave it or --part out");
    expect_refused(run_program({"conflicts", file, "--part", "3/2"}), 2, "there are 2 parts");
    expect_refused(run_program({"conflicts", file, "--part", "3"}), 2, "is not like 3/8");
    expect_refused(run_program({"conflicts", file, "--within", "-1"}), 2, "--within");
}

class MergeCommand : public ::testing::Test {
  protected:
    /// Writes each part, and returns their files.
    std::vector<std::string> parts(const std::vector<std::string>& command, int count) const {
        std::vector<std::string> out;
        for (int part = 1; part <= count; ++part) {
            std::vector<std::string> of_part = command;
            of_part.insert(of_part.end(), {"--part", std::to_string(part) + "/" + std::to_string(count)});
            const Result run = run_program(of_part);
            EXPECT_EQ(run.status, 0) << run.err;
            out.push_back(folder.write("part" + std::to_string(part) + ".json", run.out));
        }
        return out;
    }
    static std::vector<std::string> merge(std::vector<std::string> files, const std::string& option = "") {
        files.insert(files.begin(), "merge");
        if (!option.empty()) files.push_back(option);
        return files;
    }
    std::string crowd() const {
        std::string csv = "id,t,x,y\n";
        for (int i = 0; i < 200; ++i) {
            for (int k = 0; k < 6; ++k) {
                const double way = 0.5 * k * (i % 2 == 0 ? 1 : -1);
                csv += std::to_string(i) + ',' + std::to_string(0.4 * (i % 23 + k)) + ',' +
                       std::to_string(i * 7919 % 211 * 0.03 + way) + ',' + std::to_string(i * 104729 % 197 * 0.03) +
                       '\n';
            }
        }
        return folder.write("crowd.csv", csv);
    }

    const TempFolder folder;
};

TEST_F(MergeCommand, GivesTheWholeByteForByte) {
    const std::string file = crowd();
    const std::vector<std::vector<std::string>> commands{
        {"conflicts", file},
        {"conflicts", file, "--within", "0.5", "--min-duration", "0.2"},
        {"conflicts", file, "--trim", "2:6.1"}};
    for (const std::vector<std::string>& command : commands) {
        for (const int count : {1, 4, 6}) {
            const std::vector<std::string> files = parts(command, count);
            for (const std::string option : {"", "--json", "--csv"}) {
                std::vector<std::string> whole = command;
                if (!option.empty()) whole.push_back(option);
                const Result merged = run_program(merge(files, option));
                EXPECT_EQ(merged.status, 0) << merged.err;
                EXPECT_EQ(merged.out, run_program(whole).out);
                EXPECT_GT(merged.out.size(), 500u);
            }
        }
    }
}

TEST_F(MergeCommand, OfPlansToo) {
    const std::string file =
        folder.write("plan.txt", "0:(0,0),(2,0),(5,5),\n1:(1,0),(1,0),(5,5),\n2:(2,0),(0,0),(5,5),\n");
    // The whole is of the format that its parts were asked for in, unless merge is asked for another.
    for (const char* option : {"--json", "--csv"})
        EXPECT_EQ(run_program(merge(parts({"conflicts", file, option}, 3))).out,
                  run_program({"conflicts", file, option}).out);
    EXPECT_EQ(run_program(merge(parts({"conflicts", file}, 3), "--json")).out,
              run_program({"conflicts", file, "--json"}).out);
}

TEST_F(MergeCommand, OfRunsToo) {
    const std::string file = kSource / "tests/app/goldens/files/run.json";
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"conflicts", file}, {"conflicts", file, "--motion", "linear", "--within", "0.3"}}) {
        const Result merged = run_program(merge(parts(command, 4), "--json"));
        EXPECT_EQ(merged.out, run_program(with(command, {"--json"})).out);
        EXPECT_GT(merged.out.size(), 500u);
    }
}

TEST_F(MergeCommand, OfBodiesOnFloorsToo) {
    std::string clips, agents;
    for (int i = 0; i < 40; ++i) {
        const std::string name = "\"a" + std::to_string(i) + '"', x = std::to_string(0.5 * (i * 7 % 17));
        const std::string y = std::to_string(0.5 * (i * 5 % 13)), to = std::to_string(0.5 * (i * 11 % 19));
        clips += (i > 0 ? ", " : "") + name + R"(: {"dt": 1, "motion": "linear", "body": [[0.5,0,0.3],[-0.5,0,0.3]],
            "samples": [[)" +
                 x + ',' + y + ",1],[" + to + ',' + x + ",1],[" + y + ',' + to + ",1]]}";
        agents += (i > 0 ? ", " : "") + (R"({"name": )" + name) + R"(, "clip": )" + name +
                  (i % 3 > 0 ? R"(, "floor": )" + std::to_string(i % 3) : "") + "}";
    }
    const std::string file = folder.write("bodies.json", "{\"clips\": {" + clips + "}, \"agents\": [" + agents + "]}");
    for (const std::string option : {"--json", "--csv"}) {
        const std::vector<std::string> command{"conflicts", file, "--within", "0.2"};
        const Result merged = run_program(merge(parts(command, 6), option));
        EXPECT_EQ(merged.out, run_program(with(command, {option})).out);
        EXPECT_GT(merged.out.size(), 500u);
    }
}

TEST_F(MergeCommand, RefusesWhatIsNoWhole) {
    const std::string file = crowd();
    std::vector<std::string> files = parts({"conflicts", file}, 3);
    expect_refused(run_program(merge({files[0], files[2]})), 2, "part 2/3 is missing; ask for it with");
    expect_refused(run_program(merge({files[0], files[1], files[1], files[2]})), 2, "give each once");
    expect_refused(
        run_program(merge(
            {files[0], folder.write("other.json",
                                    json_of({"conflicts", file, "--radius", "0.3", "--part", "2/3"}).dump() + "\n")})),
        2, "is a part of another whole");
    expect_refused(run_program(merge({file})), 2, "is no part");
    expect_refused(run_program(merge({folder.write("whole.json", run_program({"conflicts", file, "--json"}).out)})), 2,
                   "is no part");
    // Of the same name, and something else.
    for (const char* const option : {"--motion", "--trim"}) {
        const std::string value = option == std::string("--motion") ? "held" : "0:4";
        folder.write("part2.json", run_program({"conflicts", file, option, value, "--part", "2/3"}).out);
        expect_refused(run_program(merge(files)), 2, "part2.json: is a part of another whole");
    }
    const std::string right = run_program({"conflicts", file, "--part", "2/3"}).out;
    const std::size_t numbers = right.find("\"agents\": [") + std::string_view("\"agents\": ").size();
    for (const json& agents : {json{-5, -7}, json{70, 3}, json{3, 3}, json{1.5, 2}, json{1, 1e300}}) {
        std::string wrong = right;
        folder.write("part2.json", wrong.replace(numbers, right.find(']', numbers) + 1 - numbers, agents.dump()));
        const Result refused = run_program(merge(files));
        expect_refused(refused, 2, "ask for this part again");
        EXPECT_NE(refused.err.find("part2.json: line 14: is not as it was written"), std::string::npos) << refused.err;
    }
    json wrong = json::parse(right);
    folder.write("part2.json", wrong.dump());
    expect_refused(run_program(merge(files)), 2, "ask for this part again");
    // Two rows change places.
    const std::size_t first = right.find("    {"), second = right.find("    {", first + 1);
    folder.write("part2.json", right.substr(0, first) + right.substr(second, right.find("    {", second + 1) - second) +
                                   right.substr(first, second - first) + right.substr(right.find("    {", second + 1)));
    expect_refused(run_program(merge(files)), 2, "ask for this part again");
    for (const json& part : {json{2.5, 3}, json{0, 0}, json{2, 1e300}}) {
        wrong["part"] = part;
        folder.write("part2.json", wrong.dump());
        expect_refused(run_program(merge(files)), 2, "ask for this part again");
    }
    folder.write("part2.json", run_program({"conflicts", file, "--part", "2/3"}).out);
    // Killed half way, and asked again.
    for (const std::size_t size : {right.size() / 9000, std::size_t{100}, right.size() / 2, second, right.size() - 3}) {
        folder.write("part2.json", right.substr(0, size));
        expect_refused(run_program(merge(files)), 2, "part2.json: is not whole; ask for this part again");
    }
    folder.write("part2.json", run_program({"conflicts", file, "--part", "2/3"}).out);
    EXPECT_EQ(run_program(merge(files)).out, run_program({"conflicts", file}).out);
}

}  // namespace
}  // namespace mobbscope
