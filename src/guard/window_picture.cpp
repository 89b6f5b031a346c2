#include <guard/window_picture.h>

#include <app/headless_window.h>
#include <guard/shader_warnings.h>

#include <memory>
#include <sstream>
#include <utility>

namespace mobbscope::guard {

Image window_picture(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                     Backend backend, PictureSize size, double scale, const app::Script* script) {
    Scene scene = fitted.scene();
    scene.fit = fitted.options();
    scene.view = view;
    app::Session session(false);
    session.open_scene(scene, {file});
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
