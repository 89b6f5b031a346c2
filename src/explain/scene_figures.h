/// The figures of the nodes of a scene's trees, each column worked out when somebody asks for it first.
#pragma once

#include <explain/avoidable.h>
#include <explain/branch_costs.h>
#include <explain/node_values.h>
#include <scene/fitted_scene.h>

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace mobbscope {

/// Those of a tree are kept as long as somebody else has the tree, whatever else of the scene changes; what was counted
/// in queries is kept of the last few scenes that ask different ones or have other trees. Not for several threads.
class SceneFigures {
  public:
    /// Tests and avoidable overlaps depend on the scene's queries. They are counted as soon as somebody asks for them
    /// (at_once), or elsewhere: then only those are known that `take` was given.
    enum class Counting { at_once, elsewhere };
    explicit SceneFigures(Counting counting = Counting::at_once) : counting_(counting) {}

    /// Those of a clip's tree, the column of `field` among them as far as it is known. Valid as long as somebody has
    /// the tree.
    const NodeValues& of(const std::shared_ptr<const FittedScene>& fitted, int clip, NodeField field);
    /// Whether tests, or avoidable overlaps, have been counted in the queries of this scene.
    bool is_counted(const std::shared_ptr<const FittedScene>& fitted, NodeField field);

    /// For each sample of a clip how many tests of boxes hold it: of its scene's queries where these are counted, else
    /// the part of all tests that is expected to, under standard placements.
    std::vector<double> heat(const std::shared_ptr<const FittedScene>& fitted, int clip);
    NodeField heat_of(const std::shared_ptr<const FittedScene>& fitted);

    /// What is known of the queries of a scene; null: they have not been counted.
    void take(const std::shared_ptr<const FittedScene>& fitted, std::shared_ptr<const SceneCosts> costs,
              std::shared_ptr<const BlameInScene> blame);
    /// Another number when what was counted has changed.
    std::int64_t revision() const { return revision_; }

  private:
    struct Counted {
        std::shared_ptr<const FittedScene> in;
        std::shared_ptr<const SceneCosts> costs;    ///< null: not counted
        std::shared_ptr<const BlameInScene> blame;  ///< likewise
    };
    struct Kept {
        NodeValues values;
        bool has_shares = false;
        std::shared_ptr<const SceneCosts> costs{};    ///< whose tests these are; null: none
        std::shared_ptr<const BlameInScene> blame{};  ///< likewise
    };
    Counted* counted_in(const std::shared_ptr<const FittedScene>& fitted);
    Counted known(const std::shared_ptr<const FittedScene>& fitted, NodeField field);
    Kept& kept(const std::shared_ptr<const mobb::Tree>& tree, int clip);

    Counting counting_;
    std::map<std::shared_ptr<const mobb::Tree>, std::map<int, Kept>> kept_;  ///< by tree, and by clip that has it
    std::vector<Counted> counted_;                                           ///< the latest first
    std::int64_t revision_ = 0;
};

}  // namespace mobbscope
