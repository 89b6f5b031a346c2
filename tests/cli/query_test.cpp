#include "run_program.h"

#include <explain/avoidable.h>
#include <explain/query_sentence.h>
#include <scene/drawn_agent.h>
#include <scene/fitted_scene.h>
#include <support/bvh_text.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

json results(const std::vector<std::string>& arguments) {
    const Result run = run_program(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return json::parse(run.out)["results"];
}

TEST(Query, JsonIsTheAnswer) {
    const std::string file = kScenes / "collision.json";
    const json found = results({"query", file, "--json"});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(keys(found[0]), (std::set<std::string>{"query", "a", "b", "collides", "contact", "tests"}));
    EXPECT_EQ(found[0]["query"], 0);
    EXPECT_EQ(found[0]["a"], "A");
    EXPECT_EQ(found[0]["b"], "B");
    EXPECT_EQ(found[0]["collides"], true);
    const Scene scene = load_scene(file);
    const FittedScene fitted(scene, scene.fit);
    const RecordedQuery recorded = record(fitted, fitted.queries()[0]);
    EXPECT_EQ(keys(found[0]["contact"]), (std::set<std::string>{"time", "a_sample", "b_sample", "distance", "radii"}));
    EXPECT_EQ(found[0]["contact"]["time"], recorded.contact->time);
    EXPECT_EQ(found[0]["contact"]["a_sample"], recorded.contact->a_sample);
    EXPECT_EQ(found[0]["contact"]["distance"], recorded.contact->distance);
    json tests;
    for (const mobb::TestKind test : mobb::kTestKinds) tests[mobb::name(test)] = recorded.tests[test];
    EXPECT_EQ(found[0]["tests"], tests);
}

TEST(Query, NoCollisionHasNoContact) {
    const json found = results({"query", kCrossing, "--json", "--all-contacts"});
    EXPECT_EQ(found[0]["collides"], false);
    EXPECT_TRUE(found[0]["contact"].is_null());
    EXPECT_EQ(found[0]["contacts"], json::array());
}

TEST(Query, WhereTellsOnlyWhatPasses) {
    const std::string file = kCrossing;
    const json whole = results({"query", file, "--json", "--trace"})[0]["trace"];
    const json passing = results({"query", file, "--json", "--where", "outcome = separated and gap < 0.5"})[0]["trace"];
    std::size_t wanted = 0;
    for (const json& event : whole) {
        if (event["outcome"] == "separated" && event["gap"] < 0.5) ++wanted;
    }
    EXPECT_GT(wanted, 0u);
    EXPECT_EQ(passing.size(), wanted);
    const json judged = results({"query", file, "--json", "--where", "avoidable"})[0];
    EXPECT_EQ(judged["avoidable"], judged["trace"].size());
    const Result words = run_program({"query", file, "--where", "outcome = overlap"});
    EXPECT_NE(words.out.find(" of " + std::to_string(whole.size()) + " events"), std::string::npos) << words.out;
    const Result wrong = run_program({"query", file, "--where", "gap < 0.05 and levle(a) > 2"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("gap < 0.05 and levle(a) > 2\n               ^\n"), std::string::npos) << wrong.err;
    EXPECT_NE(wrong.err.find("did you mean 'level'"), std::string::npos) << wrong.err;
    const Result open = run_program({"query", file, "--where", "gap < 0.05 and"});
    EXPECT_NE(open.err.find("^\nexpected one of: step, time, "), std::string::npos) << open.err;
    EXPECT_NE(open.err.find("--where: a field is missing"), std::string::npos) << open.err;
    const Result unclosed = run_program({"query", file, "--where", "leaf(a"});
    EXPECT_NE(unclosed.err.find("^\nexpected )\n"), std::string::npos) << unclosed.err;
}

TEST(Query, EveryTreeAndTheDirectSearchGiveTheSameContacts) {
    const std::string file = kScenes / "collision.json";
    const json brute = results({"query", file, "--json", "--all-contacts", "--tree", "brute"});
    EXPECT_EQ(brute[0]["tests"]["time"], 0);
    EXPECT_GT(brute[0]["tests"]["samples"], 0);
    ASSERT_FALSE(brute[0]["contacts"].empty());
    EXPECT_EQ(brute[0]["contacts"][0][0], brute[0]["contact"]["time"]);
    for (const mobb::TreeKind kind : mobb::kTreeKinds) {
        const std::string tree(mobb::name(kind));
        const json found = results({"query", file, "--json", "--all-contacts", "--tree", tree, "--leaf", "3"});
        EXPECT_EQ(found[0]["contact"], brute[0]["contact"]) << tree;
        EXPECT_EQ(found[0]["contacts"], brute[0]["contacts"]) << tree;
        for (const mobb::BoxKind box : mobb::kBoxKinds) {
            if (mobb::info(box).in_paper) continue;
            EXPECT_EQ(found[0]["tests"][mobb::name(box)] > 0, mobb::info(kind).below == box) << tree;
        }
    }
}

TEST(Query, TheTraceIsTheRecord) {
    const std::string file = kScenes / "collision.json";
    const json found = results({"query", file, "--json", "--trace", "--tree", "umobb"});
    const Scene scene = load_scene(file);
    mobb::FitOptions options = scene.fit;
    options.tree = mobb::TreeKind::umobb;
    const FittedScene fitted(scene, options);
    const mobb::Trace trace = record(fitted, fitted.queries()[0]).trace;
    const AvoidableOverlaps avoidable =
        avoidable_overlaps(trace, fitted.placed(fitted.queries()[0].a), fitted.placed(fitted.queries()[0].b));
    EXPECT_EQ(found[0]["avoidable"], avoidable.events.size());
    const json& printed = found[0]["trace"];
    int separations = 0;
    std::size_t measured = 0;
    ASSERT_EQ(static_cast<int>(printed.size()), trace.size());
    for (int step = 0; step < trace.size(); ++step) {
        const json& event = printed[static_cast<std::size_t>(step)];
        std::set<std::string> said{"step", "parent", "depth", "a", "b", "test", "outcome", "axis", "gap", "pairs"};
        if (avoidable.at(step)) said.insert("avoidable");
        EXPECT_EQ(keys(event), said);
        const mobb::Trace::Event recorded = trace[step];
        EXPECT_EQ(event["step"], step);
        EXPECT_EQ(event["parent"], recorded.parent);
        EXPECT_EQ(event["depth"], recorded.depth);
        EXPECT_EQ(event["a"], recorded.a);
        EXPECT_EQ(event["b"], recorded.b);
        EXPECT_EQ(event["test"], mobb::name(recorded.test));
        EXPECT_EQ(event["outcome"], mobb::name(recorded.outcome));
        const bool separated = recorded.outcome == mobb::Outcome::separated;
        EXPECT_EQ(event["axis"], separated ? json(recorded.axis) : json());
        EXPECT_EQ(event["gap"], separated ? json(recorded.gap) : json());
        json pairs = json::array();
        for (const mobb::MeasuredPair& pair : recorded.pairs) pairs.push_back({pair.i, pair.j, pair.distance});
        EXPECT_EQ(event["pairs"], pairs);
        separations += separated ? 1 : 0;
        measured += pairs.size();
    }
    EXPECT_GT(separations, 0) << "the scene shows nothing";
    EXPECT_GT(measured, 0u);
    EXPECT_EQ(printed.back()["outcome"], "hit");
}

TEST(Query, TheTraceOfTheDirectSearchIsOneTestOfSamples) {
    const json found = results({"query", kScenes / "collision.json", "--json", "--trace", "--tree", "brute"});
    const json& trace = found[0]["trace"];
    ASSERT_EQ(trace.size(), 1u);
    EXPECT_EQ(trace[0]["test"], "samples");
    EXPECT_EQ(trace[0]["outcome"], "hit");
    EXPECT_EQ(static_cast<std::int64_t>(trace[0]["pairs"].size()), found[0]["tests"]["samples"]);
    EXPECT_EQ(trace[0]["pairs"].back()[0], found[0]["contact"]["a_sample"]);
    EXPECT_EQ(trace[0]["pairs"].back()[1], found[0]["contact"]["b_sample"]);
    EXPECT_EQ(trace[0]["pairs"].back()[2], found[0]["contact"]["distance"]);
}

TEST(Query, LevelsCutTheTreeButNotTheAnswer) {
    const std::string file = kScenes / "collision.json";
    const json whole = results({"query", file, "--json", "--all-contacts"});
    const json cut = results({"query", file, "--json", "--all-contacts", "--levels", "1"});
    EXPECT_EQ(cut[0]["contact"], whole[0]["contact"]);
    EXPECT_EQ(cut[0]["contacts"], whole[0]["contacts"]);
    EXPECT_EQ(cut[0]["tests"]["time"], 1) << "there is nothing below the roots";
    EXPECT_GT(cut[0]["tests"]["samples"], whole[0]["tests"]["samples"]);
}

TEST(Query, EveryIntervalOfContactIsTold) {
    const TempFolder folder;
    // A walks past two posts that stand on its way.
    const std::string file = folder.write("s.json", R"({"clips": {
        "walk": {"dt": 0.5, "samples": [[0,0,0.5],[1,0,0.5],[2,0,0.5],[3,0,0.5],[4,0,0.5],[5,0,0.5],[6,0,0.5],[7,0,0.5]]},
        "jump": {"dt": 2, "samples": [[1,0,0.25],[6,0,1.25]]}},
        "queries": [{"a": {"clip": "walk"}, "b": {"clip": "jump"}}]})");
    for (const std::string tree : {"mobb", "umobb", "brute"}) {
        // Their steps are longer than their radii, of which they warn.
        const Result run = run_program({"query", file, "--json", "--all-contacts", "--leaf", "1", "--tree", tree});
        const json found = json::parse(run.out)["results"];
        EXPECT_EQ(found[0]["contacts"], json::parse("[[0.5, 1], [2.5, 4]]")) << tree << found[0]["contacts"];
    }
    EXPECT_NE(run_program({"query", file, "--all-contacts"}).out.find("In contact: 0.5 to 1 s, 2.5 to 4 s."),
              std::string::npos);
}

