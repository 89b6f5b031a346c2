/// The questions of a table: pairs of placed clips.
#pragma once

#include <mobb/clip.h>
#include <scene/scene.h>

#include <string>
#include <vector>

namespace mobbscope {

struct WorkloadQuery {
    int clip_a = 0;  ///< index into Workload::clips
    int clip_b = 0;
    mobb::Placement a, b;
};

struct Workload {
    std::string name;                  ///< "table1" or "table2"
    std::string description;           ///< what it was made of, for people
    std::vector<mobb::ClipPtr> clips;  ///< at least one
    std::vector<WorkloadQuery> queries;
    mobb::FitOptions fit{};  ///< the scene's, for what is not asked for otherwise
};

/// The queries of a scene, such as those that a simulation recorded. At most kMaxQueries of them are taken.
Workload workload_of_scene(const Scene& scene);

/// More queries than this would measure nothing new, and fill the memory.
inline constexpr int kMaxQueries = 10'000'000;

/// Seconds; 0 without clips.
double mean_duration(const Workload& workload);

}  // namespace mobbscope
