/// Who may meet: the agents of a scene, or the tracks of a file, of which nothing else is kept.
#pragma once

#include <mobb/clip.h>
#include <scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

struct CrowdMember {
    std::string name{};
    mobb::ClipPtr clip{};
    mobb::Placement placement{};
    std::vector<std::pair<double, double>> invented{};  ///< SourceFacts::invented
    bool of_plan = false;
    int person = 0;          ///< from 0, in their order
    int samples_before = 0;  ///< of the same person
};

class Crowd {
  public:
    /// Nobody, of a file.
    explicit Crowd(const std::filesystem::path& file) : file_(file) {}
    /// The agents of a scene, or of a motion file with several performers.
    explicit Crowd(const Scene& scene);

    /// `goes_on`: it is walked by the person before.
    void add(const SceneClip& clip, const Agent& agent, bool goes_on = false);

    const std::filesystem::path& file() const { return file_; }
    const std::deque<CrowdMember>& members() const { return members_; }
    std::size_t people() const { return members_.empty() ? 0 : static_cast<std::size_t>(members_.back().person) + 1; }
    /// Of tracks: time 0 on their file's own clock, seconds. The agents of a scene start when the scene says.
    std::optional<double> t0() const { return t0_; }
    const std::string& doubt() const { return doubt_; }  ///< SourceFacts::doubt

    /// By member; they refer to the members' clips.
    std::vector<mobb::PlacedClip> placed() const;
    std::vector<int> person_of() const;
    /// Metres: of every disk, if it is one.
    std::optional<double> common_radius() const;
    /// The same for the same crowd: of each member the digest of its clip (mobb::digest), in two halves, and its
    /// placement.
    std::uint64_t digest() const;

  private:
    std::filesystem::path file_;
    std::deque<CrowdMember> members_;
    std::optional<double> t0_;
    std::string doubt_;
};

}  // namespace mobbscope
