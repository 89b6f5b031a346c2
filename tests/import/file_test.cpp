#include <import/error.h>
#include <import/file.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <sys/stat.h>

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

TEST(File, OnlyRegularFilesAreRead) {
    const TempFolder folder;
    EXPECT_NE(input_error([&] { read_file(folder.path() / "none"); }).find("no such file"), std::string::npos);
    EXPECT_NE(input_error([&] { read_file(folder.path()); }).find("is a directory"), std::string::npos);
    EXPECT_NE(input_error([] { read_file("/dev/zero"); }).find("no regular file"), std::string::npos);
}

TEST(File, ExtensionsAreComparedInLowerCase) {
    EXPECT_EQ(lower_extension("a/B.CSV"), ".csv");
    EXPECT_EQ(lower_extension("a.b/none"), "");
}

}  // namespace
}  // namespace mobbscope
