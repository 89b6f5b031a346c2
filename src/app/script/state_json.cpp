#include <app/commands/picture_order.h>
#include <app/script/state_json.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/reasons.h>
#include <render/drawlist/font.h>
#include <render/pictures/candidates.h>
#include <scene/fit_text.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// Of a run all but what everybody plays.
Json scene_json(Scene scene) {
    scene.crowd.reset();
    scene.view = {};
    for (SceneQuery& query : scene.queries) query.trace.reset();
    std::vector<int> counts;
    for (const SceneClip& clip : scene.clips) counts.push_back(clip.clip->count());
    Json json = Json::parse(to_json(scene));
    std::size_t index = 0;
    for (Json& clip : json["clips"]) clip["samples"] = counts[index++];
    json.erase("mobbscope");
    return json;
}

Json view_json(const ViewState& view) {
    std::ostringstream text;
    JsonWriter out(text);
    write_view(out, view);
    return Json::parse(text.str());
}

std::string name_of(const Workspace& workspace, const Selection& selection) {
    const auto index = static_cast<std::size_t>(selection.index);
    switch (selection.kind) {
        case Selection::Kind::none:
            return "";
        case Selection::Kind::clip:
            return workspace.scene().clips[index].name;
        case Selection::Kind::query: {
            const SceneQuery query = workspace.fitted().queries()[index];
            return query.a.name + " against " + query.b.name;
        }
        case Selection::Kind::path:
        case Selection::Kind::node:
        case Selection::Kind::sample:
            break;
    }
    return placed_agent_of(workspace.fitted(), selection.path)->name;
}

Json selection_json(const Workspace& workspace, const Selection& selection) {
    Json json{{"kind", kSelectionKinds[static_cast<std::size_t>(selection.kind)]}};
    if (selection.kind == Selection::Kind::none || !exists(workspace.fitted(), selection)) return json;
    json["name"] = name_of(workspace, selection);
    if (selection.on_path()) {
        const AgentRef& path = selection.path;
        json["path"] = {{"participant", path.agent}, {"query", path.query}, {"side", path.side}};
    }
    if (selection.kind != Selection::Kind::path) json["index"] = selection.index;
    if (selection.kind == Selection::Kind::node && workspace.blame()) {
        const int clip = placed_agent_of(workspace.fitted(), selection.path)->clip;
        json["to_blame"] = workspace.blame()->of(clip, selection.index);
    }
    return json;
}

Json proof_json(const Workspace& workspace, const QueryProof& proof) {
    Json json{{"lines", proof.lines.size()}, {"tightest", or_null(proof.tightest)}, {"line", nullptr}};
    if (const auto& time = workspace.view().time) json["line"] = or_null(proof.at(*time));
    return json;
}

/// The list of events, and how often breakpoints hold; null where the query has made no test.
Json events_json(const Workspace& workspace, const QueryInspector& queries, bool shown) {
    if (workspace.recorded()->trace.empty()) return nullptr;
    const EventList& list = workspace.events;
    return {{"shown", shown},
            {"filter", list.filter ? Json(list.filter->text()) : Json(nullptr)},
            {"listed", queries.listed_events()->size()},
            {"sort", column_name(list.by)},
            {"descending", list.descending},
            {"breaks", queries.break_steps().size()}};
}

/// What the query is compared with, and where the two sides part.
Json compare_json(const Workspace::CompareWith& with, const Workspace& workspace, const QueryInspector& queries) {
    if (const auto other = queries.comparison()) {
        return {{"with", fit_text(*with.fit, workspace.fitted().options())},
                {"times", other->traversals.times.size()},
                {"tests", other->recorded.tests.all()}};
    }
    if (!queries.stored_trace()) return {{"with", "stored"}, {"agrees", nullptr}};
    const TraceCheck& check = queries.stored_check();
    return {{"with", "stored"},
            {"agrees", check.agrees()},
            {"difference", check.difference ? Json(check.difference->step) : Json(nullptr)}};
}

Json query_json(const Workspace& workspace, const QueryInspector& queries, const Settings& settings) {
    const RecordedQuery* recorded = workspace.recorded();
    if (!recorded) return nullptr;
    const int index = *workspace.view().query;
    const SceneQuery query = workspace.fitted().queries()[static_cast<std::size_t>(index)];
    Json tests = Json::object();
    for (const mobb::TestKind test : mobb::kTestKinds)
        if (recorded->tests[test] > 0) tests[mobb::name(test)] = recorded->tests[test];
    const mobb::Trace::Event event = recorded->trace[workspace.step()];
    const std::vector<DrawnAgent> sides = drawn_agents(workspace.fitted(), workspace.view());
    Json json{{"index", index},
              {"a", query.a.name},
              {"b", query.b.name},
              {"collides", recorded->contact.has_value()},
              {"contact_time", recorded->contact ? Json(recorded->contact->time) : Json(nullptr)},
              {"step", workspace.step()},
              {"steps", recorded->trace.size()},
              {"tests", std::move(tests)},
              {"outcome", mobb::name(event.outcome)},
              {"proof", proof_json(workspace, queries.findings()->proof)},
              {"sentence", step_sentence(sides, recorded->trace, workspace.step())},
              {"events", events_json(workspace, queries, settings.bottom_tab == BottomTab::events)}};
    if (const auto& with = workspace.compare_with) json["compare"] = compare_json(*with, workspace, queries);
    if (recorded->trace.stopped()) json["all_events"] = recorded->trace.events();
    return json;
}

