// Programs that are started: how they end, and what is said to them.
#include <base/error.h>
#include <base/process.h>
#include <support/processes.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace mobbscope {
namespace {

pid_t pid_in(const std::filesystem::path& file) {
    EXPECT_TRUE(comes([&] { return std::filesystem::exists(file) && slurp(file).ends_with('\n'); }));
    return static_cast<pid_t>(std::stol(slurp(file)));
}

TEST(Process, EndsWithWhoStartedIt) {
    const TempFolder folder;
    const std::filesystem::path pid = folder.path() / "pid";
    const pid_t parent = ::fork();
    if (parent == 0) {
        const Process process("/bin/sh", {"-c", "echo $$ >'" + pid.string() + "'; exec sleep 100"}, {});
        ::pause();
        ::_exit(0);
    }
    const pid_t child = pid_in(pid);
    EXPECT_TRUE(is_alive(child));
    ::kill(parent, SIGKILL);
    ::waitpid(parent, nullptr, 0);
    EXPECT_TRUE(comes([&] { return !is_alive(child); }));
}

TEST(Process, EndsWithItsObject) {
    const TempFolder folder;
    const std::filesystem::path pid = folder.path() / "pid";
    pid_t child = 0;
    {
        const Process process("/bin/sh", {"-c", "echo $$ >'" + pid.string() + "'; exec sleep 100"}, {});
        child = pid_in(pid);
        EXPECT_TRUE(is_alive(child));
    }
    EXPECT_FALSE(is_alive(child));
}

TEST(Process, IsFoundInPath) {
    EXPECT_EQ(program_in_path("sh").value().filename(), "sh");
    EXPECT_FALSE(program_in_path("no such program"));
}

TEST(Process, WhatItSaysIsKeptInMemory) {
    const Descriptor said = memory_file();
    Process process("/bin/sh", {"-c", "echo one; echo two >&2"}, {-1, said.get(), said.get()});
    ASSERT_EQ(process.wait(5), 0);
    EXPECT_EQ(beginning_of(said, 100), "one\ntwo\n");
    EXPECT_EQ(beginning_of(said, 2), "on");
}

TEST(Process, AReaderThatTakesNothingIsNotWaitedForForEver) {
    Connection both = Connection::make();
    const std::string much(8 << 20, 'x');
    EXPECT_FALSE(send_all(both.here, much, 0.05));
    both.there.close();
    EXPECT_FALSE(send_all(both.here, much, 100));
}

TEST(Process, SaysHowItEnded) {
    Process quick("/bin/sh", {"-c", "exit 4"}, {});
    EXPECT_EQ(how_it_ended(quick.wait(5).value()), "ended with status 4");
    Process crashes("/bin/sh", {"-c", "kill -ABRT $$"}, {});
    EXPECT_EQ(how_it_ended(crashes.wait(5).value()), "crashed: Aborted");
    Process stays("/bin/sleep", {"100"}, {});
    EXPECT_FALSE(stays.wait(0.01));
    try {
        const Process none("/no/such/program", {}, {});
        ADD_FAILURE();
    } catch (const MachineError& error) {
        EXPECT_STREQ(error.what(), "/no/such/program: cannot be started: No such file or directory");
    }
}

/// Also where standard input, output and error of this program are closed, and their numbers go to what it opens.
TEST(Process, TalksThroughConnections) {
    for (const bool closed : {false, true}) {
        const pid_t parent = ::fork();
        if (parent == 0) {
            if (closed) {
                for (int i = 0; i < 3; ++i) ::close(i);
            }
            Connection talk = Connection::make(), complaints = Connection::make();
            Process process("/bin/sh", {"-c", "read -r word; echo got $word; echo bad >&2"},
                            {talk.there.get(), talk.there.get(), complaints.there.get()});
            talk.there.close();
            complaints.there.close();
            bool right = send_all(talk.here, "this\n") && process.wait(5) == 0;
            std::string said, complained;
            while (read_some(talk.here, said)) continue;
            while (read_some(complaints.here, complained)) continue;
            right = right && said == "got this\n" && complained == "bad\n" && !send_all(talk.here, "more\n");
            ::_exit(right ? 0 : 1);
        }
        int status = -1;
        ::waitpid(parent, &status, 0);
        EXPECT_EQ(status, 0) << closed;
    }
}

}  // namespace
}  // namespace mobbscope
