// What the commands write: never over what they read, and without leaving an unfinished file.
#include "render_runs.h"
#include "run_program.h"

#include <render/image/png.h>
#include <support/bvh_text.h>
#include <support/seccomp.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using Option = std::pair<std::string, std::string>;  ///< of a command: {"graph build", "-o"}

/// A run that writes, but for the name of the file.
struct Writer {
    Option option;
    std::vector<std::string> arguments;  ///< the option's name last
    std::string extension;
    std::vector<std::string> reads;  ///< files of the folder
    bool draws = false;              ///< needs OpenGL
};

/// Files that commands read, one of each kind.
class Outputs : public ::testing::Test {
  protected:
    Outputs() {
        folder.write("track.csv", "id,t,x,y\n1,0,0,0\n1,0.5,0.1,0\n2,0,1,1\n2,0.5,1,1.2\n");
        folder.write("radii.csv", "id,r\n1,0.3\n2,0.4\n");
        folder.write("clip.csv", "t,x,y,r\n0,0,0,0.4\n0.5,0.1,0,0.4\n");
        folder.write("walker.bvh", kWalker);
        folder.write("scene.json", R"({"clips": {"c": {"source": "clip.csv"}}})");
        folder.write("motion.json",
                     R"({"clips": {"c": {"source": "walker.bvh"}}, "agents": [{"name": "A", "clip": "c"}]})");
        folder.write("two.json", R"({"clips": {"c": {"source": "clip.csv"}},
            "agents": [{"name": "A", "clip": "c"}, {"name": "B", "clip": "c", "translate": [3, 0]}]})");
        folder.write("view.json", R"({"theme": "light"})");
        folder.write("graph.json", R"({"clips": {"c": {"source": "clip.csv"}}, "graph": {"hubs": [{"name": "a"}],
            "moves": [{"clip": "c", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [0.2, 0, 0]}]}})");
        Image image(300, 300);
        std::minstd_rand noise;  // which packing leaves as large as it is
        for (std::uint8_t& channel : image.rgba) channel = static_cast<std::uint8_t>(noise() >> 8);
        write_png(folder.path() / "a.png", image);
        write_png(folder.path() / "b.png", Image(300, 300));
        write_png(folder.path() / "mask.png", image);
        std::filesystem::create_directory(folder.path() / "cases");
        folder.write("cases/c.case.json", R"({"mobbscope_case": 1, "scene": "../scene.json", "size": "80x80"})");
        folder.write("cases/c.png", slurp(folder.path() / "a.png"));
        folder.write("cases/c.state.json", "{}");
    }

    std::string path(const std::string& name) const { return folder.path() / name; }

    std::vector<Writer> writers() const {
        const auto picture = [this](const std::string& option) -> std::vector<std::string> {
            return {"render", path("scene.json"), "--size", "80x80", "--view-state", path("view.json"), option};
        };
        const auto test = [this](const std::string& option) -> std::vector<std::string> {
            return {"test", path("cases"), "--output", path("failed"), option};
        };
        const std::vector<std::string> pictured{"scene.json", "clip.csv", "view.json"};
        const std::vector<std::string> tested{"cases/c.case.json", "cases/c.png", "cases/c.state.json"};
        return {
            {{"convert", "-o"}, {"convert", path("scene.json"), "-o"}, ".json", {"scene.json", "clip.csv"}},
            {{"convert", "-o"},
             {"convert", path("track.csv"), "--radius", path("radii.csv"), "-o"},
             ".csv",
             {"track.csv", "radii.csv"}},
            {{"convert", "-o"},
             {"convert", path("motion.json"), "--agent", "A", "-o"},
             ".bvh",
             {"motion.json", "walker.bvh"}},
            {{"convert", "-o"}, {"convert", path("walker.bvh"), "-o"}, ".glb", {"walker.bvh"}},
            {{"diff", "-o"},
             {"diff", path("a.png"), path("b.png"), "--mask", path("mask.png"), "-o"},
             ".png",
             {"a.png", "b.png", "mask.png"}},
            {{"diff", "--strip"}, {"diff", path("a.png"), path("b.png"), "--strip"}, ".png", {"a.png", "b.png"}},
            {{"graph build", "-o"}, {"graph", "build", path("walker.bvh"), "--whole", "-o"}, ".json", {"walker.bvh"}},
            {{"graph draw", "-o"},
             {"graph", "draw", path("graph.json"), "-o"},
             ".png",
             {"graph.json", "clip.csv"},
             true},
            {{"map", "-o"},
             {"map", path("two.json"), "--over", "dx=-1:1,dy=-1:1", "--cells", "4x4", "-o"},
             ".png",
             {"two.json", "clip.csv"},
             true},
            {{"query", "--certificate"},
             {"query", path("two.json"), "--certificate"},
             ".json",
             {"two.json", "clip.csv"}},
            {{"render", "-o"}, picture("-o"), ".png", pictured, true},
            {{"render", "--ids"}, picture("--ids"), ".png", pictured, true},
            {{"render", "--draw-list"}, picture("--draw-list"), ".json", pictured},
            {{"simulate", "-o"},
             {"simulate", path("graph.json"), "--seconds", "1", "--agents", "2", "-o"},
             ".json",
             {"graph.json", "clip.csv"}},
            {{"simulate", "--record"},
             {"simulate", path("graph.json"), "--seconds", "1", "--agents", "2", "-o", path("run.json"), "--record"},
             ".json",
             {"graph.json", "clip.csv"}},
            {{"sweep", "-o"},
             {"sweep", path("two.json"), "--over", "leaf=5,10", "--queries", "50", "-o"},
             ".png",
             {"two.json", "clip.csv"},
             true},
            {{"test", "--contact-sheet"}, test("--contact-sheet"), ".png", tested, true},
            {{"test", "--html"}, test("--html"), ".html", tested, true},
            {{"test", "--junit"}, test("--junit"), ".xml", tested, true},
        };
    }

    TempFolder folder;
};