TEST(Query, ACrowdsPairsAreAskedInOrder) {
    const json found = [] {
        const TempFolder folder;
        std::string agents;
        for (const char* name : {"A", "B", "C", "D"}) {
            agents += (agents.empty() ? "" : ",") + std::string(R"({"name": ")") + name + R"(", "clip": "c"})";
        }
        return results(
            {"query",
             folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1]]}}, "agents": [)" + agents + "]}"),
             "--json"});
    }();
    std::string pairs;
    for (const json& entry : found) pairs += entry["a"].get<std::string>() + entry["b"].get<std::string>() + ' ';
    EXPECT_EQ(pairs, "AB AC AD BC BD CD ");
}

TEST(Query, SaysWhichOverlapsWereAvoidableAndWhoIsToBlame) {
    for (const char* tree : {"moving", "umobb", "aabb"}) {
        const std::vector<std::string> asked{"query", kCrossing, "--tree", tree};
        std::vector<std::string> as_json = asked, as_text = asked;
        as_json.insert(as_json.end(), {"--json", "--trace"});
        as_text.emplace_back("--trace");
        const json all = json::parse(run_program(as_json).out);
        const json& found = all["results"][0];
        int marked = 0;
        for (const json& event : found["trace"]) {
            if (!event.contains("avoidable")) continue;
            EXPECT_EQ(event["avoidable"], true);
            EXPECT_EQ(event["outcome"], "overlap");
            ++marked;
        }
        EXPECT_EQ(found["avoidable"], marked) << tree;
        int told = 0;
        const std::string text = run_program(as_text).out;
        for (std::size_t at = 0; (at = text.find(", avoidable: a line keeps the disks ", at)) != text.npos; ++at)
            ++told;
        EXPECT_EQ(told, marked) << text;
        const Scene scene = load_scene(kCrossing);
        mobb::FitOptions options = scene.fit;
        options.tree = *mobb::tree_kind_from_name(tree);
        const FittedScene fitted(scene, options);
        const BlameInScene blame = blame_in(fitted);
        std::int64_t last = std::numeric_limits<std::int64_t>::max(), in_all = 0, listed = 0;
        for (const json& node : all["blame"]) {
            const int clip = node["clip"] == fitted.scene().clips[0].name ? 0 : 1;
            EXPECT_EQ(node["overlaps"], blame.of(clip, node["node"]));
            EXPECT_EQ(node["level"], fitted.tree(clip).level(node["node"]));
            EXPECT_LE(node["overlaps"], last) << "those of the most first";
            last = node["overlaps"];
            listed += last;
        }
        for (const BlameByNode& nodes : blame.of_clip) in_all = std::accumulate(nodes.begin(), nodes.end(), in_all);
        EXPECT_EQ(listed, in_all);
    }
    const json brute = results({"query", kCrossing, "--json", "--trace", "--tree", "brute"});
    EXPECT_FALSE(brute[0].contains("avoidable")) << "the direct search has no boxes";
}

