// mobbscope test: exit statuses, what is written, and what is said.
#include "run_program.h"

#include <base/base64.h>
#include <render/image/png.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include "cases/case_folder.h"
#include "render/backends.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

void expect_test_refused(const Result& run, const std::string& why) {
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_PRED2(says, run.err, why);
    EXPECT_EQ(run.out, "");
}

/// Three cases: two views of one scene, and one that cannot be read.
class TestCommandTest : public ::testing::Test {
  protected:
    TestCommandTest() {
        cases.add("path");
        std::filesystem::create_directory(cases.path() / "query");
        cases.write("query/end", R"({"mobbscope_case": 1, "scene": "../scene.json", "size": "160x120",
                                     "view": {"query": 0}})");
    }

    const CaseFolder cases;
    const std::filesystem::path output = cases.path() / "out";

    Result test(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"test", cases.path().string(), "--output", output.string()};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all);
    }
    bool exists(const std::string& file) const { return std::filesystem::exists(cases.path() / file); }
};

/// The same, drawn.
class DrawnTestCommandTest : public TestCommandTest {
  protected:
    void SetUp() override {
        if (!has_or_skip(Backend::automatic)) return;
    }
    void take_all() const { ASSERT_EQ(test({"--update", "all"}).status, 0); }
};

TEST_F(TestCommandTest, ListsTheNames) {
    EXPECT_EQ(test({"--list"}).out, "path\nquery/end\n");
    EXPECT_EQ(test({"--list", "query/*"}).out, "query/end\n");
    EXPECT_EQ(test({"--list", "path", "q*"}).out, "path\nquery/end\n");
    EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(TestCommandTest, RefusesWhatIsNoRun) {
    const CaseFolder none;
    expect_test_refused(run_program({"test", none.path().string()}), "holds no case");
    expect_test_refused(run_program({"test", (none.path() / "x").string()}), "cannot be searched");
    expect_test_refused(test({"pth"}), "there is no case 'pth' (did you mean 'path'?)");
    expect_test_refused(test({"--update", "pth"}), "there is no case 'pth'");
    expect_test_refused(test({"--columns", "2"}), "--contact-sheet");
    expect_test_refused(test({"--contact-sheet", "sheet.jpg"}), "sheet.jpg: the contact sheet is written as .png");
    expect_test_refused(test({"--backend", "vulkan"}), "'vulkan' is not one of auto, osmesa, egl");
    expect_test_refused(test({"--html", (cases.path() / "scene.json").string()}), "is written as .html");
    expect_test_refused(test({"--junit", ""}), "the name of a file is empty");
    cases.folder().write("path.png", "no picture");
    expect_test_refused(test({"query/*", "--contact-sheet", (cases.path() / "path.png").string()}),
                        "path.png', which it is made from");
    const std::string folder = cases.path().string();
    expect_test_refused(run_program({"test", folder, "--output", folder}), "where the goldens are");
    expect_test_refused(test({"--update", "all", "path"}), "--update: all");
    EXPECT_EQ(run_program({"test"}).status, 2);
}

TEST_F(DrawnTestCommandTest, AllAreThoseThatAreRun) {
    EXPECT_EQ(test({"path", "--update", "all"}).status, 0);
    EXPECT_TRUE(exists("path.png"));
    EXPECT_FALSE(exists("query/end.png"));
}

TEST_F(DrawnTestCommandTest, WhatPassesLeavesNoPicturesOfEarlierFaults) {
    EXPECT_EQ(test({"path"}).status, 1);
    EXPECT_TRUE(std::filesystem::exists(output / "path.actual.png"));
    EXPECT_EQ(test({"path", "--update", "all"}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(output / "path.actual.png"));
}

TEST_F(DrawnTestCommandTest, NothingIsDrawnWherePicturesCannotGo) {
    const std::string report = (cases.path() / "report.html").string();
    const std::string file = (cases.path() / "scene.json").string();
    EXPECT_EQ(run_program({"test", cases.path().string(), "path", "--html", report, "--output", file}).status, 3);
    EXPECT_FALSE(std::filesystem::exists(report));
}

TEST_F(TestCommandTest, AsksOnlyAtATerminal) {
    // Standard input of tests is none.
    expect_test_refused(test({"--update"}), "--update: there is no terminal to ask at; name the cases");
}

TEST_F(TestCommandTest, WithoutOpenGLEveryCaseIsSkippedWithTheReason) {
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const Result run =
        test({"--json", "--junit", (output / "junit.xml").string(), "--html", (output / "report.html").string()});
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_PRED2(says, run.err, "no OpenGL 3.3");
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["summary"]["skipped"], 2);
    for (const auto& one : report["cases"]) EXPECT_PRED2(says, one["message"].get<std::string>(), "egl: ");
    EXPECT_PRED2(says, slurp(output / "junit.xml"), "skipped");
    EXPECT_PRED2(says, slurp(output / "report.html"), "egl: ");
}

/// A case of answers beside those of pictures, and no OpenGL.
class AnswersTestCommandTest : public TestCommandTest {
  protected:
    AnswersTestCommandTest() {
        cases.write("answers", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["answers", "fit"]})");
        ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    }
    ~AnswersTestCommandTest() override { ::unsetenv("MESA_GL_VERSION_OVERRIDE"); }

    void make_finer() const {
        cases.write("answers", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["answers", "fit"],
                                   "fit": {"leaf": 1}})");
    }
};

