/// Who may meet: the agents of a scene, or the tracks of a file, of which nothing else is kept.
#pragma once

#include <mobb/clip.h>
#include <scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

/// What somebody walks: a clip, or the path of a disk of its body.
struct CrowdPath {
    mobb::ClipPtr clip{};
    int agent = 0;           ///< from 0, in their order: of one with a body all of its paths
    int samples_before = 0;  ///< of the same person
};

/// An agent.
struct CrowdWalker {
    mobb::Placement placement{};
    std::vector<std::pair<double, double>> invented{};  ///< SourceFacts::invented
    bool of_plan = false;
    int person = 0;  ///< from 0, in their order: of several agents that one person walks all
    int first_path = 0;
};

class Crowd {
  public:
    /// Nobody yet, of a file of tracks.
    explicit Crowd(const std::filesystem::path& file) : file_(file) {}
    /// The agents of a scene, or of a motion file with several performers.
    explicit Crowd(const Scene& scene);

    /// `goes_on`: it is walked by the person before.
    void add(const SceneClip& clip, const Agent& agent, bool goes_on = false);

    const std::filesystem::path& file() const { return file_; }
    const CrowdPath& path(int index) const { return paths_[static_cast<std::size_t>(index)]; }
    const CrowdWalker& agent_of(int path) const { return agents_[static_cast<std::size_t>(this->path(path).agent)]; }
    /// The paths of a path's agent: the first, and the one behind the last.
    std::pair<int, int> paths_beside(int path) const;
    std::size_t people() const { return agents_.empty() ? 0 : static_cast<std::size_t>(agents_.back().person) + 1; }
    const std::string& name(int person) const { return names_[static_cast<std::size_t>(person)]; }
    /// Of tracks: time 0 on their file's own clock, seconds. The agents of a scene start when the scene says.
    std::optional<double> t0() const { return t0_; }
    const std::vector<std::string>& doubts() const { return doubts_; }  ///< SourceFacts::doubt, each once

    /// By path; they refer to the clips.
    std::vector<mobb::PlacedClip> placed() const;
    std::vector<int> person_of() const;  ///< by path
    std::vector<int> floor_of() const;   ///< by person, see numbered_floors
    /// Metres: of every disk, if it is one.
    std::optional<double> common_radius() const;
    /// The same for the same crowd: of each path the digest of its clip (mobb::digest), in two halves, and its
    /// placement and agent; and the floors.
    std::uint64_t digest() const;

  private:
    std::filesystem::path file_;
    std::deque<CrowdPath> paths_;
    std::deque<CrowdWalker> agents_;
    std::vector<std::string> names_, floors_;  ///< by person
    std::optional<double> t0_;
    std::vector<std::string> doubts_;
};

}  // namespace mobbscope
