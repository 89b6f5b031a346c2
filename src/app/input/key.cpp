#include <app/input/key.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace mobbscope::app {

namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(Key::count)> kNames{
    "",       "A",     "B",    "C",    "D",   "E",      "F",        "G",     "H",     "I",         "J",
    "K",      "L",     "M",    "N",    "O",   "P",      "Q",        "R",     "S",     "T",         "U",
    "V",      "W",     "X",    "Y",    "Z",   "0",      "1",        "2",     "3",     "4",         "5",
    "6",      "7",     "8",    "9",    "F1",  "F2",     "F3",       "F4",    "F5",    "F6",        "F7",
    "F8",     "F9",    "F10",  "F11",  "F12", "Space",  "Escape",   "Enter", "Tab",   "Backspace", "Insert",
    "Delete", "Right", "Left", "Down", "Up",  "PageUp", "PageDown", "Home",  "End",   ",",         "-",
    ".",      "/",     "=",    "[",    "]",   "Shift",  "Ctrl",     "Alt",   "Super", "Menu"};

bool same(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::string_view name(Key key) { return kNames[static_cast<std::size_t>(key)]; }

std::optional<Key> key_from_name(std::string_view name) {
    for (std::size_t i = 1; i < kNames.size(); ++i) {
        if (same(kNames[i], name)) return static_cast<Key>(i);
    }
    return std::nullopt;
}

std::optional<Chord> chord_from_name(std::string_view name) {
    Chord chord;
    while (true) {
        // A "+" cannot be a key's name: that key is "=".
        const std::size_t plus = name.find('+');
        const std::optional<Key> key = key_from_name(name.substr(0, plus));
        if (!key) return std::nullopt;
        if (plus == std::string_view::npos) {
            chord.key = *key;
            return chord;
        }
        bool* modifier = *key == Key::ctrl    ? &chord.ctrl
                         : *key == Key::shift ? &chord.shift
                         : *key == Key::alt   ? &chord.alt
                                              : nullptr;
        if (!modifier || *modifier) return std::nullopt;
        *modifier = true;
        name.remove_prefix(plus + 1);
    }
}

std::string to_string(const Chord& chord) {
    std::string text;
    if (chord.ctrl) text += "Ctrl+";
    if (chord.alt) text += "Alt+";
    if (chord.shift) text += "Shift+";
    return text += name(chord.key);
}

}  // namespace mobbscope::app
