/// A scene with a tree over each of its clips: what the commands print and the renderer draws.
#pragma once

#include <scene/scene.h>

#include <memory>
#include <optional>
#include <vector>

namespace mobbscope {

/// Immutable once made; refers to nothing outside itself.
class FittedScene {
  public:
    /// Fits every clip with `options` (usually scene.fit). Throws std::invalid_argument if an option is out of range.
    FittedScene(Scene scene, const mobb::FitOptions& options);

    const Scene& scene() const { return scene_; }
    const mobb::FitOptions& options() const { return options_; }
    const mobb::Tree& tree(int clip) const { return trees_[static_cast<std::size_t>(clip)]; }
    const std::vector<SceneQuery>& queries() const { return queries_; }             ///< effective ones
    const std::vector<Participant>& participants() const { return participants_; }  ///< what is drawn

    mobb::PlacedTree placed(const Participant& participant) const {
        return {tree(participant.clip), participant.placement};
    }

  private:
    Scene scene_;
    mobb::FitOptions options_;
    std::vector<mobb::Tree> trees_;
    std::vector<SceneQuery> queries_;
    std::vector<Participant> participants_;
};

/// The answer of one query with all that was recorded on the way.
struct RecordedQuery {
    std::optional<mobb::Contact> contact;
    mobb::TestCounts tests;
    mobb::Trace trace;
};

/// Runs a query of the scene through its trees with the recorder.
RecordedQuery record(const FittedScene& fitted, const SceneQuery& query);

}  // namespace mobbscope
