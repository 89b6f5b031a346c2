#include <base/error.h>
#include <base/file.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>

namespace mobbscope {
namespace {

using testing::input_error;
using testing::slurp;
using testing::TempFolder;

std::size_t files_in(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
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
    struct stat status {};
    ::stat(target.c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
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
    // Root may write everything: be someone else for a while.
    const bool was_root = ::geteuid() == 0;
    if (was_root) {
        ASSERT_EQ(::seteuid(65534), 0);
    }
    EXPECT_THROW(write_file(target, "new"), MachineError);
    EXPECT_NO_THROW(write_file(folder.path() / "y.csv", "new")) << "the folder itself may be written";
    if (was_root) {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_EQ(slurp(target), "old");
    EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(File, ANewFileHasTheRightsOfTheProcess) {
    const TempFolder folder;
    const mode_t before = ::umask(027);
    write_file(folder.path() / "x.csv", "x");
    ::umask(before);
    struct stat status {};
    ::stat((folder.path() / "x.csv").c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
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
    EXPECT_NE(input_error([] { read_file("/dev/zero"); }).find("no regular file"), std::string::npos);
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