TEST(Query, TheTraceNamesATestAsItsPictureDoes) {
    const Scene scene = load_scene(kCrossing);
    const FittedScene fitted(scene, scene.fit);
    ViewState view;
    view.query = 0;
    const std::vector<DrawnAgent> sides = drawn_agents(fitted, view);
    const mobb::Trace trace = record(fitted, fitted.queries()[0]).trace;
    std::istringstream text(run_program({"query", kCrossing, "--trace"}).out);
    std::string line;
    while (std::getline(text, line) && line != "   Trace:") {
    }
    for (int step = 0; step < trace.size(); ++step) {
        ASSERT_TRUE(std::getline(text, line));
        const std::string pictured = step_sentence(sides, trace, step);
        const std::size_t nodes = pictured.find(": ") + 2, outcome = pictured.find(": ", nodes);
        EXPECT_NE(line.find(pictured.substr(nodes, outcome - nodes)), std::string::npos) << line << '\n' << pictured;
        EXPECT_TRUE(line.ends_with(pictured.substr(outcome))) << line << '\n' << pictured;
    }
}

TEST(Query, TextIsASentence) {
    const Result run = run_program({"query", kScenes / "collision.json", "--trace", "--all-contacts"});
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(run.out.starts_with("0: A and B collide at 2.433 s: sample 73 of A and sample 67 of B")) << run.out;
    EXPECT_NE(run.out.find("In contact: 2.43333 to "), std::string::npos);
    EXPECT_NE(run.out.find("samples: samples 73 and 67 hit at "), std::string::npos);
    EXPECT_NE(run_program({"query", kCrossing}).out.find("A and B never collide."), std::string::npos);
}