TEST_F(AnswersTestCommandTest, RunsWithoutOpenGL) {
    Result run = test({"answers"});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_PRED2(says, run.out, "missing golden: answers: there is no golden ");
    EXPECT_PRED2(says, run.out, "What did not pass: ");
    run = test({"--update", "answers"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_PRED2(says, run.out, "wrote " + (cases.path() / "answers.answers.json").string());
    EXPECT_PRED2(says, run.out, "wrote " + (cases.path() / "answers.fit.json").string());
    EXPECT_EQ(test({"answers", "--strict"}).status, 0);
    run = test();
    EXPECT_EQ(run.status, 3) << "the pictures are skipped";
    EXPECT_PRED2(says, run.out, "1 passed, 2 skipped");

    run = test({"answers", "--update", "all"});
    EXPECT_EQ(run.status, 0);
    make_finer();
    EXPECT_EQ(test({"--update", "answers"}).status, 0);
}

TEST_F(AnswersTestCommandTest, AFullDiskHidesNoVerdict) {
    std::vector<std::string> answers{"test", cases.path().string(), "answers", "--output", output.string()};
    // Standard output alone is full.
    Result run = run_program(answers, "/dev/full");
    EXPECT_EQ(run.status, 1) << "a missing golden weighs more than what cannot be written";
    EXPECT_PRED2(says, run.err, "standard output cannot be written");
    EXPECT_PRED2(says, run.err, "1 without a golden: answers (missing golden)");
    EXPECT_TRUE(exists("out/report.json"));

    const auto fill_disk = [] {
        const rlimit none{10, 10};
        ::setrlimit(RLIMIT_FSIZE, &none);
    };
    EXPECT_EQ(run_program(answers, "/dev/null", "/dev/null", fill_disk).status, 1);
    ASSERT_EQ(test({"--update", "answers"}).status, 0);
    answers.insert(answers.end(), {"--junit", (output / "junit.xml").string()});
    EXPECT_EQ(run_program(answers, "/dev/null", "/dev/null", fill_disk).status, 3) << "it passed, and is not written";
    EXPECT_EQ(run_program(answers).status, 0);
}

TEST_F(DrawnTestCommandTest, ARunThatIsEndedReportsWhatWasDone) {
    const CaseFolder two;
    std::string frames;
    for (int i = 0; i < 20; ++i) frames += "frames 100000\n";
    two.folder().write("slow.script", frames);
    two.write("slow", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x360", "time_limit": 600,
                          "window": {"script": "slow.script"}})");
    two.add("\xff");  // its name is no text: known at once
    const std::filesystem::path junit = output / "junit.xml";
    const std::filesystem::path out = cases.folder().write("out.txt", "");
    const pid_t child = start_program(
        {"test", two.path().string(), "--jobs", "2", "--output", output.string(), "--junit", junit.string()},
        {"/dev/null", out, "/dev/null"});
    std::this_thread::sleep_for(std::chrono::seconds(3));
    ::kill(child, SIGTERM);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    EXPECT_PRED2(says, slurp(junit), "value=\"ended after 1 of 2 cases\"");
    EXPECT_PRED2(says, slurp(out), "1 failed; drawn by nothing; ended after 1 of 2 cases");
    EXPECT_TRUE(exists("out/report.json"));
}

TEST_F(AnswersTestCommandTest, EveryReportSaysWhatDiffers) {
    ASSERT_EQ(test({"--update", "answers"}).status, 0);
    const std::string before = slurp(cases.path() / "answers.answers.json");
    make_finer();
    const std::string html = (output / "report.html").string(), junit = (output / "junit.xml").string();
    const Result run = test({"answers", "--html", html, "--junit", junit});
    EXPECT_EQ(run.status, 1);
    const std::string words = "answers.answers.json: query 0, A and B: ";
    EXPECT_PRED2(says, run.out, "different: answers: " + words);
    EXPECT_PRED2(says, run.out, "What is right becomes a golden with\n  mobbscope test ");
    EXPECT_PRED2(says, slurp(junit), words);
    EXPECT_PRED2(says, slurp(junit), "If what is there now is right: ");
    EXPECT_PRED2(says, slurp(html), words);
    EXPECT_PRED2(says, slurp(html), "Commands that accept this case");
    const nlohmann::json line = nlohmann::json::parse(test({"answers", "--json-lines"}).out);
    EXPECT_EQ(line["findings"][0]["golden"], ".answers.json");
    EXPECT_EQ(line["backend"], "none");
    EXPECT_TRUE(line["actual"].is_null());

    const std::string now = slurp(output / "answers.actual.answers.json");
    EXPECT_NE(now, before);
    const Result taken = run_program({"test", cases.path().string(), "--accept", html});
    EXPECT_EQ(taken.status, 0) << taken.err;
    EXPECT_EQ(slurp(cases.path() / "answers.answers.json"), now);
    EXPECT_EQ(test({"answers"}).status, 0);
    EXPECT_FALSE(exists("out/answers.actual.answers.json"));
    EXPECT_EQ(test({"answers", "--html", html}).status, 0);
    EXPECT_PRED2(says, slurp(html), "answers") << "one that passed without a picture";
}

TEST_F(AnswersTestCommandTest, BesideAPictureAnswersAreHeldWithoutOpenGL) {
    const auto write = [&](const std::string& more) {
        cases.write("both", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "160x120",
                                "hold": ["picture", "answers"])" +
                                more + "}");
    };
    const std::string html = (output / "report.html").string(), junit = (output / "junit.xml").string();
    const auto run = [&] { return test({"--html", html, "--junit", junit}); };
    write("");
    Result taken = test({"--update", "both"});
    EXPECT_EQ(taken.status, 3) << "the picture is skipped";
    EXPECT_PRED2(says, taken.out, "wrote " + (cases.path() / "both.answers.json").string());
    ASSERT_EQ(test({"--update", "answers"}).status, 0);

    const std::string words = "as in the goldens: answers; the picture was not drawn: no OpenGL 3.3";
    Result held = run();
    EXPECT_EQ(held.status, 3) << held.out;
    EXPECT_TRUE(held.err.starts_with("mobbscope: no OpenGL 3.3")) << held.err;
    EXPECT_PRED2(says, held.out, "skipped: both: " + words);
    EXPECT_PRED2(says, held.out, "1 passed, 3 skipped; drawn by nothing: there is no OpenGL");
    EXPECT_PRED2(says, slurp(html), words);
    EXPECT_PRED2(says, slurp(junit), "<skipped message=\"" + words);
    const nlohmann::json told = nlohmann::json::parse(test({"both", "--json"}).out)["cases"][0];
    EXPECT_EQ(told["outcome"], "skipped");
    EXPECT_PRED2(says, told["message"].get<std::string>(), words);

    write(R"(, "fit": {"leaf": 1})");
    held = run();
    EXPECT_EQ(held.status, 1) << "a difference weighs more than what was not drawn";
    EXPECT_TRUE(is_one_line(held.err)) << held.err;
    EXPECT_PRED2(says, held.err, "warning: no OpenGL 3.3");
    EXPECT_PRED2(says, held.out, "different: both: both.answers.json: query 0, A and B: ");
    EXPECT_PRED2(says, held.out, "\n  the picture was not drawn: no OpenGL 3.3");
    for (const std::string& report : {html, junit}) {
        EXPECT_PRED2(says, slurp(report), "both.answers.json: ");
        EXPECT_PRED2(says, slurp(report), "the picture was not drawn: no OpenGL 3.3");
    }
    EXPECT_EQ(test({"both", "--json-lines"}).status, 1);
    EXPECT_EQ(run_program({"test", cases.path().string(), "both", "--accept", html}).status, 0);
    EXPECT_EQ(run().status, 3);
}

TEST_F(AnswersTestCommandTest, WithoutOpenGLWhatIsNotWrittenIsSaid) {
    ASSERT_EQ(test({"--update", "answers"}).status, 0);
    const std::string sheet = (output / "all.png").string();
    cases.add("broken", R"("veiw": {})");
    Result run = test({"broken", "--contact-sheet", sheet});
    EXPECT_EQ(run.status, 1) << "a failure weighs more than a sheet: " << run.err;
    EXPECT_PRED2(says, run.err, "warning: " + sheet + ": not written: no OpenGL 3.3");
    std::filesystem::remove(cases.path() / "broken.case.json");

    cases.write("both", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "160x120",
                            "hold": ["picture", "answers"]})");
    run = test({"--contact-sheet", sheet});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_PRED2(says, run.err, "warning: " + sheet + ": not written: no OpenGL 3.3");
}

TEST_F(AnswersTestCommandTest, WhatTheSceneExpectsNoGoldenMends) {
    cases.folder().write("scene.json", std::string(kSmallScene).insert(1, R"( "queries": [{"a": "A", "b": "B",
        "expect": {"tests": {"time": 1000}}}],)"));
    const Result run = test({"--update", "answers"});
    EXPECT_EQ(run.status, 1);
    EXPECT_PRED2(says, run.out, "query 0: expected 1000 tests of time, but there are ");
    EXPECT_TRUE(exists("answers.answers.json")) << "its goldens are taken all the same";
    EXPECT_FALSE(says(test({"answers"}).out, "--update")) << "there is nothing more to take";
}

TEST_F(AnswersTestCommandTest, TheGuardedFolderIsFound) {
    const std::filesystem::path shared = kSharedData / "guard/answers";
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "there is no " << shared;
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    if (!has_or_skip(Backend::automatic)) return;
    const TempFolder folder;
    std::filesystem::copy(shared, folder.path() / "answers");
    const std::string cases_of = (folder.path() / "answers").string();
    const Result run = run_program({"test", cases_of, "--output", output.string()});
    EXPECT_EQ(run.status, 1);
    EXPECT_PRED2(says, run.out, "s.json: query 0: expected no collision, but A and B collide at 1.45 s");
}

TEST_F(DrawnTestCommandTest, MissingGoldensAreNamedAndKept) {
    const Result run = test();
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_PRED2(says, run.out, "missing golden: path:");
    EXPECT_PRED2(says, run.out, "missing golden: query/end:");
    EXPECT_TRUE(exists("out/path.actual.png"));
    EXPECT_TRUE(exists("out/query/end.actual.png"));
    EXPECT_FALSE(exists("out/path.golden.png"));
    EXPECT_FALSE(exists("path.png")) << "nothing is taken that was not asked for";
}

TEST_F(DrawnTestCommandTest, PassesAndLeavesNothing) {
    take_all();
    const Result run = test();
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_PRED2(says, run.out, "2 passed");
    EXPECT_EQ(run.err, "");
    EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(DrawnTestCommandTest, EveryOutcomeIsToldApart) {
    take_all();
    cases.add("path", R"("view": {"levels": 0})");
    cases.add("new");
    cases.add("broken", R"("veiw": {})");
    cases.add("later", R"("skip": "waits for the crowd")");
    const Result run = test({"--json"});
    EXPECT_EQ(run.status, 1) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["summary"]["passed"], 1);
    EXPECT_EQ(report["summary"]["different"], 1);
    EXPECT_EQ(report["summary"]["failed"], 1);
    EXPECT_EQ(report["summary"]["skipped"], 1);
    for (const char* what : {"actual", "golden", "heat"}) {
        EXPECT_TRUE(exists(std::string("out/path.") + what + ".png")) << what;
    }
    EXPECT_TRUE(exists("out/new.actual.png"));
    EXPECT_FALSE(exists("out/query/end.actual.png")) << "it passed";
    EXPECT_PRED2(says, test().out, "failed: broken: ");
    EXPECT_PRED2(says, test().out, "skipped: later: waits for the crowd");
}

