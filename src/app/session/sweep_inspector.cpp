#include <app/session/sweep_inspector.h>
#include <explain/tree_cost.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <vector>

namespace mobbscope::app {

namespace {

std::vector<mobb::ClipPtr> clips_of(const Scene& scene) {
    std::vector<mobb::ClipPtr> out;
    out.reserve(scene.clips.size());
    for (const SceneClip& clip : scene.clips) out.push_back(clip.clip);
    return out;
}

/// Whether the same is asked of both.
bool is_same(const Scene& a, const Scene& b, QueryWorkload::Kind kind) {
    if (!std::ranges::equal(a.clips, b.clips, {}, &SceneClip::clip, &SceneClip::clip)) return false;
    return kind == QueryWorkload::Kind::placements || (a.agents == b.agents && a.queries == b.queries);
}

}  // namespace

SweepOrder SweepInspector::order() const {
    SweepOrder out = usual_sweep(workspace_.fitted().options());
    if (over_axes) set_over(out, "axes=all");
    if (over_time_scale) set_over(out, "time_scale=0.1:30");
    return out;
}

void SweepInspector::start() {
    refuse_bodies(workspace_.document().fitted->scene(), "a sweep");
    auto sweep = std::make_shared<Sweep>();
    sweep->scene = workspace_.document().fitted->shared_scene();
    sweep->kind = workspace_.workload();
    running_ = sweep;
    job_ = std::make_unique<Job>(
        "Trying fits",
        [sweep, order = order(),
         timer = options_.may_measure ? timer : FitTimer()](JobControl& control) -> Job::Finish {
            const std::vector<mobb::ClipPtr> clips = clips_of(*sweep->scene);
            const QueryWorkload workload = sweep->kind == QueryWorkload::Kind::placements
                                               ? standard_workload(clips, order.most_queries, kCountedSeed)
                                               : scene_workload(*sweep->scene);
            const auto publish = [&](const std::shared_ptr<const SweepResult>& result) {
                {
                    const std::scoped_lock lock(sweep->mutex);
                    sweep->result = result;
                    sweep->area = workload.area;
                    sweep->offset = workload.offset;
                }
                control.tell_news();
            };
            const auto result = std::make_shared<const SweepResult>(
                sweep_fits(clips, workload, order, progress_of(control), publish, timer));
            publish(result);
            if (order.time_scale.values.empty()) return {};
            auto curves = std::make_shared<const std::vector<LevelCurve>>(
                time_scale_curves(clips, *result, progress_of(control)));
            const std::scoped_lock lock(sweep->mutex);
            sweep->curves = std::move(curves);
            return {};
        },
        [&at = *desktop_] { at.wake(); });
    if (!options_.attended) {
        job_->wait(std::chrono::hours(24));
        update();
    }
}

void SweepInspector::cancel() {
    job_.reset();
    running_.reset();
}

void SweepInspector::update() {
    if (job_ && !is_same(*running_->scene, workspace_.scene(), running_->kind)) cancel();
    if (!job_ || !job_->done()) return;
    try {
        job_->finish();
        ended_ = running_;
        has_news_ = true;
        compared_ = {};
    } catch (const std::exception& error) {
        notifications_.tell(MessageLevel::error, error.what());
    }
    cancel();
}

std::shared_ptr<const SweepInspector::Sweep> SweepInspector::shown() const {
    for (const auto& sweep : {running_, ended_}) {
        if (!sweep) continue;
        const std::scoped_lock lock(sweep->mutex);
        if (sweep->result) return sweep;
    }
    return nullptr;
}

std::optional<SweepInspector::Shown> SweepInspector::result() const {
    const auto sweep = shown();
    if (!sweep) return std::nullopt;
    const std::scoped_lock lock(sweep->mutex);
    return Shown{sweep->result, sweep->kind, sweep->area, sweep->offset, sweep->curves};
}

bool SweepInspector::is_of_scene() const {
    const auto sweep = shown();
    const std::shared_ptr<const Scene>& now = workspace_.document().fitted->shared_scene();
    if (!sweep) return false;
    if (compared_.first != sweep || compared_.second != now) {
        compared_ = {sweep, now};
        is_same_ = is_same(*sweep->scene, *now, sweep->kind);
    }
    return is_same_;
}

}  // namespace mobbscope::app
