#include <scene/fitted_scene.h>

#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace mobbscope {

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options, const FittedScene* previous,
                         const Progress& progress)
    : scene_(std::move(scene)), options_(options), participants_(mobbscope::placed_agents(scene_)) {
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

std::size_t FittedScene::bytes_beyond(const FittedScene& other) const {
    if (this == &other) return 0;
    std::unordered_set<const void*> shared;
    for (const auto& tree : other.trees_) shared.insert({tree.get(), &tree->clip()});
    std::size_t bytes = scene_.clips.size() * sizeof(SceneClip) + scene_.agents.size() * sizeof(Agent) +
                        scene_.queries.size() * sizeof(SceneQuery) + participants_.size() * sizeof(PlacedAgent);
    for (const auto& tree : trees_) {
        if (shared.insert(tree.get()).second) bytes += tree->nodes().size() * (sizeof(mobb::Node) + sizeof(int));
        if (shared.insert(&tree->clip()).second) bytes += tree->clip().samples().size_bytes();
    }
    return bytes;
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