/// Each of standard output's lines.
std::vector<nlohmann::json> json_lines(const std::string& out) {
    std::vector<nlohmann::json> lines;
    std::istringstream text(out);
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

TEST_F(DrawnTestCommandTest, EachResultIsALineOfJson) {
    take_all();
    cases.add("changed");
    ASSERT_EQ(test({"changed", "--update", "all"}).status, 0);
    const std::string golden = slurp(cases.path() / "changed.png");
    cases.add("changed", R"("view": {"levels": 0})");
    cases.add("new \"one\"\nof two lines");
    cases.write("broken", R"({"mobbscope_case": 1,)");
    cases.add("later", R"("skip": "waits for the crowd")");
    const Result run = test({"--json-lines"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "") << "a case that cannot be drawn is a result";
    EXPECT_FALSE(std::filesystem::exists(output)) << "nothing is written";

    const std::vector<nlohmann::json> lines = json_lines(run.out);
    std::vector<std::pair<std::string, std::string>> told;
    for (const nlohmann::json& line : lines) {
        for (const char* key : {"name", "outcome", "message", "remarks", "tolerance", "backend", "renderer", "diff",
                                "findings", "mask", "actual", "golden", "fresh"}) {
            EXPECT_TRUE(line.contains(key)) << key;
        }
        told.emplace_back(line["name"], line["outcome"]);
    }
    ASSERT_EQ(told, (std::vector<std::pair<std::string, std::string>>{{"broken", "failed"},
                                                                      {"changed", "different"},
                                                                      {"later", "skipped"},
                                                                      {"new \"one\"\nof two lines", "missing golden"},
                                                                      {"path", "passed"},
                                                                      {"query/end", "passed"}}));
    EXPECT_PRED2(says, lines[0]["message"].get<std::string>(), "broken.case.json: line 1");
    EXPECT_TRUE(lines[0]["actual"].is_null());
    EXPECT_EQ(lines[2]["message"], "waits for the crowd");
    // What would be written if it were accepted, and in place of what.
    const nlohmann::json& changed = lines[1];
    EXPECT_GT(changed["diff"]["failing"], 0);
    ASSERT_EQ(changed["fresh"].size(), 2u);
    const auto bytes = [](const nlohmann::json& packed) { return from_base64(packed.get<std::string>()).value(); };
    EXPECT_EQ(changed["fresh"][0]["golden"], ".png");
    EXPECT_EQ(bytes(changed["fresh"][0]["replaces"]), golden);
    EXPECT_EQ(bytes(changed["fresh"][0]["bytes"]), bytes(changed["actual"]));
    EXPECT_EQ(changed["findings"].size(), 2u) << "picture and draw list";
    EXPECT_EQ(lines[4]["fresh"], nlohmann::json::array());

    EXPECT_EQ(test({"--json-lines", "path"}).status, 0);
    EXPECT_EQ(json_lines(test({"--json-lines", "path"}).out).size(), 1u);
}

TEST_F(TestCommandTest, LinesOfJsonAreRefusedAsReportsAre) {
    expect_test_refused(run_program({"test", (cases.path() / "x").string(), "--json-lines"}), "cannot be searched");
    expect_test_refused(test({"--json-lines", "pth"}), "there is no case 'pth'");
    expect_test_refused(test({"--json-lines", "--update", "all"}), "--json-lines writes nothing else");
    expect_test_refused(test({"--json-lines", "--html", "a.html"}), "--json-lines writes nothing else");
    EXPECT_EQ(test({"--json-lines", "--json"}).status, 2);
}

TEST_F(TestCommandTest, WithoutOpenGLEachLineSaysSo) {
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const Result run = test({"--json-lines"});
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    const std::vector<nlohmann::json> lines = json_lines(run.out);
    ASSERT_EQ(lines.size(), 2u);
    for (const nlohmann::json& line : lines) EXPECT_EQ(line["outcome"], "skipped");
}

TEST_F(DrawnTestCommandTest, AReaderThatIsGoneEndsIt) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    ::close(ends[0]);
    constexpr int kOut = 9;
    ASSERT_EQ(::dup2(ends[1], kOut), kOut);
    const std::string command = "'" MOBBSCOPE_PROGRAM "' test '" + cases.path().string() + "' --json-lines >&9 2>'" +
                                (cases.path() / "said").string() + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 3);
    EXPECT_EQ(slurp(cases.path() / "said"), "");
    ::close(kOut);
    ::close(ends[1]);
}

