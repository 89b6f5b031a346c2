#include <base/text.h>
#include <explain/compared_fits.h>
#include <explain/query_workload.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mobbscope {

namespace {

void find_best_of(ComparedLevel& level, double alike_cost) {
    find_best(level.volume, Better::less);
    find_best(level.fill, Better::more);
    find_best(level.cost, Better::less, alike_cost);
}

/// Up to which part of them costs may differ by chance. All fits are asked the same placements, so their difference
/// has a smaller error than this.
double chance_of(std::span<const std::shared_ptr<const TreeCost>> costs) {
    double largest = 0;
    for (const auto& cost : costs) {
        if (cost && cost->workload == QueryWorkload::Kind::placements)
            largest = std::max(largest, cost->count.standard_error());
    }
    return std::max(kAlike, kSureErrors * std::numbers::sqrt2 * largest);
}

ComparedLevel empty_level(int level, std::size_t fits) {
    const ComparedFigure none{std::vector<std::optional<double>>(fits), -1};
    return {level, none, none, none};
}

/// How much smaller the best is than the next one, in per cent.
std::string less_than_next(const ComparedFigure& figure) {
    const double best = *figure.values[static_cast<std::size_t>(figure.best)];
    std::optional<double> next;
    for (std::size_t i = 0; i < figure.values.size(); ++i) {
        if (static_cast<int>(i) != figure.best && figure.values[i])
            next = std::min(next.value_or(*figure.values[i]), *figure.values[i]);
    }
    return formatted("%.0f %%", 100 * (1 - best / *next));
}

/// "level 3", "levels 0 to 4", "levels 0, 2 and 3".
std::string levels_in_words(const std::vector<int>& levels) {
    if (levels.size() == 1) return "level " + std::to_string(levels.front());
    if (levels.size() > 2 && levels.back() - levels.front() + 1 == static_cast<int>(levels.size()))
        return "levels " + std::to_string(levels.front()) + " to " + std::to_string(levels.back());
    std::string out = "levels ";
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (i > 0) out += i + 1 == levels.size() ? " and " : ", ";
        out += std::to_string(levels[i]);
    }
    return out;
}

/// On which levels a fit is the tightest.
struct TightestOn {
    int fit;
    std::vector<int> levels;
};

/// In the order of their first levels; levels without a tightest fit are left out.
std::vector<TightestOn> tightest_on(const ComparedFits& fits) {
    std::vector<TightestOn> out;
    for (const ComparedLevel& level : fits.levels) {
        if (level.volume.best < 0) continue;
        const auto known = std::ranges::find(out, level.volume.best, &TightestOn::fit);
        if (known == out.end())
            out.push_back({level.volume.best, {level.level}});
        else
            known->levels.push_back(level.level);
    }
    return out;
}

}  // namespace

void find_best(ComparedFigure& figure, Better better, double alike) {
    const auto sign = better == Better::less ? 1.0 : -1.0;
    const auto has_more = [&](std::size_t fit) {
        if (!figure.values[fit]) return false;
        const double best = *figure.values[fit];
        std::size_t others = 0;
        for (std::size_t i = 0; i < figure.values.size(); ++i) {
            if (i == fit || !figure.values[i]) continue;
            ++others;
            if (!(sign * (*figure.values[i] - best) > alike * std::abs(*figure.values[i]))) return false;
        }
        return others > 0;
    };
    for (std::size_t fit = 0; fit < figure.values.size(); ++fit) {
        if (has_more(fit)) figure.best = static_cast<int>(fit);
    }
}

std::optional<double> ComparedFigure::difference(std::size_t fit) const {
    if (!values.front() || !values[fit] || *values.front() == 0) return std::nullopt;
    return *values[fit] / *values.front() - 1;
}

bool ComparedFits::differ_in_depth() const {
    const auto& last = levels.back().volume.values;
    return !std::ranges::all_of(last, [](const std::optional<double>& value) { return value.has_value(); });
}

