#include <picture_tests/window_picture.h>

#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <picture_tests/picture_maker.h>
#include <review/review_screen.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::picture_tests {

namespace {

/// While it lives, relative names of files are relative to a folder.
class WorkingFolder {
  public:
    explicit WorkingFolder(const std::filesystem::path& folder) {
        std::error_code gone;
        before_ = std::filesystem::current_path(gone);
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

/// A window that a script has worked.
class WorkedWindow {
  public:
    WorkedWindow(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file, Backend backend,
                 PictureSize size, double scale, const app::Script* script)
        // Dialogs show the names of folders: the window must not see from where the program runs.
        : folder_(file.parent_path().empty() ? "." : file.parent_path()), session_(false) {
        // First, as the session starts threads (driver_watch.h).
        std::unique_ptr<GlContext> context = GlContext::open(backend);
        Scene scene = fitted.scene();
        scene.file = "." / file.filename();
        scene.fit = fitted.options();
        scene.view = view;
        session_.options.may_write = false;
        session_.options.may_measure = false;
        app::add_review(session_);
        std::vector<std::filesystem::path> opened;
        if (file.has_filename()) opened.push_back(scene.file);
        session_.files.open_scene(scene, opened);
        const GlContext& drawn_in = *context;
        window_.emplace(std::move(context), session_, size, scale);
        if (script) {
            std::ostringstream nothing;
            script->run(session_, *window_, nothing);
        }
        window_->settle();
        refuse_warnings(drawn_in.name(), drawn_in.warnings());
    }

    const app::Session& session() const { return session_; }
    Image read_back() { return window_->shell().read_back(); }

  private:
    WorkingFolder folder_;
    app::Session session_;
    std::optional<app::HeadlessWindow> window_;
};

}  // namespace

WindowPicture window_picture(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                             Backend backend, PictureSize size, double scale, const app::Script* script) {
    WorkedWindow window(fitted, view, file, backend, size, scale, script);
    return {window.read_back(), app::state_text(app::state_json(window.session()), 1)};
}

}  // namespace mobbscope::picture_tests
