#include <guard/window_picture.h>

#include <app/headless_window.h>
#include <guard/shader_warnings.h>

#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

namespace mobbscope::guard {

namespace {

/// While it lives, relative names of files are relative to a folder.
class WorkingFolder {
  public:
    explicit WorkingFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder);
    }
    ~WorkingFolder() {
        std::error_code ignored;
        std::filesystem::current_path(before_, ignored);
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

  private:
    std::filesystem::path before_;
};

}  // namespace

Image window_picture(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                     Backend backend, PictureSize size, double scale, const app::Script* script) {
    // Dialogs show the names of folders: the window must not see from where the program runs.
    const WorkingFolder folder(file.parent_path().empty() ? "." : file.parent_path());
    Scene scene = fitted.scene();
    scene.file = "." / file.filename();
    scene.fit = fitted.options();
    scene.view = view;
    app::Session session(false);
    session.may_write = false;
    session.open_scene(scene, {scene.file});
    std::unique_ptr<GlContext> context = GlContext::open(backend);
    const GlContext& drawn_in = *context;
    app::HeadlessWindow window(std::move(context), session, size, scale);
    if (script) {
        std::ostringstream nothing;
        script->run(session, window, nothing);
    }
    window.settle();
    refuse_warnings(drawn_in.name(), drawn_in.warnings());
    return window.shell().read_back();
}

}  // namespace mobbscope::guard
