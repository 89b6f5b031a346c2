/// The window with the scene of a CrossingFolder, worked by lines of a script.
#pragma once

#include "app/folder_window.h"

#include <app/script/script.h>
#include <app/session/session.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include <sstream>
#include <string>

namespace mobbscope::app {
inline namespace testing {

struct CrossingWindow : FolderWindow<CrossingFolder> {
    CrossingWindow() : FolderWindow({1600, 1000}) { open(folder.scene); }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
        window.settle();
    }
};

}  // namespace testing
}  // namespace mobbscope::app
