#include <explain/query_sentence.h>
#include <import/skeleton/motion.h>
#include <render/layout/annotations.h>
#include <render/pictures/moment_caption.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <cstdio>

namespace mobbscope {

namespace {

/// The tip of a bone has no name of its own.
std::string joint_words(std::span<const Joint> joints, int index) {
    const Joint& joint = joints[static_cast<std::size_t>(index)];
    if (!joint.name.empty() || joint.parent < 0) return joint.name;
    return "the end of " + joints[static_cast<std::size_t>(joint.parent)].name;
}

std::string radius(const DrawnAgent& agent, const Body& body) {
    std::string text = "radius " + with_unit(body.disk.r, "m");
    if (!sets_radius(body)) return text;
    return text + ": as far as " + joint_words(agent.skeleton->joints, body.farthest->joint) + " reaches";
}

constexpr std::size_t kMostPairs = 3;

}  // namespace

Caption moment_caption(const Palette& palette, std::span<const DrawnAgent> agents, const Moment& moment,
                       std::size_t people) {
    Caption out;
    const std::string then = at_time(moment.time);
    const auto agent = [&](int body) -> const DrawnAgent& {
        return agents[static_cast<std::size_t>(moment.bodies[static_cast<std::size_t>(body)].agent)];
    };
    const auto both = [&](const BodyPair& pair) { return agent(pair.a).label + " and " + agent(pair.b).label; };
    const std::size_t count = moment.bodies.size();
    // There is always a detail, or the scene would jump while time runs.
    const auto add_detail = [&](const std::string& text) {
        out.detail += (out.detail.empty() ? "" : "  \u00B7  ") + text;
    };
    if (count < people) {
        add_detail(std::to_string(count) + " of " + std::to_string(people) + " are on the floor then");
    }
    if (count == 0) {
        out.headlines = {"Nobody is on the floor" + then};
    } else if (count == 1) {
        out.headlines = {agent(0).label + then};
        add_detail(radius(agent(0), moment.bodies.front()));
    } else if (moment.overlaps.size() > 1) {
        const std::string pairs = std::to_string(moment.overlaps.size()) + " pairs";
        out.headlines = {pairs + " of " + std::to_string(count) + " agents overlap" + then, pairs + " overlap" + then};
        std::string names;
        for (std::size_t i = 0; i < std::min(moment.overlaps.size(), kMostPairs); ++i) {
            names += (i == 0 ? "" : ", ") + both(moment.overlaps[i]);
        }
        add_detail(names + (moment.overlaps.size() > kMostPairs ? " ..." : ""));
        out.mark = palette.hit;
    } else if (moment.overlaps.size() == 1) {
        const BodyPair& pair = moment.overlaps.front();
        out.headlines = {both(pair) + " overlap" + then + " by " + with_unit(-pair.clearance, "m"),
                         both(pair) + " overlap" + then};
        out.mark = palette.hit;
    } else {
        const std::string clearance = with_unit(moment.nearest->clearance, "m") + " of clearance";
        const std::string all = std::to_string(count) + " agents" + then;
        if (count == 2) {
            out.headlines = {both(*moment.nearest) + then + "; " + clearance, clearance + then};
        } else {
            out.headlines = {all + "; nobody overlaps", all};
            add_detail("nearest: " + both(*moment.nearest) + ", " + clearance);
        }
        out.mark = palette.separated;
    }
    if (count == 2) {
        add_detail("radii " + with_unit(moment.bodies[0].disk.r, "m") + " and " +
                   with_unit(moment.bodies[1].disk.r, "m"));
    } else if (out.detail.empty()) {
        add_detail("all " + std::to_string(count) + " are on the floor then");
    }
    return out;
}

std::vector<LegendEntry> moment_legend(const Palette& palette, std::span<const DrawnAgent> agents,
                                       const ViewState& view) {
    std::vector<LegendEntry> out;
    // A crowd's colours only keep neighbours apart.
    if (names_fit(agents.size())) out = agent_entries(agents);
    const auto line = [&](Rgba color, float width, const char* text) {
        LegendEntry entry;
        entry.color = color;
        entry.width = width;
        entry.text = text;
        out.push_back(entry);
    };
    if (view.disks && agents.size() > 1) line(palette.hit, 3, "overlap");
    if (view.disks && may_show_radii(agents)) line(palette.text, 1.4f, "radius, to the farthest joint");
    const bool is_run = !agents.empty() && agents.front().run_agent >= 0;
    if (view.floor && !(is_run && agents.size() > kMostWithWays)) {
        line(palette.quiet_text, 2.6f, "way so far");
        line(with_alpha(palette.quiet_text, 0.6f), 1.2f, "way ahead");
    }
    return out;
}

bool may_show_radii(std::span<const DrawnAgent> agents) {
    return agents.size() <= 2 &&
           std::any_of(agents.begin(), agents.end(), [](const DrawnAgent& s) { return s.skeleton != nullptr; });
}

}  // namespace mobbscope
