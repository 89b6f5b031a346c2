#include <app/input/input_queue.h>

#include <gtest/gtest.h>

#include <cfloat>
#include <vector>

namespace mobbscope::app {
namespace {

class InputQueueTest : public ::testing::Test {
  protected:
    InputQueueTest() : context_(ImGui::CreateContext()) { ImGui::SetCurrentContext(context_); }
    ~InputQueueTest() override { ImGui::DestroyContext(context_); }

    ImGuiIO& io() { return ImGui::GetIO(); }
    void feed() {
        queue.feed(io(), {[this](const Chord& chord, bool repeated) {
                              chords.push_back(chord);
                              repeats += repeated;
                              return taken;
                          },
                          [this](const Drop& drop) { dropped += drop.paths.size(); }, [this] { closed = true; }});
    }

    InputQueue queue;
    std::vector<Chord> chords;
    int repeats = 0;
    std::size_t dropped = 0;
    bool closed = false;
    InputQueue::Taken taken = InputQueue::Taken::nobodys;

  private:
    ImGuiContext* context_;
};

TEST_F(InputQueueTest, AClickInOneBatchTakesTwoFrames) {
    queue.push(MouseButton{0, true});
    queue.push(MouseButton{0, false});
    feed();
    EXPECT_TRUE(io().MouseDown[0]);
    EXPECT_TRUE(queue.any_button_down());
    EXPECT_FALSE(queue.empty());
    feed();
    EXPECT_FALSE(io().MouseDown[0]);
    EXPECT_FALSE(queue.any_button_down());
    EXPECT_TRUE(queue.empty());
}

TEST_F(InputQueueTest, TheMouseArrivesBeforeItPresses) {
    queue.push(MouseMove{{10, 20}});
    queue.push(MouseMove{{30, 40}});
    queue.push(MouseButton{1, true});
    queue.push(MouseMove{{50, 60}});
    feed();
    EXPECT_EQ(io().MousePos.x, 30);
    EXPECT_FALSE(io().MouseDown[1]);
    feed();
    EXPECT_TRUE(io().MouseDown[1]);
    EXPECT_EQ(io().MousePos.x, 30) << "it moved on before the press was seen";
    feed();
    EXPECT_EQ(io().MousePos.y, 60);
}

TEST_F(InputQueueTest, AButtonIsSeenWhereverTheMouseIs) {
    queue.push(MouseMove{{10, 20}});
    feed();
    queue.push(MouseMove{{-FLT_MAX, -FLT_MAX}});
    queue.push(MouseButton{0, true});
    queue.push(MouseButton{0, false});
    for (int i = 0; i < 3; ++i) feed();
    EXPECT_TRUE(queue.empty()) << "it left the window, and nothing has told where it is";
}

TEST_F(InputQueueTest, ChordsCarryTheModifiersThatAreHeld) {
    for (const bool down : {true, false}) {
        queue.push(KeyPress{Key::ctrl, down});
        queue.push(KeyPress{Key::shift, down});
        queue.push(KeyPress{Key::s, down});
    }
    feed();
    ASSERT_EQ(chords.size(), 3u);
    EXPECT_EQ(chords[2], (Chord{Key::s, true, true, false}));
    EXPECT_TRUE(io().KeyCtrl);
    feed();
    EXPECT_FALSE(io().KeyCtrl);
    EXPECT_EQ(chords.size(), 3u) << "a key that goes up calls nothing";
}

TEST_F(InputQueueTest, AKeyIsSeenWithItsModifiersWhicheverIsLetGoFirst) {
    queue.push(KeyPress{Key::ctrl, true});
    feed();
    queue.push(KeyPress{Key::down, true});
    queue.push(KeyPress{Key::ctrl, false});
    queue.push(KeyPress{Key::down, false});
    feed();
    EXPECT_TRUE(io().KeysDown[static_cast<std::size_t>(Key::down)]);
    EXPECT_TRUE(io().KeyCtrl) << "else Dear ImGui sees the arrow alone";
    feed();
    EXPECT_FALSE(io().KeyCtrl);
    queue.push(KeyPress{Key::down, true});
    queue.push(KeyPress{Key::shift, true});
    feed();
    EXPECT_FALSE(io().KeyShift) << "it was not held yet";
}

TEST_F(InputQueueTest, AHeldKeyRepeats) {
    queue.push(KeyPress{Key::right, true});
    feed();
    EXPECT_EQ(repeats, 0);
    queue.push(KeyPress{Key::right, true});
    feed();
    EXPECT_EQ(repeats, 1);
}

TEST_F(InputQueueTest, AKeyThatDidSomethingTypesNothing) {
    taken = InputQueue::Taken::command;
    queue.push(KeyPress{Key::f, true});
    queue.push(TypedText{U'f'});
    feed();
    EXPECT_TRUE(io().InputQueueCharacters.empty());
    taken = InputQueue::Taken::nobodys;
    queue.push(KeyPress{Key::g, true});
    queue.push(TypedText{U'g'});
    feed();
    ASSERT_EQ(io().InputQueueCharacters.Size, 1);
    EXPECT_EQ(io().InputQueueCharacters[0], 'g');
}

TEST_F(InputQueueTest, PressesOfACommandsKeyAllComeInOneFrame) {
    taken = InputQueue::Taken::command;
    for (int i = 0; i < 10; ++i) {
        queue.push(KeyPress{Key::left_bracket, true});
        queue.push(TypedText{U'['});
        queue.push(KeyPress{Key::left_bracket, false});
    }
    feed();
    EXPECT_EQ(chords.size(), 10u);
    EXPECT_EQ(repeats, 0);
    EXPECT_TRUE(queue.empty());
    EXPECT_TRUE(io().InputQueueCharacters.empty());
    EXPECT_FALSE(io().KeysDown[static_cast<std::size_t>(Key::left_bracket)]) << "it is not Dear ImGui's";
    queue.push(KeyPress{Key::right, true});
    for (int i = 0; i < 30; ++i) queue.push(KeyPress{Key::right, true});
    feed();
    EXPECT_EQ(chords.size(), 41u);
    EXPECT_EQ(repeats, 30);
    EXPECT_TRUE(queue.empty()) << "a held key does not pile up";
}

TEST_F(InputQueueTest, APressOfTheMouseMeetsWhatTheKeysHaveDone) {
    taken = InputQueue::Taken::command;
    queue.push(KeyPress{Key::right, true});
    queue.push(MouseButton{0, true});
    queue.push(KeyPress{Key::right, false});
    feed();
    EXPECT_FALSE(io().MouseDown[0]);
    feed();
    EXPECT_TRUE(io().MouseDown[0]);
}

TEST_F(InputQueueTest, WhatACommandOpensTakesTheKeysFromTheNextFrameOn) {
    taken = InputQueue::Taken::opened;
    queue.push(KeyPress{Key::slash, true});
    queue.push(TypedText{U'?'});
    queue.push(KeyPress{Key::slash, false});
    queue.push(KeyPress{Key::a, true});
    queue.push(TypedText{U'a'});
    feed();
    EXPECT_TRUE(io().InputQueueCharacters.empty());
    EXPECT_EQ(chords.size(), 1u);
    taken = InputQueue::Taken::nobodys;
    feed();
    EXPECT_EQ(chords.size(), 2u);
    ASSERT_EQ(io().InputQueueCharacters.Size, 1);
    EXPECT_EQ(io().InputQueueCharacters[0], 'a');
}

TEST_F(InputQueueTest, AHeldKeyOfACommandThatDoesNotRepeatTypesNothing) {
    taken = InputQueue::Taken::command;
    queue.push(KeyPress{Key::b, true});
    feed();
    taken = InputQueue::Taken::nobodys;
    queue.push(KeyPress{Key::b, true});
    queue.push(TypedText{U'b'});
    feed();
    EXPECT_TRUE(io().InputQueueCharacters.empty());
    EXPECT_FALSE(io().KeysDown[static_cast<std::size_t>(Key::b)]);
    queue.push(KeyPress{Key::b, false});
    queue.push(KeyPress{Key::b, true});
    queue.push(TypedText{U'b'});
    feed();
    EXPECT_EQ(io().InputQueueCharacters.Size, 1) << "pressed anew it is nobody's";
}

TEST_F(InputQueueTest, EnterAfterTextComesAFrameLater) {
    queue.push(TypedText{U'a'});
    queue.push(TypedText{U'b'});
    queue.push(KeyPress{Key::enter, true});
    feed();
    EXPECT_EQ(io().InputQueueCharacters.Size, 2);
    EXPECT_TRUE(chords.empty());
    feed();
    EXPECT_EQ(chords.size(), 1u);
}

TEST_F(InputQueueTest, DropsAndTheCloseButtonAreHandedOn) {
    queue.push(Drop{{"a.bvh", "b.bvh"}});
    queue.push(CloseRequest{});
    feed();
    EXPECT_EQ(dropped, 2u);
    EXPECT_TRUE(closed);
}

}  // namespace
}  // namespace mobbscope::app
