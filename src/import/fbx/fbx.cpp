#include <base/error.h>
#include <base/text.h>
#include <import/fbx/animation.h>
#include <import/fbx/document.h>
#include <import/fbx/fbx.h>
#include <import/fbx/objects.h>
#include <import/fbx/transform.h>
#include <import/nodes/node_scene.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kCentimetre = 0.01;  // the unit of UnitScaleFactor
// Time is counted in ticks: those of FBX 7, and those that TCDefinition brings.
constexpr double kTicksPerSecond = 46'186'158'000;
constexpr double kNewTicksPerSecond = 141'120'000;
constexpr std::int64_t kOldTicks = 127;          // of TCDefinition
constexpr std::int64_t kHeaderWithTicks = 1004;  // FBXHeaderVersion
constexpr double kTurn = 0.16;                   // degrees: a joint that turns less stands still
// A skeleton of so many joints is a body, however large others are; one joint alone is a prop.
constexpr std::size_t kJointsOfBody = 4;
constexpr std::size_t kMostJointsOfProp = 1;
constexpr double kMostSeconds = 1e6;  // of a stack; more is what programs write for "without end"
constexpr double kHeld = 0.5;         // seconds: a pose held beyond the keys for longer is said
constexpr double kLeastUnit = 1e-5;   // centimetres: what GlobalSettings may say
constexpr double kMostUnit = 1e7;
constexpr std::size_t kMostReused = 10'000'000;  // keys of curves that several stacks share

/// What a file's first record of the names leads to, as an integer.
std::optional<std::int64_t> integer_at(const FbxDocument& document, std::initializer_list<std::string_view> path) {
    FbxDocument::Index at = FbxDocument::kFile;
    for (const std::string_view name : path) at = document.find(at, name);
    const std::span<const FbxValue> values = document.values(at);
    return values.empty() ? std::nullopt : std::optional(values[0].integer);
}

double ticks_per_second(const FbxDocument& document) {
    const auto header = integer_at(document, {"FBXHeaderExtension", "FBXHeaderVersion"});
    const auto definition = integer_at(document, {"FBXHeaderExtension", "OtherFlags", "TCDefinition"});
    const bool is_told = definition && header.value_or(0) >= kHeaderWithTicks;
    const bool is_new = is_told ? *definition != kOldTicks : document.version() >= 8000;
    return is_new ? kNewTicksPerSecond : kTicksPerSecond;
}

/// An axis that GlobalSettings name: 0 to 2, or what is none; and its sign.
struct Axis {
    std::optional<std::int64_t> index;
    int sign = 1;

    bool is_one() const { return index && *index >= 0 && *index < 3; }
    glm::dvec3 direction() const {
        glm::dvec3 out(0);
        out[static_cast<int>(*index)] = sign;
        return out;
    }
};

/// The axes of a file.
struct Axes {
    Axis up, front, right;

    /// Whether those that are given are three different ones.
    bool agree() const {
        const auto is_apart = [](const Axis& a, const Axis& b) { return !a.index || !b.index || *a.index != *b.index; };
        const auto is_sound = [](const Axis& axis) { return !axis.index || axis.is_one(); };
        return is_sound(up) && is_sound(front) && is_sound(right) && is_apart(up, front) && is_apart(up, right) &&
               is_apart(front, right);
    }

    /// To x (right), y (away from the front) and z (up), where `up` is an axis. What the others do not say makes the
    /// axes right-handed.
    glm::dmat3 ground() const {
        const glm::dvec3 z = up.direction();
        std::optional<glm::dvec3> x, y;
        if (agree() && right.index) x = right.direction();
        if (agree() && front.index) y = -front.direction();
        if (!x && !y) x = *up.index == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        if (!x) x = glm::cross(*y, z);
        if (!y) y = glm::cross(z, *x);
        return glm::transpose(glm::dmat3(*x, *y, z)) + glm::dmat3(0);  // no negative zeros
    }
};

