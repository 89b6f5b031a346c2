/// Keys and chords of keys, by the names that menus, the help sheet and scripts show.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mobbscope::app {

// The order is that of the names in key.cpp, and within rows of the keyboard GLFW's; a line for each would say nothing.
// clang-format off
enum class Key : std::uint16_t {
    none, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, n0, n1, n2, n3, n4, n5, n6,
    n7, n8, n9, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, space, escape, enter, tab, backspace, insert, del,
    right, left, down, up, page_up, page_down, home, end, comma, minus, period, slash, equal, left_bracket,
    right_bracket, shift, ctrl, alt, super, menu, count
};
// clang-format on

/// A key with the modifiers held when it goes down.
struct Chord {
    Key key = Key::none;
    bool ctrl = false, shift = false, alt = false;
    friend bool operator==(const Chord&, const Chord&) = default;
};

/// "A", "F1", "Left", "[" ...; the name is what key_from_name reads, whatever its case.
std::string_view name(Key key);
std::optional<Key> key_from_name(std::string_view name);

/// "Ctrl+Shift+S". The key stands last; modifiers in any order, each at most once.
std::optional<Chord> chord_from_name(std::string_view name);
std::string to_string(const Chord& chord);

}  // namespace mobbscope::app
