/// A session in a window without a display, over files of a folder.
#pragma once

#include "app/crossing_folder.h"

#include <app/input/key.h>
#include <app/session/session.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include <filesystem>
#include <string>

namespace mobbscope::app {
inline namespace testing {

/// `Folder`: CrossingFolder or TempFolder.
template <class Folder>
struct FolderWindow {
    Folder folder;
    TestDesktop desktop;
    Session session;
    HeadlessWindow window;

    explicit FolderWindow(PictureSize size, double scale = 1, bool attended = false)
        : session(attended), window(GlContext::open(Backend::automatic), session, size, scale) {
        session.desktop = &desktop;
    }
    void open(const std::filesystem::path& file) {
        session.files.open({file});
        window.settle();
    }
    /// Runs a command.
    void run(const std::string& command, const std::string& argument = "") {
        run_command(session, command, argument);
        window.settle();
    }
    /// Presses and releases a chord such as "Ctrl+Shift+Z".
    void key(const std::string& name) {
        const Chord chord = *chord_from_name(name);
        const auto send = [&](Key key, bool down) { window.shell().feed(KeyPress{key, down}); };
        if (chord.ctrl) send(Key::ctrl, true);
        if (chord.shift) send(Key::shift, true);
        send(chord.key, true);
        send(chord.key, false);
        if (chord.shift) send(Key::shift, false);
        if (chord.ctrl) send(Key::ctrl, false);
        window.settle();
    }
    void type(const std::string& text) {
        for (const char c : text) window.shell().feed(TypedText{static_cast<char32_t>(c)});
        window.settle();
    }
    /// What widgets and other places are marked as stands in the window, and where.
    bool has(const std::string& mark) { return window.shell().marks().all().contains(mark); }
    const Rect& rect(const std::string& mark) { return window.shell().marks().all().at(mark); }
};

}  // namespace testing
}  // namespace mobbscope::app
