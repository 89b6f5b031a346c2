#include <base/text.h>
#include <import/fbx/animation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

/// x^exponent for an exponent in [0, 1]; of a negative x with its sign, but 1 for an exponent of 0.
double signed_power(double x, double exponent) {
    return exponent > 0 ? std::copysign(std::pow(std::abs(x), exponent), x) : 1;
}

glm::dvec3 signed_powers(const glm::dvec3& v, double exponent) {
    return {signed_power(v.x, exponent), signed_power(v.y, exponent), signed_power(v.z, exponent)};
}

/// A layer over what is below it.
glm::dvec3 blended(const FbxLayer& layer, double weight, FbxProperty property, int order, const glm::dvec3& below,
                   const glm::dvec3& value) {
    using Blend = FbxLayer::Blend;
    if (layer.blend == Blend::replace) return value;
    const bool is_sum = layer.blend == Blend::add;
    if (property == FbxProperty::scaling && layer.multiplies_scales)
        return (is_sum ? below : signed_powers(below, 1 - weight)) * signed_powers(value, weight);
    if (property == FbxProperty::rotation && layer.composes_rotations) {
        const glm::dquat from = fbx_rotation(below, order);
        const glm::dquat to = fbx_rotation(value, order);
        const glm::dquat none{1, 0, 0, 0};
        return fbx_angles(is_sum ? from * glm::slerp(none, to, weight) : glm::slerp(from, to, weight), order);
    }
    return is_sum ? below + weight * value : (1 - weight) * below + weight * value;
}

/// Finds the curve nodes and curves of stacks, each read once.
class StackReader {
  public:
    StackReader(FbxDocument& document, const FbxObjects& objects, const std::map<std::int64_t, std::size_t>& node_of,
                double ticks_per_second)
        : document_(document), objects_(objects), node_of_(node_of), ticks_per_second_(ticks_per_second) {
        for (const FbxConnection& connection : objects.connections()) {
            const FbxObject* const from = connection.property.empty() ? nullptr : objects.find(connection.from);
            if (from && from->kind == "AnimationCurveNode") targets_[connection.from].push_back(connection);
        }
    }

