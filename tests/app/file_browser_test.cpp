// What the file dialog lists, in which order, and what is chosen there.
#include <app/document/file_browser.h>
#include <app/document/file_preview.h>
#include <scene/load_files.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

using Choose = FileBrowser::Choose;
using Names = std::vector<std::string>;

struct FolderOfFiles {
    TempFolder folder;
    std::string at;
    FileBrowser browser;

    FolderOfFiles() : at(folder.path().string() + "/") {
        for (const char* name :
             {"walk.csv", "Walk2.csv", "walk10.json", "walk.png", ".hidden.csv", "w\xc3\xa4.csv", "w\xc3\xb6.csv"}) {
            folder.write(name, "12345");
        }
        std::filesystem::create_directory(folder.path() / "walks");
        std::filesystem::create_directory(folder.path() / "deep");
        browser.begin(folder.path(), openable_extensions());
    }
    Names names() const {
        Names out;
        for (const FileEntry& entry : browser.entries()) out.push_back(entry.name);
        return out;
    }
    Names chosen() const {
        Names out;
        for (const auto& path : browser.chosen()) out.push_back(path.filename().string());
        return out;
    }
    std::string completed(const std::string& typed) const {
        return complete_path(typed, folder.path(), openable_extensions());
    }
};

TEST(FileBrowser, ListsFoldersThenWhatCanBeOpened) {
    const FolderOfFiles files;
    EXPECT_EQ(files.names(),
              (Names{"deep", "walks", "walk.csv", "Walk2.csv", "walk10.json", "w\xc3\xa4.csv", "w\xc3\xb6.csv"}));
    EXPECT_EQ(files.browser.entries()[2].size, 5u);
}

TEST(FileBrowser, ListsWhatHoldsTheTypedPart) {
    FolderOfFiles files;
    files.browser.follow("ALK", true);
    EXPECT_EQ(files.names(), (Names{"walks", "walk.csv", "Walk2.csv", "walk10.json"}));
    files.browser.follow("2", true);
    EXPECT_EQ(files.chosen(), Names{"Walk2.csv"}) << "Enter takes it";
    files.browser.follow(".h", true);
    EXPECT_EQ(files.names(), Names{".hidden.csv"});
    files.browser.follow("", true);
    EXPECT_EQ(files.names().size(), 7u);
    files.browser.show_hidden(true);
    EXPECT_EQ(files.names().size(), 8u);
    files.browser.follow("walk", false);
    EXPECT_EQ(files.names().size(), 8u) << "a name for a new file lists all";
}

TEST(FileBrowser, OrdersByEachColumnBothWays) {
    FolderOfFiles files;
    files.folder.write("walk.csv", "1");
    const auto now = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(files.folder.path() / "w\xc3\xa4.csv", now - std::chrono::hours(48));
    std::filesystem::last_write_time(files.folder.path() / "Walk2.csv", now + std::chrono::hours(1));
    files.browser.begin(files.folder.path(), openable_extensions());
    files.browser.order_by("date");
    EXPECT_EQ(files.names()[2], "w\xc3\xa4.csv") << "behind the folders";
    EXPECT_EQ(files.names().back(), "Walk2.csv");
    files.browser.order_by("-date");
    EXPECT_EQ(files.names()[2], "Walk2.csv");
    files.browser.order_by("size");
    EXPECT_EQ(files.names()[2], "walk.csv");
    files.browser.order_by("-name");
    EXPECT_EQ(files.names(),
              (Names{"walks", "deep", "w\xc3\xb6.csv", "w\xc3\xa4.csv", "walk10.json", "Walk2.csv", "walk.csv"}));
}

TEST(FileBrowser, ChoosesSeveral) {
    FolderOfFiles files;
    files.browser.choose(3, Choose::only);
    files.browser.choose(5, Choose::range);
    EXPECT_EQ(files.chosen(), (Names{"Walk2.csv", "walk10.json", "w\xc3\xa4.csv"}));
    files.browser.choose(2, Choose::range);
    EXPECT_EQ(files.chosen(), (Names{"walk.csv", "Walk2.csv"})) << "from where it began";
    files.browser.choose(2, Choose::toggle);
    files.browser.choose(6, Choose::toggle);
    EXPECT_EQ(files.chosen(), (Names{"Walk2.csv", "w\xc3\xb6.csv"}));
    files.browser.order_by("-name");
    EXPECT_EQ(files.chosen(), (Names{"w\xc3\xb6.csv", "Walk2.csv"})) << "another order changes nothing";
    EXPECT_EQ(files.browser.entries()[files.browser.cursor()].name, "w\xc3\xb6.csv");
    files.browser.choose_all();
    EXPECT_EQ(files.chosen().size(), 5u) << "files alone";
}

TEST(FileBrowser, GoesUpAndIsWhereItCameFrom) {
    FolderOfFiles files;
    files.browser.go(files.folder.path() / "walks");
    EXPECT_TRUE(files.names().empty());
    files.browser.go_up();
    EXPECT_EQ(files.chosen(), Names{"walks"});
    EXPECT_EQ(files.browser.way().back(), files.folder.path());
    EXPECT_EQ(files.browser.way().front(), "/");
    for (int i = 0; i < 20; ++i) files.browser.go_up();
    EXPECT_EQ(files.browser.way(), std::vector<std::filesystem::path>{"/"});
}