/// Whether a Model is of a skeleton, by its type.
bool is_limb(std::string_view type) {
    return type == "LimbNode" || type == "Limb" || type == "Root" || type == "Effector";
}

/// The scene without its motion, and the motion; shared by all that pose it.
struct PosedScene {
    std::vector<FbxTransform> rest;  ///< by node
    std::vector<FbxStack> stacks;

    /// Of one animation, by rising node.
    std::span<const FbxAnimatedProperty> moved(std::size_t stack, int node) const {
        const std::vector<FbxAnimatedProperty>& all = stacks[stack].properties;
        return {std::ranges::lower_bound(all, as_index(node), {}, &FbxAnimatedProperty::node),
                std::ranges::upper_bound(all, as_index(node), {}, &FbxAnimatedProperty::node)};
    }

    FbxTransform transform_at(std::size_t stack, int node, double seconds) const {
        FbxTransform out = rest[as_index(node)];
        for (const FbxAnimatedProperty& property : moved(stack, node)) {
            out[property.property] = stacks[stack].value(property, rest[as_index(node)], seconds);
        }
        return out;
    }

    /// What a pose takes beside the nodes: every layer over another.
    std::size_t more_steps(std::size_t stack, std::span<const PosedNode> nodes) const {
        std::size_t out = 0;
        for (const PosedNode& posed : nodes) {
            for (const FbxAnimatedProperty& property : moved(stack, posed.node)) out += property.layers.size() - 1;
        }
        return out;
    }

    void pose(std::size_t stack, std::optional<double> seconds, std::span<const PosedNode> nodes,
              std::span<Affine> out) const {
        std::vector<FbxGlobal> globals(nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto [node, above] = nodes[i];
            globals[i] = fbx_global(seconds ? transform_at(stack, node, *seconds) : rest[as_index(node)],
                                    above < 0 ? nullptr : &globals[as_index(above)]);
            out[i] = globals[i].node;
        }
    }
};

class FbxSceneBuilder {
  public:
    FbxSceneBuilder(std::string_view bytes, const std::string& file) : document_(bytes, file), objects_(document_) {
        scene_.file = file;
        scene_.format = "fbx";
        scene_.has_pivots = true;
    }

    NodeScene build() {
        add_settings();
        add_nodes();
        link_parents();
        posed_->stacks = fbx_stacks(document_, objects_, node_of_, ticks_per_second(document_));
        if (posed_->stacks.empty())
            throw InputError(scene_.file, "", "holds no animation; export the clip with its animation");
        for (std::size_t i = 0; i < posed_->stacks.size(); ++i) add_animation(i);
        find_characters();
        warn_of_orders();
        return std::move(scene_);
    }

  private:
    void add_settings() {
        Axes axes;
        std::optional<FbxValue> unit;
        const FbxDocument::Index above =
            document_.is_old() ? document_.find(FbxDocument::kFile, "Objects") : FbxDocument::kFile;
        objects_.each_property_in(document_.find(above, "GlobalSettings"),
                                  [&](std::string_view name, std::span<const FbxValue> values) {
                                      const FbxValue& value = values[0];
                                      const int sign = value.integer < 0 ? -1 : 1;
                                      if (name == "UpAxis") axes.up.index = value.integer;
                                      if (name == "UpAxisSign") axes.up.sign = sign;
                                      if (name == "FrontAxis") axes.front.index = value.integer;
                                      if (name == "FrontAxisSign") axes.front.sign = sign;
                                      if (name == "CoordAxis") axes.right.index = value.integer;
                                      if (name == "CoordAxisSign") axes.right.sign = sign;
                                      if (name == "UnitScaleFactor") unit = value;
                                  });
        take_axes(axes);
        const double centimetres = unit ? unit->real : 1;
        if (centimetres >= kLeastUnit && centimetres <= kMostUnit) {
            scene_.unit = centimetres * kCentimetre;
        } else {
            const std::string said = unit->kind == FbxValue::Kind::text ? in_quotes(unit->text) : brief(centimetres);
            scene_.unit_doubt = "GlobalSettings says UnitScaleFactor " + said +
                                ", which is not a unit: the unit was guessed from the body's height";
        }
    }