TEST(Query, WithNothingToAskItIsRefused) {
    for (const char* file : {"circles.json", "walk.csv"}) {
        const Result run = run_program({"query", kScenes / file});
        EXPECT_EQ(run.status, 2) << file;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

/// collision.json with another expectation.
std::string expecting(const TempFolder& folder, const std::string& expectation) {
    json scene = json::parse(slurp(kScenes / "collision.json"));
    scene["queries"][0]["expect"] = json::parse(expectation);
    for (json& clip : scene["clips"]) clip["source"] = kScenes / clip["source"].get<std::string>();
    return folder.write("s.json", scene.dump());
}

TEST(Query, AnAnswerThatIsNotTheExpectedOneIsStatusOne) {
    const TempFolder folder;
    const Result denied = run_program({"query", expecting(folder, R"({"collides": false})"), "--json"});
    EXPECT_EQ(denied.status, 1);
    EXPECT_EQ(json::parse(denied.out)["results"][0]["collides"], true) << "the answer is told all the same";
    EXPECT_NE(denied.err.find("query 0: expected no collision, but A and B collide at 2.433 s"), std::string::npos);

    const json contact = results({"query", kScenes / "collision.json", "--json"})[0]["contact"];
    json expectation = {{"collides", true}, {"contact", contact}};
    EXPECT_EQ(run_program({"query", expecting(folder, expectation.dump())}).status, 0);
    expectation["contact"]["b_sample"] = 66;
    EXPECT_EQ(run_program({"query", expecting(folder, expectation.dump())}).status, 1);
    expectation["contact"] = contact;
    expectation["contact"]["distance"] = contact["distance"].get<double>() + 1e-6;
    EXPECT_EQ(run_program({"query", expecting(folder, expectation.dump())}).status, 1);
}

TEST(Query, TestsThatAreNotTheExpectedOnesAreStatusOne) {
    const TempFolder folder;
    const json found = results({"query", kScenes / "collision.json", "--json"})[0]["tests"];
    const std::string same = expecting(folder, json{{"tests", found}}.dump());
    EXPECT_EQ(run_program({"query", same}).status, 0);
    EXPECT_EQ(run_program({"query", same, "--check"}).status, 0);
    const std::string time = std::to_string(found["time"].get<int>());
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{}, {"--check"}, {"--json"}}) {
        std::vector<std::string> all{"query", same, "--leaf", "1", "--axes", "covariance"};
        all.insert(all.end(), more.begin(), more.end());
        const Result finer = run_program(all);
        EXPECT_EQ(finer.status, 1);
        EXPECT_NE(finer.err.find("query 0: expected " + time + " tests of time, but there are "), std::string::npos)
            << finer.err;
    }
    // Brute force makes none of these tests: that is said, and the answer is compared.
    const Result brute = run_program({"query", same, "--tree", "brute"});
    EXPECT_EQ(brute.status, 0);
    EXPECT_NE(brute.err.find("expected numbers of tests are not compared"), std::string::npos) << brute.err;
    const Result both = run_program({"query", expecting(folder, R"({"collides": false, "tests": {"time": 1}})")});
    EXPECT_EQ(both.status, 1);
    EXPECT_NE(both.err.find(" m; expected 1 test of time, but there are " + time + "\n"), std::string::npos)
        << both.err;
}

