#include <app/input/input_queue.h>

#include <gtest/gtest.h>

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
                              return takes_chords;
                          },
                          [this](const Drop& drop) { dropped += drop.paths.size(); }, [this] { closed = true; }});
    }

    InputQueue queue;
    std::vector<Chord> chords;
    int repeats = 0;
    std::size_t dropped = 0;
    bool closed = false;
    bool takes_chords = false;

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

TEST_F(InputQueueTest, AHeldKeyRepeats) {
    queue.push(KeyPress{Key::right, true});
    feed();
    EXPECT_EQ(repeats, 0);
    queue.push(KeyPress{Key::right, true});
    feed();
    EXPECT_EQ(repeats, 1);
}

TEST_F(InputQueueTest, AKeyThatDidSomethingTypesNothing) {
    takes_chords = true;
    queue.push(KeyPress{Key::f, true});
    queue.push(TypedText{U'f'});
    feed();
    EXPECT_TRUE(io().InputQueueCharacters.empty());
    takes_chords = false;
    queue.push(KeyPress{Key::g, true});
    queue.push(TypedText{U'g'});
    feed();
    ASSERT_EQ(io().InputQueueCharacters.Size, 1);
    EXPECT_EQ(io().InputQueueCharacters[0], 'g');
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
