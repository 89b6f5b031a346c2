/// The figures of the nodes of a scene's trees, each column worked out when somebody asks for it first.
#pragma once

#include <explain/avoidable.h>
#include <explain/branch_costs.h>
#include <explain/node_values.h>
#include <scene/fitted_scene.h>

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace mobbscope {

/// Those of a tree are kept as long as the scene that is asked about has it, whatever else of the scene changes. Not
/// for several threads.
class SceneFigures {
  public:
    /// Of what depends on the scene's queries: counted as soon as somebody asks, or only what `take` was given.
    enum class Counting { at_once, elsewhere };
    explicit SceneFigures(Counting counting = Counting::at_once) : counting_(counting) {}

    /// Those of a clip's tree, the column of `field` among them as far as it is known. Valid until the next call.
    const NodeValues& of(const std::shared_ptr<const FittedScene>& fitted, int clip, NodeField field);
    /// Whether the queries of this scene have been counted for that: only tests and avoidable overlaps have to be.
    bool is_counted(const std::shared_ptr<const FittedScene>& fitted, NodeField field);

    /// For each sample of a clip how many tests of boxes hold it: of its scene's queries where these are counted, else
    /// the part of all tests that is expected to, under standard placements.
    std::vector<double> heat(const std::shared_ptr<const FittedScene>& fitted, int clip);
    NodeField heat_of(const std::shared_ptr<const FittedScene>& fitted);

    /// Somebody has counted the queries of a scene; null: has not.
    void take(const std::shared_ptr<const FittedScene>& fitted, const SceneCosts* costs,
              std::shared_ptr<const BlameInScene> blame);
    /// Another number when what was counted has changed.
    std::int64_t revision() const { return revision_; }

  private:
    struct Kept {
        NodeValues values;
        bool has_shares = false;
        std::int64_t tests_of = -1, avoidable_of = -1;  ///< the revision whose these are
    };
    void know(const std::shared_ptr<const FittedScene>& fitted, NodeField field);

    Counting counting_;
    std::map<std::pair<std::shared_ptr<const mobb::Tree>, int>, Kept> kept_;  ///< by tree and clip
    std::shared_ptr<const FittedScene> counted_in_;
    std::shared_ptr<const SceneCosts> costs_;
    std::shared_ptr<const BlameInScene> blame_;
    std::int64_t revision_ = 0;
};

}  // namespace mobbscope
