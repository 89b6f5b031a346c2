#include <app/document/document.h>
#include <app/document/selection.h>
#include <render/layout/follow.h>
#include <scene/arrangement.h>
#include <scene/crowd_scene.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace mobbscope::app {

namespace {

/// Fits of fewer samples than this are no work for a job.
constexpr std::size_t kQuickSamples = 50'000;
/// How much longer than the paper's axes those found by searching take.
constexpr std::size_t kSearchFactor = 100;

/// The options of each fit of `present` when those of the fit in use become `options`.
std::vector<mobb::FitOptions> fits_with(const FittedScene& present, const mobb::FitOptions& options) {
    std::vector<mobb::FitOptions> out;
    for (const auto& fit : present.fits()) out.push_back(fit->options);
    out[present.fit_in_use()] = options;
    return out;
}

}  // namespace

QueryKey query_key(const FittedScene& fitted, int query) {
    const Scene& scene = fitted.scene();
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(query)];
    // Where all pairs are asked each is asked once.
    const auto end = scene.queries.begin() + (scene.queries.empty() ? 0 : query);
    const auto same = std::count_if(scene.queries.begin(), end, [&](const SceneQuery& other) {
        return other.a.name == asked.a.name && other.b.name == asked.b.name;
    });
    return {asked.a.name, asked.b.name, static_cast<int>(same)};
}

std::optional<int> find_query(const FittedScene& fitted, const QueryKey& key) {
    const auto& [a, b, same] = key;
    const Scene& scene = fitted.scene();
    if (scene.queries.empty()) {
        const auto index_of = [&](const std::string& name) {
            return static_cast<std::size_t>(std::ranges::find(scene.agents, name, &Agent::name) - scene.agents.begin());
        };
        const std::size_t first = index_of(a);
        const std::size_t second = index_of(b);
        if (first >= second || second >= scene.agents.size() || fitted.queries().empty()) return std::nullopt;
        const std::optional<std::size_t> index = fitted.queries().index_of(first, second);
        return index ? std::optional(static_cast<int>(*index)) : std::nullopt;
    }
    int left = same;
    for (std::size_t i = 0; i < scene.queries.size(); ++i) {
        const SceneQuery& query = scene.queries[i];
        if (query.a.name == a && query.b.name == b && left-- == 0) return static_cast<int>(i);
    }
    return std::nullopt;
}

StepKey step_key(const FittedScene& fitted, int query) { return {query_key(fitted, query), fitted.options().tree}; }

Document whole_of(const ExcerptSource& source) {
    Document out{source.fitted, source.view};
    out.beside = source.beside;
    out.place = source.place;
    out.links = source.links;
    out.steps = source.steps;
    out.opening = source.opening;
    return out;
}

std::vector<SceneView> views_of(const Document& document) {
    std::vector<SceneView> out = document.beside;
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(document.place), {document.fitted, document.view});
    return out;
}

void set_views(Document& document, std::vector<SceneView> views, std::size_t place) {
    const auto active = views.begin() + static_cast<std::ptrdiff_t>(place);
    document.fitted = std::move(active->fitted);
    document.view = std::move(active->view);
    views.erase(active);
    document.beside = std::move(views);
    document.place = place;
}

Document document_of(Scene scene, const FittedScene* previous, const Progress& progress) {
    const mobb::FitOptions options = scene.fit;
    const ViewState view = scene.view;
    return {std::make_shared<const FittedScene>(std::move(scene), options, previous, progress), view};
}

