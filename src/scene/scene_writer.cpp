// Scene files written: what is read back is the same scene, bit for bit.
#include <base/json_writer.h>
#include <base/text.h>
#include <import/clip/import_options.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <scene/scene_edits.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <sstream>
#include <string>
#include <unordered_map>
#include <vector>

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

/// The poses that clips are warped to, each once, with a name of its own.
class PoseNames {
  public:
    explicit PoseNames(const Scene& scene) {
        for (const SceneClip& clip : scene.clips) {
            if (!clip.warp || !clip.source) continue;
            for (const WarpEnd* end : {&clip.warp->begin, &clip.warp->end}) {
                const auto [at, is_new] = names_.try_emplace(end->pose.get());
                if (!is_new) continue;
                at->second = unused_.take(end->name);
                poses_.push_back(end->pose.get());
            }
        }
    }

    const std::string& operator[](const MovingPose* pose) const { return names_.at(pose); }

    void write(JsonWriter& out) const {
        if (poses_.empty()) return;
        out.begin_object("poses");
        for (const MovingPose* pose : poses_) {
            out.begin_object(names_.at(pose));
            out.members("height", pose->height, "velocity", pose->velocity);
            out.list("joints", pose->joints, [&](const HangingJoint& joint) {
                const glm::dquat& q = joint.rotation;
                out.tuple(q.x, q.y, q.z, q.w, joint.spin.x, joint.spin.y, joint.spin.z, joint.offset.x, joint.offset.y,
                          joint.offset.z);
            });
            out.end_object();
        }
        out.end_object();
    }

  private:
    UnusedNames unused_;
    std::unordered_map<const MovingPose*, std::string> names_;
    std::vector<const MovingPose*> poses_;  ///< in the order of their first clips
};

void write_warp(JsonWriter& out, const ClipWarp& warp, const PoseNames& poses) {
    const auto write_end = [&](const char* key, const WarpEnd& end) {
        out.key(key);
        out.tuple(poses[end.pose.get()], end.heading_deg);
    };
    out.begin_object("warp");
    out.member("seconds", warp.seconds);
    write_end("begin", warp.begin);
    write_end("end", warp.end);
    out.end_object();
}

void write_body(JsonWriter& out, const std::vector<mobb::BodyDisk>& body) {
    out.list("body", body, [&](const mobb::BodyDisk& disk) { out.tuple(disk.forward, disk.left, disk.r); });
}

void write_clip(JsonWriter& out, const SceneClip& clip, const PoseNames& poses, bool inline_samples) {
    out.key(clip.name);
    if (clip.source && !inline_samples) {
        out.begin_object(Layout::row);
        out.member("source", *clip.source);
        for_each_import_option([&](const char* key, auto option) {
            if (clip.options.*option) write_option(out, key, *(clip.options.*option));
        });
        if (clip.warp) write_warp(out, *clip.warp, poses);
        if (clip.turn) {
            out.key("turn");
            out.row("deg", clip.turn->deg, "seconds", clip.turn->seconds);
        }
        if (clip.options.body) write_body(out, *clip.options.body);
        out.end_object();
        return;
    }
    out.begin_object();
    out.members("dt", clip.clip->dt(), "motion", mobb::name(clip.clip->motion()));
    if (clip.digest) out.member("digest", digest_text(*clip.digest));
    if (!clip.body.empty()) write_body(out, clip.body);
    if (!clip.headings.empty()) out.values("headings", clip.headings);
    out.list("samples", clip.clip->samples(), [&](const mobb::Disk& disk) { out.tuple(disk.x, disk.y, disk.r); });
    out.end_object();
}

void write_placement(JsonWriter& out, const mobb::Placement& placement) {
    out.members("translate", placement.translate, "rotate_deg", placement.rotate_deg, "start", placement.start);
}

void write_agent(JsonWriter& out, const Scene& scene, const Agent& agent) {
    out.begin_object(Layout::row);
    out.member("name", agent.name);
    out.member("clip", scene.clips[static_cast<std::size_t>(agent.clip)].name);
    write_placement(out, agent.placement);
    if (agent.color) out.member("color", to_string(*agent.color));
    if (!agent.floor.empty()) out.member("floor", agent.floor);
    out.end_object();
}

void write_placed_agent(JsonWriter& out, const Scene& scene, const PlacedAgent& who) {
    if (who.agent >= 0) return out.value(scene.agents[static_cast<std::size_t>(who.agent)].name);
    out.begin_object(Layout::row);
    out.member("clip", scene.clips[static_cast<std::size_t>(who.clip)].name);
    write_placement(out, who.placement);
    out.end_object();
}

void write_expectation(JsonWriter& out, const Expectation& expect) {
    out.begin_object("expect", Layout::row);
    if (expect.collides) {
        out.member("collides", *expect.collides);
        out.key("contact");
        write_contact(out, expect.contact);
    }
    if (constexpr ExpectedTests none{}; expect.tests != none) {
        out.begin_object("tests");
        for (const mobb::TestKind test : mobb::kTestKinds) {
            if (const auto& count = expect.tests[test.index()]) out.member(mobb::name(test), *count);
        }
        out.end_object();
    }
    out.end_object();
}

void write_query(JsonWriter& out, const Scene& scene, const SceneQuery& query) {
    out.begin_object();
    out.key("a");
    write_placed_agent(out, scene, query.a);
    out.key("b");
    write_placed_agent(out, scene, query.b);
    if (query.expect) {
        write_expectation(out, *query.expect);
    }
    if (query.trace) {
        out.key("trace");
        write_trace(out, *query.trace);
        if (query.trace->stopped()) out.member("events", query.trace->events());
    }
    out.end_object();
}

}  // namespace

std::string to_json(const Scene& scene, bool inline_samples) {
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object();
    out.member("mobbscope", 1);
    const PoseNames poses(scene);
    if (!inline_samples) poses.write(out);
    out.begin_object("clips");
    for (const SceneClip& clip : scene.clips) write_clip(out, clip, poses, inline_samples);
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
    if (scene.debug != DebugState{}) {
        out.key("debug");
        write_debug_state(out, scene.debug);
    }
    if (scene.view != ViewState{}) {
        out.key("view");
        write_view(out, scene.view);
    }
    out.end_object();
    return std::move(text).str();
}

}  // namespace mobbscope
