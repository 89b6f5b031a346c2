/// The window with the scene of a CrossingFolder, worked by lines of a script.
#pragma once

#include "app/crossing_folder.h"

#include <app/script/script.h>
#include <app/session/session.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include <sstream>
#include <string>

namespace mobbscope::app::inline testing {

struct CrossingWindow {
    CrossingFolder folder;
    Session session{false};
    HeadlessWindow window{GlContext::open(Backend::automatic), session, {1600, 1000}, 1};

    CrossingWindow() {
        session.files.open({folder.scene});
        window.settle();
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
        window.settle();
    }
    bool has(const std::string& mark) { return window.shell().marks().all().contains(mark); }
};

}  // namespace mobbscope::app::inline testing
