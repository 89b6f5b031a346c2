// Cases drawn by other processes: what becomes of them and of these when something goes wrong. Shell scripts stand in
// for the program.
#include <base/error.h>
#include <cases/drawing_child.h>
#include <cases/result_line.h>
#include <support/processes.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

/// Draws cases a, b, ... with a script that says of each what it has in a file, but for those that are told otherwise.
class DrawCasesTest : public ::testing::Test {
  protected:
    static constexpr std::size_t kCases = 6;

    DrawCasesTest() {
        for (std::size_t i = 0; i < kCases; ++i) add(std::string(1, static_cast<char>('a' + i)), "");
    }
    void add(const std::string& name, const std::string& more) {
        const CaseFile file = cases.add(name, more);
        std::erase_if(orders, [&](const CaseOrder& order) { return order.file.name == name; });
        orders.push_back({file});
        CaseResult result;
        result.file = file;
        result.drawn_by = {"osmesa", "llvmpipe"};
        std::ostringstream line;
        write_result_line(line, result);
        cases.folder().write(name + ".line", line.str());
    }
    /// `otherwise`: lines of a shell's `case`, by name.
    std::vector<std::string> draw(const std::string& otherwise, int jobs) {
        return draw_cases(
            {.program = script(otherwise), .backend = "auto", .jobs = jobs}, cases.path(), orders,
            [this](const CaseResult& result) { told.push_back(result); }, [] {});
    }
    std::filesystem::path script(const std::string& otherwise) const {
        const std::string folder = cases.path().string();
        const std::filesystem::path out = cases.folder().write(
            "draw.sh", "#!/bin/sh\necho $$ >>'" + folder +
                           "/pids'\n"
                           "echo\nwhile read -r line; do\n  name=$(printf %s \"$line\" | sed 's/.*\"name\": "
                           "\"\\([^\"]*\\)\".*/\\1/')\n  case $name in\n" +
                           otherwise + "\n    *) cat '" + folder + "'/\"$name\".line ;;\n  esac\ndone\n");
        std::filesystem::permissions(out, std::filesystem::perms::owner_all);
        return out;
    }
    CaseResult result_of(const std::string& name) const {
        const auto at = std::ranges::find(told, name, [](const CaseResult& one) { return one.file.name; });
        return at == told.end() ? CaseResult{} : *at;
    }
    std::string message_of(const std::string& name) const {
        const CaseResult result = result_of(name);
        return std::string(picture_tests::name(result.outcome)) + ": " + result.message;
    }
    Summary sum() const { return summary(told); }
    std::size_t processes() const {
        const std::string pids = slurp(cases.path() / "pids");
        return static_cast<std::size_t>(std::count(pids.begin(), pids.end(), '\n'));
    }

    const CaseFolder cases;
    std::vector<CaseOrder> orders;
    std::vector<CaseResult> told;
};

TEST_F(DrawCasesTest, OneProcessDrawsOneCaseAfterTheOther) {
    EXPECT_TRUE(draw("", 1).empty());
    EXPECT_EQ(sum()[CaseOutcome::passed], static_cast<int>(kCases));
    EXPECT_EQ(processes(), 1u);
}

TEST_F(DrawCasesTest, NoMoreProcessesThanCases) {
    orders.resize(2, {cases.add("a")});
    EXPECT_TRUE(draw("", 50).empty());
    EXPECT_EQ(told.size(), 2u);
    EXPECT_LE(processes(), 2u);
}

TEST_F(DrawCasesTest, ACrashIsOneCasesFault) {
    for (const int jobs : {1, 3}) {
        told.clear();
        draw("    b) echo 'no such driver' >&2; kill -SEGV $$ ;;\n    e) kill -KILL $$ ;;", jobs);
        EXPECT_EQ(told.size(), kCases);
        EXPECT_EQ(sum()[CaseOutcome::passed], static_cast<int>(kCases) - 2);
        EXPECT_EQ(message_of("b"), "failed: crashed: Segmentation fault (no such driver)");
        EXPECT_EQ(message_of("e"), "failed: crashed: Killed");
    }
}

