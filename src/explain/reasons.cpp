#include <explain/query_sentence.h>
#include <explain/reasons.h>

#include <algorithm>

namespace mobbscope {

namespace {

const RecursionPair& pair_at(const Recursion& recursion, int pair) {
    return recursion.pairs[static_cast<std::size_t>(pair)];
}

/// The first pair that is not below this one.
int behind(const Recursion& recursion, int pair) {
    const auto end = static_cast<std::size_t>(pair_at(recursion, pair).end);
    return end < recursion.pair_of.size() ? recursion.pair_of[end] : static_cast<int>(recursion.pairs.size());
}

/// Pairs of which `holds` is true, without looking below others: children lie within their parents.
template <class Holds>
std::vector<int> pairs_that_hold(const Recursion& recursion, const Holds& holds) {
    std::vector<int> out;
    for (int pair = 0; pair < static_cast<int>(recursion.pairs.size());) {
        if (!holds(pair_at(recursion, pair))) {
            pair = behind(recursion, pair);
            continue;
        }
        out.push_back(pair++);
    }
    return out;
}

/// Recording stopped within it.
bool is_open(const Recursion& recursion, int pair) {
    return recursion.stopped && pair_at(recursion, pair).end == static_cast<int>(recursion.pair_of.size());
}

bool holds(const mobb::Interval& node, double time, const mobb::Interval& root) {
    return node.t0 <= time && (time < node.t1 || (time == root.t1 && node.t1 == root.t1));
}

}  // namespace

std::vector<int> pairs_at(const Recursion& recursion, double time_a, double time_b) {
    if (recursion.pairs.empty()) return {};
    const RecursionPair& root = recursion.pairs.front();
    return pairs_that_hold(recursion, [&](const RecursionPair& pair) {
        return holds(pair.time_a, time_a, root.time_a) && holds(pair.time_b, time_b, root.time_b);
    });
}

std::vector<int> end_pairs_of_sample(const Recursion& recursion, const mobb::Tree& tree, int side, int sample) {
    std::vector<int> out = pairs_that_hold(recursion, [&](const RecursionPair& pair) {
        const mobb::Node& node = tree.node(side == 0 ? pair.a : pair.b);
        return node.first <= sample && sample < node.end();
    });
    std::erase_if(out, [&](int pair) { return pair_at(recursion, pair).has_children(); });
    return out;
}

std::vector<int> children_of(const Recursion& recursion, int pair) {
    std::vector<int> out;
    if (!pair_at(recursion, pair).has_children()) return out;
    const int end = behind(recursion, pair);
    for (int child = pair + 1; child < end; child = behind(recursion, child)) out.push_back(child);
    return out;
}

std::string how_it_ended(const Recursion& recursion, int pair) {
    const std::vector<int> children = children_of(recursion, pair);
    if (children.empty()) return "";
    if (is_open(recursion, pair)) return "recording stopped before it ended";
    const auto hit = std::ranges::find_if(children, [&](int child) { return pair_at(recursion, child).hit; });
    const std::string all = std::to_string(children.size());
    if (hit != children.end()) return "a hit in number " + std::to_string(hit - children.begin() + 1) + " of " + all;
    const auto met = std::ranges::count_if(children, [&](int child) {
        const mobb::Outcome outcome = pair_at(recursion, child).outcome;
        return outcome == mobb::Outcome::overlap || outcome == mobb::Outcome::no_hit;
    });
    const std::string of_all = " of its " + all + " met";
    return met == 0 ? "none" + of_all : std::to_string(met) + of_all + ", without a hit";
}

std::vector<int> pairs_ended_at(const Recursion& recursion, int event) {
    std::vector<int> out;
    for (int pair = recursion.pair_of[static_cast<std::size_t>(event)]; pair >= 0;
         pair = pair_at(recursion, pair).parent) {
        if (pair_at(recursion, pair).end != event + 1 || is_open(recursion, pair)) break;
        if (pair_at(recursion, pair).has_children()) out.push_back(pair);
    }
    return out;
}

std::vector<std::string> ended_words(std::span<const DrawnAgent> sides, const Recursion& recursion, int event) {
    std::vector<std::string> out;
    for (const int pair : pairs_ended_at(recursion, event)) {
        const RecursionPair& ended = pair_at(recursion, pair);
        out.push_back(node_name(sides[0], ended.a) + " against " + node_name(sides[1], ended.b) + ": " +
                      how_it_ended(recursion, pair));
    }
    return out;
}

}  // namespace mobbscope
