// Scene files written: what is read back is the same scene, bit for bit.
#include <base/json_writer.h>
#include <base/text.h>
#include <import/clip/import_options.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <sstream>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

void write_option(JsonWriter& out, const char* key, const auto& value) { out.member(key, value); }
void write_option(JsonWriter& out, const char* key, const Radius& radius) {
    if (const double* metres = std::get_if<double>(&radius)) return out.member(key, *metres);
    out.member(key, radius_text(radius));
}
void write_option(JsonWriter& out, const char* key, Origin origin) { out.member(key, name(origin)); }
void write_option(JsonWriter& out, const char* key, mobb::Motion motion) { out.member(key, mobb::name(motion)); }
void write_option(JsonWriter& out, const char* key, const std::pair<double, double>& trim) {
    out.member(key, {trim.first, trim.second});
}

void write_clip(JsonWriter& out, const SceneClip& clip, bool inline_samples) {
    out.key(clip.name);
    if (clip.source && !inline_samples) {
        out.begin_object(Layout::row);
        out.member("source", *clip.source);
        for_each_import_option([&](const char* key, auto option) {
            if (clip.options.*option) write_option(out, key, *(clip.options.*option));
        });
        out.end_object();
        return;
    }
    out.begin_object();
    out.member("dt", clip.clip->dt());
    out.member("motion", mobb::name(clip.clip->motion()));
    out.list("samples", clip.clip->samples(), [&](const mobb::Disk& disk) { out.numbers({disk.x, disk.y, disk.r}); });
    out.end_object();
}

void write_placement(JsonWriter& out, const mobb::Placement& placement) {
    out.member("translate", {placement.translate.x, placement.translate.y});
    out.member("rotate_deg", placement.rotate_deg);
    out.member("start", placement.start);
}

void write_agent(JsonWriter& out, const Scene& scene, const Agent& agent) {
    out.begin_object(Layout::row);
    out.member("name", agent.name);
    out.member("clip", scene.clips[static_cast<std::size_t>(agent.clip)].name);
    write_placement(out, agent.placement);
    if (agent.color) out.member("color", to_string(*agent.color));
    out.end_object();
}

void write_fit(JsonWriter& out, const mobb::FitOptions& fit) {
    out.begin_object(Layout::row);
    out.member("tree", mobb::name(fit.tree));
    out.member("leaf", fit.leaf);
    out.member("levels", fit.levels);
    out.member("axes", mobb::name(fit.axes));
    out.member("time_scale", fit.time_scale);
    out.end_object();
}

void write_placed_agent(JsonWriter& out, const Scene& scene, const PlacedAgent& who) {
    if (who.agent >= 0) return out.value(scene.agents[static_cast<std::size_t>(who.agent)].name);
    out.begin_object(Layout::row);
    out.member("clip", scene.clips[static_cast<std::size_t>(who.clip)].name);
    write_placement(out, who.placement);
    out.end_object();
}

void write_query(JsonWriter& out, const Scene& scene, const SceneQuery& query) {
    out.begin_object();
    out.key("a");
    write_placed_agent(out, scene, query.a);
    out.key("b");
    write_placed_agent(out, scene, query.b);
    if (query.expect) {
        out.begin_object("expect", Layout::row);
        out.member("collides", query.expect->collides);
        out.key("contact");
        write_contact(out, query.expect->contact);
        out.end_object();
    }
    if (query.trace) {
        out.key("trace");
        write_trace(out, *query.trace);
    }
    out.end_object();
}

}  // namespace

std::string to_json(const Scene& scene, bool inline_samples) {
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object();
    out.member("mobbscope", 1);
    out.begin_object("clips");
    for (const SceneClip& clip : scene.clips) write_clip(out, clip, inline_samples);
    out.end_object();
    if (scene.graph) {
        out.key("graph");
        write_graph(out, *scene.graph, [&scene](int clip) { return scene.clips[static_cast<std::size_t>(clip)].name; });
    }
    if (!scene.agents.empty()) {
        out.list("agents", scene.agents, [&](const Agent& agent) { write_agent(out, scene, agent); });
    }
    out.key("fit");
    write_fit(out, scene.fit);
    if (!scene.queries.empty()) {
        out.list("queries", scene.queries, [&](const SceneQuery& query) { write_query(out, scene, query); });
    }
    if (scene.crowd) {
        out.key("crowd");
        write_crowd(out, *scene.crowd);
    }
    if (scene.view != ViewState{}) {
        out.key("view");
        write_view(out, scene.view);
    }
    out.end_object();
    return std::move(text).str();
}

}  // namespace mobbscope
