#include <scene/fitted_scene.h>

#include <unordered_map>
#include <utility>

namespace mobbscope {

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options, const FittedScene* previous,
                         const Progress& progress)
    : scene_(std::move(scene)), options_(options), participants_(mobbscope::participants(scene_)) {
    mobb::check(options);
    std::unordered_map<const mobb::Clip*, std::shared_ptr<const mobb::Tree>> fitted;
    if (previous && previous->options() == options) {
        for (const auto& tree : previous->trees_) fitted.emplace(&tree->clip(), tree);
    }
    trees_.reserve(scene_.clips.size());
    for (const SceneClip& clip : scene_.clips) {
        std::shared_ptr<const mobb::Tree>& tree = fitted[clip.clip.get()];
        if (!tree) tree = std::make_shared<const mobb::Tree>(clip.clip, options);
        trees_.push_back(tree);
        if (progress) progress(trees_.size(), scene_.clips.size());
    }
}

RecordedQuery record(const FittedScene& fitted, const SceneQuery& query, Search search) {
    mobb::TraceRecorder recorder;
    RecordedQuery out;
    out.contact = ask(fitted, query, search, recorder);
    out.trace = recorder.take();
    out.tests = out.trace.counts();
    return out;
}

}  // namespace mobbscope