/// collision.json with its answer and its trace, after a change of the query: a capture.
std::string capture(const TempFolder& folder, const std::function<void(json&)>& change) {
    const json found = results({"query", kScenes / "collision.json", "--json", "--trace"})[0];
    json scene = json::parse(slurp(kScenes / "collision.json"));
    json& query = scene["queries"][0];
    query["expect"] = {{"collides", true}, {"contact", found["contact"]}};
    query["trace"] = found["trace"];
    change(query);
    for (json& clip : scene["clips"]) clip["source"] = kScenes / clip["source"].get<std::string>();
    return folder.write("capture.json", scene.dump());
}

TEST(QueryCheck, ACaptureAgreesWithItself) {
    const TempFolder folder;
    const std::string file = capture(folder, [](json&) {});
    const Result run = run_program({"query", file, "--check"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("agree with the stored trace.\n"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("Compared 1 answer and 1 trace ("), std::string::npos) << run.out;
    EXPECT_TRUE(run.out.ends_with(" of 1 query: all agree.\n")) << run.out;
    const json checked = json::parse(run_program({"query", file, "--check", "--json"}).out);
    EXPECT_EQ(checked["agrees"], true);
    EXPECT_EQ(checked["checks"][0]["trace"]["compared"], checked["compared"]["events"]);
    EXPECT_TRUE(checked["checks"][0]["trace"]["difference"].is_null());
    EXPECT_TRUE(checked["checks"][0]["disagreement"].is_null());
    const std::string answer = capture(folder, [](json& query) { query.erase("trace"); });
    EXPECT_EQ(run_program({"query", answer, "--check", "--tree", "blocks"}).status, 0)
        << "with the queries that only say yes or no";
    const std::string bare = capture(folder, [](json& query) {
        query.erase("trace");
        query.erase("expect");
    });
    const Result nothing = run_program({"query", bare, "--check"});
    EXPECT_EQ(nothing.status, 0) << nothing.err;
    EXPECT_NE(nothing.out.find("Nothing was compared"), std::string::npos) << nothing.out;
}

TEST(QueryCheck, EveryChangeOfATraceIsFound) {
    const auto event_with = [](json& query, const char* key, const json& value) -> json& {
        for (json& event : query["trace"]) {
            if (event[key] == value) return event;
        }
        ADD_FAILURE() << "no event has " << key << ' ' << value;
        return query["trace"][0];
    };
    struct Change {
        const char* what;
        std::function<void(json&)> change;
    };
    const std::vector<Change> changes{
        {"the stored trace ends there", [](json& query) { query["trace"].erase(query["trace"].size() - 1); }},
        {"now the trace ends there",
         [](json& query) {
             json event = query["trace"].back();
             event["step"] = query["trace"].size();
             query["trace"].push_back(event);
         }},
        {" in gap: ",
         [&](json& query) {
             json& event = event_with(query, "outcome", "separated");
             event["gap"] = event["gap"].get<double>() + 1e-6;
         }},
        {" in axis: ",
         [&](json& query) {
             json& event = event_with(query, "outcome", "separated");
             event["axis"] = event["axis"] == 0 ? 1 : 0;
         }},
        {" in outcome: ", [&](json& query) { event_with(query, "outcome", "hit")["outcome"] = "no_hit"; }},
        {" in pairs: ", [&](json& query) { event_with(query, "outcome", "hit")["pairs"].erase(0); }},
        {"events agree with the stored trace",
         [](json& query) {
             query["expect"] = {{"collides", false}};
         }},
        {"but the stored trace is of",
         [](json& query) {
             query["trace"].erase(query["trace"].size() - 1);
             query["events"] = 1000;
         }},
    };
    for (const auto& [what, change] : changes) {
        const TempFolder folder;
        const std::string file = capture(folder, change);
        const Result run = run_program({"query", file, "--check"});
        EXPECT_EQ(run.status, 1) << what;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_NE(run.err.find("query 0: "), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(what), std::string::npos) << run.err;
        if (std::string_view(what).starts_with(" in ")) {
            EXPECT_NE(run.err.find(" against "), std::string::npos) << "nodes are named as elsewhere: " << run.err;
        }
        EXPECT_NE(run.out.find("1 query disagrees."), std::string::npos) << run.out;
        const Result as_json = run_program({"query", file, "--check", "--json"});
        EXPECT_EQ(as_json.status, 1);
        EXPECT_EQ(json::parse(as_json.out)["agrees"], false);
    }
}

TEST(QueryCheck, SamplesThatWereAlteredAreRefused) {
    const TempFolder folder;
    json scene = json::parse(R"({"clips": {"c": {"dt": 0.1, "digest": "73bdd65c058284da",
        "samples": [[0, 0, 0.3], [0.1, 0, 0.3]]}}, "agents": [{"name": "A", "clip": "c"},
        {"name": "B", "clip": "c", "translate": [0, 5]}],
        "queries": [{"a": "A", "b": "B", "expect": {"collides": false}}]})");
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"query", folder.write("capture.json", scene.dump())};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all);
    };
    EXPECT_EQ(run({"--check"}).status, 0);
    EXPECT_EQ(run({}).err, "");
    EXPECT_EQ(run({"--check", "--motion", "linear"}).status, 0) << "the file's motion is as it was";
    scene["clips"]["c"]["samples"][1][1] = 1e-15;
    const Result altered = run({"--check"});
    EXPECT_EQ(altered.status, 2);
    EXPECT_EQ(altered.out, "");
    EXPECT_NE(altered.err.find("/clips/c/digest: its samples are not those that were captured"), std::string::npos)
        << altered.err;
    const Result asked = run({});
    EXPECT_EQ(asked.status, 0);
    EXPECT_NE(asked.err.find("clip 'c': its samples are not those that were captured"), std::string::npos) << asked.err;
    scene["clips"]["c"]["samples"][1][1] = 0;
    scene["clips"]["c"]["motion"] = "linear";
    EXPECT_EQ(run({"--check"}).status, 2) << "the motion counts too";
    scene["clips"]["c"]["digest"] = "73bdd65c058284";
    EXPECT_EQ(run({}).status, 2) << "too short";
}