/// Which part of the query is looked at, and what is pointed out in it.
Json look_json(const Workspace& workspace, const QueryInspector& queries) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    if (!findings || findings->recursion.pairs.empty()) return nullptr;
    const QueryLook& look = workspace.look;
    Json json{{"hovered_event", workspace.hovered_event < 0 ? Json(nullptr) : Json(workspace.hovered_event)},
              {"ended", ended_words(findings->sides, findings->recursion, workspace.step())},
              {"focus", {{"branch", nullptr}, {"time", nullptr}, {"tests", queries.counts_in_all().tests.all()}}},
              {"zoom", nullptr},
              {"reasons", nullptr}};
    if (look.focus.branch) {
        json["focus"]["branch"] = findings->recursion.pairs[static_cast<std::size_t>(*look.focus.branch)].last;
    }
    if (look.focus.time) json["focus"]["time"] = {look.focus.time->t0, look.focus.time->t1};
    if (look.zoom) json["zoom"] = {look.zoom->first, look.zoom->end - 1};
    if (const std::optional<PlaceReasons> found = queries.reasons()) {
        Json steps = Json::array();
        for (const int pair : found->pairs) {
            steps.push_back(findings->recursion.pairs[static_cast<std::size_t>(pair)].last);
        }
        json["reasons"] = {{"of", found->of}, {"steps", std::move(steps)}};
    }
    return json;
}

/// The table of the tree in focus.
Json nodes_json(const NodeInspector& nodes) {
    const int selected = nodes.selected();
    return {{"filter", nodes.filter ? Json(nodes.filter->text()) : Json(nullptr)},
            {"listed", nodes.listed()->size()},
            {"sort", info(nodes.by).name},
            {"descending", nodes.descending},
            {"selected", selected < 0 ? Json(nullptr) : Json(selected)}};
}

Json crowd_json(const Workspace& workspace, const CrowdInspector& crowds) {
    if (!is_crowd(workspace)) return nullptr;
    Json json{{"following", text_or_null(workspace.view().follow)}, {"choice", nullptr}, {"conflicts", nullptr}};
    if (const FollowedChoice* followed = crowds.choice()) {
        const Choice& choice = followed->choice;
        json["choice"] = {{"play", followed->play},
                          {"time", choice.time},
                          {"candidates", choice.candidates.size()},
                          {"taken", choice.taken},
                          {"comes_out", followed->comes_out},
                          {"pointed_out", crowds.candidate()},
                          {"sentence", choice_sentence(workspace.scene(), *followed)}};
    }
    if (const auto* conflicts = crowds.conflicts()) {
        json["conflicts"] = {{"count", conflicts->size()}, {"shown", workspace.conflict}};
        if (const auto doubts = doubts_in(workspace.scene()); !doubts.empty()) json["conflicts"]["warnings"] = doubts;
    }
    return json;
}

/// Null where its panel is folded, or no query is in view.
Json map_json(const MapInspector& maps) {
    const std::shared_ptr<const PlacementMap> map = maps.map();
    if (!maps.is_shown || !maps.can_be() || !map) return nullptr;
    const MapOrder& order = map->order;
    const auto range = [](const MapRange& of) { return Json{{"from", of.from}, {"to", of.to}}; };
    const glm::dvec2 at = maps.place_of_b(*map);
    Json json{{"show", name(order.show)},
              {"over", {{name(order.across.axis), range(order.across)}, {name(order.up.axis), range(order.up)}}},
              {"hits", map->hit_count()},
              {"place", {at.x, at.y}},
              {"range", nullptr}};
    if (const auto& colors = maps.choice.colors) json["range"] = {colors->first, colors->second};
    return json;
}

Json messages_json(const Notifications& notifications) {
    constexpr std::array<const char*, 3> kLevels{"info", "warning", "error"};
    Json json = Json::array();
    for (const Message& message : notifications.all()) {
        Json one{{"level", kLevels[static_cast<std::size_t>(message.level)]}, {"text", message.text}};
        if (!message.offers.empty()) one["offer"] = message.offers.front().command;
        if (!message.up) one["put_away"] = true;
        json.push_back(std::move(one));
    }
    return json;
}