TEST_F(DrawnTestCommandTest, UpdateTakesWhatIsNamedAndNothingElse) {
    take_all();
    const std::string before = slurp(cases.path() / "query" / "end.png");
    cases.add("path", R"("view": {"levels": 0})");
    cases.write("query/end", R"({"mobbscope_case": 1, "scene": "../scene.json", "size": "170x120"})");
    const Result run = test({"--update", "path"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_PRED2(says, run.out, "wrote " + (cases.path() / "path.png").string());
    EXPECT_EQ(slurp(cases.path() / "query" / "end.png"), before);
    EXPECT_EQ(test().status, 1);
    EXPECT_EQ(test({"path"}).status, 0);
}

TEST_F(DrawnTestCommandTest, UpdateOfAllWritesOnlyWhatDoesNotPass) {
    take_all();
    const auto time = std::filesystem::last_write_time(cases.path() / "path.png");
    const Result run = test({"--update", "all"});
    EXPECT_EQ(run.status, 0);
    EXPECT_FALSE(says(run.out, "wrote")) << run.out;
    EXPECT_EQ(std::filesystem::last_write_time(cases.path() / "path.png"), time);
    // ... and the state of a golden that lacks it.
    std::filesystem::remove(cases.path() / "path.state.json");
    EXPECT_PRED2(says, test({"--update", "all"}).out, "wrote " + (cases.path() / "path.state.json").string());
}

TEST_F(DrawnTestCommandTest, UpdateOfANameAlwaysWrites) {
    take_all();
    const std::string right = slurp(cases.path() / "path.png");
    Image wrong = read_png(cases.path() / "path.png");
    wrong.at(80, 60)[0] ^= 0x80;
    write_png(cases.path() / "path.png", wrong);
    const Result passes = test({"path"});
    EXPECT_EQ(passes.status, 0);
    EXPECT_PRED2(says, passes.out, "passed: path: 1 of 19200 pixels");
    EXPECT_PRED2(says, passes.out, "within 1x1 at (80, 60); allowed: 4");
    EXPECT_PRED2(says, passes.out, "1 of those that passed differs from the golden in some pixels");
    const Result all = test({"--update", "all"});
    EXPECT_PRED2(says, all.out, "passed: path: 1 of 19200 pixels") << "it is named";
    EXPECT_NE(slurp(cases.path() / "path.png"), right);
    EXPECT_PRED2(says, test({"--update", "path"}).out, "wrote " + (cases.path() / "path.png").string());
    EXPECT_EQ(slurp(cases.path() / "path.png"), right);
    EXPECT_PRED2(says, test({"--update", "p*"}).out, "wrote " + (cases.path() / "path.png").string());
}

TEST_F(DrawnTestCommandTest, ACaseThatSeesHardlyAnythingFailsAStrictRun) {
    take_all();
    EXPECT_EQ(test({"--strict"}).status, 0);
    cases.add("path", R"("allowed": "100%", "view": {"levels": 0}, "state": false)");
    EXPECT_EQ(test().status, 0) << "it is weak";
    const std::string junit = (output / "junit.xml").string(), page = (output / "page.html").string();
    const Result strict = test({"--strict", "--junit", junit, "--html", page});
    EXPECT_EQ(strict.status, 1);
    EXPECT_PRED2(says, strict.out, "weak case: path: \"allowed\" lets 100 % of its pixels differ\n");
    EXPECT_PRED2(says, slurp(junit), "tests=\"3\" failures=\"1\"");
    EXPECT_PRED2(says, slurp(junit), "lets 100 % of its pixels differ");
    EXPECT_PRED2(says, slurp(page), "1 weakness of cases");
    EXPECT_EQ(nlohmann::json::parse(test({"--strict", "--json"}).out)["weak"].size(), 1u);
    EXPECT_EQ(test({"query/end", "--strict"}).status, 0) << "that one is not run";
}

TEST_F(DrawnTestCommandTest, AnOrphanedGoldenIsToldAndFailsAStrictRun) {
    take_all();
    cases.folder().write("lost.png", "");
    const Result told = test();
    EXPECT_EQ(told.status, 0);
    EXPECT_PRED2(says, told.out, "orphaned golden: " + (cases.path() / "lost.png").string() + ": no case has it");
    EXPECT_FALSE(says(test({"path"}).out, "orphaned")) << "where only some are run, nothing is said of the others";
    const std::string junit = (output / "junit.xml").string();
    EXPECT_EQ(test({"--strict", "--junit", junit}).status, 1);
    EXPECT_PRED2(says, slurp(junit), "tests=\"3\" failures=\"1\"");
    EXPECT_PRED2(says, slurp(junit), "lost.png: no case has it");
    EXPECT_EQ(nlohmann::json::parse(test({"--json"}).out)["orphans"].size(), 1u);
    std::filesystem::remove(cases.path() / "lost.png");
    std::filesystem::create_directory(cases.path() / "kept");
    cases.folder().write("kept/path.actual.png", slurp(cases.path() / "path.png"));
    EXPECT_EQ(test({"--strict"}).status, 1);
    const std::string inside = (cases.path() / "kept").string();
    EXPECT_EQ(run_program({"test", cases.path().string(), "--strict", "--output", inside}).status, 0)
        << "an earlier run left it";
}

TEST_F(DrawnTestCommandTest, AMaskOfAnotherSizeEndsTheRun) {
    cases.add("path", R"("mask": "small.png")");
    write_png(cases.path() / "small.png", Image(10, 10));
    EXPECT_EQ(test({"path"}).status, 1) << "there is no golden yet";
    write_png(cases.path() / "path.png", Image(160, 120));
    expect_test_refused(test({"path"}), "small.png: the mask has 10x10 pixels and ");
    cases.add("path", R"("mask": "small.png", "skip": "later")");
    EXPECT_EQ(test({"path"}).status, 0) << "nothing is compared";
}

TEST_F(DrawnTestCommandTest, AStateWithAnOldNameEndsTheRun) {
    cases.add("path", R"("window": {})");
    cases.folder().write("path.state.json", "{\n \"views\": [{\"tree\": \"production\"}]}\n");
    expect_test_refused(test({"path"}), "path.state.json: line 2, /views/0/tree: `production` is called `blocks`");
}

TEST_F(DrawnTestCommandTest, APictureOfAnotherSizeIsTakenWithTheMaskThatFitsIt) {
    cases.add("path", R"("mask": "mask.png")");
    Image mask(160, 120);
    std::ranges::fill(mask.rgba, std::uint8_t{255});
    write_png(cases.path() / "mask.png", mask);
    write_png(cases.path() / "path.png", Image(80, 60));
    expect_test_refused(test({"path"}), "mask.png: the mask has 160x120 pixels and ");
    EXPECT_EQ(test({"--update", "path"}).status, 0);
    EXPECT_EQ(test({"path"}).status, 0);
}

// --- from a report

/// Goldens, and a report of a run that found the first case another, the second without a golden.
class AcceptTest : public DrawnTestCommandTest {
  protected:
    void SetUp() override {
        DrawnTestCommandTest::SetUp();
        if (IsSkipped()) return;
        ASSERT_EQ(test({"path", "--update", "all"}).status, 0);
        before = slurp(cases.path() / "path.png");
        cases.add("path", R"("view": {"levels": 0})");
        ASSERT_EQ(test({"--html", page.string()}).status, 1);
    }
    Result accept(const std::filesystem::path& report, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"test", cases.path().string(), "--accept", report.string()};
        all.insert(all.end(), more.begin(), more.end());
        // As on a machine without OpenGL.
        ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
        Result run = run_program(all);
        ::unsetenv("MESA_GL_VERSION_OVERRIDE");
        return run;
    }

    /// What the state was that the report was held against.
    std::string old_state() const {
        const nlohmann::json report = nlohmann::json::parse(slurp(output / "report.json"));
        for (const nlohmann::json& fresh : report["cases"][0]["fresh"]) {
            if (fresh["golden"] == ".state.json") return from_base64(fresh["replaces"].get<std::string>()).value();
        }
        return "";
    }

    std::string before;
    const std::filesystem::path page = output / "page.html";
};

TEST_F(AcceptTest, TakesThePicturesOfAReportByteByByte) {
    for (const std::filesystem::path& report : {page, output, output / "report.json"}) {
        cases.folder().write("path.png", before);
        std::filesystem::remove(cases.path() / "query/end.png");
        std::filesystem::remove(cases.path() / "query/end.state.json");
        const std::string state = slurp(output / "path.actual.state.json");
        const Result run = accept(report);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_PRED2(says, run.out, "wrote " + (cases.path() / "path.png").string());
        EXPECT_PRED2(says, run.out, "accepted 2 cases of ");
        EXPECT_EQ(slurp(cases.path() / "path.png"), slurp(output / "path.actual.png"));
        EXPECT_EQ(slurp(cases.path() / "path.state.json"), state);
        EXPECT_EQ(slurp(cases.path() / "query/end.png"), slurp(output / "query/end.actual.png"));
        const Result again = accept(report);
        EXPECT_EQ(again.status, 0) << "twice is once";
        EXPECT_PRED2(says, again.out, "2 cases have the goldens of ");
        EXPECT_FALSE(says(again.out, "accepted")) << again.out;
        cases.folder().write("path.state.json", old_state());
    }
}

TEST_F(AcceptTest, OfSomeOfItsCases) {
    EXPECT_EQ(accept(page, {"path"}).status, 0);
    EXPECT_EQ(slurp(cases.path() / "path.png"), slurp(output / "path.actual.png"));
    EXPECT_FALSE(exists("query/end.png"));
    const std::string rest = accept(page).out;
    EXPECT_PRED2(says, rest, "1 case has the goldens of " + page.string() + " already\naccepted 1 case of ");
    expect_test_refused(accept(page, {"pth"}), "there is no case 'pth'");
    cases.add("fine");
    expect_test_refused(accept(page, {"fine"}), "'fine' passed there, or was not drawn");
}

TEST_F(AcceptTest, LeavesAGoldenThatIsAnotherThanInTheReport) {
    cases.folder().write("path.png", "somebody else's");
    expect_test_refused(accept(page), "path.png: has changed on the disk");
    EXPECT_EQ(slurp(cases.path() / "path.png"), "somebody else's");
    EXPECT_FALSE(exists("query/end.png")) << "all or none";
}

TEST_F(AcceptTest, SaysWhatItCannotTake) {
    std::filesystem::remove(cases.path() / "query/end.case.json");
    const Result gone = accept(page);
    EXPECT_EQ(gone.status, 1);
    EXPECT_PRED2(says, gone.err, "query/end: not accepted: there is no such case");
    EXPECT_EQ(slurp(cases.path() / "path.png"), slurp(output / "path.actual.png")) << "the others are taken";
    cases.add("path", R"("veiw": {})");
    EXPECT_EQ(test().status, 1);
    const Result failed = accept(output);
    EXPECT_EQ(failed.status, 1);
    EXPECT_PRED2(says, failed.err, "path: not accepted: it has no golden to take");
}

TEST_F(AcceptTest, AReportTellsOfTheCasesThatThereAre) {
    using Told = std::vector<std::string>;
    const auto names = [](const std::filesystem::path& folder) {
        const nlohmann::json told = nlohmann::json::parse(slurp(folder / "report.json"));
        Told out;
        for (const nlohmann::json& one : told["cases"]) out.push_back(one["name"].get<std::string>());
        return out;
    };
    EXPECT_EQ(test({"path"}).status, 1);
    EXPECT_EQ(names(output), (Told{"path", "query/end"})) << "what a run of some leaves out stays";
    cases.add("path");
    EXPECT_EQ(test({"path"}).status, 0);
    EXPECT_EQ(names(output), Told{"query/end"}) << "and what passes goes";

    // Folders may share a report.
    const CaseFolder others;
    others.write("far", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["answers"]})");
    const TempFolder shared;
    const auto run = [&](const CaseFolder& of) {
        return run_program({"test", of.path().string(), "--output", shared.path().string()}).status;
    };
    EXPECT_EQ(run(others), 1);
    EXPECT_EQ(run(cases), 1);
    EXPECT_EQ(names(shared.path()), (Told{"far", "query/end"}));
    std::filesystem::remove(cases.path() / "query/end.case.json");
    EXPECT_EQ(run(cases), 0);
    EXPECT_EQ(names(shared.path()), Told{"far"}) << "a run of all leaves only what is told of other folders";
}

