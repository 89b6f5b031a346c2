#include <base/text.h>
#include <mobb/least_clearance.h>
#include <scene/fitted_scene.h>

#include <map>
#include <stdexcept>
#include <tuple>
#include <unordered_set>
#include <utility>

namespace mobbscope {

namespace {

/// A fit of every clip, with the trees that one of `sources` has already.
std::shared_ptr<const NamedFit> fit_of(const Scene& scene, std::string name, const mobb::FitOptions& options,
                                       std::span<const FittedScene* const> sources, const Progress& progress) {
    mobb::check(options);
    std::map<const mobb::Clip*, std::shared_ptr<const mobb::Tree>> made;
    for (const FittedScene* source : sources) {
        for (const auto& fit : source->fits()) {
            if (fit->options != options) continue;
            for (const auto& tree : fit->trees) made.emplace(&tree->clip(), tree);
        }
    }
    NamedFit out{std::move(name), options, {}};
    std::size_t all = scene.clips.size();
    for (const SceneClip& clip : scene.clips) all += clip.members.size();
    out.trees.reserve(all);
    const auto add = [&](const mobb::ClipPtr& path) {
        std::shared_ptr<const mobb::Tree>& tree = made[path.get()];
        if (!tree) tree = std::make_shared<const mobb::Tree>(path, options);
        out.trees.push_back(tree);
        if (progress) progress(out.trees.size(), all);
    };
    for (const SceneClip& clip : scene.clips) add(clip.clip);
    for (const SceneClip& clip : scene.clips) {
        out.members_at.push_back(out.trees.size());
        for (const mobb::ClipPtr& member : clip.members) add(member);
    }
    for (const FittedScene* source : sources) {
        for (const auto& fit : source->fits()) {
            if (fit->name == out.name && fit->options == options && fit->trees == out.trees) return fit;
        }
    }
    return std::make_shared<const NamedFit>(std::move(out));
}

constexpr std::size_t kMostKnown = 100'000;  // queries: all pairs of a crowd may be asked

/// Metres between two paths where they come nearest; none if they share no time.
std::optional<double> nearest_of(const mobb::PlacedClip& a, const mobb::PlacedClip& b) {
    const auto nearest = mobb::least_clearance(a, mobb::ClipDisks(a.clip()), b, mobb::ClipDisks(b.clip()));
    return nearest ? std::optional(nearest->clearance) : std::nullopt;
}

}  // namespace

SceneQuery QueryList::operator[](std::size_t index) const {
    SceneQuery out = query_at(*scene_, *pairs_, index);
    const auto has_body = [&](const PlacedAgent& who) {
        return !scene_->clips[static_cast<std::size_t>(who.clip)].members.empty();
    };
    if (!has_body(out.a) && !has_body(out.b)) return out;
    std::unique_lock lock(known_->mutex);
    auto at = known_->members.find(index);
    if (at == known_->members.end()) {
        lock.unlock();
        // Who else finds it meanwhile finds the same.
        const std::pair<int, int> found = asked_members(out);
        lock.lock();
        if (known_->members.size() >= kMostKnown) known_->members.clear();
        at = known_->members.insert_or_assign(index, found).first;
    }
    std::tie(out.a.member, out.b.member) = at->second;
    return out;
}

std::pair<int, int> QueryList::asked_members(const SceneQuery& query) const {
    const std::vector<PlacedAgent> of_a = members_of(*scene_, query.a), of_b = members_of(*scene_, query.b);
    std::pair<int, int> out{of_a.front().member, of_b.front().member};
    if (of_a.size() * of_b.size() == 1) return out;
    std::optional<double> first;  // seconds: the first contact
    std::optional<double> least;  // metres
    for (const PlacedAgent& a : of_a) {
        const mobb::PlacedTree tree_a(*fit_->tree(a), a.placement);
        for (const PlacedAgent& b : of_b) {
            const mobb::PlacedTree tree_b(*fit_->tree(b), b.placement);
            if (const auto contact = mobb::query(tree_a, tree_b)) {
                if (first && contact->time >= *first) continue;
                first = contact->time;
            } else {
                const auto nearest = first ? std::nullopt : nearest_of(tree_a.placed_clip(), tree_b.placed_clip());
                if (!nearest || (least && *nearest >= *least)) continue;
                least = nearest;
            }
            out = {a.member, b.member};
        }
    }
    return out;
}

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options, const FittedScene* previous,
                         const Progress& progress)
    : FittedScene(std::move(scene), options, std::span(&previous, previous ? 1 : 0), progress) {}

