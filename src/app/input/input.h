/// What a person does to the window, whether with a real mouse or from a script.
#pragma once

#include <app/input/key.h>

#include <glm/vec2.hpp>

#include <filesystem>
#include <variant>
#include <vector>

namespace mobbscope::app {

/// Pixels of the window's framebuffer from its upper left corner.
struct MouseMove {
    glm::vec2 at{0};
};
struct MouseButton {
    int button = 0;  ///< 0 left, 1 right, 2 middle
    bool down = true;
};
/// Notches; y > 0 is away from the person.
struct Wheel {
    glm::vec2 by{0};
};
struct KeyPress {
    Key key = Key::none;
    bool down = true;
};
struct TypedText {
    char32_t code = 0;
};
struct Drop {
    std::vector<std::filesystem::path> paths;
};
/// The window manager's close button.
struct CloseRequest {};
/// Another window has the keys now. The keys that were held go up by KeyPress events of their own.
struct KeysLost {};

using InputEvent = std::variant<MouseMove, MouseButton, Wheel, KeyPress, TypedText, Drop, CloseRequest, KeysLost>;

}  // namespace mobbscope::app