/// Options that name files or folders and are not among the writers.
const std::set<Option> kOtherFiles{
    {"diff", "--mask"},
    {"render", "--view-state"},
    {"test", "--output"},  // a folder of pictures, which is never that of the goldens
};

std::vector<std::string> commands_of(const std::vector<std::string>& words) {
    std::vector<std::string> arguments = words;
    arguments.emplace_back("--help");
    std::istringstream help(run_program(arguments).out);
    std::vector<std::string> out;
    std::string line;
    bool listed = false;
    while (std::getline(help, line)) {
        if (line == "Subcommands:") listed = true;
        if (listed && line.starts_with("  ") && line[2] != ' ') out.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return out;
}

/// All options whose value is called like a file that is written.
std::set<Option> options_with_files() {
    std::set<Option> out;
    std::vector<std::vector<std::string>> commands;
    for (const std::string& name : commands_of({})) {
        const std::vector<std::string> below = commands_of({name});
        if (below.empty()) commands.push_back({name});
        for (const std::string& second : below) commands.push_back({name, second});
    }
    const std::regex option("^  (-[^, ]+)[^ ]* (OUT|FOLDER|[A-Z]+\\.[a-z]+)( .*)?$");
    for (std::vector<std::string> words : commands) {
        const std::string command = words.size() > 1 ? words[0] + ' ' + words[1] : words[0];
        words.emplace_back("--help");
        std::istringstream help(run_program(words).out);
        std::string line;
        std::smatch found;
        while (std::getline(help, line)) {
            if (std::regex_match(line, found, option)) out.emplace(command, found[1]);
        }
    }
    return out;
}

TEST_F(Outputs, EveryOptionThatNamesAFileIsTried) {
    const std::set<Option> all = options_with_files();
    std::set<Option> known = kOtherFiles;
    for (const Writer& writer : writers()) known.insert(writer.option);
    EXPECT_EQ(all, known) << "say of a new option what it writes, among the writers or the other files";
}

TEST_F(Outputs, NothingThatIsReadIsReplaced) {
    std::map<std::string, std::string> before;
    int number = 0;
    for (const Writer& writer : writers()) {
        for (const std::string& read : writer.reads) before[read] = slurp(path(read));
        for (const std::string& read : writer.reads) {
            const std::filesystem::path link = path("link" + std::to_string(number) + writer.extension);
            std::vector<std::string> arguments = writer.arguments;
            arguments.push_back(link);
            switch (number++ % 3) {
                case 0:
                    std::filesystem::create_symlink(path(read), link);
                    break;
                case 1:
                    std::filesystem::create_hard_link(path(read), link);
                    break;
                default:
                    std::filesystem::create_symlink(path(read), link);
                    arguments.back() = path("none/../" + link.filename().string());
            }
            SCOPED_TRACE(writer.option.first + ' ' + writer.option.second + ' ' + read);
            expect_refused(run_program(arguments), 2, "would replace");
            std::filesystem::remove(link);
        }
        for (const std::string& read : writer.reads) EXPECT_EQ(slurp(path(read)), before[read]) << read;
    }
    EXPECT_FALSE(std::filesystem::exists(path("run.json")));
    EXPECT_FALSE(std::filesystem::exists(path("failed")));
}

TEST_F(Outputs, NothingThatComesFromStandardInputIsReplaced) {
    int tried = 0;
    for (const Writer& writer : writers()) {
        const std::string read = path(writer.reads.front());
        std::vector<std::string> arguments = writer.arguments;
        const auto input = std::ranges::find(arguments, read);
        const bool takes_standard_input = writer.option.first != "diff" && writer.option.first != "graph build";
        if (input == arguments.end() || !takes_standard_input) continue;
        *input = "-";
        const std::filesystem::path link = path("link" + writer.extension);
        std::filesystem::create_hard_link(read, link);
        arguments.push_back(link);
        const std::string before = slurp(read);
        SCOPED_TRACE(writer.option.first + ' ' + writer.option.second);
        const auto in_folder = [this] { ASSERT_EQ(::chdir(folder.path().c_str()), 0); };
        expect_refused(run_program(arguments, {}, read, in_folder), 2, "would replace");
        EXPECT_EQ(slurp(read), before);
        std::filesystem::remove(link);
        ++tried;
    }
    EXPECT_GT(tried, 8);
    // By the names that the system has for it, too.
    for (const char* name : {"/dev/stdin", "/proc/self/fd/0", "/dev/fd/0"}) {
        const Result run =
            run_program({"convert", name, "--radius", "0.3", "-o", path("track.csv")}, {}, path("track.csv"));
        expect_refused(run, 2, "would replace");
    }
}

TEST_F(Outputs, ResultsDoNotReplaceWhatTheyAreMadeFrom) {
    const std::string before = slurp(path("two.json"));
    const auto appending = [this] { ::dup2(::open(path("two.json").c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO); };
    const Result run = run_program({"query", path("two.json")}, {}, "/dev/null", appending);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("two.json: is where standard output goes"), std::string::npos) << run.err;
    EXPECT_EQ(slurp(path("two.json")), before);
}

TEST_F(Outputs, PicturesOfWhatDidNotPassReplaceNothingThatWasRead) {
    // Each has the name of something that a run leaves beside the goldens.
    for (const std::string name : {"report.json", "c.txt", "c.actual.answers.json"}) {
        std::filesystem::create_directory(path("left"));
        folder.write("left/" + name, name.ends_with(".txt") ? slurp(path("track.csv")) : slurp(path("two.json")));
        folder.write("left/scene.json", R"({"clips": {"c": {"source": "c.txt", "id": "1"}},
                                            "agents": [{"name": "A", "clip": "c"}, {"name": "B", "clip": "c"}]})");
        const std::string scene = name.ends_with(".txt") ? "scene.json" : name;
        const std::filesystem::path cases = path("answered");
        std::filesystem::create_directory(cases);
        folder.write("answered/c.case.json",
                     R"({"mobbscope_case": 1, "hold": ["answers"], "scene": "../left/)" + scene + "\"}");
        folder.write("left/clip.csv", slurp(path("clip.csv")));
        const std::string before = slurp(path("left/" + name));
        expect_refused(run_program({"test", cases, "--output", path("left")}), 2, name + ": would replace");
        EXPECT_EQ(slurp(path("left/" + name)), before);
        std::filesystem::remove_all(path("left"));
        std::filesystem::remove_all(cases);
    }
}

