#include <app/commands/command.h>
#include <app/document/job.h>
#include <app/panels/query_parts.h>
#include <base/text.h>
#include <explain/body_words.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

/// Are measured within a frame, in some 20 ms.
constexpr std::int64_t kMostBonePairs = 300'000;

/// A and B; refer to the findings, and these to the fitted scene.
std::pair<PlacedBody, PlacedBody> bodies_of(const QueryFindings& findings) {
    const DrawnAgent& a = findings.sides[0];
    const DrawnAgent& b = findings.sides[1];
    return {PlacedBody(a.clip(), *a.skeleton), PlacedBody(b.clip(), *b.skeleton)};
}

}  // namespace

const BodyDistances* QueryBodies::of(const std::shared_ptr<const QueryFindings>& findings) {
    if (!known_ || known_->of != findings) {
        known_ = std::make_shared<Known>(Known{findings, {}});
        if (!findings->sides[0].skeleton || !findings->sides[1].skeleton || !findings->clearance.least) return nullptr;
        const auto [a, b] = bodies_of(*findings);
        if (body_cost(a, b, findings->clearance, kBoneRadius) <= kMostBonePairs)
            known_->distances = body_distances(a, b, findings->clearance, kBoneRadius);
    }
    return known_->distances ? &*known_->distances : nullptr;
}

void QueryBodies::measure(Ui& ui) {
    ui.later([known = known_, scene = ui.workspace.shown()](Jobs& jobs) {
        jobs.start("Measuring bones", [known, scene](JobControl& control) -> Job::Finish {
            const auto [a, b] = bodies_of(*known->of);
            BodyDistances found = body_distances(a, b, known->of->clearance, kBoneRadius, progress_of(control));
            return [known, found = std::move(found)]() mutable { known->distances = std::move(found); };
        });
    });
}

void QueryBodies::show(Ui& ui, const std::shared_ptr<const QueryFindings>& findings) {
    const BodyDistances* distances = of(findings);
    const std::vector<DrawnAgent>& sides = findings->sides;
    if (!sides[0].skeleton || !sides[1].skeleton || !findings->clearance.least) return;
    if (!distances) {
        words(ui.style.quiet, "For clips as long as these it takes long to find which bones touch.");
        if (small_button(ui, "Measure bones", "query.measure_bones")) measure(ui);
        return;
    }
    const auto [a, b] = bodies_of(*findings);
    const std::vector<std::string> sentences = body_sentences(a, sides[0].label, b, sides[1].label, *distances);
    for (std::size_t i = 0; i < sentences.size(); ++i) words(i == 0 ? ui.style.text : ui.style.quiet, sentences[i]);
    ui.mark_only("query.bodies");
    if (!distances->nearest) return;
    const double time = distances->first ? distances->first->time : distances->steps[*distances->nearest].nearest.time;
    if (!small_button(ui, distances->first ? "Show where they touch" : "Show the nearest bones", "query.bones",
                      "Goes to that moment, on the floor"))
        return;
    ui.invoke("time.at", formatted("%.17g", time));
    if (ui.workspace.view().show == Show::space_time) ui.invoke("view.moment");
}

}  // namespace mobbscope::app