    void take_axes(const Axes& axes) {
        if (axes.up.is_one()) scene_.ground = axes.ground();
        if (axes.agree()) return;
        const auto said = [](const char* name, const Axis& axis) {
            return axis.index ? std::string(name) + " " + std::to_string(*axis.index) : std::string(name) + " as usual";
        };
        scene_.up_doubt = "GlobalSettings says " + said("UpAxis", axes.up) + ", " + said("FrontAxis", axes.front) +
                          " and " + said("CoordAxis", axes.right) +
                          ", which are not three axes: " + (scene_.ground ? "the first was used" : "y was taken as up");
    }

    void add_nodes() {
        for (const FbxObject& object : objects_.all()) {
            if (object.kind != "Model" || !node_of_.try_emplace(object.id, scene_.nodes.size()).second) continue;
            const std::string unnamed = "node" + std::to_string(scene_.nodes.size());
            scene_.nodes.push_back({object.name.empty() ? unnamed : object.name, -1});
            is_limb_.push_back(is_limb(object.type));
            posed_->rest.push_back(transform_of(object));
            if (posed_->rest.back().rotation_order >= kFbxRotationOrders)
                unordered_.push_back(scene_.nodes.back().name);
        }
    }

    FbxTransform transform_of(const FbxObject& object) const {
        FbxTransform out;
        bool is_active = true;
        bool is_for_limits = false;
        objects_.each_property(object, [&](std::string_view name, std::span<const FbxValue> values) {
            if (const auto property = fbx_property(name)) out[*property] = fbx_vector(values, out[*property]);
            const std::int64_t number = values[0].integer;
            if (name == "RotationOrder") out.rotation_order = static_cast<int>(std::clamp<std::int64_t>(number, 0, 9));
            if (name == "RotationActive") is_active = number != 0;
            if (name == "RotationSpaceForLimitOnly") is_for_limits = number != 0;
            if (name == "InheritType") {
                out.inherit = number == 0   ? FbxInherit::along_axes
                              : number == 2 ? FbxInherit::without_parent
                                            : FbxInherit::with_shear;
            }
        });
        out.has_rotation_space = is_active && !is_for_limits;
        return out;
    }

    void link_parents() {
        for (const FbxConnection& connection : objects_.connections()) {
            const auto child = node_of_.find(connection.from);
            const auto parent = node_of_.find(connection.to);
            if (!connection.property.empty() || child == node_of_.end() || parent == node_of_.end()) continue;
            int& link = scene_.nodes[child->second].parent;
            if (link < 0) link = static_cast<int>(parent->second);
        }
        const std::vector<int> lost = nodes_in_circles(scene_.nodes);
        if (lost.empty()) return;
        throw InputError(scene_.file, "Connections",
                         in_quotes(scene_.nodes[as_index(lost.front())].name) + ", one of " +
                             counted(lost.size(), "node", "nodes") + ", is its own ancestor; export the file again");
    }

