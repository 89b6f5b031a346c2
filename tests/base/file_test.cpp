#include <base/error.h>
#include <base/file.h>
#include <support/input_error.h>
#include <support/seccomp.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>

namespace mobbscope {
namespace {

std::size_t files_in(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

mode_t rights_of(const std::filesystem::path& file) {
    struct stat status {};
    ::stat(file.c_str(), &status);
    return status.st_mode & 07777;
}

TEST(File, WhatIsWrittenIsReadAndNothingElseIsLeft) {
    const TempFolder folder;
    const std::string bytes("a\0b\r\n", 5);
    write_file(folder.path() / "x.csv", bytes);
    EXPECT_EQ(read_file(folder.path() / "x.csv"), bytes);
    write_file(folder.path() / "x.csv", "new");
    EXPECT_EQ(slurp(folder.path() / "x.csv"), "new");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, ReplacingKeepsRightsAndLinks) {
    const TempFolder folder;
    const auto target = folder.write("target.csv", "old");
    ::chmod(target.c_str(), 0640);
    std::filesystem::create_symlink("target.csv", folder.path() / "link.csv");
    write_file(folder.path() / "link.csv", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.csv"));
    EXPECT_EQ(slurp(target), "new");
    EXPECT_EQ(rights_of(target), 0640u);
}

/// Whoever is root is someone else for a while.
class AnotherUser {
  public:
    AnotherUser() {
        if (was_root_ && ::seteuid(kNobody) != 0) throw std::runtime_error("root stays root");
    }
    ~AnotherUser() {
        if (was_root_ && ::seteuid(0) != 0) std::abort();
    }
    AnotherUser(const AnotherUser&) = delete;
    AnotherUser& operator=(const AnotherUser&) = delete;

    static constexpr uid_t kNobody = 65534;

  private:
    bool was_root_ = ::geteuid() == 0;
};

TEST(File, ReplacingKeepsNoRightsToRunAsTheOwner) {
    const TempFolder folder;
    const auto target = folder.write("x.csv", "old");
    ::chmod(target.c_str(), 06755);
    write_file(target, "new");
    EXPECT_EQ(rights_of(target), 0755u);
}

TEST(File, ReplacingKeepsTheOwner) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
    const TempFolder folder;
    const auto target = folder.write("x.csv", "old");
    ASSERT_EQ(::chown(target.c_str(), AnotherUser::kNobody, 12345), 0);
    ::chmod(target.c_str(), 0640);
    write_file(target, "new");
    struct stat status {};
    ::stat(target.c_str(), &status);
    EXPECT_EQ(status.st_uid, AnotherUser::kNobody);
    EXPECT_EQ(status.st_gid, 12345u);
    EXPECT_EQ(rights_of(target), 0640u);
}

TEST(File, ALinkThatLeadsToNothingIsWrittenThrough) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "deep");
    std::filesystem::create_symlink("deep/second", folder.path() / "first");
    std::filesystem::create_symlink("new.csv", folder.path() / "deep/second");
    write_file(folder.path() / "first", "x");
    EXPECT_EQ(slurp(folder.path() / "deep/new.csv"), "x");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "first"));
    std::filesystem::create_symlink("round", folder.path() / "round");
    EXPECT_THROW(write_file(folder.path() / "round", "x"), MachineError);
    std::filesystem::create_symlink("none/x", folder.path() / "nowhere");
    EXPECT_THROW(write_file(folder.path() / "nowhere", "x"), MachineError);
    EXPECT_EQ(files_in(folder.path()), 4u);
}

