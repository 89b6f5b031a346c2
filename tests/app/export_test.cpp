// Exported pictures: the dialog by keys and clicks, and the command line that does the same.
#include <app/commands/picture_order.h>
#include <app/script/script.h>
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <app/window/picture_clipboard.h>
#include <base/error.h>
#include <base/text.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <review/review_screen.h>
#include <scene/load_files.h>

#include <support/temp_folder.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

class ExportTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            window = std::make_unique<HeadlessWindow>(GlContext::open(Backend::automatic), session,
                                                      PictureSize{1000, 640}, 1);
        } catch (const MachineError& error) {
            GTEST_SKIP() << error.what();
        }
        session.desktop = &desktop;
        session.files.open({folder.scene});
        window->settle();
        run("run picture.file " + file.string());
    }

    void TearDown() override {
        if (session.dialogs.exporting.temporary)
            std::filesystem::remove_all(session.dialogs.exporting.temporary->file.parent_path());
    }

    std::string run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, *window, out);
        return out.str();
    }

    /// Exports by the dialog's command, then runs its line, as a person pastes it: the same file, byte for byte.
    void expect_the_line_does_the_same(const std::string& script) {
        SCOPED_TRACE(script);
        run(script + "\nrun picture.write\nrun picture.copy_command");
        const std::string exported = slurp(file);
        ASSERT_FALSE(exported.empty());
        std::filesystem::remove(file);
        SCOPED_TRACE(copied);
        ASSERT_TRUE(copied.starts_with("mobbscope render "));
        const std::string line = shell_word(MOBBSCOPE_PROGRAM) + copied.substr(std::string("mobbscope").size());
        ASSERT_EQ(std::system(line.c_str()), 0);
        EXPECT_TRUE(slurp(file) == exported);
    }

    CrossingFolder folder;
    std::filesystem::path file = folder.file("a picture's.png");
    Session session{false};
    std::unique_ptr<HeadlessWindow> window;
    TestDesktop desktop;
    const std::string& copied = desktop.text;
};

TEST_F(ExportTest, TheCommandLineDrawsTheSameBytes) {
    expect_the_line_does_the_same("");
    expect_the_line_does_the_same("drag viewport 90 -35\nscroll viewport 2\nrun picture.size 640x360");
    expect_the_line_does_the_same("run picture.background transparent\nrun picture.without caption legend floor");
    expect_the_line_does_the_same(
        "run go.node A 2\nrun picture.scale 1.75\nrun picture.samples 1\nrun picture.theme light");
    expect_the_line_does_the_same(
        "run query.select 0\nrun step.first\nrun step.to 7\nrun time.at 0.4\nrun view.past all\nrun picture.without "
        "inset time_axis");
    expect_the_line_does_the_same("run picture.without past\nrun picture.samples 2\nrun picture.background opaque");
    expect_the_line_does_the_same("run query.none\nrun view.moment\nrun time.at 0.4\nrun picture.without none");
}

TEST_F(ExportTest, VectorFilesAreThoseOfTheCommandLine) {
    for (const char* name : {"a picture's.svg", "a picture's.pdf"}) {
        file = folder.file(name);
        expect_the_line_does_the_same("run picture.file " + file.string() + "\nrun go.node A 2");
    }
}

TEST_F(ExportTest, TheLineOfASceneThatNoFileHoldsNamesATemporaryOne) {
    run("run go.agent A\nrun agent.nudge 1 0");
    ASSERT_TRUE(session.workspace.modified());
    expect_the_line_does_the_same("run picture.size 640x360");
    ASSERT_TRUE(session.dialogs.exporting.temporary);
    EXPECT_EQ(session.dialogs.exporting.temporary->file.extension(), ".json");
    EXPECT_NE(all_messages(session).find("a copy was written to"), std::string::npos);
    // Seen otherwise, and with another fit beside it.
    const std::filesystem::path first = session.dialogs.exporting.temporary->file;
    expect_the_line_does_the_same("run view.top\nrun picture.without boxes");
    EXPECT_EQ(session.dialogs.exporting.temporary->file, first) << "it holds this scene still";
    expect_the_line_does_the_same("run view.split\nrun tree.kind umobb\nrun picture.without none");
}

