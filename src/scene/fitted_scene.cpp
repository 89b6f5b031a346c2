#include <scene/fitted_scene.h>

#include <utility>

namespace mobbscope {

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options)
    : scene_(std::move(scene)), options_(options), participants_(mobbscope::participants(scene_)) {
    mobb::check(options);
    trees_.reserve(scene_.clips.size());
    for (const SceneClip& clip : scene_.clips) {
        trees_.emplace_back(clip.clip, options);
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
