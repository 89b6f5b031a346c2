#include <base/error.h>
#include <base/text.h>
#include <scene/scene_edits.h>

#include <scene/view_options.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

/// Behind a name; more is part of the name itself.
constexpr int kMostNumber = 999'999;

Agent& agent_at(Scene& scene, int agent) { return scene.agents.at(static_cast<std::size_t>(agent)); }

/// Throws std::invalid_argument, naming the number, where a clip cannot be placed.
void check_placement(const Scene& scene, int clip, const mobb::Placement& placement) {
    mobb::checked(placement, scene.clips.at(static_cast<std::size_t>(clip)).clip->most_start());
}

/// Queries as their agents are now.
template <class Change>
void change_sides(Scene& scene, int agent, const Change& change) {
    for (SceneQuery& query : scene.queries) {
        for (PlacedAgent* side : {&query.a, &query.b}) {
            if (side->agent != agent) continue;
            change(*side);
            query.trace.reset();
        }
    }
}

/// The scene's view and its named ones.
template <class AScene, class Use>
void for_each_view(AScene& scene, const Use& use) {
    use(scene.view);
    for (auto& named : scene.debug.views) use(named.view);
}

/// Gives the queries that views and bookmarks name other indices; what names one that is gone goes too.
void renumber_queries(Scene& scene, const std::function<std::optional<int>(int)>& now) {
    for_each_view(scene, [&](ViewState& view) {
        if (view.query) view.query = now(*view.query);
    });
    std::vector<Bookmark> stay;
    for (Bookmark& bookmark : scene.debug.bookmarks) {
        const std::optional<int> query = now(bookmark.query);
        if (!query) continue;
        bookmark.query = *query;
        stay.push_back(std::move(bookmark));
    }
    scene.debug.bookmarks = std::move(stay);
}

/// Keeps what names queries while agents change: where all pairs of agents are queries, their indices change too. It is
/// made before the change, `renumber` then gives the same pairs their new indices.
class ImpliedQueries {
  public:
    explicit ImpliedQueries(const Scene& scene) : implied_(scene.queries.empty()) {
        if (!implied_) return;
        const AskedPairs asked(scene);
        const auto keep = [&](int query) {
            if (static_cast<std::size_t>(query) >= asked.size()) return;
            const auto [a, b] = asked[static_cast<std::size_t>(query)];
            pairs_[query] = Pair{static_cast<int>(a), static_cast<int>(b)};
        };
        for_each_view(scene, [&](const ViewState& view) {
            if (view.query) keep(*view.query);
        });
        for (const Bookmark& bookmark : scene.debug.bookmarks) keep(bookmark.query);
    }

    void agent_removed(int agent) {
        std::erase_if(pairs_, [&](const auto& each) { return each.second.a == agent || each.second.b == agent; });
        for (auto& [query, pair] : pairs_) {
            pair.a -= pair.a > agent ? 1 : 0;
            pair.b -= pair.b > agent ? 1 : 0;
        }
    }

    void renumber(Scene& scene) const {
        if (!implied_) return;
        renumber_queries(scene, queries_now(scene, 0));
    }

    /// Gives what was a query its index in a scene where the agents follow so many others; none: it is asked no more.
    /// Refers to this.
    std::function<std::optional<int>(int)> queries_now(const Scene& scene, int others) const {
        return [this, asked = AskedPairs(scene), others](int query) -> std::optional<int> {
            const auto pair = pairs_.find(query);
            if (pair == pairs_.end()) return std::nullopt;
            const auto index = asked.index_of(static_cast<std::size_t>(pair->second.a + others),
                                              static_cast<std::size_t>(pair->second.b + others));
            return index ? std::optional(static_cast<int>(*index)) : std::nullopt;
        };
    }

  private:
    struct Pair {
        int a = -1, b = -1;  ///< agents
    };
    bool implied_;
    std::map<int, Pair> pairs_;  ///< by the index of the query before the change
};

/// Behind what the scene has. `now` gives the other's queries their indices in the scene; bookmarks of those that the
/// scene does not ask are left out.
void merge_debug_state(Scene& scene, DebugState other, const std::function<std::optional<int>(int)>& now) {
    DebugState& debug = scene.debug;
    UnusedNames names(debug.filters);
    for (NamedFilter& filter : other.filters) {
        if (std::ranges::find(debug.filters, filter.where, &NamedFilter::where) != debug.filters.end()) continue;
        filter.name = names.take(filter.name);
        debug.filters.push_back(std::move(filter));
    }
    for (Breakpoint& breakpoint : other.breakpoints) {
        if (std::ranges::find(debug.breakpoints, breakpoint.where, &Breakpoint::where) == debug.breakpoints.end())
            debug.breakpoints.push_back(std::move(breakpoint));
    }
    for (Bookmark& bookmark : other.bookmarks) {
        const std::optional<int> query = now(bookmark.query);
        if (!query) continue;
        bookmark.query = *query;
        debug.bookmarks.push_back(std::move(bookmark));
    }
    UnusedNames view_names(debug.views);
    for (NamedView& named : other.views) {
        named.name = view_names.take(named.name);
        if (named.view.query) named.view.query = now(*named.view.query);
        debug.views.push_back(std::move(named));
    }
}

