// How the window answers: coarse pictures while keys come, the fine one once the hand rests. By a clock that the tests
// turn: nothing here is timed.
#include <app/commands/command.h>
#include <app/window/adaptive_quality.h>
#include <app/window/shell.h>
#include <render/drawlist/picture_options.h>
#include <render/gl/gl_context.h>

#include "render/counting_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace mobbscope::app {
namespace {

constexpr PictureSize kWindow{800, 500};

/// Somebody in front of the demo's first query at its last step. `part`: seconds that each part of a picture takes.
struct AnswersTest : ::testing::Test {
    double measured = 0, part = 0.05;
    double now = 0;
    Session session{true};
    Shell shell{GlContext::open(Backend::automatic), session, 1, [this] { return measured += part; }};
    double wanted = 0;

    void SetUp() override {
        session.files.open_demo();
        do {
            frame();
        } while (session.jobs.job());
        run_command(session, "query.select", "0");
        run_command(session, "step.last");
        rest();
        ASSERT_GT(session.workspace.step(), 12);
    }

    Image frame() {
        wanted = shell.frame(kWindow, now);
        now += 0.01;
        return shell.read_back();
    }
    void rest() {
        int frames = 0;
        do {
            frame();
            if (!std::isinf(wanted)) now += wanted;
            ASSERT_LT(++frames, 2000);
        } while (!std::isinf(wanted));
    }
    void key(Key key) {
        for (const bool down : {true, false}) shell.feed(KeyPress{key, down});
    }
    bool works() const { return shell.marks().all().contains("viewport.working"); }
    /// Of the window the picture alone.
    Image picture() {
        const Image all = shell.read_back();
        const Rect& rect = shell.marks().all().at("viewport");
        Image out(static_cast<int>(rect.size().x), static_cast<int>(rect.size().y));
        for (int y = 0; y < out.height; ++y) {
            std::copy_n(all.at(static_cast<int>(rect.min.x), static_cast<int>(rect.min.y) + y), 4 * out.width,
                        out.at(0, y));
        }
        return out;
    }
};

TEST_F(AnswersTest, TenPressesThatCameTogetherAreOneCoarsePictureAndThenTheFineOne) {
    const int step = session.workspace.step();
    const Shell::Painted before = shell.painted();
    for (int i = 0; i < 10; ++i) key(Key::left);
    frame();
    EXPECT_EQ(session.workspace.step(), step - 10) << "a step for each";
    EXPECT_EQ(shell.painted().coarse, before.coarse + 1);
    EXPECT_EQ(shell.painted().fine, before.fine);
    EXPECT_NE(picture().rgba, shell.viewport_picture().rgba);
    rest();
    EXPECT_EQ(session.workspace.step(), step - 10);
    EXPECT_EQ(shell.painted().coarse, before.coarse + 1);
    EXPECT_EQ(shell.painted().fine, before.fine + 1);
    EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
}

TEST_F(AnswersTest, PressesWithinASecondAreCoarseEachAndFineAtTheEndAlone) {
    const int step = session.workspace.step();
    const Shell::Painted before = shell.painted();
    for (int i = 0; i < 10; ++i) {
        key(Key::left);
        for (int k = 0; k < 10; ++k) frame();
    }
    EXPECT_EQ(session.workspace.step(), step - 10);
    EXPECT_EQ(shell.painted().coarse, before.coarse + 10);
    EXPECT_EQ(shell.painted().fine, before.fine);
    rest();
    EXPECT_EQ(shell.painted().fine, before.fine + 1);
    EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
}

TEST_F(AnswersTest, EachPressIsALookOfItsOwnAlsoOfThoseThatCameTogether) {
    run_command(session, "view.disks");
    rest();
    key(Key::n2);
    key(Key::b);
    frame();
    ASSERT_FALSE(session.workspace.view().boxes);
    session.edits.previous_view();
    EXPECT_TRUE(session.workspace.view().boxes);
    EXPECT_EQ(session.workspace.view().camera.preset, CameraPreset::top);
}

TEST_F(AnswersTest, AKeyIsAnsweredInTheMidstOfTheFinePicture) {
    key(Key::left);
    frame();
    now += AdaptiveQuality::kRest;
    const Shell::Painted before = shell.painted();
    for (int i = 0; i < 3; ++i) frame();
    ASSERT_EQ(shell.painted().fine, before.fine) << "it takes more than three parts";
    EXPECT_EQ(wanted, 0) << "there is more to do";
    const int step = session.workspace.step();
    key(Key::left);
    frame();
    EXPECT_EQ(session.workspace.step(), step - 1);
    EXPECT_EQ(shell.painted().coarse, before.coarse + 1);
    EXPECT_EQ(shell.painted().fine, before.fine);
    rest();
    EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
}

TEST_F(AnswersTest, WhereTheFinePictureIsQuickNoCoarseOneIsShown) {
    part = 0;
    key(Key::left);
    rest();
    const Shell::Painted before = shell.painted();
    for (int i = 0; i < 5; ++i) {
        key(Key::left);
        frame();
        EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
    }
    EXPECT_EQ(shell.painted().coarse, before.coarse);
    EXPECT_EQ(shell.painted().fine, before.fine + 5);
    EXPECT_FALSE(works());
    part = 0.05;
    key(Key::left);
    frame();
    EXPECT_EQ(shell.painted().coarse, before.coarse + 1) << "one that takes long after all is given up";
    rest();
    EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
}

TEST_F(AnswersTest, ADragIsCoarseUntilTheButtonIsUp) {
    const glm::vec2 middle = shell.marks().all().at("viewport").center();
    shell.feed(MouseMove{middle});
    frame();
    shell.feed(MouseButton{0, true});
    frame();
    rest();
    const Shell::Painted before = shell.painted();
    for (int i = 1; i <= 5; ++i) {
        shell.feed(MouseMove{middle + glm::vec2(20 * i, 0)});
        frame();
        frame();
        now += 1;  // a hand that thinks
        for (int k = 0; k < 3; ++k) frame();
    }
    EXPECT_EQ(shell.painted().coarse, before.coarse + 5);
    EXPECT_EQ(shell.painted().fine, before.fine);
    EXPECT_FALSE(works()) << "nothing is under way";
    shell.feed(MouseButton{0, false});
    rest();
    EXPECT_EQ(shell.painted().fine, before.fine + 1);
}

/// A key moves the camera, which flies: nothing happens after its last picture but that the hand rests.
TEST_F(AnswersTest, AFlightEndsInTheFinePicture) {
    key(Key::n2);
    rest();
    EXPECT_EQ(session.workspace.view().camera.preset, CameraPreset::top);
    EXPECT_EQ(picture().rgba, shell.viewport_picture().rgba);
}

TEST_F(AnswersTest, ASignOfWorkComesAfterAWhileAndGoesWithTheFinePicture) {
    key(Key::left);
    frame();
    EXPECT_FALSE(works());
    now += 0.14;
    frame();
    EXPECT_FALSE(works());
    now += 0.1;
    frame();
    EXPECT_TRUE(works());
    rest();
    EXPECT_FALSE(works());
}

TEST_F(AnswersTest, WhereNobodyLooksEveryPictureIsFine) {
    Session alone(false);
    Shell window(GlContext::open(Backend::automatic), alone, 1, [this] { return measured += part; });
    alone.files.open_demo();
    for (int i = 0; i < 5; ++i) {
        window.frame(kWindow, 0.01 * i);
        window.read_back();
    }
    EXPECT_EQ(window.painted().coarse, 0);
    EXPECT_GT(window.painted().fine, 0);
}

/// A graphics card is quick, and nobody knows how quick without waiting for it: nobody does.
TEST(Answers, OnAGraphicsCardEveryPictureIsFineAtOnce) {
    double measured = 0, now = 0;
    Session session(true);
    Shell shell(std::make_unique<CountingContext>(GlContext::open(Backend::automatic), kGraphicsCard), session, 1,
                [&] { return measured += 0.05; });
    const auto frame = [&] {
        const double wanted = shell.frame(kWindow, now += 0.01);
        shell.read_back();
        return wanted;
    };
    session.files.open_demo();
    while (session.jobs.job() || frame() == 0) frame();
    run_command(session, "query.select", "0");
    run_command(session, "step.last");
    while (frame() == 0) {
    }
    const Shell::Painted before = shell.painted();
    CountingContext::counts = {};
    for (int i = 0; i < 5; ++i) {
        for (const bool down : {true, false}) shell.feed(KeyPress{Key::left, down});
        frame();
        EXPECT_EQ(shell.painted().fine, before.fine + i + 1);
    }
    // A drag, whose pictures are all other disks.
    shell.feed(MouseMove{shell.marks().all().at("viewport").center()});
    shell.feed(MouseButton{0, true});
    frame();
    shell.feed(MouseMove{shell.marks().all().at("viewport").center() + glm::vec2(40, 0)});
    frame();
    shell.feed(MouseButton{0, false});
    while (frame() == 0) {
    }
    EXPECT_GE(shell.painted().fine, before.fine + 6);
    EXPECT_EQ(shell.painted().coarse, 0);
    EXPECT_FALSE(shell.marks().all().contains("viewport.working"));
    EXPECT_EQ(CountingContext::counts.finishes, 0u);
}

TEST(AdaptiveQuality, ADragBecomesCoarserIfItMustButNotFinerAgain) {
    constexpr AdaptiveQuality::Needs kAll = AdaptiveQuality::Needs::all;
    AdaptiveQuality quality;
    EXPECT_TRUE(quality.coarse_first(kAll)) << "until it is known that this is not needed";
    quality.painted_coarse(0.010);
    EXPECT_EQ(quality.divisor(), 1);
    quality.painted_coarse(0.180);
    EXPECT_EQ(quality.divisor(), 2);
    quality.painted_coarse(0.010);
    EXPECT_EQ(quality.divisor(), 2);
    quality.painted_coarse(3);
    EXPECT_EQ(quality.divisor(), AdaptiveQuality::kCoarsest);
    quality.painted_fine(kAll, 0.5);
    EXPECT_TRUE(quality.coarse_first(kAll));
    quality.painted_coarse(0.010);
    EXPECT_EQ(quality.divisor(), 2) << "a new drag may be finer";
    quality.painted_fine(kAll, 0.01);
    EXPECT_FALSE(quality.coarse_first(kAll));
    quality.gave_up_fine(kAll, 0.06);
    EXPECT_TRUE(quality.coarse_first(kAll));
}

TEST(AdaptiveQuality, WhatNeedsTheRestAloneIsExpectedToBeQuick) {
    AdaptiveQuality quality;
    EXPECT_TRUE(quality.coarse_first(AdaptiveQuality::Needs::all));
    EXPECT_FALSE(quality.coarse_first(AdaptiveQuality::Needs::rest));
    quality.gave_up_fine(AdaptiveQuality::Needs::rest, 0.06);
    EXPECT_TRUE(quality.coarse_first(AdaptiveQuality::Needs::rest));
    quality.painted_coarse(0.01);
    quality.painted_fine(AdaptiveQuality::Needs::rest, 0.02);
    EXPECT_FALSE(quality.coarse_first(AdaptiveQuality::Needs::rest));
    EXPECT_TRUE(quality.coarse_first(AdaptiveQuality::Needs::all)) << "that says nothing of whole ones";
}

}  // namespace
}  // namespace mobbscope::app
