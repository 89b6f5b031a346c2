#include <scene/fitted_scene.h>

#include <utility>

namespace mobbscope {

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options)
    : scene_(std::move(scene)),
      options_(options),
      queries_(effective_queries(scene_)),
      participants_(mobbscope::participants(scene_)) {
    mobb::check(options);
    trees_.reserve(scene_.clips.size());
    for (const SceneClip& clip : scene_.clips) {
        trees_.emplace_back(clip.clip, options);
    }
}

RecordedQuery record(const FittedScene& fitted, const SceneQuery& query) {
    mobb::TraceRecorder recorder;
    RecordedQuery out;
    out.contact = mobb::query(fitted.placed(query.a), fitted.placed(query.b), recorder);
    out.trace = recorder.take();
    out.tests = out.trace.counts();
    return out;
}

}  // namespace mobbscope
