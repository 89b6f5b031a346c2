/// The questions of a table: pairs of placed clips.
#pragma once

#include <crowd/simulation/simulate.h>
#include <mobb/blocks.h>
#include <mobb/clip.h>
#include <mobb/placed_tree.h>
#include <paper_tables/random_queries.h>
#include <scene/scene.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mobbscope {

struct Workload {
    std::string name;                  ///< "table1" or "table2"
    std::string description;           ///< what it was made of, for people
    std::vector<mobb::ClipPtr> clips;  ///< at least one
    std::vector<WorkloadQuery> queries;
    mobb::FitOptions fit{};  ///< the scene's, for what is not asked for otherwise
};

/// Trees of its clips, in their order.
std::vector<mobb::Tree> trees_of(const Workload& workload, const mobb::FitOptions& options);

/// Both sides of a query where they are placed.
template <class Placed>
struct PlacedPair {
    Placed a, b;
};
PlacedPair<mobb::PlacedClip> placed(const Workload& workload, const WorkloadQuery& query);
/// The trees must outlive it.
PlacedPair<mobb::PlacedTree> placed(const std::vector<mobb::Tree>& trees, const WorkloadQuery& query);

/// Trees of blocks, of which these are asked. They must outlive what is placed.
struct BlocksOf {
    const std::vector<mobb::Tree>& trees;
};
PlacedPair<mobb::PlacedBlocks> placed(const BlocksOf& of, const WorkloadQuery& query);

/// The queries of a scene, such as those that a simulation recorded. At most kMaxQueries of them are taken.
Workload workload_of_scene(const Scene& scene);

/// More queries than this would measure nothing new, and fill the memory.
inline constexpr int kMaxQueries = 1'000'000;

/// Seconds; 0 without clips.
double mean_duration(const Workload& workload);

/// What of a crowd's queries is taken. With the defaults they are like the paper's: some 80 % end at the roots, and
/// 0.45 test their boxes. More than half are apart in time, so its agents knew more of each other than what plays now.
struct CrowdDraw {
    double within = 1;   ///< metres >= 0: how near a reserved motion comes to a candidate's, at any time
    double ahead = 2.5;  ///< seconds >= 0 before its begin at which a move is chosen
    std::uint64_t seed = 1;
};

/// Lets a crowd of 100 on 30 x 40 m play the scene's graph for 120 s, or without one its clips whole and back to back,
/// and takes a sample of `count` of the pairs of a candidate and another agent's reserved motion (0: all of them). The
/// agents plan nothing and turn on the spot in no time, as the paper's. Throws InputError as simulate does.
Workload crowd_queries(Scene scene, int count, const CrowdDraw& draw);

}  // namespace mobbscope
