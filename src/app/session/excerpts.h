/// Two paths of what is drawn as a scene of their own, with the query between them, in the colours that they had. Undo
/// leads back, and so does `leave`.
#pragma once

#include <app/session/crowd_inspector.h>
#include <app/session/playback.h>
#include <base/color.h>

#include <array>
#include <optional>
#include <string>

namespace mobbscope::app {

class Excerpts {
  public:
    Excerpts(Workspace& workspace, Jobs& jobs, Playback& playback, CrowdInspector& crowds, Counts& counts)
        : workspace_(workspace), jobs_(jobs), playback_(playback), crowds_(crowds), counts_(counts) {}

    // All throw std::invalid_argument while a job is under way.
    void open(const PlacedAgent& a, const PlacedAgent& b);
    /// The two agents of a conflict. In a run without forced plays the query expects a miss.
    void open_conflict(const SceneConflict& of);
    /// A candidate of the choice and who rules it out. Throws std::invalid_argument if nobody does.
    void open_candidate(int candidate);
    void leave();

  private:
    struct Side {
        std::string name;
        SceneClip clip;
        mobb::Placement placement;
    };
    void open(Side a, Side b, const std::array<Rgba, 2>& colors, const std::optional<Expectation>& expect = {});
    void turn_away();

    Workspace& workspace_;
    Jobs& jobs_;
    Playback& playback_;
    CrowdInspector& crowds_;
    Counts& counts_;
};

}  // namespace mobbscope::app
