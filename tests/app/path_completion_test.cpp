#include <app/panels/path_completion.h>
#include <scene/load_files.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace mobbscope::app {
namespace {

struct Files {
    mobbscope::testing::TempFolder folder;
    std::string at;

    Files() : at(folder.path().string() + "/") {
        for (const char* name :
             {"walk.csv", "walk.json", "walk.png", ".hidden.csv", "w\xc3\xa4.csv", "w\xc3\xb6.csv"}) {
            folder.write(name, "12345");
        }
        std::filesystem::create_directory(folder.path() / "walks");
        std::filesystem::create_directory(folder.path() / "deep");
    }
    std::vector<std::string> names(const std::string& typed) const {
        std::vector<std::string> out;
        for (const PathEntry& entry : complete_path(typed, openable_extensions()).entries) out.push_back(entry.name);
        return out;
    }
    std::string completed(const std::string& typed) const {
        return complete_path(typed, openable_extensions()).completed;
    }
};

TEST(PathCompletion, ListsFoldersThenWhatCanBeOpened) {
    const Files files;
    EXPECT_EQ(files.names(files.at),
              (std::vector<std::string>{"deep", "walks", "walk.csv", "walk.json", "w\xc3\xa4.csv", "w\xc3\xb6.csv"}));
    EXPECT_EQ(files.names(files.at + "walk"), (std::vector<std::string>{"walks", "walk.csv", "walk.json"}));
    EXPECT_EQ(files.names(files.at + "."), std::vector<std::string>{".hidden.csv"});
    EXPECT_EQ(complete_path(files.at + "walk.c", openable_extensions()).entries[0].size, 5u);
}

TEST(PathCompletion, CompletesAsFarAsAllAgree) {
    const Files files;
    EXPECT_EQ(files.completed(files.at + "wal"), files.at + "walk");
    EXPECT_EQ(files.completed(files.at + "walk.c"), files.at + "walk.csv");
    EXPECT_EQ(files.completed(files.at + "d"), files.at + "deep/");
    EXPECT_EQ(files.completed(files.at + "x"), files.at + "x");
    EXPECT_EQ(files.completed(files.at + "w\xc3"), files.at + "w") << "no half characters";
    EXPECT_EQ(files.completed(files.at + "none/x"), files.at + "none/x");
}

TEST(PathCompletion, KnowsTheHome) {
    const Files files;
    const char* const home = std::getenv("HOME");
    const std::string before = home ? home : "";
    ::setenv("HOME", files.folder.path().c_str(), 1);
    EXPECT_EQ(expanded("~/walk.csv"), files.at + "walk.csv");
    EXPECT_EQ(expanded("~"), files.folder.path().string());
    EXPECT_EQ(expanded("a~/b"), "a~/b");
    EXPECT_EQ(files.completed("~/de"), "~/deep/") << "what was typed stays";
    ::setenv("HOME", before.c_str(), 1);
}

TEST(PathCompletion, AnEntryTakesThePlaceOfItsBeginning) {
    EXPECT_EQ(with_entry("a/wa", {"walk.csv", false, 0}), "a/walk.csv");
    EXPECT_EQ(with_entry("wa", {"walks", true, 0}), "walks/");
}

TEST(PathCompletion, APathMayBeginAnewBehindAnother) {
    EXPECT_EQ(expanded("/home/someone//data/walk.bvh"), "/data/walk.bvh");
    EXPECT_EQ(expanded("/data/walk.bvh"), "/data/walk.bvh");
    EXPECT_EQ(expanded("/home/someone/~/clips"), expanded("~/clips"));
}

}  // namespace
}  // namespace mobbscope::app
