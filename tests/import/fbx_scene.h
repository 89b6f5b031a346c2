/// Scenes for tests of the FBX reader, put together object by object, and where their joints are.
#pragma once

#include "fbx_writer.h"

#include <import/fbx/fbx.h>
#include <support/input_error.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
inline namespace testing {
namespace fbx {

inline constexpr double kTicks = 46'186'158'000;
inline constexpr std::int64_t kLinear = 0x4;
inline constexpr std::int64_t kStepped = 0x2;
inline constexpr std::int64_t kSteppedNext = 0x102;
inline constexpr std::int64_t kUser = 0x408;
inline constexpr std::int64_t kBroken = 0xC08;

using Properties = std::vector<std::pair<std::string, std::vector<FbxWritten>>>;

inline std::vector<FbxWritten> vector(double x, double y, double z) { return {x, y, z}; }
inline std::vector<FbxWritten> scalar(double value) { return {value}; }
inline std::vector<FbxWritten> choice(std::int64_t value) { return {value}; }

inline FbxWrite properties(const Properties& of) {
    FbxWrite out{"Properties70"};
    for (const auto& [name, values] : of) {
        FbxWrite property{"P", {name, std::string(), std::string(), std::string("A")}};
        property.values.insert(property.values.end(), values.begin(), values.end());
        out.add(std::move(property));
    }
    return out;
}

/// The keys of one number: linear ones, unless there are flags and tangents for each.
struct Keys {
    std::vector<double> seconds;
    std::vector<double> values;
    std::vector<std::int64_t> flags{};
    std::vector<std::pair<double, double>> slopes{};   ///< of each key: after it, and before the next one
    std::vector<std::pair<double, double>> weights{};  ///< likewise
    Properties ends{};  ///< "Pre-Extrapolation" and "Post-Extrapolation": a letter and a count
};

inline Keys line(double from, double to, double seconds = 2) { return {{0, seconds}, {from, to}}; }

/// A document in the making. By default a person in cm walks along x from 0 to 400 in 2 s.
class Scene {
  public:
    std::int64_t model(const std::string& name, std::int64_t parent, const Properties& of = {},
                       const std::string& type = "LimbNode") {
        const std::int64_t id = next_++;
        FbxWrite& model = objects_.add({"Model", {id, "Model::" + name, type}});
        model.add(properties(of));
        connect(id, parent);
        return id;
    }

    std::int64_t stack(const std::string& name, const Properties& of = {}) {
        const std::int64_t id = next_++;
        objects_.add({"AnimationStack", {id, "AnimStack::" + name, std::string()}}).add(properties(of));
        return id;
    }

    std::int64_t layer(std::int64_t stack, const Properties& of = {}) {
        const std::int64_t id = next_++;
        objects_.add({"AnimationLayer", {id, std::string("AnimLayer::over"), std::string()}}).add(properties(of));
        connect(id, stack);
        return id;
    }

    /// Curves for the axes that `keys` has; `fixed` are the numbers of the others. Gives the curve node.
    std::int64_t animate(std::int64_t layer, std::int64_t object, const std::string& property,
                         const std::vector<std::pair<std::string, Keys>>& keys, const Properties& fixed = {}) {
        const std::int64_t node = next_++;
        objects_.add({"AnimationCurveNode", {node, std::string("AnimCurveNode::T"), std::string()}})
            .add(properties(fixed));
        connect(node, layer);
        connect(node, object, property);
        for (const auto& [axis, of] : keys) connect(curve(of), node, "d|" + axis);
        return node;
    }

    std::int64_t curve(const Keys& keys) {
        const std::int64_t id = next_++;
        std::vector<std::int64_t> times;
        std::vector<std::uint32_t> data;
        for (const double seconds : keys.seconds) times.push_back(std::llround(seconds * kTicks));
        std::vector<std::int64_t> flags(keys.seconds.size(), kLinear);
        for (std::size_t i = 0; i < keys.flags.size(); ++i) flags[i] = keys.flags[i];
        for (std::size_t i = 0; i < flags.size(); ++i) {
            const auto [after, before] = i < keys.slopes.size() ? keys.slopes[i] : std::pair{0.0, 0.0};
            data.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(after)));
            data.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(before)));
            std::uint32_t weights = 0;
            if (i < keys.weights.size()) {
                flags[i] |= 0x3000000;
                weights = static_cast<std::uint32_t>(std::lround(keys.weights[i].first * 1e4)) |
                          static_cast<std::uint32_t>(std::lround(keys.weights[i].second * 1e4)) << 16;
            }
            data.push_back(weights);
            data.push_back(0);
        }
        FbxWrite& curve = objects_.add({"AnimationCurve", {id, std::string("AnimCurve::"), std::string()}});
        curve.add({"KeyTime", {times}});
        curve.add({"KeyValueFloat", {keys.values}});
        curve.add({"KeyAttrFlags", {flags}});
        curve.add({"KeyAttrDataFloat", {data}});
        curve.add({"KeyAttrRefCount", {std::vector<std::int64_t>(flags.size(), 1)}});
        for (const auto& [name, values] : keys.ends) {
            FbxWrite& end = curve.add({name});
            end.add({"Type", {values[0]}});
            end.add({"Repetition", {values[1]}});
        }
        return id;
    }

    void connect(std::int64_t from, std::int64_t to, const std::string& property = "") {
        FbxWrite connection{"C", {std::string(property.empty() ? "OO" : "OP"), from, to}};
        if (!property.empty()) connection.values.emplace_back(property);
        connections_.add(std::move(connection));
    }

    void setting(const std::string& name, FbxWritten value) { settings_.push_back({name, {std::move(value)}}); }
    void model_template(const Properties& of) {
        FbxWrite& type = definitions_.add({"ObjectType", {std::string("Model")}});
        type.add({"PropertyTemplate", {std::string("FbxNode")}}).add(properties(of));
    }
    FbxWrite& objects() { return objects_; }

    std::vector<FbxWrite> records() const {
        FbxWrite settings{"GlobalSettings"};
        settings.add(properties(settings_));
        return {settings, definitions_, objects_, connections_};
    }
    std::string bytes(const FbxForm& form = {}) const { return fbx_bytes(records(), form); }

  private:
    std::int64_t next_ = 1000;
    Properties settings_;
    FbxWrite definitions_{"Definitions"};
    FbxWrite objects_{"Objects"};
    FbxWrite connections_{"Connections"};
};