TEST_F(DrawCasesTest, WhatTakesTooLongIsEnded) {
    add("c", R"("time_limit": 0.2)");
    draw("    c) exec sleep 100 ;;", 2);
    EXPECT_EQ(told.size(), kCases);
    EXPECT_EQ(message_of("c"), "failed: took longer than 0.2 s (time_limit)");
    EXPECT_GE(result_of("c").seconds, 0.2);
    EXPECT_EQ(sum()[CaseOutcome::passed], static_cast<int>(kCases) - 1);
    std::istringstream pids(slurp(cases.path() / "pids"));
    for (pid_t process = 0; pids >> process;) EXPECT_FALSE(is_alive(process));
}

TEST_F(DrawCasesTest, WhatIsNoResultIsOneCasesFault) {
    draw("    a) echo nonsense ;;\n    b) cat '" + (cases.path() / "c.line").string() + "' ;;\n    d) exit 7 ;;", 1);
    EXPECT_EQ(told.size(), kCases);
    EXPECT_EQ(message_of("a"), "failed: the drawing process wrote something that is not a result");
    EXPECT_EQ(message_of("b"), message_of("a")) << "of another case";
    EXPECT_EQ(message_of("d"), "failed: the process that draws ended with status 7");
    EXPECT_EQ(sum()[CaseOutcome::passed], static_cast<int>(kCases) - 3);
}

TEST_F(DrawCasesTest, AProcessThatDiesBetweenCasesIsSaidAndReplaced) {
    // It ends after its answer, before it is asked again or while it is: then that case is blamed.
    const std::vector<std::string> complaints =
        draw("    f) cat '" + (cases.path() / "f.line").string() + "'; exit 5 ;;", 1);
    EXPECT_EQ(sum()[CaseOutcome::passed], static_cast<int>(kCases));
    EXPECT_EQ(complaints, std::vector<std::string>{"after its last case: the process that draws ended with status 5"});
}

TEST_F(DrawCasesTest, OfWhatNoProcessCanDrawNothingIsKnown) {
    draw("    b) rm \"$0\"; exit 7 ;;", 1);
    EXPECT_EQ(message_of("b"), "failed: the process that draws ended with status 7");
    EXPECT_TRUE(message_of("c").starts_with("skipped: no process that draws can be started: ")) << message_of("c");
    EXPECT_EQ(result_of("c").not_drawn, result_of("c").message);
    EXPECT_EQ(sum()[CaseOutcome::skipped], static_cast<int>(kCases) - 2);
}

TEST_F(DrawCasesTest, AProgramThatIsNotThereIsNoMachine) {
    const auto nothing = [](const CaseResult&) {};
    try {
        draw_cases({.program = "/no/program"}, cases.path(), orders, nothing, [] {});
        ADD_FAILURE();
    } catch (const MachineError& error) {
        EXPECT_STREQ(error.what(),
                     "no process that draws can be started: /no/program: cannot be started: No such file or directory");
    }
}

TEST_F(DrawCasesTest, ALastingDrawerGoesOnAfterACrashAndAHang) {
    LastingDrawer drawer({.program = script("    b) kill -SEGV $$ ;;\n    c) exec sleep 100 ;;")}, cases.path());
    const auto drawn = [&](const std::string& name, const std::string& asked = {}) {
        CaseOrder order{case_named(cases.path(), name)};
        if (!asked.empty()) order.options.asked = asked;
        const CaseResult result = drawer.draw(order);
        return std::string(picture_tests::name(result.outcome)) + ": " + result.message;
    };
    EXPECT_EQ(drawn("a"), "passed: ");
    EXPECT_EQ(drawn("a"), "passed: ");
    EXPECT_EQ(processes(), 1u);
    EXPECT_EQ(drawn("b"), "failed: crashed: Segmentation fault");
    EXPECT_EQ(drawn("c", R"({"mobbscope_case": 1, "time_limit": 0.2})"), "failed: took longer than 0.2 s (time_limit)");
    EXPECT_EQ(drawn("d"), "passed: ");
    EXPECT_EQ(processes(), 3u);
    LastingDrawer none({.program = "/no/program"}, cases.path());
    EXPECT_TRUE(none.draw({case_named(cases.path(), "a")}).message.starts_with("no process that draws can be started"));
}

TEST_F(DrawCasesTest, WhenNobodyWantsTheRestItIsEnded) {
    EXPECT_THROW(draw_cases(
                     {.program = "/bin/cat"}, cases.path(), orders, [](const CaseResult&) {},
                     [] { throw std::runtime_error("enough"); }),
                 std::runtime_error);
}

// --- processes

}  // namespace
}  // namespace mobbscope::picture_tests