TEST_F(ExportTest, TheLineOfACasesSceneDrawsWhatTheCaseShows) {
    std::filesystem::create_directories(folder.file("cases"));
    folder.write(
        "cases/one.case.json",
        R"({"mobbscope_case": 1, "scene": "../scene.json", "view": {"levels": "leaves"}, "fit": {"tree": "umobb"}})");
    std::filesystem::create_directories(folder.file("drawn"));
    folder.write("drawn/report.json", R"({"mobbscope_report": 1, "cases": []})");
    ReviewScreen& reviews = add_review(session);
    reviews.open(folder.file("cases"), folder.file("drawn"));
    reviews.open_case(0);
    window->settle();
    ASSERT_EQ(session.files.visited(), "one");
    ASSERT_EQ(session.workspace.document().fitted->options().tree, mobb::TreeKind::umobb);
    expect_the_line_does_the_same("run picture.size 640x360");
}

TEST_F(ExportTest, AnotherSceneClosesTheDialog) {
    run("key Ctrl+E\nclick export.browse\nexpect /dialog \"export_file\"");
    session.files.open({folder.write("other.json", R"({"clips": {"a": {"dt": 1, "samples": [[0, 0, 1]]}}})")});
    window->settle();
    EXPECT_EQ(session.dialogs.now, Dialog::none);
}

TEST_F(ExportTest, WhatTheViewportShowsIsExportedUnlessTheDialogSaysOtherwise) {
    // What folds caption and legend stands in the window alone.
    run("run view.caption\nrun view.legend\nrun go.agent B\nmove 5 5\nrun picture.write");
    EXPECT_EQ(read_png(file).rgba, window->shell().viewport_picture().rgba);
    run("run picture.size 640x360\nrun picture.background transparent\nrun file.export_picture " + file.string());
    EXPECT_EQ(read_png(file).rgba, window->shell().viewport_picture().rgba);
    run("run picture.write");
    const Image other = read_png(file);
    EXPECT_EQ(other.width, 640);
    EXPECT_EQ(other.at(0, 359)[3], 0) << "nothing is drawn there";
}

TEST_F(ExportTest, TheDialogIsWorkedByKeysAlone) {
    run("key Ctrl+E\nexpect /dialog \"export_picture\"");
    EXPECT_EQ(session.dialogs.input.text, file.string()) << "what was said before";
    run("key Ctrl+A\ntype other\nexpect /export/file \"other\"\nkey Tab\nexpect /focus \"export.browse\"\nkey Tab");
    run("expect /focus \"export.size\"\nkey Enter\nkey Down\nkey Enter\nexpect /export/size \"1280x720\"");
    // A side takes the other one along.
    run("key Tab\nexpect /focus \"export.width\"\nkey Enter\nkey Ctrl+A\ntype 640\nkey Enter");
    run("expect /export/size \"640x360\"");
    run("key Escape\nexpect /dialog \"none\"\nkey Ctrl+E\nexpect /export/file \"other\"");
    run("key Enter\nexpect /dialog \"none\"");
    const Image image = read_png(folder.file("other.png"));
    EXPECT_EQ(image.width, 640) << "the settings stay, and a name alone goes beside the scene";
    EXPECT_NE(all_messages(session).find("Wrote " + folder.file("other.png").string() + " (640 x 360, "),
              std::string::npos)
        << all_messages(session);
}

TEST_F(ExportTest, AnExtensionIsMeantOnce) {
    run("key Ctrl+E\ntype mine.png\nkey Enter\nexpect /dialog \"none\"");
    EXPECT_TRUE(std::filesystem::exists(folder.file("mine.png")));
}

TEST_F(ExportTest, ClicksChangeTheSettingsAndThePreview) {
    run("key Ctrl+E");
    const auto preview = [&] { return session.dialogs.exporting.image; };
    const auto before = preview();
    ASSERT_TRUE(before);
    const Image whole = window->shell().viewport_picture();
    EXPECT_NEAR(static_cast<double>(before->width) / before->height, static_cast<double>(whole.width) / whole.height,
                0.02);
    run("click export.without.legend\nclick export.without.boxes\nexpect /export/without \"boxes legend\"");
    const auto without = preview();
    ASSERT_TRUE(without);
    EXPECT_NE(without->rgba, before->rgba);
    run("click export.background.transparent\nclick export.samples.2\nclick export.theme.light");
    run("expect /export/background \"transparent\"\nexpect /export/samples \"2\"\nexpect /export/theme \"light\"");
    EXPECT_EQ(preview()->at(0, preview()->height - 1)[3], 0);
    EXPECT_EQ(session.workspace.view().theme, Theme::dark);
    run("click export.without.legend\nclick export.without.boxes\nexpect /export/without \"none\"");
    // What the view does not show either cannot be left out.
    run("run view.legend\nclick export.without.legend\nexpect /export/without \"none\"");
    run("click export.copy_command");
    EXPECT_TRUE(copied.ends_with(" --background transparent -o " + shell_word(file.string()))) << copied;
    EXPECT_EQ(session.dialogs.now, Dialog::export_picture);
    run("click export.close\nexpect /dialog \"none\"");
}

