#include <import/text.h>
#include <render/subject.h>
#include <scene/crowd_scene.h>
#include <scene/view_mismatch.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace mobbscope {

namespace {

constexpr std::size_t kLongestLabel = 24;

Subject make_subject(const FittedScene& fitted, const Participant& participant, int index, int color_index) {
    const Scene& scene = fitted.scene();
    return {fitted.placed(participant),
            participant.name,
            shortened(participant.name, kLongestLabel),
            agent_color(scene, participant, color_index),
            index,
            scene.clips[static_cast<std::size_t>(participant.clip)].skeleton.get(),
            participant.agent >= 0 ? scene.agents[static_cast<std::size_t>(participant.agent)].person : -1};
}

/// The samples that hold at some time between two.
mobb::SampleRange samples_between(const mobb::PlacedClip& clip, double begin, double end) {
    const int first = mobb::first_ending_after(clip, 0, clip.count(), begin);
    int last = mobb::first_ending_after(clip, 0, clip.count(), end);
    if (last < clip.count() && clip.time(last) < end) ++last;
    return {first, std::max(last - first, 0)};
}

}  // namespace

std::vector<Subject> subjects(const FittedScene& fitted, const ViewState& view) {
    std::vector<Subject> out;
    if (!view.query) {
        for (const Participant& participant : fitted.participants()) {
            const int index = static_cast<int>(out.size());
            out.push_back(make_subject(fitted, participant, index, index));
        }
        if (fitted.scene().crowd && view.show == Show::space_time) {
            const double time = run_time(fitted.scene(), view);
            for (Subject& subject : out) {
                subject.window = samples_between(subject.clip(), time - view.time_window, time + view.time_window);
            }
        }
        return out;
    }
    const std::size_t count = fitted.queries().size();
    if (*view.query < 0 || static_cast<std::size_t>(*view.query) >= count) {
        throw ViewMismatch("query", "there is no query " + std::to_string(*view.query) + ": the scene has " +
                                        (count == 0 ? "none" : std::to_string(count) + ", counted from 0"));
    }
    const SceneQuery query = fitted.queries()[static_cast<std::size_t>(*view.query)];
    const int color_a = query.a.agent >= 0 ? query.a.agent : 0;
    out.push_back(make_subject(fitted, query.a, 0, color_a));
    out.push_back(make_subject(fitted, query.b, 1, query.b.agent >= 0 ? query.b.agent : color_a + 1));
    // Two sides of one colour or name could not be told apart.
    if (out[1].color == out[0].color) out[1] = make_subject(fitted, query.b, 1, color_a + 1);
    if (out[1].name == out[0].name) {
        out[0].name += " (A)";
        out[1].name += " (B)";
    }
    if (out[1].label == out[0].label) {
        out[0].label += " (A)";
        out[1].label += " (B)";
    }
    return out;
}

}  // namespace mobbscope
