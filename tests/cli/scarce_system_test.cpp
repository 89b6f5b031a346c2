// Where the system gives little, a command does with it or says what is missing.
#include <base/threads.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include "cli/render_runs.h"
#include "render/backends.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// The system starts no more threads and processes. Limits do not bind root, so somebody else does it then.
void start_nothing_more() {
    constexpr unsigned kNobodyElse = 61'973;
    const rlimit one{1, 1};
    ::setrlimit(RLIMIT_NPROC, &one);
    if (::getuid() != 0) return;
    if (::setgroups(0, nullptr) != 0 || ::setgid(kNobodyElse) != 0 || ::setuid(kNobodyElse) != 0) ::_exit(126);
    if (::access(MOBBSCOPE_PROGRAM, X_OK) != 0) ::_exit(126);
}

class FewThreads : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_.write("scene.json", kStandingScene);
        folder_.write("s.script", "state\n");
        std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
    }
    std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
    void expect_done(const std::vector<std::string>& arguments) const {
        const Result result = run_program(arguments, {}, "/dev/null", start_nothing_more);
        if (result.status == 126) GTEST_SKIP() << "the program is not to be read by others than root here";
        EXPECT_EQ(result.status, 0) << arguments.front() << ": " << result.err;
    }

    TempFolder folder_;
};

TEST_F(FewThreads, ACrowdIsSimulated) {
    expect_done({"simulate", "--whole", kClips, "-o", file("run.json"), "--agents", "3", "--seconds", "2"});
}

TEST_F(FewThreads, APictureIsDrawn) {
    if (!has_or_skip(Backend::automatic)) return;
    // Shaders are compiled anew, as whoever draws has no cache: few of them.
    expect_done({"render", file("scene.json"), "-o", file("p.png"), "--size", "64x64", "--samples", "1", "--no-disks",
                 "--no-labels", "--no-floor", "--no-legend", "--no-inset"});
}

TEST_F(FewThreads, AScriptIsRun) {
    if (!has_or_skip(Backend::automatic)) return;
    expect_done({file("scene.json"), "--headless", "--script", file("s.script")});
}

TEST(Threads, ThoseThatWereStartedAreGone) {
    const int before = thread_count();
    EXPECT_EQ(startable_threads(0), 0);
    EXPECT_EQ(startable_threads(3), 3);
    EXPECT_EQ(thread_count(), before);
}

/// In a folder that is removed.
Result run_nowhere(const std::vector<std::string>& arguments) {
    const TempFolder folder;
    const std::filesystem::path gone = folder.path() / "gone";
    std::filesystem::create_directory(gone);
    return run_program(arguments, {}, "/dev/null", [&] {
        if (::chdir(gone.c_str()) != 0 || ::rmdir(gone.c_str()) != 0) ::_exit(126);
    });
}

TEST(DeletedFolder, WholeNamesWork) {
    const TempFolder folder;
    const std::string run = (folder.path() / "run.json").string();
    const Result simulated = run_nowhere({"simulate", "--whole", kClips, "-o", run, "--agents", "2", "--seconds", "1"});
    EXPECT_EQ(simulated.status, 0) << simulated.err;
    const Result drawn = run_nowhere({"render", run, "--draw-list", (folder.path() / "list.json").string()});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    const Result listed = run_nowhere({"test", MOBBSCOPE_SOURCE_DIR "/tests/goldens", "--list"});
    EXPECT_EQ(listed.status, 0) << listed.err;
}

TEST(DeletedFolder, OthersAreRefusedInALine) {
    const TempFolder folder;
    folder.write("scene.json", kStandingScene);
    const std::string scene = (folder.path() / "scene.json").string();
    const std::vector<std::vector<std::string>> commands{
        {"render", scene, "-o", "x.png"},
        {"convert", scene, "-o", "x.csv"},
        {"simulate", "--whole", kClips, "-o", "x.json"},
    };
    for (const std::vector<std::string>& command : commands) {
        const Result result = run_nowhere(command);
        expect_refused(result, 3, "cannot be written");
    }
}

}  // namespace
}  // namespace mobbscope
