/// The map of placements of the query in view: where could its B stand? Made beside the window, coarse first, and kept
/// while only B moves along the map's axes.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>
#include <explain/placement_map.h>

#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

/// The section of its panel, as settings call it.
inline constexpr std::string_view kMapSection = "where could b stand?";

/// What the map shows.
struct MapChoice {
    MapAxis across = MapAxis::dx, up = MapAxis::dy;
    MapShow show = MapShow::clearance;
    /// Of B's placement; none: all where the two can meet, and some room.
    std::optional<std::pair<MapRange, MapRange>> extent{};
    std::optional<std::pair<double, double>> colors{};  ///< the values at the ends of the colours; none: all there are
};

class MapInspector {
  public:
    MapInspector(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~MapInspector() { end_work(); }
    MapInspector(const MapInspector&) = delete;
    MapInspector& operator=(const MapInspector&) = delete;

    MapChoice choice;
    bool is_shown = false;  ///< whether its panel is unfolded

    /// Whether a query is in view.
    bool can_be() const { return workspace_.view().query.has_value(); }
    /// What is asked; requires can_be().
    SceneQuery query() const;

    /// Whoever shows the map calls this before each frame: it is made anew where it is another.
    void update();
    /// The map as far as it is known; null: nothing of it is yet, or no query is in view.
    std::shared_ptr<const PlacementMap> map() const;
    /// Seconds that the whole map took; none: it is not whole yet.
    std::optional<double> seconds() const;

    /// Where B is in a map, along its axes.
    glm::dvec2 place_of_b(const PlacementMap& map) const;
    /// Why B cannot be placed; empty: it can.
    std::string why_not_placed() const;
    /// B moved to a place in a map: what is asked there, and where place_b puts it.
    SceneQuery query_at(const MapOrder& axes, glm::dvec2 at) const;
    /// What the map would say of exactly that place: "they never collide, at least 0.183 m apart".
    const std::string& words_at(const MapOrder& axes, glm::dvec2 at);
    /// The place that was asked for last, and what was said of it.
    struct Told {
        std::shared_ptr<const FittedScene> fitted;
        SceneQuery query;
        MapShow show;
        std::string words;
    };
    const std::optional<Told>& told() const { return told_; }
    /// Places B along the axes; what a drag does is one edit. Throws std::invalid_argument.
    void place_b(const MapOrder& axes, glm::dvec2 at);
    /// The axes that are chosen, without ranges.
    MapOrder axes() const;

    void end_work();

  private:
    /// What a map follows from.
    struct Key {
        mobb::ClipPtr a, b;
        mobb::Placement place_a, reference;
        MapOrder order;
        std::shared_ptr<const mobb::Tree> tree_a, tree_b;  ///< where tests are counted
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Made;

    Key key_now() const;
    void start(const Key& key);

    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    std::optional<Key> key_;
    std::shared_ptr<Made> made_;  ///< the job's, until another's has more to show
    std::shared_ptr<Made> before_;
    std::unique_ptr<Job> job_;
    std::optional<Told> told_;
};

}  // namespace mobbscope::app
