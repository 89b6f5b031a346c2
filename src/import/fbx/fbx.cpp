#include <base/error.h>
#include <base/text.h>
#include <import/fbx/animation.h>
#include <import/fbx/document.h>
#include <import/fbx/fbx.h>
#include <import/fbx/objects.h>
#include <import/fbx/transform.h>
#include <import/nodes/node_scene.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
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
constexpr std::size_t kFewestJoints = 4;         // of a body

/// What a file's first record of the names leads to, as an integer.
std::optional<std::int64_t> integer_at(const FbxDocument& document, std::initializer_list<std::string_view> path) {
    FbxDocument::Index at = FbxDocument::kNone;
    bool is_top = true;
    for (const std::string_view name : path) {
        at = is_top ? document.find_top(name) : document.find(at, name);
        is_top = false;
        if (at == FbxDocument::kNone) return {};
    }
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

/// The axes that GlobalSettings name.
struct Axes {
    int up = 1, up_sign = 1;
    int front = 2, front_sign = 1;
    int right = 0, right_sign = 1;

    /// To x (right), y (away from the front) and z (up); where the axes are not three of their own, as `up` has it.
    glm::dmat3 ground() const {
        const auto is_axis = [](int axis) { return axis >= 0 && axis < 3; };
        glm::dmat3 rows(0);
        const auto row = [&](int index, int axis, int sign) { rows[axis][index] = sign < 0 ? -1 : 1; };
        const bool is_whole = is_axis(up) && is_axis(front) && is_axis(right) && up + front + right == 3 &&
                              up != front && front != right && right != up;
        if (is_whole) {
            row(0, right, right_sign);
            row(1, front, -front_sign);
            row(2, up, up_sign);
        } else if (up == 2) {
            rows = glm::dmat3(1);
        } else {
            row(0, 0, 1);
            row(1, 2, -1);
            row(2, 1, 1);
        }
        return rows;
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

    FbxTransform transform_at(std::size_t stack, int node, double seconds) const {
        FbxTransform out = rest[as_index(node)];
        const std::vector<FbxAnimatedProperty>& moved = stacks[stack].properties;
        for (auto at = std::ranges::lower_bound(moved, as_index(node), {}, &FbxAnimatedProperty::node);
             at != moved.end() && at->node == as_index(node); ++at) {
            out[at->property] = stacks[stack].value(*at, rest[as_index(node)], seconds);
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
        // Programs leave empty stacks beside those that count.
        const auto is_empty = [](const NodeAnimation& animation) { return animation.moved.empty(); };
        if (!std::ranges::all_of(scene_.animations, is_empty)) std::erase_if(scene_.animations, is_empty);
        find_characters();
        return std::move(scene_);
    }

  private:
    void add_settings() {
        const FbxDocument::Index settings = document_.find_top("GlobalSettings");
        Axes axes;
        double unit = 1;
        if (settings != FbxDocument::kNone) {
            objects_.each_property_in(settings, [&](std::string_view name, std::span<const FbxValue> values) {
                const auto number = static_cast<int>(std::clamp<std::int64_t>(values[0].integer, -9, 9));
                if (name == "UpAxis") axes.up = number;
                if (name == "UpAxisSign") axes.up_sign = number;
                if (name == "FrontAxis") axes.front = number;
                if (name == "FrontAxisSign") axes.front_sign = number;
                if (name == "CoordAxis") axes.right = number;
                if (name == "CoordAxisSign") axes.right_sign = number;
                if (name == "UnitScaleFactor") unit = values[0].real;
            });
        }
        scene_.ground = axes.ground();
        scene_.unit = (std::isfinite(unit) && unit > 0 ? unit : 1) * kCentimetre;
    }

    void add_nodes() {
        for (const FbxObject& object : objects_.all()) {
            if (object.kind != "Model" || !node_of_.try_emplace(object.id, scene_.nodes.size()).second) continue;
            const std::string unnamed = "node" + std::to_string(scene_.nodes.size());
            scene_.nodes.push_back({object.name.empty() ? unnamed : object.name, -1});
            is_limb_.push_back(is_limb(object.type));
            posed_->rest.push_back(transform_of(object));
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
        const std::size_t reached = parents_first(scene_.nodes).size();
        if (reached < scene_.nodes.size()) {
            throw InputError(scene_.file, "Connections",
                             counted(scene_.nodes.size() - reached, "node hangs", "nodes hang") +
                                 " on each other in a circle; export the file again");
        }
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
                    if (!list) list = std::make_shared<const std::vector<double>>(curve->times());
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
        // Before its first key and after its last one a stack may hold a pose.
        if (stack.begin < stack.end) {
            animation.times.first = std::min(animation.times.first, stack.begin);
            animation.times.last = std::max(animation.times.last, stack.end);
        }
        animation.warnings = stack.warnings;
        if (animation.moved.empty()) animation.moves_nothing = "moves no node; give a clip that does";
        animation.pose = [posed = posed_, index](std::optional<double> seconds, std::span<const PosedNode> nodes,
                                                 std::span<Affine> out) { posed->pose(index, seconds, nodes, out); };
        scene_.animations.push_back(std::move(animation));
    }

    /// Several skeletons are several people: each topmost limb with a body's joints below it, and what is above it and
    /// above no other. One of them alone is found as in any file.
    void find_characters() {
        const std::vector<Node>& nodes = scene_.nodes;
        std::vector<bool> is_moved(nodes.size());
        for (const NodeAnimation& animation : scene_.animations) {
            for (const int node : animation.moved) is_moved[as_index(node)] = true;
        }
        // Where no node is a limb, those that move are.
        const std::vector<bool>& counts = std::ranges::find(is_limb_, true) == is_limb_.end() ? is_moved : is_limb_;
        const std::vector<int> order = parents_first(nodes);
        std::vector<int> top(nodes.size(), -1);          // of each node, the topmost limb that it is or is below
        std::vector<std::size_t> size(nodes.size(), 0);  // by that limb
        std::vector<bool> is_body_moved(nodes.size());
        for (const int node : order) {
            const int parent = nodes[as_index(node)].parent;
            int& own = top[as_index(node)];
            own = parent < 0 ? -1 : top[as_index(parent)];
            if (own < 0 && counts[as_index(node)]) own = node;
            if (own < 0) continue;
            if (counts[as_index(node)]) ++size[as_index(own)];
            if (is_moved[as_index(node)]) is_body_moved[as_index(own)] = true;
        }
        std::vector<int> bodies;
        std::vector<int> bodies_below(nodes.size(), 0);
        for (const int node : order) {
            if (top[as_index(node)] != node || size[as_index(node)] < kFewestJoints || !is_body_moved[as_index(node)])
                continue;
            bodies.push_back(node);
            bodies_below[as_index(node)] = 1;
        }
        if (bodies.size() < 2) return;
        for (auto node = order.rbegin(); node != order.rend(); ++node) {
            const int parent = nodes[as_index(*node)].parent;
            if (parent >= 0) bodies_below[as_index(parent)] += bodies_below[as_index(*node)];
        }
        for (const int body : bodies) {
            int begin = body;
            for (int above = nodes[as_index(body)].parent; above >= 0 && bodies_below[as_index(above)] == 1;
                 above = nodes[as_index(above)].parent) {
                if (is_moved[as_index(above)]) begin = above;
            }
            scene_.characters.push_back({begin});
        }
        // Everything below the topmost joint counts, as in a file of one person.
        std::vector<int> character(nodes.size(), -1);
        for (std::size_t i = 0; i < scene_.characters.size(); ++i) {
            character[as_index(scene_.characters[i][0])] = static_cast<int>(i);
        }
        for (const int node : order) {
            const int parent = nodes[as_index(node)].parent;
            if (parent < 0 || character[as_index(node)] >= 0 || character[as_index(parent)] < 0) continue;
            character[as_index(node)] = character[as_index(parent)];
            scene_.characters[as_index(character[as_index(node)])].push_back(node);
        }
    }

    FbxDocument document_;
    FbxObjects objects_;
    NodeScene scene_;
    std::shared_ptr<PosedScene> posed_ = std::make_shared<PosedScene>();
    std::map<std::int64_t, std::size_t> node_of_;  ///< by the id of a Model
    std::vector<bool> is_limb_;                    ///< by node
};

}  // namespace

MotionFile parse_fbx(std::string_view bytes, const std::filesystem::path& file) {
    return node_motion_file(FbxSceneBuilder(bytes, file.string()).build());
}

}  // namespace mobbscope
