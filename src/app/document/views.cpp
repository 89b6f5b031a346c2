#include <app/document/views.h>
#include <render/drawlist/camera.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <utility>

namespace mobbscope::app {

SceneView Views::at(std::size_t place) const {
    const Document& now = workspace_.document();
    if (place == now.place) return {workspace_.shown(), now.view};
    const SceneView& other = now.beside[place < now.place ? place : place - 1];
    shown_beside_.resize(now.beside.size() + 1);
    return {shown_beside_[place].at(other), other.view};
}

void Views::split(const std::string& name, const mobb::FitOptions& options) {
    Document next = workspace_.document();
    FittedScene fitted = *next.fitted;
    const std::size_t index = fit_with(fitted, name, options);
    if (fitted.fits().size() > next.fitted->fits().size()) {
        next.fitted = std::make_shared<const FittedScene>(fitted);
        for (SceneView& other : next.beside) {
            other.fitted = std::make_shared<const FittedScene>(fitted.using_fit(other.fitted->fit_in_use()));
        }
    }
    SceneView added{std::make_shared<const FittedScene>(fitted.using_fit(index)), next.view};
    // Other trees take other tests: as far on in theirs.
    if (const RecordedQuery* query = workspace_.recorded(); query && query->trace.size() > 1) {
        added.view.step = {Step::Unit::percent, 100.0 * workspace_.step() / (query->trace.size() - 1)};
    }
    next.beside.push_back(std::move(added));
    workspace_.change_document(std::move(next), {"splitting the view: " + name, ""});
}

void Views::close_others() {
    if (workspace_.document().beside.empty()) return;
    Document next = workspace_.document();
    next.beside.clear();
    next.place = 0;
    next.fitted = std::make_shared<const FittedScene>(next.fitted->without_unused_fits());
    workspace_.change_document(std::move(next), {"closing the other views", ""});
}

void Views::activate(std::size_t place) {
    if (place == workspace_.document().place || place > workspace_.document().beside.size()) return;
    workspace_.amend([&](Document& next) { set_views(next, views_of(next), place); });
}

void Views::settle_camera(std::size_t place, const Camera& camera, double time_height) {
    if (place >= count()) return;
    workspace_.amend([&](Document& next) {
        ViewState& view = place == next.place ? next.view : next.beside[place - (place > next.place ? 1 : 0)].view;
        view.camera = camera;
        if (time_height > 0) view.time_height = time_height;
    });
    if (time_height > 0) workspace_.settled_height = time_height;
}

void Views::resize_pictures(PictureSize to) {
    const std::optional<PictureSize> from = std::exchange(workspace_.picture_size, to);
    if (!from || from->height == to.height) return;
    const auto resize = [&](Camera& camera) {
        if (camera.target) camera = resized(camera, *from, to);
    };
    workspace_.history.amend_views([&](ViewState& view) { resize(view.camera); });
    for (auto& other : workspace_.other_cameras) resize(other.second);
}

void Views::link_cameras(bool linked) {
    workspace_.amend([&](Document& next) { next.linked_cameras = linked; });
}

}  // namespace mobbscope::app