    void add_animation(std::size_t index) {
        const FbxStack& stack = posed_->stacks[index];
        NodeAnimation animation;
        animation.name = stack.name.empty() ? "#" + std::to_string(index) : stack.name;
        std::map<const FbxCurve*, Numbers> times;
        for (const FbxAnimatedProperty& property : stack.properties) {
            bool moves = false;
            bool turns = false;
            for (const FbxAnimatedProperty::InLayer& in : property.layers) {
                for (const auto& curve : in.track.curves) {
                    if (!curve) continue;
                    moves = true;
                    turns = turns || (property.property == FbxProperty::rotation && !curve->is_constant(kTurn));
                    Numbers& list = times[curve.get()];
                    if (list) continue;
                    if (!seen_.insert(curve.get()).second) reuse(*curve);
                    list = std::make_shared<const std::vector<double>>(curve->times());
                }
            }
            const auto node = static_cast<int>(property.node);
            if (moves && (animation.moved.empty() || animation.moved.back() != node)) animation.moved.push_back(node);
            if (turns && (animation.turned.empty() || animation.turned.back() != node))
                animation.turned.push_back(node);
        }
        std::vector<Numbers> lists;
        for (const auto& [curve, list] : times) lists.push_back(list);
        animation.times = key_times(lists);
        animation.warnings = stack.warnings;
        hold(stack, animation);
        if (animation.moved.empty()) {
            animation.moves_nothing = "moves no node" +
                                      (stack.warnings.empty() ? "" : ", as " + stack.warnings.front()) +
                                      "; give a clip that does";
        }
        animation.more_steps = [posed = posed_, index](std::span<const PosedNode> nodes) {
            return posed->more_steps(index, nodes);
        };
        animation.pose = [posed = posed_, index](std::optional<double> seconds, std::span<const PosedNode> nodes,
                                                 std::span<Affine> out) { posed->pose(index, seconds, nodes, out); };
        scene_.animations.push_back(std::move(animation));
    }

    /// Before its first key and after its last one a stack may hold a pose.
    static void hold(const FbxStack& stack, NodeAnimation& animation) {
        MotionTimes& times = animation.times;
        if (!(stack.begin < stack.end)) return;
        if (std::max(-stack.begin, stack.end) > kMostSeconds) {
            animation.warnings.push_back("LocalStart and LocalStop are " + brief(stack.begin) + " s and " +
                                         brief(stack.end) + " s, which no clip lasts: its keys alone count");
            return;
        }
        if (times.first - stack.begin > kHeld || stack.end - times.last > kHeld) {
            animation.warnings.push_back("it plays from " + brief(stack.begin) + " s to " + brief(stack.end) +
                                         " s (LocalStart, LocalStop), but its keys are from " + brief(times.first) +
                                         " s to " + brief(times.last) +
                                         " s: a pose is held until there; trim it if that is not meant");
        }
        times.first = std::min(times.first, stack.begin);
        times.last = std::max(times.last, stack.end);
    }

    /// A curve is read once, but each stack that it moves lists its keys.
    void reuse(const FbxCurve& curve) {
        reused_ += curve.keys().size();
        if (reused_ > kMostReused) {
            throw InputError(scene_.file, "",
                             "its animation stacks share curves of too many keys; export fewer stacks at a time");
        }
    }

    void warn_of_orders() {
        if (unordered_.empty()) return;
        std::string nodes = in_quotes(unordered_.front());
        if (unordered_.size() > 1) nodes += " and " + counted(unordered_.size() - 1, "more node", "more nodes");
        warn_all("RotationOrder of " + nodes + " is not an order of three axes: read as XYZ");
    }

    void warn_of_props(const std::vector<std::string>& names) {
        if (names.size() == 1) {
            warn_all("the small skeleton " + in_quotes(names.front()) + " was left out; give root to follow it");
        } else if (!names.empty()) {
            warn_all("the small skeletons " + in_quotes(names.front()) + " and " + std::to_string(names.size() - 1) +
                     " more were left out; give root to follow one");
        }
    }

    void warn_all(const std::string& warning) {
        for (NodeAnimation& animation : scene_.animations) animation.warnings.push_back(warning);
    }