TEST(QueryCheck, AContactThatDiffersALittleIsShownToDiffer) {
    const TempFolder folder;
    const std::string file = capture(folder, [](json& query) {
        query.erase("trace");
        json& contact = query["expect"]["contact"];
        contact["time"] = contact["time"].get<double>() + 1e-7;
        contact["distance"] = contact["distance"].get<double>() + 1e-6;
    });
    const Result run = run_program({"query", file, "--check"});
    EXPECT_EQ(run.status, 1);
    const json contact = json::parse(slurp(file))["queries"][0]["expect"]["contact"];
    for (const char* what : {"; time: expected ", "; distance: expected "}) {
        const std::size_t at = run.err.find(what);
        ASSERT_NE(at, std::string::npos) << run.err;
        const std::string pair = run.err.substr(at + std::string(what).size());
        const std::string now = pair.substr(pair.find(", now ") + 6);
        EXPECT_NE(pair.substr(0, pair.find(' ')), now.substr(0, now.find(' '))) << run.err;
    }
}

TEST(QueryCheck, ARecordingThatStoppedIsComparedUpToThere) {
    const TempFolder folder;
    const std::string file = capture(folder, [](json& query) {
        query["events"] = query["trace"].size();
        query["trace"].erase(query["trace"].size() - 1);
    });
    const Result run = run_program({"query", file, "--check"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("of the stored trace recording stopped at event"), std::string::npos) << run.out;
}

TEST(QueryCompare, LaysTwoFitsSideBySide) {
    const std::string file = kCrossing;
    const Result run = run_program({"query", file, "--compare", "umobb,leaf=3"});
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* words : {"A and B never collide.", "difference", "decided earlier for", "step "})
        EXPECT_NE(run.out.find(words), std::string::npos) << run.out;
    const json found = json::parse(run_program({"query", file, "--compare", "umobb", "--json"}).out)["comparisons"][0];
    EXPECT_EQ(found["sides"][1]["fit"]["tree"], "umobb");
    ASSERT_FALSE(found["times"].empty());
    for (std::size_t i = 1; i < found["times"].size(); ++i)
        EXPECT_EQ(found["times"][i]["t0"], found["times"][i - 1]["t1"]);
    const json same =
        json::parse(run_program({"query", file, "--compare", "tree=mobb", "--json"}).out)["comparisons"][0];
    for (const auto& [test, difference] : same["difference"].items()) EXPECT_EQ(difference, 0) << test;
    for (const json& time : same["times"]) {
        EXPECT_EQ(time["earlier"], 0);
        EXPECT_EQ(time["sides"][0], time["sides"][1]);
    }
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"--compare", "mob"},
                                               {"--compare", "leaf=0"},
                                               {"--compare", "mobb", "--check"},
                                               {"--check", "--trace"},
                                               {"--check", "--tree", "brute"}}) {
        std::vector<std::string> all{"query", file};
        all.insert(all.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_program(all).status, 2) << wrong.back();
    }
}