FittedScene::FittedScene(Scene scene, const mobb::FitOptions& options, std::span<const FittedScene* const> previous,
                         const Progress& progress)
    : scene_(std::make_shared<const Scene>(std::move(scene))),
      placed_agents_(std::make_shared<const std::vector<PlacedAgent>>(mobbscope::placed_agents(*scene_))),
      asked_pairs_(std::make_shared<const AskedPairs>(*scene_)),
      fits_{fit_of(*scene_, "", options, previous, progress)} {}

FittedScene::FittedScene(std::shared_ptr<const Scene> scene, std::vector<std::shared_ptr<const NamedFit>> fits,
                         std::size_t in_use)
    : scene_(std::move(scene)),
      placed_agents_(std::make_shared<const std::vector<PlacedAgent>>(mobbscope::placed_agents(*scene_))),
      asked_pairs_(std::make_shared<const AskedPairs>(*scene_)),
      fits_(std::move(fits)),
      in_use_(in_use) {}

FittedScene FittedScene::with_fit(std::string name, const mobb::FitOptions& options,
                                  std::span<const FittedScene* const> previous, const Progress& progress) const {
    if (name.empty()) throw std::invalid_argument("a further fit needs a name");
    for (const auto& fit : fits_) {
        if (fit->name == name) throw std::invalid_argument("there is a fit named " + in_quotes(name) + " already");
    }
    std::vector<const FittedScene*> sources(previous.begin(), previous.end());
    sources.push_back(this);
    FittedScene out = *this;
    out.fits_.push_back(fit_of(*scene_, std::move(name), options, sources, progress));
    return out;
}

FittedScene FittedScene::using_fit(std::size_t index) const {
    FittedScene out = *this;
    out.in_use_ = index;
    out.last_ = std::make_shared<Last>();
    return out;
}

bool ask_the_same(const FittedScene& a, const FittedScene& b) {
    const Scene &of_a = a.scene(), &of_b = b.scene();
    return a.fits()[a.fit_in_use()]->trees == b.fits()[b.fit_in_use()]->trees && a.options() == b.options() &&
           (&of_a == &of_b || (of_a.clips == of_b.clips && of_a.agents == of_b.agents && of_a.queries == of_b.queries &&
                               of_a.graph == of_b.graph && of_a.crowd == of_b.crowd));
}

FittedScene FittedScene::without_unused_fits() const {
    FittedScene out = *this;
    out.fits_ = {fits_.front()};
    if (in_use_ > 0) out.fits_.push_back(fits_[in_use_]);
    out.in_use_ = out.fits_.size() - 1;
    return out;
}

const std::vector<GridCell>& FittedScene::grid() const {
    std::call_once(grid_->made, [this] { grid_->cells = grid_of(*scene_, *placed_agents_); });
    return grid_->cells;
}

std::shared_ptr<const RecordedQuery> FittedScene::recorded(std::size_t query) const {
    const std::lock_guard lock(last_->mutex);
    std::shared_ptr<const RecordedQuery> out = last_->recorded.lock();
    if (out && last_->query == query) return out;
    out = std::make_shared<const RecordedQuery>(record(*this, queries()[query]));
    last_->query = query;
    last_->recorded = out;
    return out;
}

std::size_t FittedScene::bytes_beyond(std::span<const std::shared_ptr<const NamedFit>> others) const {
    std::unordered_set<const void*> shared;
    for (const auto& fit : others) {
        for (const auto& tree : fit->trees) shared.insert({tree.get(), &tree->clip()});
    }
    std::size_t bytes = 0;
    for (const auto& fit : fits_) {
        for (const auto& tree : fit->trees) {
            if (shared.insert(tree.get()).second) bytes += tree->bytes();
            if (shared.insert(&tree->clip()).second) bytes += tree->clip().samples().size_bytes();
        }
    }
    return bytes;
}

namespace {

RecordedQuery taken_from(mobb::TraceRecorder& recorder, const std::optional<mobb::Contact>& contact) {
    const mobb::TestCounts tests = recorder.tests();
    return {contact, tests, recorder.take()};
}

}  // namespace

RecordedQuery record(const FittedScene& fitted, const SceneQuery& query, Search search, const mobb::TraceBound& bound) {
    mobb::TraceRecorder recorder(bound);
    const std::optional<mobb::Contact> contact = ask(fitted, query, search, recorder);
    return taken_from(recorder, contact);
}

RecordedQuery record(const mobb::PlacedTree& a, const mobb::PlacedTree& b) {
    mobb::TraceRecorder recorder;
    const std::optional<mobb::Contact> contact = mobb::query(a, b, recorder);
    return taken_from(recorder, contact);
}

}  // namespace mobbscope