TEST_F(Outputs, ADashIsNoFileAndTheRefusalNamesTheOption) {
    for (const Writer& writer : writers()) {
        std::vector<std::string> arguments = writer.arguments;
        arguments.emplace_back("-");
        expect_refused(
            run_program(arguments), 2,
            writer.option.second + (writer.option.second == "-o" ? ",--output" : "") + ": '-' is standard output");
    }
}

TEST_F(Outputs, AnOutputIsNotTheFileThatTheResultsGoTo) {
    for (const std::string& name : {std::string("/dev/stdout"), path("results.json")}) {
        const Result run = run_program({"query", path("two.json"), "--certificate", name}, path("results.json"));
        EXPECT_EQ(run.status, 2);
        EXPECT_NE(run.err.find(name + ": is the file that standard output goes to"), std::string::npos) << run.err;
    }
}

TEST_F(Outputs, AReportReplacesNothingThatACaseIsDrawnFrom) {
    for (const std::string read : {"scene.json", "clip.csv"}) {
        const std::string before = slurp(path(read));
        std::filesystem::create_hard_link(path(read), path("report.html"));
        const Result run =
            run_program({"test", path("cases"), "--output", path("failed"), "--html", path("report.html")});
        if (run.status == 3) GTEST_SKIP() << run.err;
        expect_refused(run, 2, "would replace");
        EXPECT_EQ(slurp(path(read)), before);
        std::filesystem::remove(path("report.html"));
    }
}