TEST(Query, PlacementsInAQueryAreUsed) {
    const TempFolder folder;
    const std::string file = folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]},
        "rod": {"dt": 1, "samples": [[5,0,1]]}},
        "queries": [{"a": {"clip": "c"}, "b": {"clip": "c", "translate": [0, 2]}},
                    {"a": {"clip": "c"}, "b": {"clip": "c", "translate": [0, 1.9], "start": 1.5}},
                    {"a": {"clip": "c"}, "b": {"clip": "c", "rotate_deg": 90, "start": 2}},
                    {"a": {"clip": "c"}, "b": {"clip": "rod", "translate": [0, 5]}},
                    {"a": {"clip": "c"}, "b": {"clip": "rod", "translate": [0, 5], "rotate_deg": -90}}]})");
    const json found = results({"query", file, "--json"});
    EXPECT_EQ(found[0]["collides"], false) << "touching is not colliding";
    EXPECT_EQ(found[1]["collides"], false) << "1 m aside and 1.9 m ahead";
    EXPECT_EQ(found[2]["collides"], false) << "one ends when the other begins";
    EXPECT_EQ(found[2]["a"], "c");
    EXPECT_EQ(found[3]["collides"], false) << "7 m away";
    EXPECT_EQ(found[4]["collides"], true) << "turned onto the origin";
    EXPECT_EQ(found[4]["contact"]["distance"], 0);
}