TEST_F(AcceptTest, RefusesWhatIsNoReport) {
    expect_test_refused(accept(cases.path() / "none.html"), "there is no report; give the folder");
    expect_test_refused(accept(cases.path()), "report.json");
    expect_test_refused(accept(cases.path() / "scene.json"), "scene.json");
    cases.folder().write("old.json", R"({"mobbscope_report": 9, "cases": []})");
    expect_test_refused(accept(cases.path() / "old.json"), "version 9; this program reads version 1");
    std::string cut = slurp(page);
    cut.resize(cut.find("mobbscope_report") + 200);
    cases.folder().write("cut.html", cut);
    expect_test_refused(accept(cases.path() / "cut.html"), "cut.html");
    for (const char* other : {"--strict", "--json"}) expect_test_refused(accept(page, {other}), "--accept");
    expect_test_refused(accept(page, {"--update", "all"}), "--accept");
}

TEST_F(AcceptTest, RefusesADamagedReportAndWritesNothing) {
    const std::string whole = slurp(output / "report.json");
    const std::string before_state = slurp(cases.path() / "path.state.json");
    const auto expect_refused = [&](const nlohmann::json& report, const std::string& words) {
        cases.folder().write("damaged.json", report.dump());
        expect_test_refused(accept(cases.path() / "damaged.json"), words);
        EXPECT_EQ(slurp(cases.path() / "path.png"), before);
        EXPECT_EQ(slurp(cases.path() / "path.state.json"), before_state);
        EXPECT_FALSE(exists("query/end.png"));
    };
    nlohmann::json report = nlohmann::json::parse(whole);
    report["cases"].push_back(report["cases"][0]);
    expect_refused(report, "/cases/2/name: the case 'path' is given twice");
    for (nlohmann::json::size_type i = 0; i < 2; ++i) {
        report = nlohmann::json::parse(whole);
        report["cases"][1]["fresh"][i]["bytes"] = base64("damaged");
        expect_refused(report, i == 0 ? "end.png as it would be: " : "end.state.json as it would be: ");
    }
    report = nlohmann::json::parse(whole);
    report["cases"][1]["fresh"][0]["golden"] = ".script";
    expect_refused(report, "/cases/1/fresh/0/golden: '.script' is not a golden of a case");

    std::string text = slurp(page);
    text.replace(text.find("\"mobbscope_report\": 1"), 21, "\"mobbscope_report\": 9");
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find("mobbscope_report")), '\n');
    cases.folder().write("other.html", text);
    expect_test_refused(accept(cases.path() / "other.html"), "other.html: line " + std::to_string(line) + ',');
    cases.folder().write("other.html", "<!DOCTYPE html>\n<html></html>");
    expect_test_refused(accept(cases.path() / "other.html"), "other.html: is a page without a report");
}

TEST_F(DrawnTestCommandTest, AFailedPictureNeverTouchesItsGolden) {
    take_all();
    const std::string before = slurp(cases.path() / "path.png");
    cases.add("path", R"("view": {"query": 9})");
    EXPECT_EQ(test({"--update", "all"}).status, 1);
    EXPECT_EQ(slurp(cases.path() / "path.png"), before);
}

TEST_F(DrawnTestCommandTest, StatesAreHeldAndTaken) {
    take_all();
    ASSERT_TRUE(exists("path.state.json"));
    nlohmann::json state = nlohmann::json::parse(slurp(cases.path() / "path.state.json"));
    state["panels"][0]["agents"][1]["translate"] = {1, 0};
    cases.folder().write("path.state.json", state.dump());
    const Result differs = test({"path"});
    EXPECT_EQ(differs.status, 1);
    EXPECT_PRED2(says, differs.out, "different: path: path.state.json: B moved by (0, -1)\n");
    cases.folder().write("path.state.json", "");
    EXPECT_EQ(test({"path"}).status, 1);
    EXPECT_PRED2(says, test({"--update", "path"}).out, "wrote " + (cases.path() / "path.state.json").string());
    EXPECT_EQ(test().status, 0);
}

TEST_F(DrawnTestCommandTest, AtATerminalItAsks) {
    if (std::system("command -v script >/dev/null") != 0) GTEST_SKIP() << "there is no script(1) to make a terminal";
    const auto answer = [&](const std::string& keys) {
        const std::string command = "printf '" + keys + "' | script -qec \"'" MOBBSCOPE_PROGRAM "' test '" +
                                    cases.path().string() + "' --output '" + output.string() +
                                    "' --update\" /dev/null >'" + (cases.path() / "said").string() + "' 2>&1";
        return WEXITSTATUS(std::system(command.c_str()));
    };
    EXPECT_EQ(answer("n\\ny\\n"), 1);
    EXPECT_FALSE(exists("path.png"));
    EXPECT_TRUE(exists("query/end.png"));
    const std::string said = slurp(cases.path() / "said");
    EXPECT_PRED2(says, said, "take it? [y/N/a/q]");
    EXPECT_PRED2(says, said, "path.actual.png");
    EXPECT_PRED2(says, said, "wrote ");

    std::filesystem::remove(cases.path() / "query" / "end.png");
    EXPECT_EQ(answer("q\\n"), 1);
    EXPECT_FALSE(exists("path.png"));
    EXPECT_FALSE(exists("query/end.png"));

    EXPECT_EQ(answer("a\\n"), 0);
    EXPECT_TRUE(exists("path.png"));
    EXPECT_TRUE(exists("query/end.png"));
}

TEST_F(DrawnTestCommandTest, AllPicturesStandInOneSheet) {
    const std::filesystem::path sheet = output / "deep" / "sheet.png";
    EXPECT_EQ(test({"--contact-sheet", sheet.string(), "--columns", "2"}).status, 1);
    const Image image = read_png(sheet);
    EXPECT_GT(image.width, 320);
    EXPECT_LT(image.width, 400);
    EXPECT_GT(image.height, 120);
    EXPECT_LT(image.height, 200);
}

/// What did not pass stands first, marked.
TEST_F(DrawnTestCommandTest, TheSheetBeginsWithWhatDidNotPass) {
    take_all();
    cases.add("zz", R"("veiw": {})");
    const std::filesystem::path sheet = output / "sheet.png";
    EXPECT_EQ(test({"--contact-sheet", sheet.string(), "--columns", "3"}).status, 1);
    const Image image = read_png(sheet);
    const auto marked = [&](int from, int to) {
        constexpr std::array<std::uint8_t, 4> kMark{0xF0, 0x70, 0x1A, 255};
        int count = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = from; x < to; ++x) count += std::equal(kMark.begin(), kMark.end(), image.at(x, y)) ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(marked(0, image.width / 3), 1000);
    EXPECT_LT(marked(image.width / 3, image.width), 500) << "a hit in a picture has that colour too";
}

TEST_F(DrawnTestCommandTest, ShardsTogetherAreAllCases) {
    for (const char* name : {"b", "c", "d"}) cases.add(name);
    EXPECT_EQ(test({"--list", "--shard", "1/2"}).out, "b\nd\nquery/end\n");
    EXPECT_EQ(test({"--list", "--shard", "2/2"}).out, "c\npath\n");
    EXPECT_EQ(test({"--list", "--shard", "2/2", "path", "d"}).out, "path\n");
    for (const char* bad : {"0/2", "3/2", "2", "1/", "/", "a/b", "1/2/3"}) {
        EXPECT_EQ(test({"--shard", bad}).status, 2) << bad;
    }
    take_all();
    cases.folder().write("lost.png", "");
    const Result run = test({"--shard", "2/2", "--json"});
    EXPECT_EQ(run.status, 0);
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["shard"], "2/2");
    EXPECT_EQ(report["summary"]["passed"], 2);
    EXPECT_EQ(report["orphans"].size(), 1u) << "goldens of the other shards' cases are none";
    const Result strict = test({"--shard", "1/2", "--strict"});
    EXPECT_EQ(strict.status, 1);
    EXPECT_PRED2(says, strict.out, ", shard 1/2: 3 passed");
    const Result empty = test({"--shard", "9/9"});
    EXPECT_EQ(empty.status, 0) << empty.err;
    EXPECT_PRED2(says, empty.out, ", shard 9/9: no cases");
    expect_test_refused(test({"--shard", "1/2", "--accept", output.string()}), "--accept");
}

