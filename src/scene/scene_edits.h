/// Edits of a scene that keep its parts consistent: queries carry copies of their agents.
#pragma once

#include <scene/scene.h>

#include <filesystem>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace mobbscope {

/// Gives names that nothing has yet.
class UnusedNames {
  public:
    UnusedNames() = default;
    /// Of clips, or agents.
    template <class Items>
    explicit UnusedNames(const Items& items) {
        for (const auto& item : items) taken_.insert(item.name);
    }
    /// `wanted`, or with " 2", " 3", ... behind it. Nobody gets it again.
    std::string take(const std::string& wanted);
    /// For a copy of what has that name: "A 2" for "A", and "A 3", not "A 2 2", for "A 2".
    std::string take_next(const std::string& name);

  private:
    /// `stem` with the first number behind it, after `last`, that is not taken.
    std::string take_numbered(const std::string& stem, int last);

    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, int> last_number_;  ///< up to which all that are wanted are taken
};

/// A scene without agents gets one for every clip, where it is and when its track or take starts: what was seen of it
/// is then agents.
void add_agents_for_clips(Scene& scene);

/// The agent's clip placed elsewhere. Its queries follow; traces recorded of them are dropped, expectations stay.
/// Throws std::invalid_argument if a number is out of range for the clip (mobb::checked).
void place_agent(Scene& scene, int agent, const mobb::Placement& placement);

/// A view calls an agent by another name.
void rename_in_view(ViewState& view, const std::string& before, const std::string& name);

/// In the scene and its view. Throws std::invalid_argument if the name is empty or another agent's.
void rename_agent(Scene& scene, int agent, const std::string& name);

/// Adds an agent that plays a clip; returns its index. A scene without agents first gets one for every clip, as that is
/// what was seen of it. Where all pairs are asked (no queries in the file) it takes part in them; otherwise it is asked
/// against nobody until add_query.
int add_agent(Scene& scene, int clip, const mobb::Placement& placement = {});

/// A copy of an agent under a name of its own; returns its index.
int duplicate_agent(Scene& scene, int agent);

/// Removes an agent with its queries. Throws std::invalid_argument if it is the last one: a scene without agents shows
/// its clips instead.
void remove_agent(Scene& scene, int agent);

/// Asks two agents against each other; returns the query's index. The pairs that were asked implicitly are written out
/// first. Throws std::invalid_argument if both are one agent.
std::size_t add_query(Scene& scene, int a, int b);
void remove_query(Scene& scene, std::size_t query);

/// Writes what is asked implicitly (all pairs of agents) as queries.
void make_queries_explicit(Scene& scene);

/// Traces recorded under other trees say nothing of these.
void drop_traces(Scene& scene);

/// Clips, agents and queries of `other` behind those of `scene`; names that are taken get a number. Sources are made
/// relative to the scene's file. Agents of one and bare clips of the other stay what they are: bare clips become
/// agents.
void merge(Scene& scene, Scene other);

/// The scene under another file name: relative sources are rewritten to lead where they led.
void move_to_file(Scene& scene, const std::filesystem::path& file);

}  // namespace mobbscope