    FbxStack read(const FbxObject& stack) {
        FbxStack out;
        out.name = stack.name;
        objects_.each_property(stack, [&](std::string_view name, std::span<const FbxValue> values) {
            if (name == "LocalStart") out.begin = values[0].real / ticks_per_second_;
            if (name == "LocalStop") out.end = values[0].real / ticks_per_second_;
        });
        std::vector<const FbxObject*> layers;
        for (const FbxConnection& connection : objects_.to(stack.id)) {
            const FbxObject* const layer = objects_.find(connection.from);
            // A layer belongs to one stack, a curve node to one layer: otherwise a small file could ask for any work.
            if (layer && layer->kind == "AnimationLayer" && connection.property.empty() &&
                taken_.insert(layer->id).second)
                layers.push_back(layer);
        }
        std::vector<bool> is_muted(layers.size());
        std::vector<bool> is_solo(layers.size());
        for (std::size_t i = 0; i < layers.size(); ++i) {
            objects_.each_property(*layers[i], [&](std::string_view name, std::span<const FbxValue> values) {
                if (name == "Mute") is_muted[i] = values[0].real != 0;
                if (name == "Solo") is_solo[i] = values[0].real != 0;
            });
        }
        const bool some_are_solo = std::ranges::find(is_solo, true) != is_solo.end();
        std::map<std::pair<std::size_t, FbxProperty>, std::vector<FbxAnimatedProperty::InLayer>> found;
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (is_muted[i] || (some_are_solo && !is_solo[i])) {
                out.warnings.push_back(
                    "the layer " + in_quotes(layers[i]->name) +
                    (is_muted[i] ? " is muted: it was left out" : " was left out beside a solo one"));
                continue;
            }
            FbxLayer layer = read_layer(*layers[i]);
            layer.is_base = i == 0;
            for (const FbxConnection& part : objects_.to(layers[i]->id)) {
                const auto targets = targets_.find(part.from);
                if (targets == targets_.end() || !taken_.insert(part.from).second) continue;
                const FbxTrack& moved = track(part.from);
                for (const FbxConnection& target : targets->second) {
                    const auto node = node_of_.find(target.to);
                    const std::optional<FbxProperty> property = fbx_property(target.property);
                    if (node == node_of_.end() || !property) continue;
                    std::vector<FbxAnimatedProperty::InLayer>& in = found[{node->second, *property}];
                    if (!in.empty() && in.back().layer == out.layers.size()) continue;
                    in.push_back({out.layers.size(), moved});
                }
            }
            out.layers.push_back(std::move(layer));
        }
        for (auto& [key, in] : found) out.properties.push_back({key.first, key.second, std::move(in)});
        return out;
    }

  private:
    FbxLayer read_layer(const FbxObject& object) {
        FbxLayer layer;
        const auto share = [](double percent) { return std::clamp(percent / 100, 0.0, 1.0); };
        objects_.each_property(object, [&](std::string_view name, std::span<const FbxValue> values) {
            const double value = values[0].real;
            if (name == "Weight") layer.weight = share(value);
            if (name == "BlendMode") {
                using Blend = FbxLayer::Blend;
                layer.blend = value == 0 ? Blend::add : value == 2 ? Blend::mix : Blend::replace;
            }
            if (name == "RotationAccumulationMode") layer.composes_rotations = value == 0;
            if (name == "ScaleAccumulationMode") layer.multiplies_scales = value == 0;
        });
        const std::span<const FbxConnection> parts = objects_.to(object.id);
        const auto weights = std::ranges::find(parts, "Weight", &FbxConnection::property);
        if (weights != parts.end()) layer.weights = track(weights->from).curves[0];
        return layer;
    }

    const FbxTrack& track(std::int64_t curve_node) {
        const auto [known, is_new] = tracks_.try_emplace(curve_node);
        if (is_new) known->second = read_track(curve_node);
        return known->second;
    }

    FbxTrack read_track(std::int64_t curve_node) {
        FbxTrack out;
        const FbxObject* const object = objects_.find(curve_node);
        if (!object) return out;
        objects_.each_property_in(object->record, [&](std::string_view name, std::span<const FbxValue> values) {
            if (const auto axis = axis_of(name)) out.fixed[*axis] = values[0].real;
        });
        for (const FbxConnection& part : objects_.to(curve_node)) {
            const FbxObject* const curve = objects_.find(part.from);
            if (!curve || curve->kind != "AnimationCurve") continue;
            if (const auto axis = axis_of(part.property)) out.curves[*axis] = read_curve(*curve);
        }
        return out;
    }

    /// "d|X" is the first of the numbers; what is one number alone has its own name, "d|Weight".
    static std::optional<std::size_t> axis_of(std::string_view name) {
        if (!name.starts_with("d|")) return {};
        return name == "d|Y" ? 1u : name == "d|Z" ? 2u : 0u;
    }

    std::shared_ptr<const FbxCurve> read_curve(const FbxObject& object) {
        const auto [known, is_new] = curves_.try_emplace(object.id);
        if (is_new) known->second = fbx_curve(document_, object.record, ticks_per_second_);
        return known->second;
    }

    FbxDocument& document_;
    const FbxObjects& objects_;
    const std::map<std::int64_t, std::size_t>& node_of_;
    double ticks_per_second_;
    std::map<std::int64_t, std::vector<FbxConnection>> targets_;  ///< of curve nodes, the properties that they move
    std::map<std::int64_t, FbxTrack> tracks_;                     ///< by curve node
    std::map<std::int64_t, std::shared_ptr<const FbxCurve>> curves_;
    std::set<std::int64_t> taken_;  ///< layers and curve nodes
};

}  // namespace

glm::dvec3 FbxTrack::at(double seconds, const glm::dvec3& otherwise) const {
    glm::dvec3 out = otherwise;
    for (int i = 0; i < 3; ++i) {
        const std::size_t axis = as_index(i);
        out[i] = curves[axis] ? curves[axis]->at(seconds) : fixed[axis].value_or(otherwise[i]);
    }
    return out;
}

double FbxLayer::weight_at(double seconds) const {
    return weights ? std::clamp(weights->at(seconds) / 100, 0.0, 1.0) : weight;
}