    /// Several skeletons are several people: each topmost limb with a body's joints below it, and what is above it and
    /// above no other. Smaller ones are props, and said.
    void find_characters() {
        const std::vector<Node>& nodes = scene_.nodes;
        const std::vector<bool> is_moved = moved_nodes(scene_);
        // Where no node is a limb, those that move are.
        const bool has_limbs = std::ranges::find(is_limb_, true) != is_limb_.end();
        const std::vector<bool>& counts = has_limbs ? is_limb_ : is_moved;
        const std::vector<int> order = parents_first(nodes);
        std::vector<int> top(nodes.size(), -1);          // of each node, the topmost limb that it is or is below
        std::vector<std::size_t> size(nodes.size(), 0);  // by that limb
        std::vector<int> first_moved(nodes.size(), -1);  // by that limb
        for (const int node : order) {
            const int parent = nodes[as_index(node)].parent;
            int& own = top[as_index(node)];
            own = parent < 0 ? -1 : top[as_index(parent)];
            if (own < 0 && counts[as_index(node)]) own = node;
            if (own < 0) continue;
            if (counts[as_index(node)]) ++size[as_index(own)];
            int& first = first_moved[as_index(own)];
            if (first < 0 && is_moved[as_index(node)]) first = node;
        }
        std::vector<int> skeletons;  // that move
        std::size_t largest = 0;
        for (const int node : order) {
            if (top[as_index(node)] != node || first_moved[as_index(node)] < 0) continue;
            skeletons.push_back(node);
            largest = std::max(largest, size[as_index(node)]);
        }
        if (largest <= kMostJointsOfProp) return;
        const auto is_body = [&](int node) { return size[as_index(node)] >= std::min(kJointsOfBody, largest); };
        std::vector<int> bodies_below(nodes.size(), 0);
        for (const int node : skeletons) bodies_below[as_index(node)] = is_body(node) ? 1 : 0;
        for (auto node = order.rbegin(); node != order.rend(); ++node) {
            const int parent = nodes[as_index(*node)].parent;
            if (parent >= 0) bodies_below[as_index(parent)] += bodies_below[as_index(*node)];
        }
        std::vector<int> begins;
        for (const int body : skeletons) {
            if (!is_body(body)) continue;
            int begin = first_moved[as_index(body)];
            for (int above = nodes[as_index(body)].parent; above >= 0 && bodies_below[as_index(above)] == 1;
                 above = nodes[as_index(above)].parent) {
                if (is_moved[as_index(above)]) begin = above;
            }
            begins.push_back(begin);
        }
        // Everything below the topmost joint counts, as in a file of one person.
        std::vector<int> character(nodes.size(), -1);
        std::vector<std::vector<int>> characters(begins.size());
        for (std::size_t i = 0; i < begins.size(); ++i) character[as_index(begins[i])] = static_cast<int>(i);
        for (const int node : order) {
            const int parent = nodes[as_index(node)].parent;
            int& own = character[as_index(node)];
            if (own < 0 && parent >= 0) own = character[as_index(parent)];
            if (own >= 0) characters[as_index(own)].push_back(node);
        }
        std::vector<std::string> props;
        for (const int node : skeletons) {
            if (has_limbs && !is_body(node) && character[as_index(node)] < 0)
                props.push_back(nodes[as_index(node)].name);
        }
        warn_of_props(props);
        if (begins.size() == 1) {
            scene_.body = begins.front();
        } else {
            scene_.characters = std::move(characters);
        }
    }

    FbxDocument document_;
    FbxObjects objects_;
    NodeScene scene_;
    std::shared_ptr<PosedScene> posed_ = std::make_shared<PosedScene>();
    std::map<std::int64_t, std::size_t> node_of_;  ///< by the id of a Model
    std::vector<bool> is_limb_;                    ///< by node
    std::vector<std::string> unordered_;           ///< nodes with a RotationOrder of their own kind
    std::set<const FbxCurve*> seen_;               ///< in the stacks that were gone through
    std::size_t reused_ = 0;                       ///< keys
};

}  // namespace

MotionFile parse_fbx(std::string_view bytes, const std::filesystem::path& file) {
    return node_motion_file(FbxSceneBuilder(bytes, file.string()).build());
}

}  // namespace mobbscope
