#include <base/threads.h>
#include <crowd/simulation/surroundings.h>
#include <mobb/blocks.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <tuple>

namespace mobbscope {

namespace {

constexpr std::size_t kGrain = 64;    // candidates a task: fewer are not worth a thread
constexpr std::size_t kAtATime = 64;  // as many as a number has bits

bool comes_near(const PlayedMove& candidate, const Surroundings::Near& other) {
    // Without a branch for each, which would often be mispredicted.
    return static_cast<bool>(
        static_cast<unsigned>(mobb::overlap_in_time(candidate.begin(), candidate.end(), other.begin, other.end)) &
        static_cast<unsigned>(candidate.bounds.meets(other.bounds)));
}

std::optional<mobb::Contact> contact_of(const PlayedMove& a, const PlayedMove& b) {
    return a.playable->tree ? mobb::query(a.placed_tree(), b.placed_tree()) : mobb::query(a.placed, b.placed);
}

/// Adds the contacts of two to `times`. What makes them more than `most` seconds may be added in part.
void add_contacts(const PlayedMove& a, const PlayedMove& b, double most, ContactTimes& times) {
    if (a.playable->tree) {
        for (const mobb::Interval& interval : mobb::contact_intervals(a.placed_tree(), b.placed_tree())) {
            times.seconds += interval.t1 - interval.t0;
            times.first = std::min(times.first, interval.t0);
        }
        return;
    }
    constexpr double kNever = std::numeric_limits<double>::lowest();
    struct Sum {
        mobb::IntervalCollector<mobb::PlacedBlocks, mobb::PlacedBlocks> pairs;
        double most;
        ContactTimes& ended;  // without the present interval
        mobb::Interval present{kNever, kNever};

        double seconds() const { return ended.seconds + (present.t1 - present.t0); }
    } sum{{a.placed, b.placed, {}}, most, times};
    const auto on_hit = [](void* receiver, int i, int j) {
        Sum& to = *static_cast<Sum*>(receiver);
        const mobb::Interval next = to.pairs.interval_of(i, j);
        // Intervals are those of IntervalCollector, none of which is kept.
        if (next.t0 - to.present.t1 <= mobb::kMinOverlap) {
            to.present.t1 = next.t1;
        } else {
            to.ended = {to.seconds(), std::min(to.ended.first, next.t0)};
            to.present = next;
        }
        return to.seconds() > to.most;
    };
    mobb::for_each_hit(a.placed, b.placed, {on_hit, &sum});
    times.seconds = sum.seconds();
}

}  // namespace

void Surroundings::sort() {
    std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) {
        if (a.begin != b.begin) return a.begin < b.begin;
        return std::tie(a.motion->agent, a.motion->play) < std::tie(b.motion->agent, b.motion->play);
    });
}

void Surroundings::find_first(const PlayedMove& candidate, FirstMet& found) const {
    if (candidate.playable->tree) {
        for (std::size_t i = 0; i < near_.size() && !found.collides(); ++i) {
            if (!comes_near(candidate, near_[i])) continue;
            ++found.asked;
            if (contact_of(candidate, *near_[i].motion)) found.index = i;
        }
        return;
    }
    std::array<std::size_t, kAtATime> index;
    std::array<const mobb::PlacedBlocks*, kAtATime> others;
    for (std::size_t i = 0; i < near_.size() && !found.collides();) {
        std::size_t count = 0;
        for (; i < near_.size() && count < kAtATime; ++i) {
            index[count] = i;
            others[count] = &near_[i].motion->placed;
            count += comes_near(candidate, near_[i]) ? std::size_t{1} : std::size_t{0};
        }
        const auto met = mobb::intersects_any(candidate.placed, std::span(others).first(count));
        if (met) found.index = index[*met];
        found.asked += static_cast<int>(met ? *met + 1 : count);
    }
}

void Surroundings::find_first_in(std::span<const PlayedMove* const> candidates, std::size_t from,
                                 std::span<FirstMet> found) const {
    const std::size_t end = std::min(near_.size(), from + kAtATime);
    struct Pending {
        std::size_t candidate;
        std::uint64_t left;  // of the motions near it
        std::size_t next() const { return static_cast<std::size_t>(std::countr_zero(left)); }
    };
    std::array<Pending, kAtATime> searches;
    std::size_t count = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        std::uint64_t near = 0;
        for (std::size_t k = end; k-- > from;) near = near << 1 | std::uint64_t{comes_near(*candidates[i], near_[k])};
        searches[count] = {i, near};
        count += near != 0 && !found[i].collides() ? std::size_t{1} : std::size_t{0};
    }
    std::array<mobb::BlocksPair, kAtATime> pairs;
    std::array<bool, kAtATime> meet;
    // Each is asked about one motion at a time: most that collide with any collide with the first or second.
    while (count > 0) {
        for (std::size_t i = 0; i < count; ++i) {
            const Pending& search = searches[i];
            pairs[i] = {&candidates[search.candidate]->placed, &near_[from + search.next()].motion->placed};
        }
        mobb::intersects_each(std::span(pairs).first(count), std::span(meet).first(count));
        std::size_t open = 0;
        for (std::size_t i = 0; i < count; ++i) {
            Pending search = searches[i];
            FirstMet& of = found[search.candidate];
            ++of.asked;
            of.index = meet[i] ? from + search.next() : FirstMet::kNobody;
            search.left &= search.left - 1;
            searches[open] = search;
            open += !meet[i] && search.left != 0 ? std::size_t{1} : std::size_t{0};
        }
        count = open;
    }
}