TEST(Query, BodiesAreOfClipsWithSkeletons) {
    const TempFolder folder;
    folder.write("walker.bvh", replaced(kWalker, "0 0 90 0", "0 0 0 0"));
    // Arms in parallel, 0.3 m apart; and one who is a disk alone.
    const std::string file = folder.write("s.json", R"({"clips": {"walk": {"source": "walker.bvh", "unit": "cm"},
        "disk": {"dt": 0.1, "samples": [[0,0,1]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [0.3, 0]},
                   {"name": "C", "clip": "disk"}]})");
    const json found = results({"query", file, "--json", "--bodies"});
    EXPECT_EQ(found[0]["collides"], true);
    const json& bodies = found[0]["bodies"];
    EXPECT_EQ(keys(bodies),
              (std::set<std::string>{"bone_radius", "intervals", "collides", "first", "nearest", "samples"}));
    EXPECT_EQ(bodies["bone_radius"], 0.05);
    EXPECT_EQ(bodies["collides"], false);
    EXPECT_TRUE(bodies["first"].is_null());
    EXPECT_EQ(bodies["intervals"], json::array({json::array({0, bodies["samples"].back()["t1"]})}));
    EXPECT_NEAR(bodies["nearest"]["distance"].get<double>(), 0.2, 1e-6);
    EXPECT_EQ(keys(bodies["nearest"]), (std::set<std::string>{"time", "distance", "a_bone", "b_bone"}));
    EXPECT_EQ(bodies["samples"].size(), 4u);
    EXPECT_EQ(keys(bodies["samples"][0]),
              (std::set<std::string>{"t0", "t1", "a_sample", "b_sample", "time", "distance", "a_bone", "b_bone"}));
    for (const json& joint : bodies["samples"][0]["a_bone"])
        EXPECT_TRUE((std::set<std::string>{"Hips", "Left Arm", "the end of Left Arm", "Foot"}).contains(joint));
    EXPECT_TRUE(found[1]["bodies"].is_null());
    EXPECT_EQ(found[1]["no_bodies"], "the clip 'disk' has no skeleton: its samples are disks alone");

    const json thick = results({"query", file, "--json", "--bodies", "--bone-radius", "0.2"});
    EXPECT_EQ(thick[0]["bodies"]["collides"], true);
    EXPECT_NEAR(thick[0]["bodies"]["first"]["distance"].get<double>(), -0.1, 1e-6);
    const Result words = run_program({"query", file, "--bodies"});
    EXPECT_NE(words.out.find("Bodies do not touch; nearest are "), std::string::npos) << words.out;
    EXPECT_NE(words.out.find(" of B, 0.200 m at 0"), std::string::npos) << words.out;
    EXPECT_NE(words.out.find("No bodies: the clip 'disk' has no skeleton"), std::string::npos);
    EXPECT_FALSE(results({"query", file, "--json"})[0].contains("bodies"));
}

TEST(Query, BodiesNeedASkeleton) {
    const TempFolder folder;
    const std::string file = folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1]]}},
        "queries": [{"a": {"clip": "c"}, "b": {"clip": "c"}}]})");
    const Result refused = run_program({"query", file, "--bodies"});
    expect_refused(refused, 2, "no query is between two bodies: the clip 'c' has no skeleton");
    EXPECT_EQ(run_program({"query", file, "--bone-radius", "0.1"}).status, 2);
    EXPECT_EQ(run_program({"query", file, "--bodies", "--bone-radius", "-1"}).status, 2);
}

TEST(Query, RealPathsGiveTheDirectSearchsAnswer) {
    const std::filesystem::path data = kSharedData / "trajectories/xytr";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    const TempFolder folder;
    const std::string file =
        folder.write("s.json", R"({"clips": {"a": {"source": ")" + (data / "cmu_01_06_30hz.csv").string() +
                                   R"("}, "b": {"source": ")" + (data / "cmu_03_03_30hz.csv").string() + R"("}},
        "agents": [{"name": "A", "clip": "a"}, {"name": "B", "clip": "b", "start": 1.7}, {"name": "C", "clip": "b",
        "translate": [300, 0]}]})");
    json brute = results({"query", file, "--json", "--tree", "brute"});
    json tree = results({"query", file, "--json"});
    ASSERT_EQ(tree.size(), 3u);
    EXPECT_EQ(tree[1]["collides"], false);
    for (std::size_t i = 0; i < 3; ++i) {
        brute[i].erase("tests");
        tree[i].erase("tests");
    }
    EXPECT_EQ(tree, brute);
}

}  // namespace
}  // namespace mobbscope
