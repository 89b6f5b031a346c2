/// A folder with a small scene and its clips, for tests that open, edit and save.
#pragma once

#include <app/commands/command.h>
#include <app/session/session.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>

namespace mobbscope::app {
inline namespace testing {

/// 60 samples, 30 a second, at 1 m/s along x.
inline std::string walk_csv() {
    std::string text = "t,x,y,r\n";
    for (int i = 0; i < 60; ++i) {
        text += std::to_string(i / 30.0) + ',' + std::to_string(i / 30.0) + ',' +
                std::to_string(0.05 * std::sin(0.2 * i)) + ",0.4\n";
    }
    return text;
}

/// scene.json: A and B cross and hit, C walks elsewhere and later; all play walk.csv. stand.csv belongs to nobody.
class CrossingFolder {
  public:
    CrossingFolder() {
        folder_.write("walk.csv", walk_csv());
        folder_.write("stand.csv", "t,x,y,r\n0,0,0,0.3\n0.5,0,0,0.3\n1,0,0,0.3\n");
        scene = folder_.write("scene.json", R"({
            "clips": {"walk": {"source": "walk.csv"}, "stand": {"source": "stand.csv"}},
            "agents": [{"name": "A", "clip": "walk"},
                       {"name": "B", "clip": "walk", "translate": [1, -1], "rotate_deg": 90},
                       {"name": "C", "clip": "walk", "translate": [0, 9], "start": 0.5}],
            "fit": {"leaf": 4}})");
    }

    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        return folder_.write(name, bytes);
    }

    std::filesystem::path scene;

  private:
    TempFolder folder_;
};

/// A desktop that keeps what is copied.
struct TestDesktop : Desktop {
    std::string text;               ///< that was copied last
    std::size_t picture_bytes = 0;  ///< ... of a picture
    bool has_picture_clipboard = false;
    std::atomic<int> wakes = 0;

    void wake() override { ++wakes; }
    void set_clipboard(const std::string& copied) override { text = copied; }
    void set_clipboard_picture(std::string_view png) override { picture_bytes = png.size(); }
    std::string_view why_no_clipboard_picture() override {
        return has_picture_clipboard ? "" : Desktop::why_no_clipboard_picture();
    }
};

/// The texts of all messages, and what else is easily asked of a session.
inline std::string all_messages(const Session& session) {
    std::string out;
    for (const Message& message : session.notifications.all()) out += message.text + '\n';
    return out;
}

/// What a command throws; fails if it throws nothing.
inline std::string refusal(Session& session, std::string_view id, const std::string& argument = "") {
    try {
        run_command(session, id, argument);
    } catch (const std::exception& error) {
        return error.what();
    }
    ADD_FAILURE() << id << ' ' << argument << " was not refused";
    return "";
}

}  // namespace testing
}  // namespace mobbscope::app
