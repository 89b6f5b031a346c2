// A driver of OpenGL that crashes takes nothing down, and the program has no more processes than one would think.
#include <base/threads.h>
#include <render/gl/driver_watch.h>
#include <support/temp_folder.h>

#include "cases/case_folder.h"
#include "cli/render_runs.h"
#include "render/backends.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// What puts the libraries that crash before the real ones.
std::function<void()> with_drivers(const std::vector<std::string>& libraries, const std::string& fault) {
    std::string folders;
    for (const std::string& library : libraries) folders += MOBBSCOPE_CRASHING_DRIVERS "/" + library + ":";
    return [=] {
        ::setenv("LD_LIBRARY_PATH", folders.c_str(), 1);
        ::setenv("MOBBSCOPE_TEST_DRIVER", fault.c_str(), 1);
    };
}

const std::vector<std::string> kBothDrivers{"libOSMesa.so.8", "libEGL.so.1"};

class DriverCrash : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_.write("scene.json", kStandingScene);
        folder_.write("s.script", "picture " + picture() + "\n");
    }
    std::string scene() const { return (folder_.path() / "scene.json").string(); }
    std::string picture() const { return (folder_.path() / "p.png").string(); }
    std::string script() const { return (folder_.path() / "s.script").string(); }
    Result run(const std::vector<std::string>& arguments, const std::function<void()>& in_child) const {
        return run_program(arguments, {}, "/dev/null", in_child);
    }

    TempFolder folder_;
};

TEST_F(DriverCrash, EveryCommandThatDrawsEndsWithALine) {
    const std::vector<std::vector<std::string>> commands{
        {"render", scene(), "-o", picture()},
        {"render", scene(), "-o", picture(), "--backend", "osmesa"},
        {"render", scene(), "-o", picture(), "--backend", "egl"},
        {"render", scene(), "-o", picture(), "--ui"},
        {scene(), "--headless", "--script", script()},
    };
    for (const char* fault : {"writes to nothing", "nowhere", "aborts"}) {
        for (const std::vector<std::string>& command : commands) {
            const Result result = run(command, with_drivers(kBothDrivers, fault));
            EXPECT_EQ(result.status, 3) << fault << ": " << result.err;
            EXPECT_TRUE(is_one_line(result.err)) << result.err;
            EXPECT_NE(result.err.find("crashed ("), std::string::npos) << result.err;
            EXPECT_FALSE(std::filesystem::exists(picture()));
        }
    }
}

TEST_F(DriverCrash, ListBackendsTellsOfIt) {
    const Result result = run({"render", "--list-backends"}, with_drivers(kBothDrivers, ""));
    EXPECT_EQ(result.status, 3);
    EXPECT_NE(result.out.find("osmesa: not here: crashed (Segmentation fault in libOSMesa.so.8)"), std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find("egl: not here: crashed (Segmentation fault in libEGL.so.1)"), std::string::npos)
        << result.out;
}

TEST_F(DriverCrash, TheNextOneDraws) {
    if (!has_or_skip(Backend::egl)) return;
    const Result result =
        run({"render", scene(), "-o", picture()}, with_drivers({"libOSMesa.so.8"}, "writes to nothing"));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("egl draws"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("crashed (Segmentation fault in libOSMesa.so.8)"), std::string::npos) << result.err;
    EXPECT_TRUE(std::filesystem::exists(picture()));
}

/// Of two processes that draw one has a driver: so one of two pictures is judged.
TEST_F(DriverCrash, TestsOfWhichSomeAreNotDrawnEndWith4) {
    if (!has_or_skip(Backend::osmesa)) return;
    const CaseFolder cases;
    cases.add("one");
    cases.add("two");
    const std::string output = (folder_.path() / "out").string();
    const std::vector<std::string> test{"test", cases.path().string(), "--backend", "osmesa", "--jobs", "2", "--output",
                                        output};
    ASSERT_EQ(run(with(test, {"--update", "all"}), [] {}).status, 0);
    const auto in_one_process = [&] {
        const auto drivers = with_drivers({"libOSMesa.so.8"}, "in one process " + (folder_.path() / "taken").string());
        std::filesystem::remove(folder_.path() / "taken");
        return [=] {
            drivers();
            ::setenv("MOBBSCOPE_NO_WATCH", "1", 1);
        };
    };
    const Result some = run(test, in_one_process());
    EXPECT_EQ(some.status, 4) << some.out << some.err;
    EXPECT_TRUE(is_one_line(some.err)) << some.err;
    EXPECT_NE(some.out.find("1 passed"), std::string::npos) << some.out;
    EXPECT_NE(some.out.find("1 skipped"), std::string::npos) << some.out;
    EXPECT_EQ(run_program(test, "/dev/full", "/dev/null", in_one_process()).status, 4)
        << "before 3, of what is not written";
    for (const char* golden : {"one.png", "two.png"}) std::filesystem::remove(cases.path() / golden);
    EXPECT_EQ(run(test, in_one_process()).status, 1) << "before 4";
}

TEST_F(DriverCrash, WhatMesaReadsIsNamed) {
    const auto drivers = with_drivers(kBothDrivers, "");
    const Result result = run({"render", scene(), "-o", picture()}, [&] {
        drivers();
        ::setenv("GALLIUM_DRIVER", "d3d12", 1);
    });
    EXPECT_NE(result.err.find("GALLIUM_DRIVER=d3d12"), std::string::npos) << result.err;
}