TEST_F(ExportTest, AFileIsOverwrittenOnceItWasAsked) {
    folder.write(file.filename().string(), "precious");
    run("key Ctrl+E\nkey Enter\nexpect /dialog \"export_picture\"");
    EXPECT_TRUE(session.dialogs.input.confirming);
    EXPECT_EQ(slurp(file), "precious");
    // Another name is another question.
    run("type x");
    EXPECT_FALSE(session.dialogs.input.confirming);
    run("key Ctrl+A\ntype " + file.string() + "\nkey Enter\nkey Escape\nexpect /dialog \"none\"");
    EXPECT_EQ(slurp(file), "precious");
    run("key Ctrl+E\nkey Enter\nkey Enter\nexpect /dialog \"none\"");
    const std::string first = slurp(file);
    EXPECT_NE(first, "precious");
    run("run view.top\nkey Ctrl+E\nkey Enter\nexpect /dialog \"none\"");
    EXPECT_NE(slurp(file), first) << "it is the window's own by now";
}

TEST_F(ExportTest, BrowseAsksForTheFileAndLeadsBack) {
    folder.write("there.png", "precious");
    run("key Ctrl+E\nclick export.browse\nexpect /dialog \"export_file\"");
    EXPECT_EQ(session.dialogs.input.text, file.filename().string());
    run("key Escape\nexpect /dialog \"export_picture\"");
    EXPECT_EQ(session.dialogs.input.text, file.string());
    run("click export.browse\nkey Ctrl+A\ntype there.png\nkey Enter\nexpect /dialog \"export_file\"");
    EXPECT_TRUE(session.dialogs.input.confirming);
    run("key Enter\nexpect /dialog \"export_picture\"");
    EXPECT_EQ(export_file(session.workspace, session.settings, session.dialogs), folder.file("there.png"));
    EXPECT_EQ(slurp(folder.file("there.png")), "precious") << "it was only chosen";
    run("key Enter\nexpect /dialog \"none\"");
    EXPECT_NE(slurp(folder.file("there.png")), "precious") << "who agreed there is not asked again";
}

TEST_F(ExportTest, WhatCannotBeIsRefusedAndNothingIsLeft) {
    EXPECT_NE(refusal(session, "picture.size", "0x5").find("each side must be 64 to 8192"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.size", "8192x8192").find("at most 33177600"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.scale", "100").find("8"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.samples", "3").find("give 1, 2, 4 or 8"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.background", "pink").find("give opaque or transparent"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.without", "legend heads").find("'heads' cannot be left out"),
              std::string::npos);
    EXPECT_EQ(session.settings.picture_export, PictureExport{}) << "nothing of what was refused";
    EXPECT_NE(refusal(session, "picture.write", folder.file("no/such.png").string()), "");
    EXPECT_NE(refusal(session, "picture.write", folder.file("a.jpg").string()).find("rename the output"),
              std::string::npos);
    EXPECT_NE(refusal(session, "file.copy_picture"), "");
    const auto names = [&] {
        std::set<std::string> out;
        for (const auto& entry : std::filesystem::directory_iterator(folder.scene.parent_path())) {
            out.insert(entry.path().filename().string());
        }
        return out;
    };
    EXPECT_EQ(names(), (std::set<std::string>{"scene.json", "stand.csv", "walk.csv"}));
    // In the dialog Enter does nothing then.
    for (const char* typed : {"no/such.png", "a.jpg", "../"}) {
        SCOPED_TRACE(typed);
        run("run picture.file " + folder.file(typed).string() + "\nkey Ctrl+E\nkey Enter\nkey Enter");
        EXPECT_EQ(session.dialogs.now, Dialog::export_picture);
        EXPECT_FALSE(session.dialogs.input.confirming);
        run("key Escape");
    }
    EXPECT_EQ(names(), (std::set<std::string>{"scene.json", "stand.csv", "walk.csv"}));
}

/// What a test changes of the environment, until it ends.
class Environment {
  public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* now = std::getenv(name)) before_ = now;
        ::setenv(name, value.c_str(), 1);
    }
    ~Environment() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