ComparedFits compared(std::span<const std::shared_ptr<const mobb::Tree>> trees,
                      std::span<const std::shared_ptr<const TreeCost>> costs) {
    ComparedFits out;
    std::vector<mobb::FitOptions> options;
    for (const auto& tree : trees) options.push_back(tree->options());
    out.names = names_of_fits(options);
    out.leaves = empty_level(-1, trees.size());
    out.cost = out.leaves.cost;
    for (std::size_t fit = 0; fit < trees.size(); ++fit) {
        const std::vector<mobb::LevelFigures> figures = mobb::level_figures(*trees[fit]);
        const TreeCost* cost = costs[fit].get();
        while (out.levels.size() < figures.size())
            out.levels.push_back(empty_level(static_cast<int>(out.levels.size()), trees.size()));
        for (std::size_t i = 0; i < figures.size(); ++i) {
            ComparedLevel& level = out.levels[i];
            level.volume.values[fit] = figures[i].volume;
            level.fill.values[fit] = figures[i].tightness;
            // Queries reached no level below those of the cost.
            if (cost) level.cost.values[fit] = i < cost->levels.size() ? cost->ns(cost->levels[i]) : 0;
        }
        out.leaves.volume.values[fit] = figures.back().volume;
        out.leaves.fill.values[fit] = figures.back().tightness;
        if (cost) out.cost.values[fit] = cost->ns();
    }
    const double alike = chance_of(costs);
    for (ComparedLevel& level : out.levels) find_best_of(level, alike);
    find_best_of(out.leaves, alike);
    find_best(out.cost, Better::less, alike);
    return out;
}

std::string verdict(const ComparedFits& fits) {
    const bool are_two = fits.names.size() == 2;
    const auto name = [&](int fit) { return fits.names[static_cast<std::size_t>(fit)]; };
    const std::vector<TightestOn> tightest = tightest_on(fits);
    const int at_leaves = fits.leaves.volume.best, cheapest = fits.cost.best;
    const auto known = std::ranges::count_if(fits.cost.values, [](const auto& cost) { return cost.has_value(); });
    const bool cost_alike = cheapest < 0 && known == std::ssize(fits.names);
    if (tightest.empty() && at_leaves < 0 && cost_alike)
        return are_two ? "Both are equally tight and cost about the same." : "No fit is tightest or cheapest.";
    std::string out;
    if (tightest.empty()) out = are_two ? "Both are equally tight" : "No fit is tightest";
    for (const TightestOn& each : tightest) {
        const bool on_all = each.levels.size() == fits.levels.size();
        const bool first = &each == &tightest.front();
        if (!first) out += &each == &tightest.back() ? " and " : ", ";
        out += name(each.fit);
        if (first) out += are_two ? " is tighter" : " is tightest";
        out += " on ";
        out += on_all ? "all levels" : levels_in_words(each.levels);
    }
    const bool one_is = tightest.size() == 1;
    if (at_leaves >= 0) {
        out += " (";
        if (!one_is || tightest.front().fit != at_leaves) out += name(at_leaves) + " has ";
        out += less_than_next(fits.leaves.volume) + " less volume at the leaves)";
    }
    if (cheapest >= 0) {
        const std::string less = less_than_next(fits.cost) + " less a query";
        if (one_is && tightest.front().fit == cheapest)
            out += " and costs " + less;
        else
            out += (one_is ? ", but " : "; ") + name(cheapest) + " costs " + less;
    } else if (cost_alike) {
        out += are_two ? "; both cost about the same" : "; no fit is cheapest";
    }
    return out + '.';
}

int node_over_same_samples(const mobb::Tree& from, int node, const mobb::Tree& to) {
    const mobb::Node& wanted = from.node(node);
    int out = 0;
    double most = -1;
    for (int i = 0; i < static_cast<int>(to.nodes().size()); ++i) {
        const mobb::Node& other = to.node(i);
        const int common = std::min(wanted.end(), other.end()) - std::max(wanted.first, other.first);
        if (common <= 0) continue;
        const double share = static_cast<double>(common) / (wanted.count + other.count - common);
        if (share > most) {
            most = share;
            out = i;
        }
    }
    return out;
}

}  // namespace mobbscope
