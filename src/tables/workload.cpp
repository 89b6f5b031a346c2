#include <tables/workload.h>

#include <algorithm>

namespace mobbscope {

Workload workload_of_scene(const Scene& scene) {
    Workload workload;
    workload.fit = scene.fit;
    for (const SceneClip& clip : scene.clips) workload.clips.push_back(clip.clip);
    const std::size_t count = std::min(query_count(scene), static_cast<std::size_t>(kMaxQueries));
    workload.queries.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SceneQuery query = query_at(scene, i);
        workload.queries.push_back({query.a.clip, query.b.clip, query.a.placement, query.b.placement});
    }
    return workload;
}

double mean_duration(const Workload& workload) {
    if (workload.clips.empty()) return 0;
    double sum = 0;
    for (const mobb::ClipPtr& clip : workload.clips) sum += clip->duration();
    return sum / static_cast<double>(workload.clips.size());
}

}  // namespace mobbscope