/// The clip in the import dialog: what is taken of its file by itself, and what was refused.
Json import_json(const Imports& imports, const Workspace& workspace) {
    const ClipImport& now = imports.edited;
    Json taken = Json::object();
    if (now.offer) {
        for (const OptionOffer& option : now.offer->options) taken[option.key] = text_or_null(option.taken);
    }
    Json refused = Json::object();
    for (const auto& [option, refusal] : now.refused) refused[option] = refusal.why;
    return {{"clip", workspace.scene().clips[static_cast<std::size_t>(now.clip)].name},
            {"field", text_or_null(now.field)},
            {"whole_file", now.whole_file},
            {"taken", std::move(taken)},
            {"refused", std::move(refused)}};
}

/// The export dialog: what it is asked for, by the options' keys, the file, and what a film will be.
Json export_json(const Session& session) {
    const ExportDialog& dialog = session.dialogs.exporting;
    Json json{{"file", dialog.file}};
    for (const ExportOption& option : export_options()) {
        json[option.key] = option.text(session.settings.picture_export);
    }
    if (dialog.temporary) json["temporary_scene"] = dialog.temporary->file.string();
    const PictureOrder order =
        ordered_for(export_file(session.workspace, session.settings, session.dialogs),
                    order_to_export(session.settings, session.workspace, session.views), session.settings);
    if (!order.film || session.workspace.empty()) return json;
    try {
        json["length"] = film_text(session.workspace, order);
    } catch (const std::invalid_argument& error) {
        json["length"] = error.what();
    }
    return json;
}

// --- what is expected of it

constexpr std::size_t kLongestText = 200;  // characters of what a message repeats

constexpr double kRelative = 1e-9;

bool agree(const Json& a, const Json& b) {
    if (a.is_number() && b.is_number()) {
        const double x = a.get<double>();
        const double y = b.get<double>();
        return std::abs(x - y) <= kRelative * std::max(std::abs(x), std::abs(y));
    }
    if (a.type() != b.type() || a.size() != b.size()) return false;
    if (a.is_array()) return std::equal(a.begin(), a.end(), b.begin(), agree);
    if (a.is_object()) {
        return std::all_of(a.items().begin(), a.items().end(), [&](const auto& item) {
            return b.contains(item.key()) && agree(item.value(), b[item.key()]);
        });
    }
    return a == b;
}

/// Null if there is nothing.
Json value_at(const Session& session, const Json::json_pointer& pointer) {
    const Json state = state_json(session);
    return state.contains(pointer) ? state.at(pointer) : Json(nullptr);
}

Json parse_value(std::string_view text) {
    Json value = Json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        throw std::invalid_argument(in_quotes(std::string(text)) + " is not JSON; texts stand in double quotes");
    }
    return value;
}

Json::json_pointer parse_pointer(const std::string& text) {
    try {
        return Json::json_pointer(text);
    } catch (const Json::exception&) {
        throw std::invalid_argument(in_quotes(text) + " is not a JSON pointer; write it like /query/collides");
    }
}

