#include <crowd/graph_walk.h>
#include <tables/crowd_queries.h>

#include <memory>
#include <utility>

namespace mobbscope {

Workload crowd_queries(Scene scene, SimulateOptions options, int queries, const SimulationProgress& progress) {
    if (!scene.graph) scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    const mobb::FitOptions fit = scene.fit;
    const FittedScene fitted(std::move(scene), fit);
    options.ahead = kChosenAhead;
    QuerySample sample(Recorded::all, static_cast<std::size_t>(queries), options.seed, kAskedWithin);
    simulate(MoveSet(fitted), options, &sample, progress);
    return workload_of_scene(sample.workload(fitted.scene()));
}

}  // namespace mobbscope