TEST_F(DrawnTestCommandTest, ResultsStandInTheOrderOfTheCases) {
    // The first takes longest.
    cases.add("a", R"("panels": [{}, {}, {}, {}], "size": "1600x1200")");
    for (const char* name : {"b", "c", "d"}) cases.add(name, R"("skip": "later")");
    for (const std::string how : {"--json", "--json-lines"}) {
        const Result run = test({how, "--jobs", "3"});
        const std::vector<nlohmann::json> lines =
            how == "--json" ? nlohmann::json::parse(run.out)["cases"].get<std::vector<nlohmann::json>>()
                            : json_lines(run.out);
        std::string names;
        for (const nlohmann::json& line : lines) names += line["name"].get<std::string>() + ' ';
        EXPECT_EQ(names, "a b c d path query/end ");
    }
    for (const char* bad : {"0", "-1", "x", "257"}) EXPECT_EQ(test({"--jobs", bad}).status, 2) << bad;
}

/// A case whose window waits, and the others.
class HangingCaseTest : public DrawnTestCommandTest {
  protected:
    void add_hanging(const std::string& more) const {
        cases.folder().write("hangs.script", "wait 3600\n");
        cases.add("hangs", R"("window": {"script": "hangs.script"})" + more);
    }
    void expect_reports(const std::string& status_and_why) const {
        EXPECT_PRED2(says, slurp(output / "junit.xml"), "tests=\"3\" failures=\"0\" errors=\"1\" skipped=\"0\"");
        EXPECT_PRED2(says, slurp(output / "junit.xml"), status_and_why);
        EXPECT_PRED2(says, slurp(output / "page.html"), status_and_why);
        EXPECT_PRED2(says, slurp(output / "report.json"), status_and_why);
        EXPECT_GT(read_png(output / "sheet.png").width, 320);
    }
    std::vector<std::string> all_reports() const {
        return {"test",
                cases.path().string(),
                "--output",
                output.string(),
                "--junit",
                (output / "junit.xml").string(),
                "--html",
                (output / "page.html").string(),
                "--contact-sheet",
                (output / "sheet.png").string()};
    }
};

TEST_F(HangingCaseTest, TakesNoLongerThanItMay) {
    take_all();
    add_hanging(R"(, "time_limit": 0.5)");
    const Result run = run_program(all_reports());
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_PRED2(says, run.out, "failed: hangs: took longer than 0.5 s (time_limit)");
    EXPECT_PRED2(says, run.out, ": 2 passed, 1 failed; drawn by ");
    expect_reports("took longer than 0.5 s");
    EXPECT_EQ(run_program({"test", cases.path().string(), "--list"}).status, 0);
    cases.add("hangs", R"("time_limit": 0)");
    EXPECT_PRED2(says, test({"hangs"}).out, "/time_limit: ");
}

/// The process that draws is ended from outside, as by a fault of its own.
TEST_F(HangingCaseTest, ACrashLeavesTheOthersAndAllReports) {
    take_all();
    add_hanging("");
    std::string command = "'" MOBBSCOPE_PROGRAM "'";
    for (const std::string& word : all_reports()) command += " '" + word + "'";
    const std::string said = (cases.path() / "said").string();
    command += " --jobs 1 >'" + said +
               "' 2>&1 & test=$!; until child=$(cat /proc/$test/task/$test/children) && "
               "[ -n \"$child\" ]; do sleep 0.01; done; sleep 0.1; kill -KILL $child; wait $test";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_PRED2(says, slurp(said), "failed: hangs: crashed: Killed");
    EXPECT_PRED2(says, slurp(said), ": 2 passed, 1 failed; drawn by ");
    expect_reports("crashed: Killed");
}

/// A case that draws its own folder would never end.
TEST_F(DrawnTestCommandTest, ACaseStartsNoOther) {
    cases.folder().write("chain.script", "run file.review .\n");
    cases.add("chain", R"("window": {"script": "chain.script"})");
    const Result run = test({"chain"});
    EXPECT_EQ(run.status, 1);
    EXPECT_PRED2(says, run.out, "chain.script: line 1: no case is drawn here: a picture test starts no other");
    // What an earlier run left may be looked at, but not drawn again.
    EXPECT_EQ(test({"path"}).status, 1);
    std::filesystem::rename(output, cases.path() / "earlier");
    cases.folder().write("chain.script",
                         "run file.review \".\" \"earlier\"\nexpect /review/cases/path \"missing golden\"\n");
    EXPECT_PRED2(says, test({"chain"}).out, "missing golden: chain: ");
    cases.folder().write("chain.script", "run file.review \".\" \"earlier\"\nkey Shift+R\n");
    EXPECT_PRED2(says, test({"chain"}).out, "missing golden: chain: ") << "a key's refusal is told in the window";
}

TEST_F(TestCommandTest, RequestsAreLinesOfJson) {
    const auto asked = [&](const std::string& lines) {
        cases.folder().write("lines", lines);
        return run_program({"test", cases.path().string(), "--requests"}, {}, cases.path() / "lines");
    };
    const Result nonsense = asked("path\n");
    EXPECT_EQ(nonsense.status, 2);
    EXPECT_TRUE(is_one_line(nonsense.err)) << nonsense.err;
    EXPECT_PRED2(says, nonsense.err, "a request: line 1");
    EXPECT_EQ(asked("").status, 0);
    expect_test_refused(run_program({"test", cases.path().string(), "path", "--requests"}), "leave out NAME");
    expect_test_refused(run_program({"test", cases.path().string(), "--requests", "--update", "all"}),
                        "leave out --up");
    const Result run = asked(R"({"name": "none", "fresh": "missing"})"
                             "\n");
    EXPECT_EQ(run.status, 0) << run.err;
    ASSERT_TRUE(run.out.starts_with('\n')) << "it says when it can draw";
    EXPECT_EQ(json_lines(run.out.substr(1)).size(), 1u);
}

/// What the tests of another program ask for.
class AskedTest : public DrawnTestCommandTest {
  protected:
    struct Asked {
        std::string name, scene;
        std::string keys = R"({"size": "160x120"})";
    };
    Result ask(const std::vector<Asked>& requests, const std::vector<std::string>& more = {}) const {
        std::string lines;
        for (const Asked& one : requests) {
            lines += nlohmann::json{{"name", one.name}, {"scene", one.scene}, {"keys", one.keys}}.dump();
            lines += '\n';
        }
        cases.folder().write("lines", lines);
        std::vector<std::string> all{"test", goldens.string(), "--asked", "--output", output.string()};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all, {}, cases.path() / "lines");
    }
    Result accept(const std::vector<std::string>& names = {}) const {
        return run_program(with({"test", goldens.string(), "--accept", output.string()}, names));
    }

    const std::filesystem::path goldens = cases.path() / "goldens";
    const std::string scene = kSmallScene;
    const std::string file = (cases.path() / "scene.json").string();
};

