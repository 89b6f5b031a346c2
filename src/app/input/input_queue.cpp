#include <app/input/input_queue.h>

#include <algorithm>
#include <cfloat>
#include <initializer_list>
#include <utility>

namespace mobbscope::app {

/// What has changed in the frame that is being fed.
struct InputQueue::Frame {
    bool moved = false;
    bool turned = false;  ///< the wheel
    bool typed = false;
    std::array<bool, 3> buttons{};
    std::array<bool, static_cast<std::size_t>(Key::count)> keys{};
    bool any_key = false;
    bool went_down = false;  ///< a key that Dear ImGui sees, and no modifier
    bool after_key = false;  ///< the last event was a key
    bool in_text = false;    ///< a text field has the keys
    bool opened = false;     ///< what a command opened takes the keys from the next frame on

    bool any_button() const { return buttons[0] || buttons[1] || buttons[2]; }
};

namespace {

std::size_t index_of(Key key) { return static_cast<std::size_t>(key); }

bool is_modifier(Key key) { return key == Key::shift || key == Key::ctrl || key == Key::alt || key == Key::super; }

/// Characters beyond Dear ImGui's range become U+FFFD.
ImWchar typed_letter(char32_t code) {
    return static_cast<ImWchar>(code <= IM_UNICODE_CODEPOINT_MAX ? code : char32_t{IM_UNICODE_CODEPOINT_INVALID});
}

}  // namespace

bool InputQueue::any_button_down() const {
    return std::any_of(buttons_.begin(), buttons_.end(), [](bool down) { return down; });
}

bool InputQueue::is_letter(const KeyPress& key, const Frame& frame) const {
    const bool types = (key.key >= Key::a && key.key <= Key::n9) || key.key == Key::space ||
                       (key.key >= Key::comma && key.key <= Key::right_bracket);
    return frame.in_text && types && !keys_[index_of(Key::ctrl)] && !keys_[index_of(Key::alt)];
}

bool InputQueue::must_wait(const InputEvent& event, const Frame& frame) const {
    // But for the letter of the key that opened it.
    if (frame.opened) return !typed_by_command_ || !std::holds_alternative<TypedText>(event);
    if (std::holds_alternative<MouseMove>(event)) return frame.any_button() || frame.turned;
    if (const auto* button = std::get_if<MouseButton>(&event)) {
        // What is under the mouse is known a frame after it got there.
        return frame.moved || frame.turned || frame.any_key || frame.buttons[static_cast<std::size_t>(button->button)];
    }
    if (std::holds_alternative<Wheel>(event)) return frame.any_button();
    if (const auto* key = std::get_if<KeyPress>(&event)) {
        if (is_letter(*key, frame)) return frame.any_button() || frame.any_key;
        // Dear ImGui is to see the modifiers that were held when the key went down, whichever is let go first.
        if (is_modifier(key->key) && frame.went_down) return true;
        return frame.keys[index_of(key->key)] || frame.any_button() || frame.typed;
    }
    // A letter belongs to the key right before it; any other key comes a frame earlier.
    if (std::holds_alternative<TypedText>(event)) return frame.any_button() || (frame.any_key && !frame.after_key);
    return false;
}

void InputQueue::apply(const InputEvent& event, Frame& frame, ImGuiIO& io, const Others& others) {
    const bool after_key = std::exchange(frame.after_key, false);
    const bool alone = std::holds_alternative<MouseMove>(event) ? alt_alone_ : std::exchange(alt_alone_, false);
    if (const auto* move = std::get_if<MouseMove>(&event)) {
        mouse_ = ImVec2{move->at.x, move->at.y};
        io.MousePos = *mouse_;
        frame.moved = true;
    } else if (const auto* button = std::get_if<MouseButton>(&event)) {
        const auto index = static_cast<std::size_t>(button->button);
        buttons_[index] = button->down;
        io.MouseDown[button->button] = button->down;
        frame.buttons[index] = true;
    } else if (const auto* wheel = std::get_if<Wheel>(&event)) {
        io.MouseWheelH += wheel->by.x;
        io.MouseWheel += wheel->by.y;
        frame.turned = true;
    } else if (const auto* key = std::get_if<KeyPress>(&event)) {
        const bool repeated = key->down && keys_[index_of(key->key)];
        keys_[index_of(key->key)] = key->down;
        io.KeyCtrl = keys_[index_of(Key::ctrl)];
        io.KeyShift = keys_[index_of(Key::shift)];
        io.KeyAlt = keys_[index_of(Key::alt)];
        io.KeySuper = keys_[index_of(Key::super)];
        frame.after_key = true;
        Taken taken = Taken::nobodys;
        if (key->key == Key::alt) {
            if (!key->down && alone) taken = others.chord({Key::alt}, false);
            alt_alone_ = key->down && (alone || !repeated);
        } else if (key->down) {
            taken = others.chord({key->key, io.KeyCtrl, io.KeyShift, io.KeyAlt}, repeated);
        }
        frame.opened = taken == Taken::opened;
        bool& commands = commands_[index_of(key->key)];
        // A command's key stays that until it goes up, even where the command does not repeat.
        const bool is_command = taken != Taken::nobodys || (commands && (repeated || !key->down));
        commands = typed_by_command_ = is_command && key->down;
        io.KeysDown[index_of(key->key)] = key->down && !is_command;
        frame.went_down = frame.went_down || (io.KeysDown[index_of(key->key)] && !is_modifier(key->key));
        if (is_letter(*key, frame)) return;
        frame.any_key = true;
        // A command has had all of its key.
        frame.keys[index_of(key->key)] = !is_command;
    } else if (const auto* text = std::get_if<TypedText>(&event)) {
        // Not through AddInputCharacter: from 1.87 on it has a queue of its own, a frame behind the keys of this one.
        frame.after_key = after_key;
        if (std::exchange(typed_by_command_, false)) return;
        io.InputQueueCharacters.push_back(typed_letter(text->code));
        frame.typed = true;
    } else if (const auto* drop = std::get_if<Drop>(&event)) {
        others.drop(*drop);
    } else if (std::holds_alternative<CloseRequest>(event)) {
        others.close();
    }
}

void InputQueue::feed(ImGuiIO& io, const Others& others) {
    Frame frame;
    frame.in_text = io.WantTextInput;
    while (!waiting_.empty()) {
        // Keys in menus put the mouse away; a button brings it back where it is, as moving it does.
        const bool is_away = io.MousePos.x == -FLT_MAX && mouse_ && mouse_->x != -FLT_MAX;
        if (is_away && std::holds_alternative<MouseButton>(waiting_.front())) {
            io.MousePos = *mouse_;
            frame.moved = true;
        }
        if (must_wait(waiting_.front(), frame)) return;
        const InputEvent event = std::move(waiting_.front());
        waiting_.pop_front();
        apply(event, frame, io, others);
    }
}

void InputQueue::map_keys(ImGuiIO& io) {
    for (const auto& [theirs, ours] :
         std::initializer_list<std::pair<ImGuiKey, Key>>{{ImGuiKey_Tab, Key::tab},
                                                         {ImGuiKey_LeftArrow, Key::left},
                                                         {ImGuiKey_RightArrow, Key::right},
                                                         {ImGuiKey_UpArrow, Key::up},
                                                         {ImGuiKey_DownArrow, Key::down},
                                                         {ImGuiKey_PageUp, Key::page_up},
                                                         {ImGuiKey_PageDown, Key::page_down},
                                                         {ImGuiKey_Home, Key::home},
                                                         {ImGuiKey_End, Key::end},
                                                         {ImGuiKey_Insert, Key::insert},
                                                         {ImGuiKey_Delete, Key::del},
                                                         {ImGuiKey_Backspace, Key::backspace},
                                                         {ImGuiKey_Space, Key::space},
                                                         {ImGuiKey_Enter, Key::enter},
                                                         {ImGuiKey_Escape, Key::escape},
                                                         {ImGuiKey_A, Key::a},
                                                         {ImGuiKey_C, Key::c},
                                                         {ImGuiKey_V, Key::v},
                                                         {ImGuiKey_X, Key::x},
                                                         {ImGuiKey_Y, Key::y},
                                                         {ImGuiKey_Z, Key::z}}) {
        io.KeyMap[theirs] = static_cast<int>(ours);
    }
}

}  // namespace mobbscope::app
