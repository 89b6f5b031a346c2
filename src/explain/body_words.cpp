#include <base/text.h>
#include <explain/body_words.h>
#include <explain/query_sentence.h>

#include <cstddef>
#include <string_view>

namespace mobbscope {

namespace {

std::string times_words(const std::vector<mobb::Interval>& intervals) {
    constexpr std::size_t kMostTold = 3;
    std::string out;
    for (std::size_t i = 0; i < intervals.size() && i < kMostTold; ++i) {
        out += formatted("%s%s to %s s", i == 0 ? "" : ", ", to_thousandth(intervals[i].t0).c_str(),
                         to_thousandth(intervals[i].t1).c_str());
    }
    if (intervals.size() > kMostTold) out += formatted(" and %zu times more", intervals.size() - kMostTold);
    return out;
}

void write_bone(JsonWriter& out, std::string_view name, const Skeleton& skeleton, SkeletonBone bone) {
    out.key(name);
    out.tuple(joint_words(skeleton, bone.from), joint_words(skeleton, bone.to));
}

void write_members(JsonWriter& out, const PlacedBody& a, const PlacedBody& b, const NearestBones& bones) {
    out.members("time", bones.time, "distance", bones.distance);
    write_bone(out, "a_bone", a.skeleton(), bones.a);
    write_bone(out, "b_bone", b.skeleton(), bones.b);
}

}  // namespace

std::string why_no_bodies(const Scene& scene, const SceneQuery& query) {
    for (const PlacedAgent* side : {&query.a, &query.b}) {
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(side->clip)];
        if (!clip.body.empty()) return "the clip " + in_quotes(clip.name) + " is several disks, whatever its bones do";
        if (clip.skeleton) continue;
        return "the clip " + in_quotes(clip.name) + " has no skeleton: " +
               (clip.facts.joints > 0 ? "it has too many samples to keep one" : "its samples are disks alone");
    }
    return "";
}

std::string bones_words(const PlacedBody& a, const std::string& name_a, const PlacedBody& b, const std::string& name_b,
                        const NearestBones& bones) {
    return bone_words(a.skeleton(), bones.a) + " of " + name_a + " and " + bone_words(b.skeleton(), bones.b) + " of " +
           name_b;
}

std::vector<std::string> body_sentences(const PlacedBody& a, const std::string& name_a, const PlacedBody& b,
                                        const std::string& name_b, const BodyDistances& distances) {
    const std::string radius = with_unit(distances.bone_radius, "m");
    if (distances.intervals.empty())
        return {"Bodies do not touch: disks grown by the bones' radius, " + radius + ", never overlap."};
    const NearestBones& nearest = distances.steps[*distances.nearest].nearest;
    const auto bones = [&](const NearestBones& of) { return bones_words(a, name_a, b, name_b, of); };
    std::vector<std::string> out;
    if (distances.first) {
        out.push_back("Bodies touch first at " + with_unit(distances.first->time, "s") + ": " +
                      bones(*distances.first) + ".");
        out.push_back("Deepest by " + with_unit(-nearest.distance, "m") + " at " + with_unit(nearest.time, "s") + ": " +
                      bones(nearest) + ".");
    } else {
        out.push_back("Bodies do not touch; nearest are " + bones(nearest) + ", " + with_unit(nearest.distance, "m") +
                      " at " + with_unit(nearest.time, "s") + ".");
    }
    out.push_back("Measured while disks grown by the bones' radius, " + radius +
                  ", overlap: " + times_words(distances.intervals) + ".");
    return out;
}

void write_bodies(JsonWriter& out, const PlacedBody& a, const PlacedBody& b, const BodyDistances& distances) {
    const auto write = [&](std::string_view name, const NearestBones* bones) {
        out.key(name);
        if (!bones) return out.null();
        out.begin_object(JsonWriter::Layout::row);
        write_members(out, a, b, *bones);
        out.end_object();
    };
    out.begin_object();
    out.member("bone_radius", distances.bone_radius);
    out.list("intervals", distances.intervals,
             [&](const mobb::Interval& interval) { out.tuple(interval.t0, interval.t1); });
    out.member("collides", distances.first.has_value());
    write("first", distances.first ? &*distances.first : nullptr);
    write("nearest", distances.nearest ? &distances.steps[*distances.nearest].nearest : nullptr);
    out.list("samples", distances.steps, [&](const BodyStep& step) {
        out.begin_object(JsonWriter::Layout::row);
        out.members("t0", step.t0, "t1", step.t1, "a_sample", step.a_sample, "b_sample", step.b_sample);
        write_members(out, a, b, step.nearest);
        out.end_object();
    });
    out.end_object();
}

}  // namespace mobbscope
