/// Input on its way to commands, of which a frame runs any number, and to Dear ImGui, which sees one state of mouse and
/// keys a frame: what comes too fast for that waits.
#pragma once

#include <app/input/input.h>

#include <imgui.h>

#include <array>
#include <deque>
#include <functional>
#include <optional>

namespace mobbscope::app {

class InputQueue {
  public:
    /// Whose a key was. `command`: it ran one, and so it types nothing and Dear ImGui does not see it; `opened`: one
    /// after which something else takes the keys, from the next frame on.
    enum class Taken { nobodys, command, opened };
    /// What is not for Dear ImGui. Called in the order of the events.
    struct Others {
        /// A key went down, or repeats. Alt is told once it is up again, if nothing else happened meanwhile.
        std::function<Taken(const Chord& chord, bool repeated)> chord;
        std::function<void(const Drop&)> drop;
        std::function<void()> close;
    };

    void push(const InputEvent& event) { waiting_.push_back(event); }
    bool empty() const { return waiting_.empty(); }
    bool any_button_down() const;

    /// Hands over as much as one frame can see: each button and each key that is no command's changes at most once, and
    /// nothing overtakes anything.
    void feed(ImGuiIO& io, const Others& others);

    /// Where Dear ImGui finds the keys that it knows (ImGuiIO::KeyMap).
    static void map_keys(ImGuiIO& io);

  private:
    struct Frame;
    /// A key that types a letter into the field that has the keys: of those a frame takes any number.
    bool is_letter(const KeyPress& key, const Frame& frame) const;
    bool must_wait(const InputEvent& event, const Frame& frame) const;
    void apply(const InputEvent& event, Frame& frame, ImGuiIO& io, const Others& others);

    std::deque<InputEvent> waiting_;
    std::array<bool, 3> buttons_{};
    std::array<bool, static_cast<std::size_t>(Key::count)> keys_{};
    std::array<bool, static_cast<std::size_t>(Key::count)> commands_{};  ///< keys that are down and were a command's
    std::optional<ImVec2> mouse_;    ///< where it was moved to last; none: it was not yet
    bool alt_alone_ = false;         ///< nothing else was pressed since Alt went down
    bool typed_by_command_ = false;  ///< the last key was one, so the letter that follows means nothing
};

}  // namespace mobbscope::app