TEST_F(AskedTest, GoldensOfTestsStandByThemselves) {
    const Result run = ask({{"a", scene}, {"deep/b", file}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("missing golden a\nmissing golden: a\n")) << run.out;
    EXPECT_PRED2(says, run.out, "MOBBSCOPE_UPDATE=a\n\nmissing golden deep/b\nmissing golden: deep/b\n");
    EXPECT_TRUE(run.out.ends_with("MOBBSCOPE_UPDATE=deep/b\n\n")) << run.out;
    EXPECT_FALSE(std::filesystem::exists(goldens));
    const Result unnamed = accept();
    EXPECT_EQ(unnamed.status, 1);
    EXPECT_PRED2(says, unnamed.err, "a: not accepted: the report brings " + (goldens / "a.case.json").string());
    EXPECT_FALSE(std::filesystem::exists(goldens));
    const Result named = accept({"a", "deep/b"});
    EXPECT_EQ(named.status, 0) << "a report brings cases that are new, where they are named";
    EXPECT_PRED2(says, named.out, "a.case.json is the case itself, no golden: a new one\n");
    EXPECT_PRED2(says, slurp(goldens / "deep/b.case.json"), R"("scene": "../../scene.json",)");
    EXPECT_EQ(run_program({"test", goldens.string(), "--strict"}).status, 0);
    EXPECT_EQ(ask({{"a", scene}, {"deep/b", file}}).out, "passed a\n\npassed deep/b\n\n");
    EXPECT_FALSE(std::filesystem::exists(output / "report.json"));
    // A golden without its case would be no test for anybody else.
    std::filesystem::remove(goldens / "a.case.json");
    EXPECT_PRED2(says, ask({{"a", scene}}).out, "there is no golden " + (goldens / "a.case.json").string());
}

TEST_F(AskedTest, ARunLeavesWhatTheReportTellsOfOthers) {
    ask({{"a", scene}});
    ask({{"b", scene}, {"bad", "{}"}});
    EXPECT_PRED2(says, slurp(output / "report.json"), R"("name": "a")");
    EXPECT_PRED2(says, ask({{"b", scene}}, {"--update", "b"}).out,
                 "passed b\nwrote " + (goldens / "b.case.json").string());
    const std::string report = slurp(output / "report.json");
    EXPECT_PRED2(says, report, R"("name": "a")");
    EXPECT_FALSE(says(report, R"("name": "b")"));
    nlohmann::json forged = nlohmann::json::parse(report);
    forged["cases"][0]["name"] = "../a";
    cases.folder().write("out/report.json", forged.dump());
    EXPECT_PRED2(says, accept().err, "../a: not accepted: there is no such case");
}

TEST_F(AskedTest, WhatIsWrongIsTheAnswer) {
    const auto expect = [&](const Asked& asked, const std::string& words) {
        const Result run = ask({asked});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_TRUE(run.out.starts_with("failed ") && run.out.ends_with("\n\n")) << run.out;
        EXPECT_PRED2(says, run.out, words);
    };
    expect({"a", "{\n\"clips\": }"}, "the scene that the test gives for a: line 2");
    expect({"a", "{\n\"clips\": 3}"}, "a.case.json: line 2, /scene/clips");
    expect({"a", "none.json"}, "none.json: there is no such file");
    expect({"a", ""}, "the name of a file is empty");
    expect({"a", scene, "[]"}, "the keys that the test gives for a: ");
    expect({"a", scene, "{}}, {"}, "the keys that the test gives for a: line 1");
    expect({"a", scene, R"({"mobbscope_case": 1})"}, "/mobbscope_case: is given by the test itself");
    expect({"a", scene, R"({"veiw": {}})"}, "veiw");
    for (const char* name : {"", "../a", "/a", "a/", "a\nb", "..", "a//b", "a,b", "a*", "b/-x", "-x", "all", "1"})
        expect({name, scene}, "cannot be the name of a case");
    expect_test_refused(ask({}, {"--update"}), "--update: standard input already names cases");
    expect_test_refused(ask({}, {"--jobs", "2"}), "--asked: standard input says what is drawn");
}

/// Without pictures.
class AskedAnswersTest : public AskedTest {
  protected:
    void SetUp() override {}
    const std::string answers = R"({"hold": ["answers"]})";
};

TEST_F(AskedAnswersTest, ANameIsOfOneCase) {
    const Result run =
        ask({{"a", scene, answers}, {"a", scene, R"({"hold": ["fit"]})"}, {"a", scene, answers}}, {"--update", "a"});
    EXPECT_PRED2(says, run.out, "failed a\nfailed: a: another test has asked for this name");
    EXPECT_PRED2(says, run.out, "\n\npassed a\n");
    EXPECT_FALSE(std::filesystem::exists(goldens / "a.fit.json"));
    // What was found of the first stays.
    std::filesystem::remove(goldens / "a.answers.json");
    ask({{"a", scene, answers}, {"a", scene, R"({"hold": ["fit"]})"}});
    EXPECT_PRED2(says, slurp(output / "report.json"), R"("there is no golden)");
}

TEST_F(AskedAnswersTest, AMissingGoldenSaysWhatItWouldHold) {
    const Result run = ask({{"a", scene, answers}});
    EXPECT_PRED2(says, run.out, "\n  A and B collide at ");
    EXPECT_PRED2(says, run.out, " tests of time, ");
    EXPECT_PRED2(says, run.out, "\n  actual:  " + (output / "a.actual.answers.json").string() + '\n');
}

TEST_F(AskedAnswersTest, BesideAPictureTheyAreHeldWithoutOpenGL) {
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const std::string both = R"({"hold": ["picture", "answers"])";
    const Result taken = ask({{"a", scene, both + "}"}}, {"--update", "a"});
    EXPECT_TRUE(taken.out.starts_with("skipped a\nwrote ")) << taken.out;
    EXPECT_PRED2(says, ask({{"a", scene, both + "}"}}).out,
                 "skipped a\nskipped: a: as in the goldens: answers; the picture was not drawn: no OpenGL 3.3");
    const Result differs = ask({{"a", scene, both + R"(, "fit": {"leaf": 1}})"}});
    EXPECT_TRUE(differs.out.starts_with("different a\n")) << differs.out;
    EXPECT_PRED2(says, differs.out, "a.answers.json: query 0, A and B: ");
    EXPECT_PRED2(says, differs.out, "\n  the picture was not drawn: no OpenGL 3.3");
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
}

TEST_F(AskedAnswersTest, ACaseThatItsTestHasChangedIsTold) {
    ASSERT_EQ(ask({{"a", scene, answers}}, {"--update", "all"}).status, 0);
    EXPECT_EQ(ask({{"a", scene, " " + answers}}).out, "passed a\n\n") << "it says the same";
    const std::string nearly = std::string(scene).replace(scene.find("0.45]"), 5, "0.45001]");
    EXPECT_PRED2(says, ask({{"a", nearly, answers}}).out, "a.case.json is not what the test asks for");
    const Result changed = ask({{"a", scene, R"({"hold": ["answers"], "time_limit": 5})"}});
    EXPECT_TRUE(changed.out.starts_with("different a\ndifferent: a\n  a.case.json is not what the test asks for\n"))
        << changed.out;
    for (const std::vector<std::string>& names : {std::vector<std::string>{}, {"*"}, {"?"}}) {
        EXPECT_EQ(accept(names).status, 1);
        EXPECT_FALSE(says(slurp(goldens / "a.case.json"), "time_limit")) << "it is not named";
    }
    const Result named = accept({"a"});
    EXPECT_EQ(named.status, 0);
    EXPECT_PRED2(says, named.out, "a.case.json is the case itself, no golden: other \"time_limit\"\n");
    EXPECT_FALSE(says(named.out, "weaker"));
    EXPECT_PRED2(says, slurp(goldens / "a.case.json"), R"("time_limit": 5)");
}

/// A report that was tampered with, or a test that was.
TEST_F(AskedAnswersTest, ACaseThatSeesLessIsSaidToDoSo) {
    ASSERT_EQ(ask({{"a", scene, answers}}, {"--update", "all"}).status, 0);
    const std::string before = slurp(goldens / "a.case.json");
    ask({{"a", scene, R"({"hold": ["answers"], "time_limit": 5})"}});
    nlohmann::json report = nlohmann::json::parse(slurp(output / "report.json"));
    for (nlohmann::json& fresh : report["cases"][0]["fresh"]) {
        if (fresh["golden"] != ".case.json") continue;
        nlohmann::json brought = nlohmann::json::parse(before);
        brought["skip"] = "never";
        fresh["bytes"] = base64(brought.dump());
    }
    cases.folder().write("out/report.json", report.dump());
    EXPECT_EQ(accept().status, 1);
    EXPECT_EQ(slurp(goldens / "a.case.json"), before);
    const Result named = accept({"a"});
    EXPECT_EQ(named.status, 0) << named.err;
    EXPECT_PRED2(says, named.out, "a.case.json is the case itself, no golden: other \"skip\"\n");
    EXPECT_PRED2(says, named.out, "a.case.json is weaker: it is skipped: never\n");
    // That the tests are weak now is said where that is asked for.
    const Result strict = run_program({"test", goldens.string(), "--strict"});
    EXPECT_EQ(strict.status, 1);
    EXPECT_PRED2(says, strict.out, "weak case: a: it is skipped: never\n");
    EXPECT_EQ(run_program({"test", goldens.string()}).status, 0);
    // What is no case is not taken.
    for (nlohmann::json& fresh : report["cases"][0]["fresh"]) {
        if (fresh["golden"] != ".case.json") continue;
        fresh["bytes"] = base64(R"({"mobbscope_case": 1, "hold": []})");
        fresh["replaces"] = base64(slurp(goldens / "a.case.json"));
    }
    cases.folder().write("out/report.json", report.dump());
    expect_test_refused(accept({"a"}), "nothing is held");
}

TEST_F(AskedAnswersTest, FoldersOfGoldensMayShareAReport) {
    ask({{"a", scene, answers}});
    const std::string others = (cases.path() / "others").string();
    const auto in_others = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"test", others};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all, {}, cases.path() / "lines");
    };
    expect_test_refused(in_others({"--accept", output.string()}), "tells of the goldens in " + goldens.string());
    in_others({"--asked", "--output", output.string()});
    EXPECT_EQ(accept({"a"}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(goldens / "a.answers.json"));
    EXPECT_FALSE(std::filesystem::exists(others));
    EXPECT_EQ(in_others({"a", "--accept", output.string()}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(others + "/a.answers.json"));
    // A report that was copied finds its folder by name.
    std::filesystem::remove_all(goldens);
    ask({{"a", scene, answers}});
    std::filesystem::create_directories(cases.path() / "far/away");
    std::filesystem::rename(output / "report.json", cases.path() / "far/away/report.json");
    EXPECT_EQ(run_program({"test", goldens.string(), "a", "--accept", (cases.path() / "far/away").string()}).status, 0);
}

TEST_F(AskedAnswersTest, AReportInTheFolderOfItsCasesIsOfThatFolder) {
    std::filesystem::create_directories(goldens);
    cases.write("goldens/a", R"({"mobbscope_case": 1, "scene": "../scene.json", "hold": ["answers"]})");
    const std::string others = (cases.path() / "others").string(), inside = (goldens / "out").string();
    const auto run = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> all{"test", folder};
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all);
    };
    EXPECT_EQ(run(goldens.string(), {"--output", inside}).status, 1);
    std::filesystem::create_directories(others);
    std::filesystem::copy_file(goldens / "a.case.json", others + "/a.case.json");
    expect_test_refused(run(others, {"--accept", inside}), "tells of the goldens in " + goldens.string());
    EXPECT_EQ(run(others, {"--output", inside}).status, 1);
    EXPECT_EQ(run(goldens.string(), {"--accept", inside}).status, 0) << "the other folder's run has left it";
    EXPECT_TRUE(std::filesystem::exists(goldens / "a.answers.json"));
    EXPECT_FALSE(std::filesystem::exists(others + "/a.answers.json"));
    // Moved, it is of whatever folder is given.
    std::filesystem::remove(goldens / "a.answers.json");
    std::filesystem::remove(inside + "/report.json");
    EXPECT_EQ(run(goldens.string(), {"--output", inside}).status, 1);
    std::filesystem::create_directories(cases.path() / "far/away");
    std::filesystem::rename(inside + "/report.json", cases.path() / "far/away/report.json");
    EXPECT_EQ(run(others, {"--accept", (cases.path() / "far/away").string()}).status, 0);
}