/// Takes the first word off a text; one in double quotes may hold blanks.
std::string_view take_word(std::string_view& text) {
    const bool quoted = text.starts_with('"');
    if (quoted) text.remove_prefix(1);
    const std::size_t end = std::min(text.find_first_of(quoted ? "\"" : " \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + (quoted ? 1 : 0), text.size()));
    text = trimmed(text);
    return word;
}

double take_number(std::string_view& text, const char* what) {
    if (text.empty()) throw std::invalid_argument(std::string("it needs ") + what);
    const std::string_view word = take_word(text);
    const std::optional<double> value = parse_double(word);
    if (!value) {
        throw std::invalid_argument(in_quotes(std::string(word)) + " is not a number: it needs " + what);
    }
    return *value;
}

std::string instead(const std::string& pointer, const Json& is, const std::string& expected) {
    return shortened(pointer, kLongestText) + " is " + shortened(state_text(is), kLongestText) + ", expected " +
           shortened(expected, kLongestText);
}

/// What a sweep says, as `mobbscope sweep` does. Null where none has ended for the scene as it is.
Json sweep_json(const SweepInspector& sweeps) {
    const auto shown = sweeps.result();
    if (!shown || !shown->rows->has_ended() || !sweeps.is_of_scene()) return nullptr;
    const auto fit = [&](std::size_t row) { return fit_text(shown->rows->rows[row].fit, {}); };
    Json json;
    for (const Protocol protocol : kProtocols) {
        const SweepAdvice& advice = shown->rows->of(protocol);
        Json& of = json[name(protocol)];
        of["recommended"] = advice.recommended ? Json(fit(*advice.recommended)) : Json(nullptr);
        of["undecided"] = Json::array();
        for (const std::size_t row : advice.undecided) of["undecided"].push_back(fit(row));
        of["why"] = advice.why;
    }
    return json;
}

}  // namespace

Json state_json(const Session& session) {
    Json json;
    json["title"] = session.workspace.title();
    json["file"] = session.workspace.file ? Json(session.workspace.file->string()) : Json(nullptr);
    json["modified"] = session.workspace.modified();
    json["empty"] = session.workspace.empty();
    json["scene"] = scene_json(session.workspace.scene());
    json["view"] = view_json(session.workspace.view());
    json["selection"] = selection_json(session.workspace, session.workspace.selection);
    json["hovered"] = selection_json(session.workspace, session.workspace.hovered);
    if (const Measuring& measuring = session.workspace.measuring; !measuring.is_nothing()) {
        json["measuring"] = {{"picks", measuring.picks}};
        if (measuring.from) json["measuring"]["from"] = measuring.from->what;
        if (const auto line = measuring.line()) json["measuring"]["line"] = text_of(*line);
    }
    json["query"] = query_json(session.workspace, session.queries, session.settings);
    if (Json look = look_json(session.workspace, session.queries); !look.is_null()) json["look"] = std::move(look);
    if (!session.workspace.empty() && session.settings.bottom_tab == BottomTab::nodes)
        json["nodes"] = nodes_json(session.nodes);
    json["crowd"] = crowd_json(session.workspace, session.crowds);
    if (Json map = map_json(session.maps); !map.is_null()) json["map"] = std::move(map);
    if (Json sweep = sweep_json(session.sweeps); !sweep.is_null()) json["sweep"] = std::move(sweep);
    json["excerpt"] = session.workspace.in_excerpt();
    json["time"] = or_null(session.workspace.view().time);
    json["playing"] = session.playback.playing();
    json["dialog"] = session.dialogs.name();
    if (!session.keys.focus.empty()) json["focus"] = session.keys.focus;
    json["messages"] = messages_json(session.notifications);
    if (session.notifications.unread() > 0) json["unread"] = session.notifications.unread();
    json["undo"] = text_or_null(session.workspace.history.undo_title());
    json["redo"] = text_or_null(session.workspace.history.redo_title());
    json["previous_view"] = text_or_null(session.workspace.history.look_back_title());
    json["next_view"] = text_or_null(session.workspace.history.look_forward_title());
    json["job"] = nullptr;
    if (const Job* job = session.jobs.job()) json["job"] = {{"title", job->title()}, {"progress", job->progress()}};
    if (session.dialogs.now == Dialog::import_clip) json["import"] = import_json(session.imports, session.workspace);
    if (session.dialogs.now == Dialog::export_picture) json["export"] = export_json(session);
    for (const auto& screen : session.screens) screen->add_state(json);
    if (session.views.count() > 1) {
        json["links"] = Json::object();
        for (const ViewLink& link : kViewLinks) json["links"][link.name] = session.workspace.document().links.*link.on;
        json["views"] = Json::array();
        for (std::size_t place = 0; place < session.views.count(); ++place) {
            const SceneView seen = session.views.at(place);
            json["views"].push_back({{"active", place == session.views.active()},
                                     {"fit", seen.fitted->fits()[seen.fitted->fit_in_use()]->name},
                                     {"tree", mobb::name(seen.fitted->options().tree)},
                                     {"view", view_json(seen.view)}});
        }
    }
    return json;
}

std::string state_text(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

ScriptExpectation parse_expectation(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) throw std::invalid_argument("it needs a JSON pointer and a value");
    const std::string name(take_word(text));
    const Json::json_pointer pointer = parse_pointer(name);
    if (text.starts_with("~ ")) {
        text = trimmed(text.substr(2));
        const double number = take_number(text, "a number behind ~");
        const double tolerance = take_number(text, "a tolerance");
        if (!text.empty()) throw std::invalid_argument(in_quotes(std::string(text)) + " is too much here");
        return [=](const Session& session) -> std::optional<std::string> {
            const Json is = value_at(session, pointer);
            if (is.is_number() && std::abs(is.get<double>() - number) <= tolerance) return std::nullopt;
            return instead(name, is, brief(number) + " within " + brief(tolerance));
        };
    }
    const bool other = text.starts_with("!= ");
    const Json wanted = parse_value(other ? text.substr(3) : text);
    if (wanted.is_string() && name.ends_with("/tree")) find_tree_kind(wanted.get<std::string>());
    return [=](const Session& session) -> std::optional<std::string> {
        const Json is = value_at(session, pointer);
        if (agree(is, wanted) != other) return std::nullopt;
        return instead(name, is, (other ? "anything but " : "") + wanted.dump());
    };
}

}  // namespace mobbscope::app