TEST(FileBrowser, FollowsWhatIsTypedIntoOtherFolders) {
    FolderOfFiles files;
    files.folder.write("deep/one.csv", "x");
    files.browser.follow("deep/", true);
    EXPECT_EQ(files.names(), Names{"one.csv"});
    files.browser.follow("none/", true);
    EXPECT_FALSE(files.browser.error().empty());
    EXPECT_TRUE(files.names().empty());
    files.browser.follow(files.at + "deep/o", true);
    EXPECT_EQ(files.chosen(), Names{"one.csv"});
    EXPECT_EQ(files.browser.folder(), files.folder.path());
    files.folder.write("walk", "x");
    files.browser.follow(files.at + "walk10.json", true);
    EXPECT_EQ(files.chosen(), Names{"walk10.json"});
}

TEST(FileBrowser, SeesWhatOthersWrite) {
    FolderOfFiles files;
    files.folder.write("new.csv", "x");
    std::filesystem::last_write_time(files.folder.path(),
                                     std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
    files.browser.follow("", true);
    EXPECT_EQ(files.names()[2], "new.csv");
    EXPECT_EQ(files.chosen(), Names{"deep"}) << "the cursor stays";
}

TEST(PathCompletion, CompletesAsFarAsAllAgree) {
    const FolderOfFiles files;
    EXPECT_EQ(files.completed("wal"), "walk");
    EXPECT_EQ(files.completed(files.at + "walk.c"), files.at + "walk.csv");
    EXPECT_EQ(files.completed("d"), "deep/");
    EXPECT_EQ(files.completed("x"), "x");
    EXPECT_EQ(files.completed("w\xc3"), "w") << "no half characters";
    EXPECT_EQ(files.completed(files.at + "none/x"), files.at + "none/x");
}

TEST(PathCompletion, KnowsTheHome) {
    const FolderOfFiles files;
    const char* const home = std::getenv("HOME");
    const std::string before = home ? home : "";
    ::setenv("HOME", files.folder.path().c_str(), 1);
    EXPECT_EQ(expanded("~/walk.csv"), files.at + "walk.csv");
    EXPECT_EQ(expanded("~"), files.folder.path().string());
    EXPECT_EQ(expanded("a~/b"), "a~/b");
    EXPECT_EQ(files.completed("~/de"), "~/deep/") << "what was typed stays";
    ::setenv("HOME", before.c_str(), 1);
}

TEST(PathCompletion, APathMayBeginAnewBehindAnother) {
    EXPECT_EQ(expanded("/home/someone//data/walk.bvh"), "/data/walk.bvh");
    EXPECT_EQ(expanded("/data/walk.bvh"), "/data/walk.bvh");
    EXPECT_EQ(expanded("/home/someone/~/clips"), expanded("~/clips"));
    EXPECT_EQ(typed_path("a/b", "/c"), "/c/a/b");
    EXPECT_EQ(typed_path("/a/b", "/c"), "/a/b");
}

// --- what a file holds

TEST(FilePreview, SaysWhatAFileHolds) {
    const TempFolder folder;
    const auto title = [&](const char* name, const char* text) { return summary_of(folder.write(name, text)).title; };
    const char* const clips = R"({"clips": {"a": {"dt": 1, "samples": [[0, 0, 0.3], [1, 0, 0.3]]}, "b": {"dt": 1,
        "samples": [[0, 0, 0.3]]}})";
    EXPECT_EQ(title("a.json", (std::string(clips) + "}").c_str()), "Scene with 2 clips");
    EXPECT_EQ(title("b.json", (std::string(clips) + R"(, "agents": [{"name": "A", "clip": "a", "translate": [0, 0]},
        {"name": "B", "clip": "b", "translate": [5, 0]}], "queries": [{"a": "A", "b": "B"}]})")
                                  .c_str()),
              "Scene with 2 agents, 1 query");
    const FileSummary walk = summary_of(folder.write("walk.csv", "t,x,y,r\n0,0,0,0.3\n0.5,1,0,0.3\n"));
    EXPECT_EQ(walk.title, "1 clip");
    ASSERT_FALSE(walk.facts.empty());
    EXPECT_EQ(walk.facts[0], (std::pair<std::string, std::string>("Duration", "1.0 s")));
    EXPECT_EQ(walk.facts[1].second, "2, 2 a second");
    const FileSummary broken = summary_of(folder.write("broken.json", "{"));
    EXPECT_FALSE(broken.readable);
    EXPECT_EQ(broken.title.find(folder.path().string()), std::string::npos) << broken.title;
    EXPECT_NE(broken.title.find("line 1"), std::string::npos) << broken.title;
    std::filesystem::create_directory(folder.path() / "deep");
    EXPECT_EQ(summary_of(folder.path()).title, "Folder with 1 clip file, 3 scene files, 1 folder");
    EXPECT_EQ(summary_of(folder.path() / "deep").title, "Folder without anything that can be opened");
    EXPECT_FALSE(summary_of(folder.path() / "none.csv").readable);
}

TEST(FilePreview, IsMadeBesideTheWindowAndKeptUntilTheFileChanges) {
    const TempFolder folder;
    const std::filesystem::path file = folder.write("walk.csv", "t,x,y,r\n0,0,0,0.3\n0.5,1,0,0.3\n");
    FilePreview preview;
    EXPECT_FALSE(preview.ask(file, 10, false, {}));
    EXPECT_GT(preview.ask_again_in(10), 0) << "who passes by is not read";
    const FileSummary* summary = nullptr;
    for (int i = 0; i < 10'000 && !summary; ++i) {
        summary = preview.ask(file, 11, false, {});
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(summary);
    EXPECT_EQ(summary->title, "1 clip");
    folder.write("walk.csv", "t,x,y,r\n0,0,0,nan\n");
    EXPECT_FALSE(preview.ask(file, 12, false, {}));
    summary = preview.ask(file, 13, true, {});
    if (!summary) summary = preview.ask(file, 13, true, {});
    ASSERT_TRUE(summary);
    EXPECT_FALSE(summary->readable);
}

}  // namespace
}  // namespace mobbscope::app
