#include <app/document/views.h>
#include <render/drawlist/camera.h>
#include <scene/fit_text.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

void require_other(const mobb::FitOptions& fit, std::span<const mobb::FitOptions> fits) {
    if (std::ranges::find(fits, fit) != fits.end())
        throw std::invalid_argument("two of the fits are alike: " + fit_words(fit, {}));
}

}  // namespace

std::shared_ptr<const FittedScene> Views::fitted(std::size_t place) const {
    const Document& now = workspace_.document();
    if (place == now.place) return workspace_.shown();
    const SceneView& other = now.beside[place < now.place ? place : place - 1];
    shown_beside_.resize(now.beside.size() + 1);
    return shown_beside_[place].at(other.fitted, other.view);
}

const ViewState& Views::view(std::size_t place) const {
    const Document& now = workspace_.document();
    return place == now.place ? now.view : now.beside[place < now.place ? place : place - 1].view;
}

void Views::split(const std::string& name, const mobb::FitOptions& options) {
    if (count() >= kMostViews) throw std::invalid_argument("there are no more than four views: close one first");
    std::vector<mobb::FitOptions> in_view;
    for (const SceneView& seen : views_of(workspace_.document())) in_view.push_back(seen.fitted->options());
    require_other(options, in_view);
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
    keep_part(added.view, *added.fitted, *next.fitted);
    // Other trees take other tests: as far on in theirs.
    if (const RecordedQuery* query = workspace_.recorded(); query && query->trace.size() > 1) {
        added.view.step = {Step::Unit::percent, 100.0 * workspace_.step() / (query->trace.size() - 1)};
    }
    next.beside.push_back(std::move(added));
    workspace_.change_document(std::move(next), {"splitting the view: " + name, ""});
}

void Views::compare(const std::vector<mobb::FitOptions>& fits, const std::optional<LevelRange>& levels) {
    if (fits.size() < 2 || fits.size() > kMostViews)
        throw std::invalid_argument("give two to four fits, such as mobb,leaf=10 moving");
    for (std::size_t i = 1; i < fits.size(); ++i) require_other(fits[i], std::span(fits).first(i));
    Document next = workspace_.document();
    const std::vector<std::string> names = names_of_fits(fits);
    FittedScene fitted = next.fitted->without_unused_fits();
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < fits.size(); ++i) indices.push_back(fit_with(fitted, names[i], fits[i]));
    ViewState view = next.view;
    if (levels) {
        view.levels = *levels;
        view.query.reset();
        view.projection.reset();
        view.boxes = true;
    }
    std::vector<SceneView> views;
    for (const std::size_t index : indices) {
        views.push_back({std::make_shared<const FittedScene>(fitted.using_fit(index)), view});
        keep_part(views.back().view, *views.back().fitted, *next.fitted);
    }
    set_views(next, std::move(views), 0);
    std::string title = "comparing ";
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) title += i + 1 == names.size() ? " with " : ", ";
        title += names[i];
    }
    workspace_.change_document(std::move(next), {std::move(title), ""});
}

void Views::close(std::size_t place) {
    if (count() == 1 || place >= count()) return;
    Document next = workspace_.document();
    std::vector<SceneView> views = views_of(next);
    const std::string name(mobb::info(views[place].fitted->options().tree).label);
    views.erase(views.begin() + static_cast<std::ptrdiff_t>(place));
    const std::size_t stays = next.place > place ? next.place - 1 : std::min(next.place, views.size() - 1);
    set_views(next, std::move(views), stays);
    workspace_.change_document(std::move(next), {"closing a view: " + name, ""});
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
    if (place == active() || place >= count()) return;
    const bool linked = workspace_.document().links.selection;
    const Selection there = counterpart(workspace_.selection, workspace_.fitted(), *at(place).fitted);
    workspace_.activate(place);
    if (linked) workspace_.select(there);
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

void Views::frame_camera(std::size_t place, const Camera& camera, double time_height) {
    settle_camera(place, camera, time_height);
    constexpr std::size_t kMostFramings = 8;
    std::vector<Camera>& framings = workspace_.framings;
    framings.insert(framings.begin(), camera);
    framings.resize(std::min(framings.size(), kMostFramings));
}

void Views::resize_pictures(PictureSize to) {
    const std::optional<PictureSize> from = std::exchange(workspace_.picture_size, to);
    if (!from || (from->width == to.width && from->height == to.height)) return;
    const auto resize = [&](Camera& camera, bool follows) {
        if (!follows && workspace_.is_framed(camera)) {
            camera = without_target(camera);
        } else if (camera.target) {
            camera = resized(camera, *from, to);
        }
    };
    workspace_.history.amend_views([&](ViewState& view) { resize(view.camera, !view.follow.empty()); });
    for (auto& other : workspace_.other_cameras) resize(other.second, !workspace_.view().follow.empty());
    workspace_.framings.clear();
}

void Views::link(bool ViewLinks::*what, bool linked) {
    workspace_.amend([&](Document& next) { next.links.*what = linked; });
}

}  // namespace mobbscope::app