inline MotionFile parsed(const Scene& scene, const FbxForm& form = {}) {
    return parse_fbx(scene.bytes(form), "clip.fbx");
}

/// Where a joint of the first animation and character is, file units.
inline glm::dvec3 place(const Scene& scene, const std::string& joint, double seconds, const FbxForm& form = {}) {
    const auto motion = parsed(scene, form).motion(0, 0);
    std::vector<glm::dvec3> positions(motion->joints().size());
    motion->pose(seconds, positions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (motion->joints()[i].name == joint) return positions[i];
    }
    throw std::out_of_range(joint);
}

inline void expect_place(const glm::dvec3& place, double x, double y, double z, const std::string& what = "") {
    // Tangents are stored as floats.
    EXPECT_LT(glm::distance(place, {x, y, z}), 2e-5) << what << ": " << place.x << ' ' << place.y << ' ' << place.z;
}

inline std::string refusal(const std::string& bytes) {
    return input_error([&] { parse_fbx(bytes, "clip.fbx"); });
}

/// Hips that walk along x, 4 units in 2 s, with a hand 1 unit to their side.
struct Walk {
    explicit Walk(const Properties& hips_have = {},
                  const Properties& hand_has = {{"Lcl Translation", vector(0, 0, 1)}}) {
        hips = scene.model("Hips", 0, hips_have);
        hand = scene.model("Hand", hips, hand_has);
        stack = scene.stack("Take 001");
        base = scene.layer(stack);
        scene.animate(base, hips, "Lcl Translation", {{"X", line(0, 4)}});
    }
    glm::dvec3 hips_at(double seconds) const { return place(scene, "Hips", seconds); }
    glm::dvec3 hand_at(double seconds) const { return place(scene, "Hand", seconds); }

    Scene scene;
    std::int64_t hips = 0, hand = 0, stack = 0, base = 0;
};

}  // namespace fbx
}  // namespace testing
}  // namespace mobbscope
