#include <import/nodes/gltf_animation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace mobbscope {

namespace {

glm::dquat quaternion(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

/// Between two unit quaternions along the shorter arc.
glm::dquat slerp(const glm::dquat& from, glm::dquat to, double share) {
    double cosine = glm::dot(from, to);
    if (cosine < 0) {  // q and -q are one rotation
        to = -to;
        cosine = -cosine;
    }
    // Near-parallel: the sines vanish, and the chord is as good as the arc.
    if (cosine > 1 - 1e-12) return glm::normalize(from * (1 - share) + to * share);
    const double angle = std::acos(cosine);
    return (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

void put(const glm::dquat& q, double* xyzw) {
    xyzw[0] = q.x;
    xyzw[1] = q.y;
    xyzw[2] = q.z;
    xyzw[3] = q.w;
}

/// Hermite's cubic between key `k` and the next, `span` seconds apart, at `share` of the way.
void cubic(const double* values, std::size_t width, std::size_t k, double span, double share, double* out) {
    const double s2 = share * share;
    const double s3 = s2 * share;
    const double* from = values + 3 * k * width;
    const double* to = from + 3 * width;
    for (std::size_t i = 0; i < width; ++i) {
        const double out_tangent = from[2 * width + i];
        const double in_tangent = to[i];
        out[i] = (2 * s3 - 3 * s2 + 1) * from[width + i] + span * (s3 - 2 * s2 + share) * out_tangent +
                 (3 * s2 - 2 * s3) * to[width + i] + span * (s3 - s2) * in_tangent;
    }
}

/// The value of a channel at a time: clamped outside the keys. Three numbers, or a quaternion's four (x y z w) of unit
/// length, into `out`.
void evaluate(const GltfChannel& channel, double seconds, double* out) {
    const std::vector<double>& times = *channel.times;
    const bool is_rotation = channel.property == NodeProperty::rotation;
    const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
    const std::size_t width = is_rotation ? 4 : 3;
    const double* values = channel.values->data();
    const auto value = [&](std::size_t key) { return values + (is_cubic ? 3 * key + 1 : key) * width; };

    const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
    const std::size_t key = after == 0 ? 0 : after - 1;
    const bool is_between = after > 0 && after < times.size() && channel.interpolation != Interpolation::step;
    if (!is_between) {
        std::copy_n(value(key), width, out);
    } else {
        const double span = times[after] - times[key];
        const double share = (seconds - times[key]) / span;
        if (is_cubic) {
            cubic(values, width, key, span, share, out);
        } else if (is_rotation) {
            put(slerp(glm::normalize(quaternion(value(key))), glm::normalize(quaternion(value(after))), share), out);
        } else {
            for (std::size_t i = 0; i < width; ++i) out[i] = value(key)[i] + share * (value(after)[i] - value(key)[i]);
        }
    }
    if (is_rotation) {
        const double length = glm::length(quaternion(out));
        // Tangents may lead a spline through zero, where no rotation is meant; the key before it is.
        put(length > 0 ? quaternion(out) / length : glm::normalize(quaternion(value(key))), out);
    }
}

/// The channels of one node, by NodeProperty.
using ChannelsOfNode = std::array<std::optional<GltfChannel>, 3>;

Affine local_at(const GltfRest& rest, const ChannelsOfNode& channels, double seconds) {
    TranslationRotationScale local = rest.parts;
    std::array<double, 4> v{};
    const auto take = [&](NodeProperty property) {
        const std::optional<GltfChannel>& channel = channels[static_cast<std::size_t>(property)];
        if (channel) evaluate(*channel, seconds, v.data());
        return channel.has_value();
    };
    if (take(NodeProperty::translation)) local.translation = {v[0], v[1], v[2]};
    // Of a node with a matrix only this can move.
    if (!channels[1] && !channels[2]) return {rest.matrix.linear, local.translation};
    if (take(NodeProperty::rotation)) local.rotation = {v[3], v[0], v[1], v[2]};
    if (take(NodeProperty::scale)) local.scale = {v[0], v[1], v[2]};
    return local.affine();
}

}  // namespace

std::function<void(std::optional<double>, std::span<const PosedNode>, std::span<Affine>)> gltf_pose(
    std::shared_ptr<const std::vector<GltfRest>> rest, const std::vector<GltfChannel>& channels) {
    std::map<int, ChannelsOfNode> moved;
    for (const GltfChannel& channel : channels) {
        moved[channel.node][static_cast<std::size_t>(channel.property)] = channel;
    }
    return [rest = std::move(rest), moved = std::move(moved)](std::optional<double> seconds,
                                                              std::span<const PosedNode> nodes, std::span<Affine> out) {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const GltfRest& at_rest = (*rest)[as_index(nodes[i].node)];
            const auto at = seconds ? moved.find(nodes[i].node) : moved.end();
            const Affine local = at == moved.end() ? at_rest.matrix : local_at(at_rest, at->second, *seconds);
            out[i] = nodes[i].above < 0 ? local : out[as_index(nodes[i].above)] * local;
        }
    };
}

}  // namespace mobbscope