glm::dvec3 FbxStack::value(const FbxAnimatedProperty& property, const FbxTransform& rest, double seconds) const {
    glm::dvec3 out = rest[property.property];
    for (const FbxAnimatedProperty::InLayer& in : property.layers) {
        const FbxLayer& layer = layers[in.layer];
        const glm::dvec3 nothing(property.property == FbxProperty::scaling ? 1 : 0);
        const glm::dvec3 value = in.track.at(seconds, layer.is_base ? out : nothing);
        out = layer.is_base
                  ? value
                  : blended(layer, layer.weight_at(seconds), property.property, rest.rotation_order, out, value);
    }
    return out;
}

namespace {

/// Of FBX 6: a stack of one layer.
FbxStack stack_of_take(FbxDocument& document, const FbxObjects& objects,
                       const std::map<std::int64_t, std::size_t>& node_of, FbxDocument::Index take,
                       double ticks_per_second) {
    constexpr std::string_view kProperties = "TRS", kAxes = "XYZ";
    const auto name_of = [&](FbxDocument::Index record) {
        const std::span<const FbxValue> values = document.values(record);
        return values.empty() ? std::string_view() : values[0].text;
    };
    FbxStack out;
    out.name = cleaned(name_of(take));
    const std::span<const FbxValue> times = document.values(document.find(take, "LocalTime"));
    if (times.size() == 2) {
        out.begin = times[0].real / ticks_per_second;
        out.end = times[1].real / ticks_per_second;
    }
    FbxLayer base;
    base.is_base = true;
    out.layers.push_back(std::move(base));
    std::map<std::pair<std::size_t, FbxProperty>, FbxTrack> found;
    const auto each_channel = [&](FbxDocument::Index record, std::string_view names, const auto& visit) {
        document.each_inside(record, [&](FbxDocument::Index channel) {
            const std::string_view name = name_of(channel);
            const std::size_t which = name.size() == 1 ? names.find(name[0]) : std::string_view::npos;
            if (document.record(channel).name == "Channel" && which != std::string_view::npos) visit(channel, which);
        });
    };
    document.each_inside(take, [&](FbxDocument::Index model) {
        const auto node = node_of.find(objects.id_of(name_of(model)));
        if (document.record(model).name != "Model" || node == node_of.end()) return;
        document.each_inside(model, [&](FbxDocument::Index transform) {
            if (document.record(transform).name != "Channel" || name_of(transform) != "Transform") return;
            each_channel(transform, kProperties, [&](FbxDocument::Index channel, std::size_t which) {
                constexpr std::array kMoved{FbxProperty::translation, FbxProperty::rotation, FbxProperty::scaling};
                const auto added = found.try_emplace({node->second, kMoved[which]});
                if (!added.second) return;
                FbxTrack& track = added.first->second;
                each_channel(channel, kAxes, [&](FbxDocument::Index number, std::size_t axis) {
                    const std::span<const FbxValue> fixed = document.values(document.find(number, "Default"));
                    if (!fixed.empty()) track.fixed[axis] = fixed[0].real;
                    track.curves[axis] = fbx_curve_of_channel(document, number, ticks_per_second);
                });
            });
        });
    });
    for (auto& [key, track] : found) out.properties.push_back({key.first, key.second, {{0, std::move(track)}}});
    return out;
}

}  // namespace

std::vector<FbxStack> fbx_stacks(FbxDocument& document, const FbxObjects& objects,
                                 const std::map<std::int64_t, std::size_t>& node_of, double ticks_per_second) {
    if (document.is_old()) {
        std::vector<FbxStack> takes;
        document.each_inside(document.find(FbxDocument::kFile, "Takes"), [&](FbxDocument::Index take) {
            if (document.record(take).name == "Take")
                takes.push_back(stack_of_take(document, objects, node_of, take, ticks_per_second));
        });
        return takes;
    }
    StackReader reader(document, objects, node_of, ticks_per_second);
    std::vector<FbxStack> out;
    for (const FbxObject& object : objects.all()) {
        if (object.kind == "AnimationStack") out.push_back(reader.read(object));
    }
    return out;
}

}  // namespace mobbscope