Document with_scene(const Document& present, Scene scene, const FittedScene* fitted_beside, const Progress& progress) {
    const FittedScene& before = *present.fitted;
    const std::vector<mobb::FitOptions> fits = fits_with(before, scene.fit);
    Document out = present;
    out.view = scene.view;
    scene.fit = fits.front();
    std::vector<const FittedScene*> known{&before};
    if (fitted_beside) known.push_back(fitted_beside);
    FittedScene fitted(std::move(scene), fits.front(), known, progress);
    for (std::size_t i = 1; i < fits.size(); ++i) {
        fitted = fitted.with_fit(before.fits()[i]->name, fits[i], known, progress);
    }
    out.fitted = std::make_shared<const FittedScene>(fitted.using_fit(before.fit_in_use()));
    if (out.view.subtree == present.view.subtree) keep_part(out.view, *out.fitted, before);
    for (SceneView& other : out.beside) {
        const std::shared_ptr<const FittedScene> was = std::exchange(
            other.fitted, std::make_shared<const FittedScene>(fitted.using_fit(other.fitted->fit_in_use())));
        keep_part(other.view, *other.fitted, *was);
    }
    // Named views are of the trees in use.
    DebugState debug = out.fitted->scene().debug;
    for (NamedView& seen : debug.views) keep_part(seen.view, *out.fitted, before);
    if (debug == out.fitted->scene().debug) return out;
    Scene named = out.fitted->scene();
    named.view = out.view;
    named.fit = out.fitted->options();
    named.debug = std::move(debug);
    return with_scene(out, std::move(named), nullptr, progress);
}

std::size_t fit_with(FittedScene& fitted, const std::string& name, const mobb::FitOptions& options) {
    const auto& fits = fitted.fits();
    const auto known = std::find_if(fits.begin(), fits.end(), [&](const auto& fit) { return fit->options == options; });
    const auto index = static_cast<std::size_t>(known - fits.begin());
    if (known != fits.end()) return index;
    UnusedNames names;
    for (const auto& fit : fits) names.take(fit->name);
    fitted = fitted.with_fit(names.take(name), options);
    return index;
}

bool quick_to_fit(const Scene& scene, const FittedScene& present, const FittedScene* fitted_beside) {
    std::size_t work = 0;
    for (const mobb::FitOptions& options : fits_with(present, scene.fit)) {
        std::unordered_set<const mobb::Clip*> kept;
        for (const FittedScene* source : {&present, fitted_beside}) {
            if (!source) continue;
            for (const auto& fit : source->fits()) {
                if (fit->options != options) continue;
                for (const auto& tree : fit->trees) kept.insert(&tree->clip());
            }
        }
        for (const SceneClip& clip : scene.clips) {
            if (kept.contains(clip.clip.get())) continue;
            work += static_cast<std::size_t>(clip.clip->count()) *
                    (options.axes == mobb::Axes::minarea ? kSearchFactor : 1);
        }
    }
    return work < kQuickSamples;
}

void keep_part(ViewState& view, const FittedScene& now, const FittedScene& before) {
    if (!view.subtree) return;
    const Selection part{Selection::Kind::node, {view.subtree->agent, -1, 0}, view.subtree->node};
    const auto who = placed_agent_of(now, part.path);
    if (!who || !exists(before, part)) return;  // clamped() takes it out
    const mobb::Node& was = before.tree(placed_agent_of(before, part.path)->clip).node(part.index);
    const auto& nodes = now.tree(*who).nodes();
    const auto same = std::ranges::find_if(
        nodes, [&](const mobb::Node& node) { return node.first == was.first && node.count == was.count; });
    if (same == nodes.end()) return view.subtree.reset();
    view.subtree->node = static_cast<int>(same - nodes.begin());
}

ViewState clamped(ViewState view, const FittedScene& fitted) {
    if (view.query && static_cast<std::size_t>(*view.query) >= fitted.queries().size()) view.query.reset();
    if (!view.follow.empty() && !can_follow(fitted.scene(), view.follow)) view.follow.clear();
    drop_unknown_names(fitted.scene(), view);
    // A node of a tree that was fitted anew is another one, or none.
    if (view.projection && !has_projection(fitted, view)) view.projection.reset();
    const bool has_part = view.subtree && !fitted.scene().crowd &&
                          exists(fitted, {Selection::Kind::node, {view.subtree->agent, -1, 0}, view.subtree->node});
    if (!has_part) view.subtree.reset();
    // A run is always seen at some time.
    if (fitted.scene().crowd && !view.time) view.time = run_time(fitted.scene(), view);
    return view;
}

void clamp_views(Document& document) {
    document.view = clamped(document.view, *document.fitted);
    for (SceneView& other : document.beside) other.view = clamped(other.view, *other.fitted);
}

}  // namespace mobbscope::app
