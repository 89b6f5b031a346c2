// All kinds of scenes, and what can go wrong.
#include <gtest/gtest.h>
#include <mobb/capture.h>
#include <mobbscope/picture_tests.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

mobb::Capture meeting(double aside) {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 60; ++i) path.push_back({i * 0.1, 0.0, 0.5});
    const mobb::Tree tree(std::make_shared<const mobb::Clip>(0.1, path), {.leaf = 10});
    const mobb::PlacedTree east(tree, {.translate = {0, 0}});
    const mobb::PlacedTree west(tree, {.translate = {6, aside}, .rotate_deg = 180});
    return mobb::capture(east, west, mobb::query(east, west));
}

TEST(Crowd, PeopleMeet) { EXPECT_PICTURE(meeting(2), "meeting", R"({"view": {"query": 0}})"); }

TEST(Crowd, AnswersStay) { EXPECT_ANSWERS(meeting(0.5), "contact"); }

TEST(Crowd, GoldensAreThoseOfTheFile) { EXPECT_EQ(mobbscope::picture_options().goldens, MOBBSCOPE_GOLDENS); }

/// Where B begins may be told by the environment, so that a test can make this one fail.
std::string people(const char* otherwise = std::getenv("B_BEGINS_AT")) {
    return R"({
 "clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [0.6, 0.1, 0.4], [1.2, 0, 0.4], [1.8, -0.1, 0.4]]}},
 "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [)" +
           std::string(otherwise ? otherwise : "1") + R"(, -1], "rotate_deg": 90}]
})";
}

TEST(Crowd, PeopleStand) { EXPECT_PICTURE(people(), "sub folder/people", R"({"size": "320x240"})") << "more of it"; }

TEST(Crowd, WordsOfWhatIsWrong) {
    const char* const size = R"({"size": "320x240"})";
    const auto fails = [&](const std::string& scene, const std::string& name, const std::string& keys,
                           const std::string& words) {
        mobbscope::PictureOptions elsewhere = mobbscope::picture_options();
        elsewhere.output += "/wrong";
        const mobbscope::PictureResult result = mobbscope::check_picture(scene, name, keys, elsewhere);
        if (result.outcome == mobbscope::PictureResult::Outcome::skipped) return;
        EXPECT_FALSE(result.passed()) << name;
        EXPECT_NE(result.message.find(words), std::string::npos) << result.message;
    };
    fails("{\n\"clips\": 3}", "number", size, "line 2, /scene/clips");
    fails("{\n\"clips\": }", "broken", size, "the scene that the test gives for broken: line 2");
    fails(people(), "typing error", "{\"veiw\": {}}", "'veiw'");
    fails(people(), "list", "[]", "the keys that the test gives for list: line 1");
    fails(people(), "twice", R"({"scene": {}})", "/scene: is given by the test itself");
    fails("none.json", "no file", size, "none.json: there is no such file");
    fails("", "no name", size, "the name of a file is empty");
    fails(people(), "../out", size, "cannot be the name of a case");
    fails(people(), "", size, "cannot be the name of a case");
    fails(people(), "two\nlines", size, "cannot be the name of a case");
}

/// A process that was forked while another thread asks can ask, too.
TEST(Crowd, ForksWhileAThreadAsks) {
    mobbscope::PictureOptions elsewhere = mobbscope::picture_options();
    elsewhere.output += "/forked";
    const auto ask = [&] { mobbscope::check_picture(people(), "forked", R"({"hold": ["fit"]})", elsewhere); };
    std::atomic<bool> done = false;
    std::thread other([&] {
        while (!done) ask();
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const pid_t forked = ::fork();
    if (forked == 0) {
        ::alarm(60);
        ask();
        ::_exit(0);
    }
    int status = 1;
    ::waitpid(forked, &status, 0);
    done = true;
    other.join();
    EXPECT_EQ(status, 0);
}

#if GTEST_HAS_DEATH_TEST
/// A process that was forked has a child of its own, and leaves this one's alone.
TEST(CrowdDeathTest, PeopleStand) {
    const auto passes = [] {
        return mobbscope::check_picture(people(), "sub folder/people", R"({"size": "320x240"})");
    };
    const bool before = passes().passed();
    EXPECT_EXIT(std::exit(passes().passed() == before ? 7 : 8), ::testing::ExitedWithCode(7), "");
    EXPECT_EQ(passes().passed(), before);
}
#endif