/// Of Mesa's own drivers: which of them crash is the version's; that none ends the program by a signal is ours.
TEST_F(DriverCrash, MesaDrawsOrIsTold) {
    for (const auto& [setting, value] :
         {std::pair{"GALLIUM_DRIVER", "d3d12"}, std::pair{"LP_NATIVE_VECTOR_WIDTH", "512"}}) {
        const Result result =
            run({"render", scene(), "-o", picture()}, [name = setting, to = value] { ::setenv(name, to, 1); });
        EXPECT_TRUE(result.status == 0 || result.status == 3) << setting << ": " << result.status;
        if (result.status == 3) {
            EXPECT_NE(result.err.find("mobbscope: no OpenGL"), std::string::npos) << result.err;
        }
    }
}

TEST_F(DriverCrash, ResultsComeOnce) {
    if (!has_or_skip(Backend::automatic)) return;
    const std::string says = folder_.write("says.script", "state\n").string();
    const Result watched = run({scene(), "--headless", "--script", says}, [] {});
    const Result alone = run({scene(), "--headless", "--script", says}, [] { ::setenv("MOBBSCOPE_NO_WATCH", "1", 1); });
    EXPECT_EQ(watched.status, 0) << watched.err;
    EXPECT_FALSE(watched.out.empty());
    EXPECT_EQ(watched.out, alone.out);
}

TEST(DoneInChild, WhatHangsIsEnded) {
    if (thread_count() != 1) GTEST_SKIP() << "other tests have left threads in this process";
    constexpr std::chrono::seconds kEnough{20};
    EXPECT_EQ(done_in_child([] { return std::string("done"); }, kEnough), "done");
    const auto complaint = [](const std::function<std::string()>& work, std::chrono::milliseconds longest) {
        try {
            return "came back with " + done_in_child(work, longest);
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(complaint([]() -> std::string { throw std::runtime_error("no"); }, kEnough), "no");
    const auto hang = []() -> std::string {
        for (;;) ::pause();
    };
    EXPECT_EQ(complaint(hang, std::chrono::milliseconds(50)).find("hangs"), 0);
}

/// A program whose driver hangs, so that it stays.
class WatchedProgram : public DriverCrash {
  protected:
    void SetUp() override {
        DriverCrash::SetUp();
        program_ = start_program({"render", scene(), "-o", picture()}, {}, with_drivers(kBothDrivers, "hangs"));
        const std::string id = std::to_string(program_);
        ASSERT_TRUE(soon([&] {
            std::ifstream children("/proc/" + id + "/task/" + id + "/children");
            return static_cast<bool>(children >> child_);
        }));
        // Once it handles what it does.
        ASSERT_TRUE(soon([&] { return maps_driver(); }));
    }
    void TearDown() override {
        if (child_ > 0) ::kill(child_, SIGKILL);
        if (program_ <= 0) return;
        ::kill(program_, SIGKILL);
        ::waitpid(program_, nullptr, 0);
    }

    static bool soon(const std::function<bool()>& holds) {
        for (int i = 0; i < 600; ++i) {
            if (holds()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
    bool maps_driver() const {
        std::ifstream maps("/proc/" + std::to_string(child_) + "/maps");
        const std::string all{std::istreambuf_iterator<char>(maps), {}};
        return all.find("libOSMesa.so.8") != std::string::npos;
    }
    /// Whether the child is no more, but for what its new parent has not yet asked about.
    bool child_is_gone() const {
        std::ifstream stat("/proc/" + std::to_string(child_) + "/stat");
        std::string text;
        std::getline(stat, text);
        return text.empty() || text.find(") Z") != std::string::npos || text.find(") X") != std::string::npos;
    }
    /// The signal that ended the program; 0 if none did.
    int ended_by() {
        int status = 0;
        ::waitpid(program_, &status, 0);
        program_ = 0;
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    pid_t program_ = 0, child_ = 0;
};

TEST(WatchedStatus, IsTheChildsWhereTheParentsParentIgnoresChildren) {
    if (!has_or_skip(Backend::automatic)) return;
    const TempFolder folder;
    const std::string scene = folder.write("scene.json", kStandingScene);
    const std::string script = folder.write("s.script", "expect /none 1\n");
    const Result run =
        run_program({scene, "--headless", "--script", script}, {}, "/dev/null", [] { ::signal(SIGCHLD, SIG_IGN); });
    EXPECT_EQ(run.status, 1) << run.err;
}

TEST_F(WatchedProgram, EndsWithItsChildBySignals) {
    ::kill(program_, SIGTERM);
    EXPECT_EQ(ended_by(), SIGTERM);
    EXPECT_TRUE(soon([&] { return child_is_gone(); }));
}

TEST_F(WatchedProgram, LeavesNoChildWhenItIsKilled) {
    ::kill(program_, SIGKILL);
    EXPECT_EQ(ended_by(), SIGKILL);
    EXPECT_TRUE(soon([&] { return child_is_gone(); }));
}

TEST_F(WatchedProgram, ACrashThatIsNotTheDriversStaysOne) {
#ifdef MOBBSCOPE_SANITIZED
    GTEST_SKIP() << "a sanitizer handles signals itself";
#endif
    ::kill(child_, SIGSEGV);
    EXPECT_EQ(ended_by(), SIGSEGV);
}

}  // namespace
}  // namespace mobbscope