TEST_F(AskedAnswersTest, AnOldReportThatCannotBeReadIsReplacedAndThatIsSaid) {
    std::filesystem::create_directory(output);
    cases.folder().write("out/report.json", "{");
    const Result run = ask({{"a", scene, answers}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_PRED2(says, run.err, "the old report cannot be read and is replaced: " + (output / "report.json").string());
    EXPECT_PRED2(says, slurp(output / "report.json"), R"("name": "a")");
}

TEST_F(AskedAnswersTest, ARunOfAllCasesDropsThoseThatAreNoFiles) {
    ask({{"a", scene, answers}, {"b", scene, answers}}, {"--update", "b"});
    const auto run = [&](const std::vector<std::string>& names) {
        std::vector<std::string> all{"test", goldens.string(), "--output", output.string()};
        all.insert(all.end(), names.begin(), names.end());
        EXPECT_EQ(run_program(all).status, 0);
        return std::filesystem::exists(output / "report.json");
    };
    EXPECT_TRUE(run({"b"})) << "of some cases: a may be asked for again";
    EXPECT_FALSE(run({}));
}

TEST_F(AskedAnswersTest, TheReportIsKeptWhenTheAskerIsGone) {
    std::string lines;
    for (const char* name : {"a", "b"})
        lines += nlohmann::json{{"name", name}, {"scene", scene}, {"keys", answers}}.dump() + '\n';
    cases.folder().write("lines", lines);
    const std::string command = "{ cat '" + (cases.path() / "lines").string() + "'; sleep 1; cat '" +
                                (cases.path() / "lines").string() + "'; } | '" MOBBSCOPE_PROGRAM "' test '" +
                                goldens.string() + "' --asked --output '" + output.string() +
                                "' 2>/dev/null | head -n 1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_PRED2(says, slurp(output / "report.json"), R"("name": "a")");
}

TEST_F(AskedAnswersTest, TextThatIsNotUtf8FailsItsCaseAlone) {
    cases.folder().write("lines", "{\"name\": \"a\", \"scene\": \"\xe4\"}\nnonsense\n" +
                                      nlohmann::json{{"name", "b"}, {"scene", scene}, {"keys", answers}}.dump() + '\n');
    const Result run =
        run_program({"test", goldens.string(), "--asked", "--output", output.string()}, {}, cases.path() / "lines");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("failed a\nwhat the test gives is not UTF-8")) << run.out;
    EXPECT_PRED2(says, run.out, "\nfailed \na request: line 1");
    EXPECT_PRED2(says, run.out, "\nmissing golden b\n");
}

TEST_F(AskedAnswersTest, GoldensMayStandBehindALink) {
    std::filesystem::create_directories(cases.path() / "real/deep/er");
    std::filesystem::create_directory_symlink("real/deep/er", goldens);
    EXPECT_EQ(ask({{"a", file, answers}}, {"--update", "a"}).status, 0);
    EXPECT_PRED2(says, slurp(goldens / "a.case.json"), R"("scene": "../scene.json")");
    EXPECT_EQ(ask({{"a", file, answers}}).out, "passed a\n\n");
    EXPECT_EQ(run_program({"test", goldens.string(), "--output", output.string()}).status, 0);
}

TEST_F(AskedAnswersTest, GoldensAndPicturesGoToTwoFolders) {
    cases.folder().write("lines", "");
    expect_test_refused(run_program({"test", goldens.string(), "--asked", "--output", goldens.string() + '/'}, {},
                                    cases.path() / "lines"),
                        "is where the goldens are");
}

TEST_F(DrawnTestCommandTest, NoGoldenReplacesWhatTheCaseReads) {
    for (const char* ending : {".state.json", ".answers.json"}) {
        const std::string scene = "c" + std::string(ending);
        const std::filesystem::path file = cases.folder().write(scene, kSmallScene);
        cases.write("c", R"({"mobbscope_case": 1, "hold": ["picture", "answers"], "scene": ")" + scene + "\"}");
        const Result run = test({"c", "--update", "c"});
        EXPECT_PRED2(says, run.out,
                     "failed: c: " + (cases.path() / "c.case.json").string() + ": the case reads " + scene);
        EXPECT_EQ(slurp(file), kSmallScene);
        std::filesystem::remove(file);
    }
}

TEST_F(AnswersTestCommandTest, UpdateOfAllLeavesGoldensThatPass) {
    ASSERT_EQ(test({"--update", "answers"}).status, 0);
    const std::filesystem::path golden = cases.path() / "answers.answers.json";
    const std::string before = slurp(golden) + '\n';
    cases.folder().write("answers.answers.json", before);
    cases.folder().write("scene.json", std::string(kSmallScene).insert(1, R"( "queries": [{"a": "A", "b": "B",
        "expect": {"tests": {"time": 1000}}}],)"));
    const Result run = test({"answers", "--update", "all"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(slurp(golden), before);
    EXPECT_PRED2(says, run.out,
                 "\n  if the answer is right, correct `expect` in " + (cases.path() / "scene.json").string());
    EXPECT_PRED2(says, run.out, "What did not pass: ");
}

TEST_F(DrawnTestCommandTest, BothBackendsDrawTheSamePicture) {
    if (!has_or_skip(Backend::osmesa) || !has_or_skip(Backend::egl)) return;
    EXPECT_EQ(test({"--backend", "osmesa", "--update", "all"}).status, 0);
    EXPECT_EQ(test({"--backend", "egl"}).status, 0);
}

}  // namespace
}  // namespace mobbscope