void Surroundings::find_first(std::span<const PlayedMove* const> candidates, std::span<FirstMet> found) const {
    if (candidates.empty()) return;
    if (candidates.size() == 1 || candidates.front()->playable->tree) {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (!found[i].collides()) find_first(*candidates[i], found[i]);
        }
        return;
    }
    for (std::size_t first = 0; first < candidates.size(); first += kAtATime) {
        const std::size_t count = std::min(kAtATime, candidates.size() - first);
        for (std::size_t from = 0; from < near_.size(); from += kAtATime)
            find_first_in(candidates.subspan(first, count), from, found.subspan(first, count));
    }
}

template <class Visit>
int Surroundings::ask_on(const PlayedMove& candidate, const FirstMet& met, const Visit& visit) const {
    int asked = met.asked - 1;
    double earliest = std::numeric_limits<double>::infinity();
    for (std::size_t i = met.index; i < near_.size(); ++i) {
        const Near& other = near_[i];
        // What begins after the earliest contact cannot be met before it.
        if (other.begin > earliest) break;
        if (!comes_near(candidate, other)) continue;
        ++asked;
        const auto contact = contact_of(candidate, *other.motion);
        if (!contact) continue;
        earliest = std::min(earliest, contact->time);
        visit(*other.motion, *contact);
    }
    return asked;
}

int Surroundings::append(const PlayedMove& candidate, int count, std::vector<AskedPair>& asked) const {
    for (auto other = near_.begin(); count > 0 && other != near_.end(); ++other) {
        if (!comes_near(candidate, *other)) continue;
        asked.push_back({candidate, *other->motion});
        --count;
    }
    return count;
}

CandidateCheck Surroundings::check(const PlayedMove& candidate, const FirstMet& met) const {
    if (!met.collides()) return {false, met.asked};
    const auto near = [&](const Near& other) { return comes_near(candidate, other); };
    const auto last = std::find_if(near_.rbegin(), near_.rend(), near);
    // No contact is before the candidate: what has begun by then is asked, whenever the earliest is.
    if (last->begin > candidate.begin())
        return {true, ask_on(candidate, met, [](const PlayedMove&, const mobb::Contact&) {})};
    const auto behind = near_.begin() + static_cast<std::ptrdiff_t>(met.index) + 1;
    return {true, met.asked + static_cast<int>(std::count_if(behind, last.base(), near))};
}

std::vector<CandidateCheck> Surroundings::check_all(std::span<const PlayedMove* const> candidates,
                                                    std::vector<AskedPair>* asked) const {
    std::vector<CandidateCheck> out(candidates.size());
    const auto check_range = [&](std::size_t begin, std::size_t end) {
        std::vector<FirstMet> met(end - begin);
        find_first(candidates.subspan(begin, end - begin), met);
        for (std::size_t i = begin; i != end; ++i) out[i] = check(*candidates[i], met[i - begin]);
    };
    if (candidates.size() <= kGrain) {
        check_range(0, candidates.size());
    } else {
        limit_worker_threads();
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), kGrain),
                          [&](const auto& range) { check_range(range.begin(), range.end()); });
    }
    for (std::size_t i = 0; asked && i < candidates.size(); ++i) append(*candidates[i], out[i].asked, *asked);
    return out;
}

std::optional<Blocker> Surroundings::blocker(const PlayedMove& candidate) const {
    std::optional<Blocker> out;
    FirstMet met;
    find_first(candidate, met);
    if (!met.collides()) return out;
    ask_on(candidate, met, [&](const PlayedMove& other, const mobb::Contact& contact) {
        if (!out || std::tuple(contact.time, other.agent) < std::tuple(out->contact.time, out->agent)) {
            out = {other.agent,   other.play,     contact,
                   other.planned, other.move,     other.playable->blocks.shared_clip(),
                   other.at,      other.is_joint, candidate.is_joint};
        }
    });
    return out;
}

bool Surroundings::is_clear(const PlayedMove& candidate) const {
    FirstMet met;
    find_first(candidate, met);
    return !met.collides();
}

ContactTimes Surroundings::contact_times(const PlayedMove& candidate, double most) const {
    ContactTimes times;
    for (const Near& other : near_) {
        if (times.seconds > most) break;
        if (comes_near(candidate, other)) add_contacts(candidate, *other.motion, most, times);
    }
    return times;
}

}  // namespace mobbscope
