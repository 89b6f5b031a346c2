#include <mobb/chain.h>
#include <mobb/fitting.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobb {

namespace {

std::shared_ptr<const Tree> existing_tree(std::shared_ptr<const Tree> tree) {
    if (!tree) throw std::invalid_argument("a chain part needs a tree");
    return tree;
}

/// An upper bound on |x| + |y| + r over the link's disks, in the chain's frame.
double reach_of(const ChainLink& link) {
    return std::abs(link.translate.x) + std::abs(link.translate.y) + std::numbers::sqrt2 * link.part->clip().reach();
}

bool of_linear_clip(const Tree& tree) { return tree.clip().motion() == Motion::linear; }

/// How many bits tell the nodes of a link apart: those of its tree, and the joint behind a linear one.
int bits_for(const Tree& tree) {
    return static_cast<int>(std::bit_width(tree.nodes().size() - (of_linear_clip(tree) ? 0 : 1)));
}

/// From the first centre to the last; where they coincide, what stands in for it.
glm::dvec2 chain_axis(const Disk& first, const Disk& last, glm::dvec2 stand_in) {
    const glm::dvec2 travel{last.x - first.x, last.y - first.y};
    const double length = glm::length(travel);
    return length > kStandingStill ? travel / length : stand_in;
}

KDop outline_of(std::span<const Disk> disks) {
    return {disks, chain_axis(disks.front(), disks.back(), principal_axis(disks))};
}

/// The rectangle around an outline along its axis, a little wider for rounding errors.
Rectangle chain_rectangle(const KDop& outline, double rounding) {
    return {outline.center(), outline.axis(), outline.half() + rounding};
}

[[noreturn]] void refuse(std::size_t link, const char* what) {
    throw std::invalid_argument("link " + std::to_string(link) + ": " + what);
}

}  // namespace

ChainPart::ChainPart(std::shared_ptr<const Tree> tree)
    : tree_(existing_tree(std::move(tree))), outline_(outline_of(tree_->clip().samples())) {}

Chain::Chain(std::span<const ChainLink> links) {
    if (links.empty()) throw std::invalid_argument("a chain needs at least one link");
    append(links);
}

void Chain::append(std::span<const ChainLink> links) {
    // Everything is checked first: a chain that refuses a link is as it was.
    if (links.empty()) return;
    const ChainPart* like = (links_.empty() ? links.front().part : links_.front().part).get();
    std::size_t samples = links_.empty() ? 0 : static_cast<std::size_t>(end());
    int shift = shift_;
    double reach = reach_;
    for (std::size_t k = 0; k < links.size(); ++k) {
        const ChainLink& link = links[k];
        const auto fail = [k](const char* what) { refuse(k, what); };
        if (!link.part || !like) refuse(k, "it has no part");
        const Tree& tree = link.part->tree();
        if (tree.clip().dt() != like->clip().dt()) fail("its dt must be that of the chain's other clips");
        if (tree.time_scale() != like->tree().time_scale())
            fail("its time_scale must be that of the chain's other trees");
        if (!is_valid({.translate = link.translate, .rotate_deg = link.rotate_deg}) || reach_of(link) > kMaxLength) {
            fail("its placement must be finite and keep the clip within 1e9 m");
        }
        samples += static_cast<std::size_t>(tree.clip().count());
        if (samples > kMaxSamples) fail("with it the chain has more than 500000000 samples");
        if (static_cast<double>(samples) * tree.clip().dt() > kMaxTime)
            fail("with it the chain lasts longer than 1e12 s");
        if (mobb::most_start(tree.clip().dt(), static_cast<double>(samples) * tree.clip().dt()) < 0)
            fail("with it the chain is so long that doubles cannot tell its samples' times apart");
        shift = std::max(shift, bits_for(tree));
        reach = std::max(reach, reach_of(link));
    }
    const auto count = static_cast<std::int64_t>(links_.size() + links.size());
    // Above the links stand fewer than two nodes for each, with joints.
    if ((count << shift) + 2 * count > std::numeric_limits<int>::max()) {
        throw std::invalid_argument("the chain has too many nodes: use fewer links, or trees with larger leaves");
    }
    if (links_.empty()) {
        dt_ = like->clip().dt();
        time_scale_ = like->tree().time_scale();
        links_.reserve(links.size());
        upper_.reserve(links.size());
    }
    shift_ = shift;
    reach_ = reach;
    for (const ChainLink& link : links) {
        const Tree& tree = link.part->tree();
        push({link.part, tree.nodes().data(), tree.clip().samples().data(), link.rotate_deg.rotation(), link.translate,
              links_.empty() ? 0 : end(), tree.clip().count(), of_linear_clip(tree), false, 0});
    }
    join_peaks();
}

