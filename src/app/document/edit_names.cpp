#include <app/document/edit_names.h>
#include <base/text.h>
#include <scene/view_options.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

std::string seconds_in_words(double seconds) { return formatted("%.2f s", seconds); }

std::string words_of_step(const Step& step) {
    switch (step.unit) {
        case Step::Unit::event:
            return formatted("%.0f", step.value);
        case Step::Unit::percent:
            return formatted("%.0f %%", step.value);
        case Step::Unit::end:
            return "the last";
        case Step::Unit::separated:
        case Step::Unit::overlap:
        case Step::Unit::hit:
        case Step::Unit::avoidable:
        case Step::Unit::leaf:
        case Step::Unit::depth:
            break;
    }
    return to_string(step);
}

std::string words_of_levels(const LevelRange& levels) {
    if (levels.leaves) return "the leaves";
    return (levels.first == levels.last ? "level " : "levels ") + to_string(levels);
}

/// "hiding C", "showing 3 agents again".
std::string words_of_names(const ViewOption& option, const ViewState& from, const ViewState& to) {
    const auto only_in = [](const std::vector<std::string>& names, const std::vector<std::string>& others) {
        std::vector<std::string> out;
        std::ranges::copy_if(names, std::back_inserter(out),
                             [&](const std::string& name) { return std::ranges::find(others, name) == others.end(); });
        return out;
    };
    const std::vector<std::string> added = only_in(to.*option.names, from.*option.names);
    const std::vector<std::string> gone = only_in(from.*option.names, to.*option.names);
    const bool hides = option.names == &ViewState::hidden;
    // Showing one alone also brings others back.
    const std::vector<std::string>& whom = added.empty() ? gone : added;
    const std::string who = whom.size() == 1 ? whom.front() : counted(whom.size(), "agent", "agents");
    if (option.names == &ViewState::foreground) {
        if (to.foreground.empty()) return "everybody in full again";
        return added.empty() ? who + " no longer in the foreground" : "bringing " + who + " into the foreground";
    }
    if (!added.empty()) return (hides ? "hiding " : "pinning ") + who;
    return hides ? "showing " + who + " again" : "no longer pinning " + who;
}

std::string words_of_option(const ViewOption& option, const ViewState& from, const ViewState& to) {
    if (option.names) return words_of_names(option, from, to);
    std::string title(option.title);
    title[0] = lower_letter(title[0]);
    if (option.toggle) return title + (to.*option.toggle ? ": on" : ": off");
    return title + ": " + option.text(to);
}

std::string words_of_query(const Document& from, const ViewState& to) {
    if (!to.query) return "closing the query";
    const SceneQuery query = from.fitted->queries()[static_cast<std::size_t>(*to.query)];
    return "showing " + query.a.name + " against " + query.b.name;
}

}  // namespace

EditName name_of_placing(const std::string& agent, const mobb::Placement& before, const mobb::Placement& after) {
    std::vector<std::string> values;
    const char* doing = "placing ";
    std::string parts;
    const auto note = [&](bool differs, const char* does, const std::string& part, const std::string& value) {
        if (!differs) return;
        // More than one thing is placing.
        doing = values.empty() || doing == std::string_view(does) ? does : "placing ";
        values.push_back(value);
        parts += ' ' + part;
    };
    note(after.translate.x != before.translate.x, "moving ", "x", formatted("x %.2f m", after.translate.x));
    note(after.translate.y != before.translate.y, "moving ", "y", formatted("y %.2f m", after.translate.y));
    note(after.rotate_deg != before.rotate_deg, "turning ", "turned",
         formatted("%.1f\u00B0", static_cast<double>(after.rotate_deg)));
    note(after.start != before.start, "shifting ", "start", "starts at " + seconds_in_words(after.start));
    std::string title = doing + agent;
    for (const std::string& value : values) title += (&value == &values.front() ? ": " : ", ") + value;
    return {title, "placing " + agent + parts};
}

EditName name_of_looking(const Document& from, const ViewState& to) {
    const ViewState& was = from.view;
    const auto only = [&](auto... members) {
        ViewState view = was;
        ((view.*members = to.*members), ...);
        return view == to;
    };
    if (was.levels != to.levels) return {"showing " + words_of_levels(to.levels), "look levels"};
    if (was.query != to.query) return {words_of_query(from, to), "look query"};
    if (was.show != to.show) {
        const char* const title = to.show == Show::moment ? "showing the moment"
                                  : to.show == Show::plan ? "showing the floor plan"
                                                          : "showing space-time";
        return {title, "look subject"};
    }
    if (was.projection != to.projection) {
        return {to.projection ? "showing a disk along its box's axes" : "showing space-time", "look subject"};
    }
    if (only(&ViewState::camera, &ViewState::time_height)) return {"moving the view", "look camera"};
    if (only(&ViewState::step)) return {"stepping to " + words_of_step(to.step), "look step"};
    if (only(&ViewState::time)) {
        return {to.time ? "moving in time to " + seconds_in_words(*to.time) : "taking the time cursor away",
                "look time"};
    }
    if (only(&ViewState::slab)) return {to.slab ? "showing a slab in time" : "showing all of time", "look slab"};
    if (only(&ViewState::color_range)) {
        return {"colour range: " + view_option("color_range").text(to), "look color_range"};
    }
    if (only(&ViewState::follow, &ViewState::camera, &ViewState::time_height, &ViewState::time)) {
        return {to.follow.empty() ? "no longer following" : "following " + to.follow, "look follow"};
    }
    for (const ViewOption& option : view_options()) {
        if ((option.title.empty() && !option.names) || option.same(was, to)) continue;
        const std::string title = words_of_option(option, was, to);
        // Who is hidden one after the other comes back one after the other.
        return {title, "look " + (option.names ? title : std::string(option.key))};
    }
    return {"what is shown", "look other"};
}

}  // namespace mobbscope::app