std::filesystem::path relative_source(const std::filesystem::path& source, const std::filesystem::path& from,
                                      const std::filesystem::path& to) {
    if (source.is_absolute()) return source;
    std::error_code gone;  // absolute names need no present folder
    const std::filesystem::path here = std::filesystem::current_path(gone);
    const std::filesystem::path led = (here / from / source).lexically_normal();
    const std::filesystem::path leads = led.lexically_proximate((here / to).lexically_normal());
    return leads.empty() ? led : leads;
}

void move_sources(Scene& scene, const std::filesystem::path& from, const std::filesystem::path& to) {
    for (SceneClip& clip : scene.clips) {
        if (clip.source) clip.source = relative_source(*clip.source, from, to).generic_string();
    }
}

}  // namespace

std::string UnusedNames::take(const std::string& wanted) {
    return taken_.insert(wanted).second ? wanted : take_numbered(wanted, 1);
}

std::string UnusedNames::take_next(const std::string& name) {
    const std::size_t space = name.rfind(' ');
    int number = 0;
    if (space != std::string::npos && space > 0) {
        const char* end = name.data() + name.size();
        const auto [read_to, error] = std::from_chars(name.data() + space + 1, end, number);
        if (error != std::errc() || read_to != end || number < 1 || number > kMostNumber) number = 0;
    }
    return number > 0 ? take_numbered(name.substr(0, space), number) : take_numbered(name, 1);
}

std::string UnusedNames::take_numbered(const std::string& stem, int last) {
    int& number = last_number_.try_emplace(stem, 1).first->second;
    number = std::max(number, last);
    std::string name;
    do {
        name = stem + ' ' + std::to_string(++number);
    } while (!taken_.insert(name).second);
    return name;
}

void add_agents_for_clips(Scene& scene) {
    if (!scene.agents.empty()) return;
    for (int clip = 0; clip < static_cast<int>(scene.clips.size()); ++clip) {
        const SceneClip& of = scene.clips[static_cast<std::size_t>(clip)];
        scene.agents.push_back({of.name, clip, {.start = of.start}, {}});
    }
}

void place_agent(Scene& scene, int agent, const mobb::Placement& placement) {
    check_placement(scene, agent_at(scene, agent).clip, placement);
    agent_at(scene, agent).placement = placement;
    change_sides(scene, agent, [&](PlacedAgent& side) { side.placement = placement; });
}

void rename_in_view(ViewState& view, const std::string& before, const std::string& name) {
    for (const ViewOption& option : view_options()) {
        if (option.names) std::ranges::replace(view.*option.names, before, name);
    }
    if (view.follow == before) view.follow = name;
}

void rename_agent(Scene& scene, int agent, const std::string& name) {
    if (trimmed(name).empty()) throw std::invalid_argument("an agent needs a name");
    for (int i = 0; i < static_cast<int>(scene.agents.size()); ++i) {
        if (i != agent && agent_at(scene, i).name == name) {
            throw std::invalid_argument("there is an agent " + in_quotes(name) + " already");
        }
    }
    const std::string before = std::exchange(agent_at(scene, agent).name, name);
    for_each_view(scene, [&](ViewState& view) { rename_in_view(view, before, name); });
    change_sides(scene, agent, [&](PlacedAgent& side) { side.name = name; });
}

int add_agent(Scene& scene, int clip, const mobb::Placement& placement) {
    check_placement(scene, clip, placement);
    add_agents_for_clips(scene);
    const std::string& wanted = scene.clips.at(static_cast<std::size_t>(clip)).name;
    const ImpliedQueries implied(scene);
    scene.agents.push_back({UnusedNames(scene.agents).take(wanted), clip, placement, {}});
    implied.renumber(scene);
    return static_cast<int>(scene.agents.size()) - 1;
}

int duplicate_agent(Scene& scene, int agent) {
    Agent copy = agent_at(scene, agent);
    copy.name = UnusedNames(scene.agents).take_next(copy.name);
    copy.color.reset();  // the palette tells the two apart
    const ImpliedQueries implied(scene);
    scene.agents.push_back(std::move(copy));
    implied.renumber(scene);
    return static_cast<int>(scene.agents.size()) - 1;
}