void Chain::drop_before(double seconds) {
    if (std::isnan(seconds)) throw std::invalid_argument("the chain time to drop before must not be NaN");
    const auto ends_later = [&](const Link& link) { return link.end() * dt_ > seconds; };
    auto stays = std::find_if(links_.begin(), links_.end() - 1, ends_later);
    if (stays == links_.begin()) return;
    std::vector<Link> kept(std::make_move_iterator(stays), std::make_move_iterator(links_.end()));
    links_.clear();
    linear_ = false;
    upper_.clear();
    peaks_.clear();
    perfect_ = 0;
    for (Link& link : kept) push(std::move(link));
    join_peaks();
}

/// A binary counter: two perfect trees of one size become one of the next.
void Chain::push(Link link) {
    upper_.resize(perfect_);
    const int k = static_cast<int>(links_.size());
    const bool has_joint = k > 0 && links_.back().linear;
    if (has_joint) links_.back().until = links_.back().end() - 1;
    if (k > 0) link.is_run_to = has_joint;
    link.until = link.linear && (link.count > 1 || link.is_run_to) ? link.end() - 1 : link.end();
    linear_ = linear_ || link.linear;
    Peak peak{root_child(k), k, 1, link.part->outline().placed(link.rotation, link.translate)};
    links_.push_back(std::move(link));
    if (has_joint) peak = with_joint(peak);
    while (!peaks_.empty() && peaks_.back().links == peak.links) {
        peak = joined(peaks_.back(), peak);
        peaks_.pop_back();
    }
    peaks_.push_back(peak);
    perfect_ = upper_.size();
}

/// The spine: from the smallest tree at the end to the largest in front.
void Chain::join_peaks() {
    Peak all = peaks_.back();
    for (std::size_t i = peaks_.size() - 1; i > 0; --i) all = joined(peaks_[i - 1], all);
}

/// A link, and the joint in front of it.
Chain::Peak Chain::with_joint(const Peak& link) {
    const int k = link.first_link;
    Link& before = links_[static_cast<std::size_t>(k - 1)];
    const std::array<Disk, 2> ends{before.disk(before.end() - 1), before.runs_on_to()};
    const KDop joint(ends, chain_axis(ends[0], ends[1], {1, 0}));
    before.joint = chain_rectangle(joint, kKDopRounding * reach_);
    return joined({joint_child(k - 1), k, 0, joint}, link);
}

Chain::Peak Chain::joined(const Peak& left, const Peak& right) {
    const int links = left.links + right.links;
    const Link& first = links_[static_cast<std::size_t>(left.first_link)];
    const Link& last = links_[static_cast<std::size_t>(left.first_link + links - 1)];
    // The joint in front of its first link is part of a tree; of the first link of all it has been dropped.
    const bool has_joint = left.first_link > 0 && first.is_run_to;
    const Link& begins = has_joint ? links_[static_cast<std::size_t>(left.first_link - 1)] : first;
    const int first_sample = first.first - (has_joint ? 1 : 0);
    const glm::dvec2 axis = chain_axis(begins.disk(first_sample), last.disk(last.end() - 1), left.outline.axis());
    Peak peak{static_cast<int>(upper_.size()), left.first_link, links, {left.outline, right.outline, axis}};
    upper_.push_back({chain_rectangle(peak.outline, kKDopRounding * reach_),
                      first_sample,
                      left.first_link + links - 1,
                      {left.child, right.child}});
    return peak;
}

const Chain::Link& Chain::link_of(int sample) const {
    return *std::prev(std::ranges::upper_bound(links_, sample, {}, &Link::first));
}

Disk Chain::disk(int i) const { return link_of(i).disk(i); }

Disk Chain::disk_at_end(int i) const {
    const Link& link = link_of(i);
    if (!link.linear || i == end() - 1) return link.disk(i);
    return i + 1 < link.end() ? link.disk(i + 1) : link.runs_on_to();
}

Clip flattened(const Chain& chain) {
    const Motion motion = chain.part(0).clip().motion();
    for (int k = 1; k < chain.links(); ++k) {
        if (chain.part(k).clip().motion() != motion) throw std::invalid_argument("its clips are both held and linear");
    }
    if (chain.until() == chain.first()) throw std::invalid_argument("the rest of the chain has no duration");
    std::vector<Disk> samples;
    samples.reserve(static_cast<std::size_t>(chain.end() - chain.first()));
    for (int i = chain.first(); i < chain.end(); ++i) samples.push_back(chain.disk(i));
    return {chain.dt(), std::move(samples), motion};
}

}  // namespace mobb