TEST_F(Outputs, AreAllThatIsLeft) {
    std::filesystem::create_directory(path("out"));
    for (const Writer& writer : writers()) {
        const std::string out = "out/x" + writer.extension;
        std::filesystem::create_symlink("target", path("out/x" + writer.extension));
        std::vector<std::string> arguments = writer.arguments;
        arguments.push_back(path(out));
        const Result run = run_program(arguments);
        if (writer.draws && run.status == 3) {
            std::filesystem::remove(path(out));
            continue;
        }
        EXPECT_LE(run.status, 1) << run.err;
        // A link that led to nothing leads to what was written.
        EXPECT_EQ(files_in(path("out")), (std::set<std::string>{"x" + writer.extension, "target"}));
        EXPECT_TRUE(std::filesystem::is_symlink(path(out)));
        EXPECT_GT(std::filesystem::file_size(path("out/target")), 0u);
        std::filesystem::remove(path("out/target"));
        std::filesystem::remove(path(out));
    }
}

TEST_F(Outputs, TwoAreWrittenBothOrNone) {
    const std::string heat = folder.write("heat.png", "old");
    const Result full = run_program({"diff", path("a.png"), path("b.png"), "-o", heat, "--strip", "/dev/full"});
    EXPECT_EQ(full.status, 2);  // its name ends in none of .png
    std::filesystem::create_symlink("/dev/full", path("full.png"));
    expect_refused(run_program({"diff", path("a.png"), path("b.png"), "-o", heat, "--strip", path("full.png")}), 3,
                   "full.png: cannot be written: No space left");
    EXPECT_EQ(slurp(heat), "old");
    const std::string run = folder.write("run.json", "old");
    std::filesystem::create_symlink("/dev/full", path("full.json"));
    const Result simulated = run_program(
        {"simulate", path("graph.json"), "--seconds", "1", "--agents", "2", "-o", run, "--record", path("full.json")});
    EXPECT_EQ(simulated.status, 3) << simulated.err;
    EXPECT_EQ(slurp(run), "old");
}

/// A `diff` that waits with its first picture written: nobody reads from the pipe that the second goes to.
class WaitingWriter {
  public:
    WaitingWriter(const std::string& a, const std::string& b, const TempFolder& folder, bool nameless) {
        const std::string pipe = folder.path() / "pipe.png";
        ::mkfifo(pipe.c_str(), 0600);
        reader_ = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        child_ = start_program({"diff", a, b, "-o", folder.path() / "heat.png", "--strip", pipe}, {}, [&] {
            // A job of nohup ignores them, and so would the program.
            for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::signal(signal, SIG_DFL);
            if (!nameless && !refuse_nameless_files()) ::_exit(77);
        });
    }
    ~WaitingWriter() {
        if (child_ > 0) end(SIGKILL);
        ::close(reader_);
    }
    WaitingWriter(const WaitingWriter&) = delete;
    WaitingWriter& operator=(const WaitingWriter&) = delete;

    /// Until the pipe is full; false if it ended before.
    bool wait() {
        char byte = 0;
        for (int i = 0; i < 1000; ++i) {
            if (::read(reader_, &byte, 1) == 1) return true;
            if (::waitpid(child_, &status_, WNOHANG) == child_) {
                child_ = -1;
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    bool is_skipped() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 77; }
    /// How it ended.
    int end(int signal) {
        ::kill(child_, signal);
        ::waitpid(child_, &status_, 0);
        child_ = -1;
        return status_;
    }

  private:
    int reader_ = -1;
    pid_t child_ = -1;
    int status_ = 0;
};

TEST_F(Outputs, ASignalLeavesNoUnfinishedFile) {
    for (const bool nameless : {true, false}) {
        for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
            const TempFolder to;
            WaitingWriter writer(path("a.png"), path("b.png"), to, nameless);
            if (!writer.wait()) {
                if (writer.is_skipped()) GTEST_SKIP() << "no system calls can be refused here";
                FAIL() << "the program did not wait";
            }
            EXPECT_EQ(files_in(to.path()).size(), nameless ? 1u : 2u);
            const int status = writer.end(signal);
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
            EXPECT_EQ(files_in(to.path()), std::set<std::string>{"pipe.png"});
        }
    }
}

TEST_F(Outputs, APipeWithoutReaderDoesNotBlock) {
    const std::string pipe = path("pipe.png");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    expect_refused(run_program({"diff", path("a.png"), path("b.png"), "-o", pipe}), 3, "nobody reads from it");
    expect_refused(run_program({"diff", path("a.png"), pipe}), 2, "is not a regular file");
}

}  // namespace
}  // namespace mobbscope
