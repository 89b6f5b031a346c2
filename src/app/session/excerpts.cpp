#include <app/session/excerpts.h>

#include <scene/crowd_run.h>
#include <scene/drawn_agent.h>
#include <scene/scene_edits.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

/// What is played on the way to a clip.
SceneClip joint_to(const SceneClip& to, const mobb::ClipPtr& joint) {
    return {"joint to " + to.name, std::nullopt, {}, joint};
}

Color in_bytes(const Rgba& color) {
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(255 * c)); };
    return {byte(color.r), byte(color.g), byte(color.b)};
}

}  // namespace

void Excerpts::open(const PlacedAgent& a, const PlacedAgent& b) {
    const auto side = [&](const PlacedAgent& who) {
        return Side{who.name, workspace_.fitted().scene().clips[static_cast<std::size_t>(who.clip)], who.placement};
    };
    open(side(a), side(b), query_colors(workspace_.fitted().scene(), a, b));
}

void Excerpts::open_conflict(const SceneConflict& of) {
    const auto side = [&](const PlacedAgent& who, const mobb::ClipPtr& joint) {
        const SceneClip& clip = workspace_.scene().clips[static_cast<std::size_t>(who.clip)];
        return Side{who.name, joint ? joint_to(clip, joint) : clip, who.placement};
    };
    // Of a run the first agents that are drawn are its people.
    const CrowdRun* run = workspace_.crowd();
    std::optional<Expectation> expect;
    if (run && !was_forced(*run, of)) expect = Expectation{false, {}};
    open(side(of.a, of.a_joint), side(of.b, of.b_joint), query_colors(workspace_.fitted().scene(), of.a, of.b), expect);
}

void Excerpts::open_candidate(int candidate) {
    const FollowedChoice* followed = crowds_.choice();
    const std::vector<Candidate> none;
    const std::vector<Candidate>& asked_for = followed ? followed->choice.candidates : none;
    if (candidate < 0 || candidate >= static_cast<int>(asked_for.size()) ||
        !asked_for[static_cast<std::size_t>(candidate)].blocker) {
        throw std::invalid_argument("no agent rules this candidate out: choose one that meets an agent");
    }
    const Candidate& asked = asked_for[static_cast<std::size_t>(candidate)];
    const Blocker& blocker = *asked.blocker;
    // Moves that are turned but not played are none of the run's graph.
    const auto [scene, index] = workspace_.derived().moves->extended(std::array{asked.played, blocker.move});
    const auto clip_of = [&, &run = scene, &at = index](int move) {
        const int clip = run.graph->moves[static_cast<std::size_t>(at[static_cast<std::size_t>(move)])].clip;
        return run.clips[static_cast<std::size_t>(clip)];
    };
    Side a{workspace_.view().follow, clip_of(asked.played), asked.placement};
    if (blocker.before_candidate) {
        a.clip = joint_to(a.clip, asked.joint->clip);
        a.placement = asked.joint->placement;
    }
    Side b{workspace_.crowd()->agents[static_cast<std::size_t>(blocker.agent)].name, clip_of(blocker.move),
           blocker.placement};
    if (blocker.is_joint) b.clip = joint_to(b.clip, blocker.clip);
    const auto person = [](int agent) {
        PlacedAgent out;
        out.agent = agent;
        return out;
    };
    const int follows = *run_agent_by_name(*workspace_.crowd(), a.name);
    open(std::move(a), std::move(b), query_colors(workspace_.fitted().scene(), person(follows), person(blocker.agent)));
}

void Excerpts::open(Side a, Side b, const std::array<Rgba, 2>& colors, const std::optional<Expectation>& expect) {
    jobs_.require_none();
    const bool same_clip = a.clip.clip == b.clip.clip;
    if (b.name == a.name) b.name += " (2)";
    // Of a run two plays of one move may run on to different ones.
    if (b.clip.name == a.clip.name) b.clip.name += " (2)";
    Scene excerpt;
    excerpt.file = workspace_.scene().file;
    excerpt.fit = workspace_.document().fitted->options();
    excerpt.agents.push_back({a.name, 0, a.placement, in_bytes(colors[0])});
    excerpt.agents.push_back({b.name, same_clip ? 0 : 1, b.placement, in_bytes(colors[1])});
    excerpt.clips.push_back(std::move(a.clip));
    if (!same_clip) excerpt.clips.push_back(std::move(b.clip));
    // Bookmarks are of the whole's queries; the rest holds of any.
    excerpt.debug.filters = workspace_.scene().debug.filters;
    excerpt.debug.breakpoints = workspace_.scene().debug.breakpoints;
    excerpt.view.theme = workspace_.view().theme;
    excerpt.view.query = 0;
    if (expect) {
        make_queries_explicit(excerpt);
        excerpt.queries.front().expect = expect;
    }
    Document next = document_of(std::move(excerpt), workspace_.document().fitted.get());
    const Document& now = workspace_.document();
    // An excerpt of an excerpt is of the same whole.
    ExcerptSource source =
        now.excerpt_of ? *now.excerpt_of : ExcerptSource{now.fitted,  now.view,   {},        now.steps,
                                                         now.opening, now.beside, now.place, now.links};
    source.saved = next.fitted;
    next.excerpt_of = std::make_shared<const ExcerptSource>(std::move(source));
    next.opening = ++counts_.openings;
    turn_away();
    workspace_.history.change(std::move(next), {"opening " + a.name + " against " + b.name, ""});
    workspace_.changed();
}

void Excerpts::turn_away() {
    playback_.stop();
    workspace_.selection = workspace_.hovered = {};
    workspace_.measuring = {};  // where other things stand
    workspace_.filter.clear();
    workspace_.other_cameras.clear();
}

void Excerpts::leave() {
    jobs_.require_none();
    const std::shared_ptr<const ExcerptSource> origin = workspace_.document().excerpt_of;
    turn_away();
    Document whole = whole_of(*origin);
    DebugState debug = whole.fitted->scene().debug;
    debug.filters = workspace_.scene().debug.filters;
    debug.breakpoints = workspace_.scene().debug.breakpoints;
    if (debug != whole.fitted->scene().debug) {
        Scene scene = whole.fitted->scene();
        scene.debug = std::move(debug);
        whole = with_scene(whole, std::move(scene));
    }
    workspace_.history.change(std::move(whole), {"going back to the whole", ""});
    ++counts_.restores;
    workspace_.changed();
}

}  // namespace mobbscope::app
