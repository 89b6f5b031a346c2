#include <app/document/edit_names.h>
#include <app/session/map_inspector.h>
#include <scene/scene_edits.h>

#include <chrono>
#include <exception>
#include <mutex>
#include <stdexcept>

namespace mobbscope::app {

/// What the job has made so far.
struct MapInspector::Made {
    mutable std::mutex mutex;
    std::shared_ptr<const PlacementMap> map;
    std::optional<double> seconds;
};

SceneQuery MapInspector::query() const {
    return workspace_.fitted().queries()[static_cast<std::size_t>(*workspace_.view().query)];
}

MapInspector::Key MapInspector::key_now() const {
    const FittedScene& fitted = workspace_.fitted();
    const SceneQuery asked = query();
    Key key;
    key.a = fitted.tree(asked.a).shared_clip();
    key.b = fitted.tree(asked.b).shared_clip();
    key.place_a = asked.a.placement;
    key.order = axes();
    key.order.show = choice.show;
    // Where B is along the axes does not matter: numbers in the map are those of its placement.
    key.reference = placed_at(asked.b.placement, key.order, {0, 0});
    if (choice.extent) {
        std::tie(key.order.across, key.order.up) = *choice.extent;
    } else {
        choose_ranges(fitted.placed(asked.a).placed_clip(), mobb::PlacedClip(*key.b, key.reference), key.order);
    }
    if (choice.show == MapShow::tests) {
        key.tree_a = fitted.shared_tree(asked.a);
        key.tree_b = fitted.shared_tree(asked.b);
    }
    return key;
}

void MapInspector::update() {
    if (job_ && job_->done()) {
        try {
            job_->finish();
        } catch (const std::exception& error) {
            notifications_.tell(MessageLevel::error, error.what());
        }
        job_.reset();
    }
    if (!can_be()) return end_work();
    const Key key = key_now();
    if (key_ != key) start(key);
}

void MapInspector::start(const Key& key) {
    if (map()) before_ = made_->map ? made_ : before_;
    key_ = key;
    made_ = std::make_shared<Made>();
    SceneQuery asked = query();
    asked.b.placement = key.reference;
    job_ = std::make_unique<Job>(
        "Mapping placements",
        [fitted = workspace_.shown(), asked, order = key.order, made = made_](JobControl& control) -> Job::Finish {
            refuse_bodies(fitted->scene(), "a map");
            const auto begun = std::chrono::steady_clock::now();
            const auto publish = [&](const PlacementMap& map) {
                {
                    const std::scoped_lock lock(made->mutex);
                    made->map = std::make_shared<const PlacementMap>(map);
                    if (map.step == 1)
                        made->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
                }
                control.tell_news();
            };
            map_placements(*fitted, asked, order, publish, progress_of(control));
            return {};
        },
        [&at = *desktop_] { at.wake(); });
    if (!options_.attended) job_->wait(std::chrono::hours(24));
}

std::shared_ptr<const PlacementMap> MapInspector::map() const {
    for (const auto& made : {made_, before_}) {
        if (!made) continue;
        const std::scoped_lock lock(made->mutex);
        if (made->map) return made->map;
    }
    return nullptr;
}

std::optional<double> MapInspector::seconds() const {
    if (!made_) return std::nullopt;
    const std::scoped_lock lock(made_->mutex);
    return made_->seconds;
}

glm::dvec2 MapInspector::place_of_b(const PlacementMap& map) const {
    return offset_between(map.reference, query().b.placement, map.order);
}

std::string MapInspector::why_not_placed() const {
    if (!can_be()) return "no query is shown";
    if (workspace_.crowd()) return "a run cannot be edited";
    if (query().b.agent < 0) return "the query places B itself: it is not an agent of the scene";
    return "";
}

MapOrder MapInspector::axes() const {
    MapOrder out;
    out.across.axis = choice.across;
    out.up.axis = choice.up;
    return out;
}

SceneQuery MapInspector::query_at(const MapOrder& axes, glm::dvec2 at) const {
    SceneQuery out = query();
    out.b.placement = placed_at(out.b.placement, axes, at);
    return out;
}

const std::string& MapInspector::words_at(const MapOrder& axes, glm::dvec2 at) {
    const auto fitted = workspace_.shown();
    SceneQuery there = query_at(axes, at);
    if (told_ && told_->fitted == fitted && told_->query == there && told_->show == choice.show) return told_->words;
    std::string words;
    try {
        words = placed_words(choice.show, answer_at(*fitted, there, choice.show));
    } catch (const std::invalid_argument& error) {
        words = error.what();
    }
    told_ = {fitted, std::move(there), choice.show, std::move(words)};
    return told_->words;
}

void MapInspector::place_b(const MapOrder& axes, glm::dvec2 at) {
    if (const std::string why = why_not_placed(); !why.empty())
        throw std::invalid_argument("B cannot be placed: " + why);
    const PlacedAgent b = query().b;
    const mobb::Placement placement = query_at(axes, at).b.placement;
    if (placement == b.placement) return;
    workspace_.edit({name_of_placing(b.name, b.placement, placement).title, "drag"},
                    [&](Scene& scene) { place_agent(scene, b.agent, placement); });
}

void MapInspector::end_work() {
    job_.reset();
    key_.reset();
    made_.reset();
    before_.reset();
    told_.reset();
}

}  // namespace mobbscope::app
