#include <base/error.h>
#include <base/text.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

/// Behind a name; more is part of the name itself.
constexpr int kMostNumber = 999'999;

Agent& agent_at(Scene& scene, int agent) { return scene.agents.at(static_cast<std::size_t>(agent)); }

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

/// Keeps the query in the view while agents change: where all pairs of agents are queries, their indices change too. It
/// is made before the change; `restore` then shows the same pair again, or no query if one of the two is gone.
class PairInView {
  public:
    explicit PairInView(const Scene& scene) {
        const std::optional<int> query = scene.view.query;
        if (!query || !scene.queries.empty() || static_cast<std::size_t>(*query) >= query_count(scene)) return;
        const SceneQuery shown = query_at(scene, static_cast<std::size_t>(*query));
        a_ = shown.a.agent;
        b_ = shown.b.agent;
        any_ = true;
    }

    void agent_removed(int agent) {
        gone_ = gone_ || a_ == agent || b_ == agent;
        a_ -= a_ > agent ? 1 : 0;
        b_ -= b_ > agent ? 1 : 0;
    }

    void restore(Scene& scene) const {
        if (!any_) return;
        scene.view.query.reset();
        if (gone_) return;
        scene.view.query =
            static_cast<int>(query_of_pair(scene, static_cast<std::size_t>(a_), static_cast<std::size_t>(b_)));
    }

  private:
    bool any_ = false;
    int a_ = -1, b_ = -1;  ///< the agents of the query in the view
    bool gone_ = false;
};

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
        scene.agents.push_back({scene.clips[static_cast<std::size_t>(clip)].name, clip, {}, {}});
    }
}

void place_agent(Scene& scene, int agent, const mobb::Placement& placement) {
    if (!mobb::is_valid(placement)) throw std::invalid_argument("a placement is too far away or not a number");
    agent_at(scene, agent).placement = placement;
    change_sides(scene, agent, [&](PlacedAgent& side) { side.placement = placement; });
}

void rename_in_view(ViewState& view, const std::string& before, const std::string& name) {
    std::ranges::replace(view.hidden, before, name);
    std::ranges::replace(view.pinned, before, name);
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
    rename_in_view(scene.view, before, name);
    change_sides(scene, agent, [&](PlacedAgent& side) { side.name = name; });
}

int add_agent(Scene& scene, int clip, const mobb::Placement& placement) {
    if (!mobb::is_valid(placement)) throw std::invalid_argument("a placement is too far away or not a number");
    add_agents_for_clips(scene);
    const std::string& wanted = scene.clips.at(static_cast<std::size_t>(clip)).name;
    const PairInView shown(scene);
    scene.agents.push_back({UnusedNames(scene.agents).take(wanted), clip, placement, {}});
    shown.restore(scene);
    return static_cast<int>(scene.agents.size()) - 1;
}

int duplicate_agent(Scene& scene, int agent) {
    Agent copy = agent_at(scene, agent);
    copy.name = UnusedNames(scene.agents).take_next(copy.name);
    copy.color.reset();  // the palette tells the two apart
    const PairInView shown(scene);
    scene.agents.push_back(std::move(copy));
    shown.restore(scene);
    return static_cast<int>(scene.agents.size()) - 1;
}

void remove_agent(Scene& scene, int agent) {
    if (scene.agents.size() == 1) throw std::invalid_argument("the last agent stays: a scene needs one");
    agent_at(scene, agent);
    PairInView shown(scene);
    scene.agents.erase(scene.agents.begin() + agent);
    shown.agent_removed(agent);
    const auto is_about_it = [&](const SceneQuery& query) { return query.a.agent == agent || query.b.agent == agent; };
    std::optional<int>& in_view = scene.view.query;
    if (in_view && static_cast<std::size_t>(*in_view) < scene.queries.size()) {
        const auto at = scene.queries.begin() + *in_view;
        const auto before = std::count_if(scene.queries.begin(), at, is_about_it);
        in_view = is_about_it(*at) ? std::nullopt : std::optional(*in_view - static_cast<int>(before));
    }
    std::erase_if(scene.queries, is_about_it);
    for (SceneQuery& query : scene.queries) {
        for (PlacedAgent* side : {&query.a, &query.b}) side->agent -= side->agent > agent ? 1 : 0;
    }
    shown.restore(scene);
}

std::size_t add_query(Scene& scene, int a, int b) {
    if (a == b) throw std::invalid_argument("an agent is not asked against itself");
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
    if (scene.queries.size() <= 1) throw std::invalid_argument("the last query stays: without any all pairs are asked");
    scene.queries.erase(scene.queries.begin() + static_cast<std::ptrdiff_t>(query));
}

void make_queries_explicit(Scene& scene) {
    if (!scene.queries.empty()) return;
    std::vector<SceneQuery> queries;
    const std::size_t count = query_count(scene);
    queries.reserve(count);
    for (std::size_t i = 0; i < count; ++i) queries.push_back(query_at(scene, i));
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
    const PairInView shown(scene);
    const int first_clip = static_cast<int>(scene.clips.size());
    const int first_agent = static_cast<int>(scene.agents.size());
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
    shown.restore(scene);
}

void move_to_file(Scene& scene, const std::filesystem::path& file) {
    move_sources(scene, scene.file.parent_path(), file.parent_path());
    scene.file = file;
}

}  // namespace mobbscope