void remove_agent(Scene& scene, int agent) {
    if (scene.agents.size() == 1) throw std::invalid_argument("the last agent cannot be removed: a scene needs one");
    agent_at(scene, agent);
    ImpliedQueries implied(scene);
    scene.agents.erase(scene.agents.begin() + agent);
    implied.agent_removed(agent);
    const auto is_about_it = [&](const SceneQuery& query) { return query.a.agent == agent || query.b.agent == agent; };
    if (!scene.queries.empty()) {
        renumber_queries(scene, [&](int query) -> std::optional<int> {
            if (static_cast<std::size_t>(query) >= scene.queries.size()) return std::nullopt;
            const auto at = scene.queries.begin() + query;
            const auto before = std::count_if(scene.queries.begin(), at, is_about_it);
            return is_about_it(*at) ? std::nullopt : std::optional(query - static_cast<int>(before));
        });
    }
    std::erase_if(scene.queries, is_about_it);
    for_each_view(scene, [&](ViewState& view) {
        if (view.subtree && view.subtree->agent == agent) view.subtree.reset();
        if (view.subtree && view.subtree->agent > agent) --view.subtree->agent;
    });
    for (SceneQuery& query : scene.queries) {
        for (PlacedAgent* side : {&query.a, &query.b}) side->agent -= side->agent > agent ? 1 : 0;
    }
    implied.renumber(scene);
}

std::size_t add_query(Scene& scene, int a, int b) {
    if (a == b) throw std::invalid_argument("an agent cannot be queried against itself");
    if (are_apart(agent_at(scene, a), agent_at(scene, b)))
        throw std::invalid_argument("the two are on different floors, where they never meet");
    if (scene.queries.empty() && scene.agents.size() > 1) make_queries_explicit(scene);
    const auto side = [&](int agent) {
        const Agent& of = agent_at(scene, agent);
        return PlacedAgent{of.name, of.clip, of.placement, agent};
    };
    scene.queries.push_back({side(a), side(b), {}, {}});
    return scene.queries.size() - 1;
}

void remove_query(Scene& scene, std::size_t query) {
    make_queries_explicit(scene);
    if (scene.queries.size() <= 1)
        throw std::invalid_argument("the last query cannot be removed: without queries all pairs are asked");
    scene.queries.erase(scene.queries.begin() + static_cast<std::ptrdiff_t>(query));
    const int gone = static_cast<int>(query);
    renumber_queries(scene, [&](int each) -> std::optional<int> {
        return each == gone ? std::nullopt : std::optional(each - (each > gone ? 1 : 0));
    });
}

void make_queries_explicit(Scene& scene) {
    if (!scene.queries.empty()) return;
    std::vector<SceneQuery> queries;
    const std::size_t count = query_count(scene);
    queries.reserve(count);
    const AskedPairs pairs(scene);
    for (std::size_t i = 0; i < count; ++i) queries.push_back(query_at(scene, pairs, i));
    scene.queries = std::move(queries);
}

void drop_traces(Scene& scene) {
    for (SceneQuery& query : scene.queries) query.trace.reset();
}

void merge(Scene& scene, Scene other) {
    if (scene.clips.empty()) {
        scene = std::move(other);
        return;
    }
    for (const Scene* side : {&scene, &other}) {
        if (side->crowd || side->graph) {
            throw InputError(
                side->file.string(), "",
                std::string(side->crowd ? "a run" : "a motion graph") + " stands alone: open it by itself");
        }
    }
    // Bare clips are seen where they are; next to agents only agents are seen.
    if (!scene.agents.empty() || !other.agents.empty()) {
        add_agents_for_clips(scene);
        add_agents_for_clips(other);
    }
    if (!other.queries.empty()) make_queries_explicit(scene);
    move_sources(other, other.file.parent_path(), scene.file.parent_path());
    const ImpliedQueries implied(scene);
    const int first_clip = static_cast<int>(scene.clips.size());
    const int first_agent = static_cast<int>(scene.agents.size());
    const int first_query = static_cast<int>(scene.queries.size());
    const int first_drawn = scene.agents.empty() ? first_clip : first_agent;
    const bool other_is_implied = other.queries.empty();
    const ImpliedQueries implied_in_other(other);
    UnusedNames clip_names(scene.clips);
    for (SceneClip& clip : other.clips) {
        clip.name = clip_names.take(clip.name);
        scene.clips.push_back(std::move(clip));
    }
    UnusedNames agent_names(scene.agents);
    for (Agent& agent : other.agents) {
        agent.name = agent_names.take(agent.name);
        agent.clip += first_clip;
        scene.agents.push_back(std::move(agent));
    }
    for (SceneQuery& query : other.queries) {
        for (PlacedAgent* side : {&query.a, &query.b}) {
            side->clip += first_clip;
            if (side->agent >= 0) side->agent += first_agent;
            side->name = side->agent >= 0 ? agent_at(scene, side->agent).name
                                          : scene.clips[static_cast<std::size_t>(side->clip)].name;
        }
        scene.queries.push_back(std::move(query));
    }
    implied.renumber(scene);
    for_each_view(other, [&](ViewState& view) {
        if (view.subtree) view.subtree->agent += first_drawn;
    });
    const auto now = implied_in_other.queries_now(scene, first_agent);
    merge_debug_state(scene, std::move(other.debug), [&](int query) -> std::optional<int> {
        if (!other_is_implied) return first_query + query;
        return scene.queries.empty() ? now(query) : std::nullopt;
    });
}

void move_to_file(Scene& scene, const std::filesystem::path& file) {
    move_sources(scene, scene.file.parent_path(), file.parent_path());
    scene.file = file;
}

}  // namespace mobbscope
