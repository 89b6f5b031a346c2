// Films: what `render` hands to an ffmpeg, for which a script stands in, and what it says where that fails.
#include "render_runs.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

namespace mobbscope {
namespace {

constexpr std::size_t kPictureBytes = 320 * 240 * 4;

/// A stand-in that has these encoders, and else does that.
constexpr const char* kBothEncoders = "libx264 libvpx-vp9";
constexpr const char* kTakesAll = "cat >\"$HERE/pictures\"\nprintf film\n";

class FilmTest : public DrawingTest {
  protected:
    FilmTest() { stand_in(kTakesAll); }

    void stand_in(const std::string& does, const std::string& encoders = kBothEncoders) {
        std::string text = "#!/bin/sh\nHERE='" + programs.path().string() + "'\ncase \"$*\" in *-encoders*)\n";
        text += "for name in " + encoders + "; do echo \" V....D $name an encoder\"; done\nexit 0;;\nesac\n";
        text += "echo \"$@\" >\"$HERE/arguments\"\n" + does;
        write_stand_in(text);
    }
    void write_stand_in(const std::string& text) {
        const std::filesystem::path file = programs.write("ffmpeg", text);
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }

    /// With the stand-in as the first of its name; `path`: another PATH.
    Result render(std::vector<std::string> arguments, const std::string& path = "") {
        arguments.insert(arguments.begin(), "render");
        const auto in_child = [&] {
            const char* before = std::getenv("PATH");
            const std::string found = programs.path().string() + ':' + (before ? before : "");
            ::setenv("PATH", path.empty() ? found.c_str() : path.c_str(), 1);
        };
        return run_program(arguments, {}, "/dev/null", in_child);
    }
    /// Three pictures into that film, and what else is asked.
    Result render_film(const std::filesystem::path& name, const std::vector<std::string>& more = {}) {
        return render(with({scene, "--frames", "1:3", "--size", "320x240", "-o", name.string()}, more));
    }
    std::string arguments() const { return slurp(programs.path() / "arguments"); }
    void expect_argument(const std::string& one) const {
        EXPECT_NE((' ' + arguments() + ' ').find(' ' + one + ' '), std::string::npos) << one << " of " << arguments();
    }

