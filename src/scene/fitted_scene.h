/// A scene with a tree over each of its clips: what the commands print and the renderer draws.
#pragma once

#include <scene/arrangement.h>
#include <scene/scene.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mobbscope {

/// A tree over each clip of a scene, all fitted with the same options.
struct NamedFit {
    std::string name;  ///< "" of the first fit of a scene
    mobb::FitOptions options;
    std::vector<std::shared_ptr<const mobb::Tree>> trees;  ///< by clip, and behind them those of members
    std::vector<std::size_t> members_at{};                 ///< by clip: where those of its members begin in trees

    const std::shared_ptr<const mobb::Tree>& tree(const PlacedAgent& who) const {
        const auto clip = static_cast<std::size_t>(who.clip);
        return trees[who.member < 0 ? clip : members_at[clip] + static_cast<std::size_t>(who.member)];
    }
};

/// The queries of a scene as a list whose elements are made when asked for (query_at). Of two bodies the two members
/// are asked that collide first, of those that never do the two that come nearest, or the first that share time.
class QueryList {
  public:
    /// Which members are asked, by query; the window asks again and again.
    struct Known {
        std::mutex mutex;
        std::unordered_map<std::size_t, std::pair<int, int>> members;
    };

    QueryList(const Scene& scene, const AskedPairs& pairs, const NamedFit& fit, Known& known)
        : scene_(&scene), pairs_(&pairs), fit_(&fit), known_(&known) {}

    std::size_t size() const { return scene_->queries.empty() ? pairs_->size() : scene_->queries.size(); }
    bool empty() const { return size() == 0; }
    /// 0 <= index < size().
    SceneQuery operator[](std::size_t index) const;
    /// Where all pairs of agents are asked, that of two, a < b; none if they are not.
    std::optional<std::size_t> index_of(std::size_t a, std::size_t b) const { return pairs_->index_of(a, b); }

  private:
    std::pair<int, int> asked_members(const SceneQuery& query) const;

    const Scene* scene_;
    const AskedPairs* pairs_;
    const NamedFit* fit_;
    Known* known_;
};

struct RecordedQuery;

/// A scene with any number of fits, of which one is in use: pictures, queries and figures are of its trees. Immutable
/// once made; refers to nothing outside itself. Cheap to copy: copies share scene and trees.
class FittedScene {
  public:
    /// Fits every clip with `options` (usually scene.fit); a tree of any fit of `previous` over the very same clip with
    /// equal options is shared instead. `progress` is told after each clip. Throws std::invalid_argument if an option
    /// is out of range.
    FittedScene(Scene scene, const mobb::FitOptions& options, const FittedScene* previous = nullptr,
                const Progress& progress = {});
    /// The same with several scenes to share trees of; none is null.
    FittedScene(Scene scene, const mobb::FitOptions& options, std::span<const FittedScene* const> previous,
                const Progress& progress = {});
    /// The scene with fits that were made for it: none is null, there is at least one, and `in_use` is one of them.
    FittedScene(std::shared_ptr<const Scene> scene, std::vector<std::shared_ptr<const NamedFit>> fits,
                std::size_t in_use);

    /// The same scene with one more fit; the fit in use stays. Trees of any fit of this or of `previous` are shared as
    /// above. Throws std::invalid_argument for a name that is empty or taken, and as the constructor does.
    FittedScene with_fit(std::string name, const mobb::FitOptions& options,
                         std::span<const FittedScene* const> previous = {}, const Progress& progress = {}) const;
    /// The same with another fit in use: an index < fits().size().
    FittedScene using_fit(std::size_t index) const;
    /// The same with the first fit and the one in use alone.
    FittedScene without_unused_fits() const;

    const std::vector<std::shared_ptr<const NamedFit>>& fits() const { return fits_; }  ///< at least one; none is null
    std::size_t fit_in_use() const { return in_use_; }

    const Scene& scene() const { return *scene_; }
    const std::shared_ptr<const Scene>& shared_scene() const { return scene_; }  ///< never null
    const mobb::FitOptions& options() const { return fits_[in_use_]->options; }
    const mobb::Tree& tree(int clip) const { return *shared_tree(clip); }
    const std::shared_ptr<const mobb::Tree>& shared_tree(int clip) const {
        return fits_[in_use_]->trees[static_cast<std::size_t>(clip)];
    }
    /// Of a query's side, or of who is drawn: the member's, where its clip has a body.
    const mobb::Tree& tree(const PlacedAgent& who) const { return *shared_tree(who); }
    const std::shared_ptr<const mobb::Tree>& shared_tree(const PlacedAgent& who) const {
        return fits_[in_use_]->tree(who);
    }
    /// What is asked; valid as long as this or a copy.
    QueryList queries() const { return {*scene_, *asked_pairs_, *fits_[in_use_], *known_members_}; }
    const std::vector<PlacedAgent>& placed_agents() const { return *placed_agents_; }  ///< what is drawn

    /// The cells of what is drawn, in its order; made when asked for. From any thread.
    const std::vector<GridCell>& grid() const;

    /// The record of a query by its index. What somebody still holds of the last such call is given again. From any
    /// thread.
    std::shared_ptr<const RecordedQuery> recorded(std::size_t query) const;

    mobb::PlacedTree placed(const PlacedAgent& who) const { return {tree(who), who.placement}; }

    /// Memory for the clips and trees of these fits that `others` do not share.
    std::size_t bytes_beyond(std::span<const std::shared_ptr<const NamedFit>> others) const;

  private:
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const std::vector<PlacedAgent>> placed_agents_;
    std::shared_ptr<const AskedPairs> asked_pairs_;
    std::shared_ptr<QueryList::Known> known_members_ = std::make_shared<QueryList::Known>();
    struct Grid {
        std::once_flag made;
        std::vector<GridCell> cells;
    };
    std::shared_ptr<Grid> grid_ = std::make_shared<Grid>();
    struct Last {
        std::mutex mutex;
        std::size_t query = 0;
        std::weak_ptr<const RecordedQuery> recorded;
    };
    std::shared_ptr<Last> last_ = std::make_shared<Last>();  ///< of the fit in use
    std::vector<std::shared_ptr<const NamedFit>> fits_;
    std::size_t in_use_ = 0;
};

/// Whether both have the same clips, agents and queries, with the same trees in use: whatever was found out about the
/// queries of one holds of the other.
bool ask_the_same(const FittedScene& a, const FittedScene& b);

/// Through the trees, or by measuring every pair of samples.
enum class Search { trees, direct };

/// The answer of one query with all that was recorded on the way.
struct RecordedQuery {
    std::optional<mobb::Contact> contact;
    mobb::TestCounts tests;
    mobb::Trace trace;  ///< may have stopped before the end; the answer has not
};

/// Runs a query of the scene under an observer (mobb/observer.h).
template <class Observer>
std::optional<mobb::Contact> ask(const FittedScene& fitted, const SceneQuery& query, Search search,
                                 Observer& observer) {
    const mobb::PlacedTree a = fitted.placed(query.a);
    const mobb::PlacedTree b = fitted.placed(query.b);
    return search == Search::direct ? mobb::direct_search(a.placed_clip(), b.placed_clip(), observer)
                                    : mobb::query(a, b, observer);
}

/// Runs a query of the scene with the recorder.
RecordedQuery record(const FittedScene& fitted, const SceneQuery& query, Search search = Search::trees,
                     const mobb::TraceBound& bound = {});
/// The same of two trees.
RecordedQuery record(const mobb::PlacedTree& a, const mobb::PlacedTree& b);

}  // namespace mobbscope