TEST(File, SeveralAreWrittenAllOrNone) {
    const TempFolder folder;
    const auto old = folder.write("old.csv", "old");
    const auto wanted = [&](const std::filesystem::path& last) {
        return std::array<FileBytes, 3>{{{folder.path() / "first.csv", "first"}, {old, "new"}, {last, "last"}}};
    };
    EXPECT_THROW(write_files(wanted(folder.path() / "none/x.csv")), MachineError);
    EXPECT_EQ(slurp(old), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
    write_files(wanted(folder.path() / "last.csv"));
    EXPECT_EQ(slurp(folder.path() / "first.csv") + slurp(old) + slurp(folder.path() / "last.csv"), "firstnewlast");
    EXPECT_EQ(files_in(folder.path()), 3u);
}

TEST(File, WhatWasReplacedComesBackIfALaterFileCannotBe) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root makes a file that may be written and not replaced";
    const TempFolder folder;
    ::chmod(folder.path().c_str(), 01777);
    const auto others = folder.write("others.csv", "theirs");
    ::chmod(others.c_str(), 0666);
    {
        const AnotherUser nobody;
        const auto mine = folder.write("mine.csv", "old");
        const std::array<FileBytes, 3> files{{{folder.path() / "new.csv", "x"}, {mine, "new"}, {others, "mine"}}};
        EXPECT_THROW(write_files(files), MachineError);
        const std::array<FileBytes, 2> others_first{{{others, "mine"}, {mine, "new"}}};
        EXPECT_THROW(write_files(others_first), MachineError);
    }
    EXPECT_EQ(slurp(folder.path() / "mine.csv"), "old");
    EXPECT_EQ(slurp(others), "theirs");
    EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(File, WhatAKilledProcessLeftIsRemoved) {
    const TempFolder folder;
    const auto leave = [&](const std::string& name, std::time_t seconds_ago) {
        const auto file = folder.write(name, "half");
        const std::array<timespec, 2> times{
            {{std::time(nullptr) - seconds_ago, 0}, {std::time(nullptr) - seconds_ago, 0}}};
        ::utimensat(AT_FDCWD, file.c_str(), times.data(), 0);
        return file;
    };
    leave(".mobbscope-123456789-0", 100);
    const auto young = leave(".mobbscope-123456789-1", 2);
    const auto written = leave(".mobbscope-123456789-2", 100);
    const auto other = leave(".mobbscope-notes-1", 100);
    const int lock = ::open(written.c_str(), O_RDWR);
    ASSERT_EQ(::flock(lock, LOCK_EX), 0);
    write_file(folder.path() / "x.csv", "x");
    ::close(lock);
    EXPECT_EQ(files_in(folder.path()), 4u);
    for (const auto& file : {young, written, other}) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(File, IsWrittenWhereFilesNeedNames) {
    const TempFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        if (!refuse_nameless_files()) ::_exit(77);
        const std::array<FileBytes, 2> files{{{folder.path() / "x.csv", "x"}, {folder.path() / "y.csv", "y"}}};
        write_files(files);
        try {
            write_file(folder.path() / "none/x.csv", "x");
        } catch (const MachineError&) {
            ::_exit(0);
        }
        ::_exit(1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "no system calls can be refused here";
    EXPECT_EQ(status, 0);
    EXPECT_EQ(slurp(folder.path() / "x.csv") + slurp(folder.path() / "y.csv"), "xy");
    EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(File, AFullDiskLeavesWhatWasThere) {
    const TempFolder folder;
    const auto file = folder.write("x.csv", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit least{1000, 1000};
        ::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &least);
        try {
            write_file(file, std::string(5000, 'x'));
        } catch (const MachineError& error) {
            ::_exit(error.what() == file.string() + ": cannot be written: File too large" ? 0 : 1);
        }
        ::_exit(2);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(slurp(file), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, ADiskThatFailsLeavesWhatWasThere) {
    const TempFolder folder;
    const auto file = folder.write("x.csv", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        if (!refuse_to_sync()) ::_exit(0);
        const auto fails = [](const auto& write) {
            try {
                write();
            } catch (const MachineError& error) {
                return std::string(error.what()).find("Input/output error") != std::string::npos;
            }
            return false;
        };
        int wrong = fails([&] { write_file(file, "new"); }) ? 0 : 1;
        wrong += fails([&] { write_to_disk(folder.path() / "y.csv", "new"); }) ? 0 : 2;
        ::_exit(wrong);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(slurp(file), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

/// As another program writes it.
TEST(File, ANewFileStandsThereOnceItIsWhole) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("f", "old");
    ::chmod(file.c_str(), 0640);
    const auto write_to = [](const NewFile& to, const std::string& text) {
        EXPECT_EQ(::write(to.descriptor(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    };
    {
        const NewFile unfinished(file);
        write_to(unfinished, "half");
        EXPECT_EQ(slurp(file), "old");
    }
    EXPECT_EQ(files_in(folder.path()), 1u) << "nothing is left";
    NewFile whole(file);
    write_to(whole, "whole");
    EXPECT_EQ(whole.take_place(), 5u);
    EXPECT_EQ(slurp(file), "whole");
    EXPECT_EQ(rights_of(file), 0640u);
    EXPECT_EQ(files_in(folder.path()), 1u);
    EXPECT_THROW(NewFile("/dev/null"), MachineError);
    EXPECT_THROW(NewFile(folder.path()), MachineError);
    EXPECT_THROW(NewFile(folder.path() / "no" / "f"), MachineError);
    EXPECT_THROW(NewFile(""), InputError);
}

TEST(File, WhatWasReadIsKnownByAnyName) {
    const TempFolder folder;
    const auto file = folder.write("x.csv", "x");
    std::filesystem::create_hard_link(file, folder.path() / "hard.csv");
    std::filesystem::create_symlink("x.csv", folder.path() / "soft.csv");
    EXPECT_NO_THROW(check_not_read(file));
    read_file(folder.path() / "soft.csv");
    for (const char* name :
         {"x.csv", "hard.csv", "soft.csv", "none/../x.csv", "none/../soft.csv", "./none/.././x.csv"}) {
        EXPECT_NE(input_error([&] { check_not_read(folder.path() / name); }).find("soft.csv', which it is made from"),
                  std::string::npos);
    }
    EXPECT_NO_THROW(check_not_read(folder.path() / "new.csv"));
    EXPECT_NO_THROW(check_not_read(folder.write("other.csv", "x")));
}

TEST(File, NamesOfOneFileAreKnownAsThat) {
    const TempFolder folder;
    const auto file = folder.write("x.csv", "x");
    std::filesystem::create_hard_link(file, folder.path() / "hard.csv");
    std::filesystem::create_symlink("x.csv", folder.path() / "soft.csv");
    std::filesystem::create_symlink("new.csv", folder.path() / "dangling.csv");
    folder.write("other.csv", "x");
    for (const char* name : {"x.csv", "hard.csv", "soft.csv", "none/../x.csv", "none/../soft.csv"}) {
        EXPECT_TRUE(is_same_file(file, folder.path() / name)) << name;
        EXPECT_FALSE(is_same_file(folder.path() / "other.csv", folder.path() / name)) << name;
    }
    EXPECT_TRUE(is_same_file(folder.path() / "dangling.csv", folder.path() / "new.csv")) << "neither is there yet";
    EXPECT_FALSE(is_same_file(folder.path() / "dangling.csv", folder.path() / "newer.csv"));
    EXPECT_EQ(meant(folder.path() / "none/../soft.csv"), meant(file));
    // What is written behind a folder that is not there replaces what the link leads to, not the link.
    write_file(folder.path() / "none/../soft.csv", "y");
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "soft.csv"));
    EXPECT_EQ(slurp(file), "y");
}

TEST(File, ALinkOutOfTheFolderIsToldFromOneWithin) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "in");
    folder.write("in/a.png", "a");
    std::filesystem::create_symlink("a.png", folder.path() / "in/b.png");
    std::filesystem::create_symlink("../out.png", folder.path() / "in/c.png");
    std::filesystem::create_symlink("in", folder.path() / "link");
    for (const char* name : {"in/a.png", "in/b.png", "in/new.png", "link/a.png", "link/b.png"})
        EXPECT_NO_THROW(check_stays_in_folder(folder.path() / name));
    for (const char* name : {"in/c.png", "link/c.png"}) {
        EXPECT_NE(input_error([&] { check_stays_in_folder(folder.path() / name); }).find("leads out of its folder"),
                  std::string::npos);
    }
}

TEST(File, MissingFoldersAndDevicesAreNotWritten) {
    const TempFolder folder;
    EXPECT_THROW(write_file(folder.path() / "none" / "x.csv", "x"), MachineError);
    EXPECT_THROW(write_file(folder.path(), "x"), MachineError);
    std::filesystem::create_symlink("/dev/full", folder.path() / "full.csv");
    EXPECT_THROW(write_file(folder.path() / "full.csv", "x"), MachineError);
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(File, AProtectedFileIsNotReplaced) {
    const TempFolder folder;
    const auto target = folder.write("x.csv", "old");
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    ::chmod(target.c_str(), 0444);
    {
        const AnotherUser nobody;  // root may write everything
        EXPECT_THROW(write_file(target, "new"), MachineError);
        EXPECT_NO_THROW(write_file(folder.path() / "y.csv", "new")) << "the folder itself may be written";
    }
    EXPECT_EQ(slurp(target), "old");
    EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(File, ANewFileHasTheRightsOfTheProcess) {
    const TempFolder folder;
    const mode_t before = ::umask(027);
    write_file(folder.path() / "x.csv", "x");
    ::umask(before);
    EXPECT_EQ(rights_of(folder.path() / "x.csv"), 0640u);
}

TEST(File, WhatIsNoNameIsRefused) {
    const std::filesystem::path hidden(std::string("a.csv\0.txt", 10));
    EXPECT_NE(input_error([] { read_file(""); }).find("is empty"), std::string::npos);
    EXPECT_NE(input_error([] { write_file("", "x"); }).find("is empty"), std::string::npos);
    EXPECT_NE(input_error([&] { read_file(hidden); }).find("NUL byte"), std::string::npos);
    EXPECT_NE(input_error([&] { write_file(hidden, "x"); }).find("NUL byte"), std::string::npos);
}

TEST(File, OnlyRegularFilesAreRead) {
    const TempFolder folder;
    EXPECT_NE(input_error([&] { read_file(folder.path() / "none"); }).find("no such file"), std::string::npos);
    EXPECT_NE(input_error([&] { read_file(folder.path()); }).find("is a directory"), std::string::npos);
    EXPECT_NE(input_error([] { read_file("/dev/zero"); }).find("not a regular file"), std::string::npos);
}

TEST(File, OneThatIsTooLargeIsRefused) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("large.csv", "t,x,y,r\n");
    std::filesystem::resize_file(file, std::uintmax_t{3} << 30);  // sparse: it takes no room
    EXPECT_EQ(input_error([&] { read_file(file); }), file.string() + ": is larger than 2 GiB; split it");
}

TEST(File, ExtensionsAreComparedInLowerCase) {
    EXPECT_EQ(lower_extension("a/B.CSV"), ".csv");
    EXPECT_EQ(lower_extension("a.b/none"), "");
}

}  // namespace
}  // namespace mobbscope