void write_program(const TempFolder& folder, const char* name, const std::string& text) {
    const std::filesystem::path file = folder.write(name, "#!/bin/sh\n" + text);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

TEST(PictureClipboard, AProgramOfTheDesktopTakesThePicture) {
    const TempFolder folder;
    const std::string path = std::getenv("PATH");
    const Environment no_wayland("WAYLAND_DISPLAY", "");
    const Environment display("DISPLAY", ":7");
    const Environment programs("PATH", folder.path().string());
    EXPECT_NE(why_no_picture_clipboard().find("apt install xclip"), std::string_view::npos);
    EXPECT_THROW(copy_picture_to_clipboard("png"), MachineError);
    const std::string taken = (folder.path() / "taken").string();
    write_program(folder, "xclip",
                  "PATH='" + path + "'\nprintf '%s ' \"$@\" >'" + taken + ".how'\ncat >'" + taken + "'\n");
    EXPECT_EQ(why_no_picture_clipboard(), "");
    const std::string bytes = "\x89PNG" + std::string(200'000, 'x');
    copy_picture_to_clipboard(bytes);
    EXPECT_TRUE(slurp(taken) == bytes);
    EXPECT_EQ(slurp(taken + ".how"), "-selection clipboard -target image/png -in ");
    write_program(folder, "xclip", "exit 3\n");
    try {
        copy_picture_to_clipboard(bytes);
        ADD_FAILURE() << "it did not take it";
    } catch (const MachineError& error) {
        EXPECT_NE(std::string(error.what()).find("xclip: it ended with status 3"), std::string::npos) << error.what();
    }
    const Environment wayland("WAYLAND_DISPLAY", "wayland-0");
    EXPECT_EQ(why_no_picture_clipboard(), "") << "through the X11 side of the desktop";
    std::filesystem::remove(folder.path() / "xclip");
    EXPECT_NE(why_no_picture_clipboard().find("apt install wl-clipboard"), std::string_view::npos);
    const Environment none("DISPLAY", "");
    const Environment nothing("WAYLAND_DISPLAY", "");
    EXPECT_NE(why_no_picture_clipboard().find("without a display"), std::string_view::npos);
}

/// An export by a stand-in for ffmpeg, which keeps the pictures that it is given.
class FilmExportTest : public ExportTest {
  protected:
    void SetUp() override {
        ExportTest::SetUp();
        if (IsSkipped()) return;
        session.options.program = MOBBSCOPE_PROGRAM;
        write_program(programs, "ffmpeg",
                      "case \"$*\" in *-encoders*) echo ' V... libx264 x'; exit 0;; esac\n"
                      "cat >'" +
                          pictures() + "'\nprintf film\n");
        run("run picture.size 320x240\nrun picture.rate 2");
    }
    std::string pictures() const { return programs.path() / "pictures"; }

    /// The window's film, and then the line's, which `end` ends but for the output: of the same pictures.
    void expect_the_line_films_the_same(const std::string& script, const std::string& end) {
        SCOPED_TRACE(script);
        run(script + "\nrun picture.write\nrun picture.copy_command");
        EXPECT_EQ(slurp(film), "film") << all_messages(session);
        std::filesystem::remove(film);
        const std::string taken = slurp(pictures());
        EXPECT_TRUE(copied.ends_with(end + " -o " + shell_word(film.string()))) << copied;
        EXPECT_EQ(copied.find("--step"), std::string::npos) << copied;
        const std::string line = shell_word(MOBBSCOPE_PROGRAM) + copied.substr(std::string("mobbscope").size());
        ASSERT_EQ(std::system(line.c_str()), 0);
        EXPECT_TRUE(slurp(pictures()) == taken);
        EXPECT_EQ(slurp(film), "film");
        std::filesystem::remove(film);
    }

    /// Whether it comes true, taking in what jobs have done.
    bool comes(const std::function<bool()>& what) {
        for (int i = 0; i < 6000 && !what(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            session.jobs.poll();
        }
        return what();
    }
    /// Begins the film, of which the stand-in waits for `go` to be there.
    void begin_film() {
        session.options.attended = true;
        session.options.patience = std::chrono::milliseconds(0);
        write_program(programs, "ffmpeg",
                      "case \"$*\" in *-encoders*) echo ' V... libx264 x'; exit 0;; esac\ncd '" +
                          programs.path().string() +
                          "'\necho $$ >number\nln number started\n"
                          "while [ ! -e go ]; do sleep 0.02; done\ncat >pictures\nprintf film\n");
        run_command(session, "file.export_film", film.string());
        ASSERT_TRUE(comes([&] { return std::filesystem::exists(programs.path() / "started"); }));
        ASSERT_EQ(session.jobs.count(), 1u) << all_messages(session);
    }
    bool is_stand_in_gone() const {
        const std::string number = std::to_string(std::stoi(slurp(programs.path() / "started")));
        return !std::filesystem::exists("/proc/" + number) || slurp("/proc/" + number + "/cmdline").empty();
    }
    bool is_tidy() const { return std::filesystem::is_empty(temporary.path()); }

    const TempFolder programs, temporary;
    const Environment temporaries{"TMPDIR", temporary.path().string()};
    const std::filesystem::path film = folder.file("a film's.mp4");
    const Environment path{"PATH", programs.path().string() + ':' + std::getenv("PATH")};
};

TEST_F(FilmExportTest, TheWindowAndTheLineFilmTheSame) {
    run("run picture.file " + film.string());
    expect_the_line_films_the_same("run picture.background transparent", " --size 320x240 --play --rate 2");
    EXPECT_NE(all_messages(session).find("Wrote " + film.string() + ": "), std::string::npos) << all_messages(session);
    EXPECT_NE(all_messages(session).find(" pictures of 320x240 at 2 a second"), std::string::npos);
    expect_the_line_films_the_same("run picture.film turn\nrun picture.turntable 3", " --turntable 3 --rate 2");
    expect_the_line_films_the_same("run picture.film play\nrun query.select 0\nrun step.first\nrun step.to 7",
                                   " --size 320x240 --play --rate 2");
    // Of a scene that no file holds.
    run("run query.none\nrun go.agent A\nrun agent.nudge 1 0");
    expect_the_line_films_the_same("", " --size 320x240 --play --rate 2");
}

TEST_F(FilmExportTest, NothingIsLeftOfACancelledFilm) {
    folder.write("a film's.mp4", "old");
    begin_film();
    EXPECT_FALSE(is_tidy()) << "the scene as it was";
    session.jobs.cancel(0);
    EXPECT_EQ(session.jobs.count(), 0u);
    EXPECT_TRUE(comes([&] { return is_stand_in_gone() && is_tidy(); }));
    EXPECT_EQ(slurp(film), "old");
}

TEST_F(FilmExportTest, AFilmOutlivesItsScene) {
    begin_film();
    EXPECT_NE(refusal(session, "file.export_film", film.string()).find("a film is being written to it"),
              std::string::npos);
    EXPECT_NO_THROW(session.jobs.require_none());
    session.files.request_close();
    EXPECT_FALSE(session.files.closed());
    EXPECT_NE(all_messages(session).find("quit once more"), std::string::npos);
    session.files.open({folder.file("stand.csv")});
    ASSERT_TRUE(comes([&] { return session.workspace.opened.front() == folder.file("stand.csv"); }));
    ASSERT_EQ(session.jobs.count(), 1u);
    session.files.visit(session.workspace.document(), "a case");
    EXPECT_EQ(session.jobs.count(), 1u);
    session.files.come_back([] {});
    ASSERT_EQ(session.jobs.count(), 1u);
    programs.write("go", "");
    EXPECT_TRUE(comes([&] { return session.jobs.count() == 0; }));
    EXPECT_EQ(slurp(film), "film") << all_messages(session);
    EXPECT_NE(all_messages(session).find("Wrote " + film.string()), std::string::npos) << all_messages(session);
    EXPECT_TRUE(is_tidy());
}

TEST_F(FilmExportTest, QuittingTwiceEndsAFilm) {
    begin_film();
    session.files.request_close();
    session.files.request_close();
    EXPECT_TRUE(session.files.closed());
    session.files.end_work();
    EXPECT_TRUE(is_tidy());
    EXPECT_TRUE(comes([&] { return is_stand_in_gone(); }));
    EXPECT_FALSE(std::filesystem::exists(film));
}

/// The bar shows films last, and Cancel ends what it shows.
TEST_F(FilmExportTest, OtherWorkIsCancelledBeforeIt) {
    begin_film();
    std::promise<void> go;
    session.jobs.start("Other work", [goes = go.get_future().share()](JobControl&) -> Job::Finish {
        goes.wait();
        return {};
    });
    run("click job.0.cancel");
    ASSERT_EQ(session.jobs.count(), 1u);
    EXPECT_EQ(session.jobs.purpose(0), JobPurpose::film);
    go.set_value();
    run("click job.0.cancel");
    EXPECT_EQ(session.jobs.count(), 0u);
    EXPECT_TRUE(comes([&] { return is_stand_in_gone() && is_tidy(); }));
}

TEST_F(FilmExportTest, TheDialogAsksForFilmsInItsOwnWay) {
    run("run file.export_film\nexpect /dialog \"export_picture\"");
    EXPECT_EQ(session.dialogs.input.text, folder.file("a picture's.mp4").string())
        << "the name that was said, as a film";
    run("click export.film.turn\nexpect /export/film \"turn\"\nclick export.rate.reset\nexpect /export/rate \"auto\"");
    run("click export.turntable\nkey Ctrl+A\ntype 2\nkey Enter\nexpect /export/turntable \"2\"");
    run("click export.path\nkey Ctrl+A\ntype mine\nkey Enter\nexpect /dialog \"none\"");
    EXPECT_EQ(slurp(folder.file("mine.mp4")), "film") << all_messages(session);
    run("run file.export_film\nclick export.rate\nkey Ctrl+A\ntype 119.88\nkey Enter\nexpect /export/rate \"119.88\"");
    run("key Escape");
    run("run file.export_picture");
    EXPECT_EQ(export_file(session.workspace, session.settings, session.dialogs), folder.file("mine.png"));
}

/// Before it is made, in the words of what was made.
TEST_F(FilmExportTest, TheDialogSaysWhatTheFilmWillBe) {
    run("run picture.file " + film.string() + "\nrun picture.size 321x240\nrun file.export_film");
    EXPECT_TRUE(window->shell().marks().all().contains("export.length"));
    const auto says = [&] { return state_json(session).at("export").at("length").get<std::string>(); };
    EXPECT_EQ(says(), "2.5 s: 5 pictures of 322x240 at 2 a second");
    for (const char* change :
         {"rate 3.5", "film turn\nrun picture.turntable 3", "rate auto", "film play\nrun query.select 0"}) {
        run(std::string("run picture.") + change);
        const std::string said = says();
        run("run picture.write");
        EXPECT_NE(all_messages(session).find("Wrote " + film.string() + ": 4 B, " + said), std::string::npos)
            << said << '\n'
            << all_messages(session);
    }
    session.files.open({folder.write("slow.json", R"({"clips": {"c": {"dt": 1e4, "samples": [[0,0,1], [1,0,1]]}}})")});
    window->settle();
    run("run file.export_film");
    EXPECT_EQ(says(), "The film would have 600000 pictures; at most 100000 are made at once. Lower the rate.");
    run("key Enter");
    EXPECT_EQ(session.dialogs.now, Dialog::export_picture);
    run("run picture.rate 2");
    EXPECT_EQ(says(), "20000 s: 40000 pictures of 322x240 at 2 a second");
}

TEST_F(FilmExportTest, WhatCannotBeIsSaidInOneLine) {
    write_program(programs, "ffmpeg",
                  "case \"$*\" in *-encoders*) echo ' V... libx264 x'; exit 0;; esac\necho 'no room' >&2\nexit 1\n");
    run("run file.export_film " + film.string());
    EXPECT_NE(all_messages(session).find("cannot be written: " + (programs.path() / "ffmpeg").string() +
                                         " ended with status 1 (no room)"),
              std::string::npos)
        << all_messages(session);
    EXPECT_NE(refusal(session, "file.export_film", folder.file("a.png").string()).find(".mp4 or .webm"),
              std::string::npos);
    EXPECT_NE(refusal(session, "picture.turntable", "0").find("1"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.turntable", "2.5").find("give 1 to"), std::string::npos);
    EXPECT_NE(refusal(session, "picture.rate", "0"), "");
    EXPECT_NE(refusal(session, "picture.film", "back").find("give play or turn"), std::string::npos);
    const Environment nothing("PATH", folder.scene.parent_path().string());
    EXPECT_NE(refusal(session, "file.export_film", film.string()).find("films need ffmpeg, which is not in PATH"),
              std::string::npos);
    run("run file.export_film\nkey Enter");
    EXPECT_EQ(session.dialogs.now, Dialog::export_picture) << "Export is disabled, and says why";
    session.options.may_write = false;
    EXPECT_NE(refusal(session, "file.export_film", film.string()), "");
    EXPECT_FALSE(std::filesystem::exists(film));
}

}  // namespace
}  // namespace mobbscope::app