    const TempFolder films, programs;
    const std::string scene = short_scene(folder);
    const std::filesystem::path film = films.path() / "a walk.mp4";
};

TEST_F(FilmTest, ItsPicturesAreThoseOfTheNumberedFiles) {
    const Result run = render_film(film, {"--rate", "2"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "mobbscope: " + film.string() + ": 4 B, 1.5 s: 3 pictures of 320x240 at 2 a second\n");
    EXPECT_EQ(files_in(films.path()), Names{"a walk.mp4"});
    EXPECT_EQ(slurp(film), "film");
    const std::string taken = slurp(programs.path() / "pictures");
    ASSERT_EQ(taken.size(), 3 * kPictureBytes);
    ASSERT_EQ(
        render({scene, "--frames", "1:3", "--rate", "2", "--size", "320x240", "-o", films.path() / "p.png"}).status, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        const Image picture = read_png(films.path() / ("p_000" + std::to_string(i + 1) + ".png"));
        const std::string bytes(picture.rgba.begin(), picture.rgba.end());
        EXPECT_TRUE(taken.substr(i * kPictureBytes, kPictureBytes) == bytes) << "picture " << i;
    }
}

TEST_F(FilmTest, TheNameSaysWhichKindItIs) {
    ASSERT_EQ(render_film(film, {"--rate", "2"}).status, 0);
    for (const char* part : {"-video_size 320x240", "-framerate 2", "-c:v libx264", "-f mp4"}) expect_argument(part);
    ASSERT_EQ(render_film(films.path() / "walk.WEBM").status, 0);
    for (const char* part : {"-framerate 30", "-c:v libvpx-vp9", "-f webm"}) expect_argument(part);
}

TEST_F(FilmTest, StepsAndTurntablesHaveARateToo) {
    const std::vector<std::string> steps{scene, "--query", "0", "--frames", "0:1", "--size", "320x240"};
    ASSERT_EQ(render(with(steps, {"-o", film})).status, 0);
    expect_argument("-framerate 2");
    ASSERT_EQ(render(with(steps, {"-o", film, "--rate", "2.5"})).status, 0);
    expect_argument("-framerate 2.5");
    expect_refused(render(with(steps, {"-o", films.path() / "p.png", "--rate", "2"})), 2, "only a film of them");
    ASSERT_EQ(render({scene, "--turntable", "2", "--size", "320x240", "-o", film, "--rate", "5"}).status, 0);
    expect_argument("-framerate 5");
}

TEST_F(FilmTest, SidesAreMadeEven) {
    const Result run = render({scene, "--frames", "0:0", "--size", "321x241", "-o", film});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("322x242"), std::string::npos) << run.err;
    expect_argument("-video_size 322x242");
    EXPECT_EQ(std::filesystem::file_size(programs.path() / "pictures"), 322u * 242 * 4);
    expect_refused(render({scene, "--frames", "0:0", "--size", "8193x64", "-o", film}), 2, "8193x64");
}

TEST_F(FilmTest, TheLargestPictureIsMadeEvenToo) {
    stand_in("head -c 100 >/dev/null\n");
    const Result run = render({scene, "--frames", "0:0", "--size", "5121x3239", "-o", film});
    EXPECT_EQ(run.status, 3) << run.err;
    expect_argument("-video_size 5120x3238");
}

/// The last step is the answer, which one reads.
TEST_F(FilmTest, TheLastStepStaysOn) {
    const Result run = render({scene, "--query", "0", "--frames", "0:1", "--size", "320x240", "-o", film});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("3 s: 6 pictures of 320x240 at 2 a second"), std::string::npos) << run.err;
    const std::string taken = slurp(programs.path() / "pictures");
    ASSERT_EQ(taken.size(), 6 * kPictureBytes);
    const auto picture = [&](std::size_t i) { return taken.substr(i * kPictureBytes, kPictureBytes); };
    EXPECT_TRUE(picture(0) != picture(1));
    for (std::size_t i = 2; i < 6; ++i) EXPECT_TRUE(picture(i) == picture(1)) << i;
}

TEST_F(FilmTest, WhatStandsBesideItIsNumbered) {
    ASSERT_EQ(render_film(film, {"--ids", films.path() / "i.png"}).status, 0);
    EXPECT_EQ(files_in(films.path()), (Names{"a walk.mp4", "i_0001.png", "i_0002.png", "i_0003.png"}));
}

TEST_F(FilmTest, ABatchMakesSeveral) {
    const std::string begin = scene + " --size 320x240 --frames ";
    const std::string name = films.path() / "a.mp4";
    const std::string list =
        folder.write("list", begin + "0:1 -o " + name + "\n" + begin + "0:0 -o " + std::string(films.path() / "p.png") +
                                 "\n" + begin + "2:3 -o " + std::string(films.path() / "b.webm") + "\n");
    const Result run = render({"--batch", list});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(files_in(films.path()), (Names{"a.mp4", "b.webm", "p_0000.png"}));
    const std::string twice = folder.write("twice", begin + "0:1 -o " + name + "\n" + begin + "2:3 -o " + name + "\n");
    expect_refused(render({"--batch", twice}), 2, "would be written twice");
}

TEST_F(FilmTest, WhatIsNoFilmIsRefused) {
    expect_refused(render({scene, "-o", film}), 2, "add --play, --frames A:B or --turntable N");
    expect_refused(render_film(film, {"--background", "transparent"}), 2, "leave out --background");
    expect_refused(render({scene, "--ui", "-o", film}), 2, "the whole window is written as .png");
    expect_refused(render_film(films.path() / "walk.avi"), 2, "films as .mp4 or .webm");
    expect_refused(render_film(scene), 2, "rename the output");
    expect_refused(run_program({"map", scene, "--over", "dx=-1:1,dy=-1:1", "-o", film}), 2, "rename the output");
    EXPECT_EQ(files_in(films.path()), Names{});
}

/// What was there stays, and nothing else comes.
TEST_F(FilmTest, WithoutFfmpegNothingIsDrawn) {
    films.write("a walk.mp4", "old");
    const Result run = render({scene, "--play", "--size", "320x240", "-o", film}, films.path());
    expect_refused(run, 3, "films need ffmpeg, which is not in PATH; install it (Debian: apt install ffmpeg)");
    EXPECT_NE(run.err.find("-o '" + (films.path() / "a walk.png").string() + "'"), std::string::npos) << run.err;
    EXPECT_EQ(slurp(film), "old");
}

TEST_F(FilmTest, AnEncoderThatLacksIsReplacedOrNamed) {
    stand_in(kTakesAll, "libopenh264 libvpx");
    ASSERT_EQ(render_film(film).status, 0);
    expect_argument("-c:v libopenh264");
    ASSERT_EQ(render_film(films.path() / "walk.webm").status, 0);
    expect_argument("-c:v libvpx");
    stand_in(kTakesAll, "libvpx");
    expect_refused(render_film(film), 3, "has no encoder for .mp4 films (libx264 or libopenh264)");
    write_stand_in("#!/bin/sh\nexit 5\n");
    expect_refused(render_film(film), 3, "does not say which encoders it has: it ended with status 5");
}

TEST_F(FilmTest, WhatGoesWrongIsSaidInOneLine) {
    films.write("a walk.mp4", "old");
    stand_in("cat >/dev/null\nprintf half\necho '[libx264 @ 0x1234] no room for it' >&2\necho more >&2\nexit 1\n");
    expect_refused(render_film(film), 3, "ffmpeg ended with status 1 (no room for it)");
    stand_in("head -c 100 >/dev/null\n");
    expect_refused(render_film(film), 3, "ffmpeg ended before it had all pictures");
    stand_in("cat >/dev/null\n");
    expect_refused(render_film(film), 3, "ffmpeg did not write all");
    stand_in("cat >/dev/null\nprintf half\necho 'Error writing trailer: No space left on device' >&2\n");
    expect_refused(render_film(film), 3, "did not write all (Error writing trailer: No space left on device)");
    stand_in(std::string(kTakesAll) + "echo '[libx264 @ 0x1] 3 errors of a mirror are mended' >&2\n");
    EXPECT_EQ(render_film(films.path() / "other.mp4").status, 0);
    std::filesystem::remove(films.path() / "other.mp4");
    stand_in("kill -9 $$\n");
    expect_refused(render_film(film), 3, "ffmpeg crashed: Killed");
    EXPECT_EQ(files_in(films.path()), Names{"a walk.mp4"});
    EXPECT_EQ(slurp(film), "old");
}

TEST_F(FilmTest, ADeviceHoldsNone) {
    const std::filesystem::path device = films.path() / "d.mp4";
    std::filesystem::create_symlink("/dev/null", device);
    expect_refused(render_film(device), 3, "is a pipe or a device; give a file");
}

/// Neither a file nor an ffmpeg is left of a film that is broken off.
TEST_F(FilmTest, ASignalEndsAll) {
    stand_in("echo $$ >\"$HERE/number\"\nln \"$HERE/number\" \"$HERE/started\"\nexec sleep 600\n");
    const std::string path = programs.path().string() + ':' + std::getenv("PATH");
    const pid_t child = start_program({"render", scene, "--play", "--rate", "200", "--size", "320x240", "-o", film}, {},
                                      [&] { ::setenv("PATH", path.c_str(), 1); });
    const auto wait_for = [](const std::function<bool()>& what) {
        for (int i = 0; i < 6000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return what();
    };
    ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(programs.path() / "started"); }));
    ::kill(child, SIGTERM);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    EXPECT_EQ(files_in(films.path()), Names{});
    const std::string ffmpeg = "/proc/" + std::to_string(std::stoi(slurp(programs.path() / "started"))) + "/exe";
    std::error_code ignored;
    EXPECT_TRUE(wait_for([&] { return std::filesystem::read_symlink(ffmpeg, ignored).filename() != "sleep"; }));
}

TEST_F(FilmTest, ProgressIsSaidOften) {
    // Few pictures wait, so drawing waits too, longer than it is silent.
    stand_in("head -c " + std::to_string(kPictureBytes) + " >/dev/null\nsleep 0.4\n" + kTakesAll);
    const Result run = render({scene, "--play", "--rate", "30", "--size", "320x240", "-o", film, "--progress"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("mobbscope: drew "), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(" of 76 pictures\n"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("mobbscope: finishing " + film.string() + '\n'), std::string::npos) << run.err;
}

}  // namespace
}  // namespace mobbscope
