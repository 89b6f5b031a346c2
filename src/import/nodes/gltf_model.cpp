#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/nodes/gltf_model.h>
#include <import/nodes/gltf_pointer.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace mobbscope {

namespace {

using Json = nlohmann::json;

// Files of the field nest about ten deep, extras a little more; recursion over a value must stay on the stack.
constexpr int kMaxDepth = 100;
// Bytes of memory: a value, with the room that arrays grow by; what an array or an object has of its own.
constexpr std::size_t kOfValue = 48;
constexpr std::size_t kOfContainer = 128;
constexpr std::size_t kMaxValues = 10'000'000;
constexpr std::uint64_t kMaxInteger = std::numeric_limits<int>::max();

// What a file may require: what is read here, and what is only about surfaces, lights and the like, which are not
// looked at.
constexpr std::array<std::string_view, 7> kHarmlessPrefixes{
    "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "EXT_lights_", "KHR_xmp", "VRMC_vrm"};
constexpr std::array<std::string_view, 5> kHarmless{"KHR_animation_pointer", "KHR_draco_mesh_compression",
                                                    "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                                    "MSFT_texture_dds"};

/// Refuses text that nests too deep or holds too many values, before any memory is spent on it. Gives what its values
/// will take.
Spent check_shape(std::string_view text, const std::string& file) {
    int depth = 0;
    std::size_t values = 0, containers = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        switch (text[i]) {
            case '"':
                for (++i; i < text.size() && text[i] != '"'; ++i) {
                    if (text[i] == '\\') ++i;
                }
                break;
            case '[':
            case '{':
                if (++depth > kMaxDepth) {
                    throw InputError(
                        file, "JSON",
                        "nests more than " + std::to_string(kMaxDepth) + " deep; take extras and extensions out");
                }
                ++values;
                ++containers;
                break;
            case ']':
            case '}':
                --depth;
                break;
            case ',':
                ++values;
                break;
            default:
                break;
        }
    }
    if (values > kMaxValues) {
        throw InputError(file, "JSON",
                         "holds more than " + std::to_string(kMaxValues) + " values; numbers belong into buffers");
    }
    Spent spent;
    spent.add(text.size() + kOfValue * values + kOfContainer * containers, "its JSON", file);
    return spent;
}

std::string line_and_column(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? before.size() : before.size() - newline - 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

Json parse(const GltfParts& parts, const std::string& file) {
    try {
        return Json::parse(parts.json);
    } catch (const Json::parse_error& error) {
        const std::string chunk = parts.is_glb ? "JSON chunk, " : "";
        throw InputError(file, chunk + line_and_column(parts.json, error.byte),
                         "is not valid JSON; the file is damaged or no glTF");
    } catch (const Json::exception&) {
        throw InputError(file, "JSON", "holds a number beyond the range of a double; correct it");
    }
}

std::string percent_decoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::string_view digits = uri.substr(i + 1, 2);
        unsigned char byte = 0;
        const char* const end = digits.data() + digits.size();
        if (uri[i] == '%' && digits.size() == 2 && std::from_chars(digits.data(), end, byte, 16).ptr == end) {
            out += static_cast<char>(byte);
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

/// True if a path stays in the folder that it starts from.
bool is_below(const std::string& path) {
    if (path.empty() || path[0] == '/' || path.find_first_of(":\\") != std::string::npos) return false;
    if (path.find('\0') != std::string::npos) return false;
    return ("/" + path + "/").find("/../") == std::string::npos;
}

/// A value and the way to it, which is written out only when a message needs it. Refers to what it was reached from.
class GltfPlace {
  public:
    GltfPlace(const Json& root, const std::string& file) : value_(&root), file_(&file) {}

    /// A member, which need not be there.
    GltfPlace operator[](std::string_view key) const& {
        const auto member = value_->find(key);
        return {member == value_->end() ? nullptr : &*member, *this, key, 0};
    }
    GltfPlace operator[](std::string_view key) const&& = delete;
    GltfPlace operator[](std::size_t index) const& { return {&(*value_)[index], *this, {}, index}; }
    GltfPlace operator[](std::size_t index) const&& = delete;

    bool exists() const { return value_ != nullptr; }
    const Json& value() const { return *value_; }
    std::size_t size() const { return value_->size(); }

    [[noreturn]] void fail(const std::string& message) const { throw InputError(*file_, pointer(), message); }
    void require_object() const {
        if (!value_ || !value_->is_object()) fail("must be an object");
    }
    void require_array() const {
        if (!value_ || !value_->is_array()) fail("must be an array");
    }
    const std::string& string() const {
        if (!value_ || !value_->is_string()) fail("must be a string");
        return value_->get_ref<const std::string&>();
    }
    /// The schema allows 4.0 for 4.
    std::uint64_t integer() const {
        if (!value_) fail("is missing; add it");
        if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
        const double number = value_->is_number() ? value_->get<double>() : -1;
        if (!(number >= 0 && number <= 1e15) || number != std::floor(number)) fail("must be an integer of 0 or more");
        return static_cast<std::uint64_t>(number);
    }

  private:
    GltfPlace(const Json* value, const GltfPlace& up, std::string_view key, std::size_t index)
        : value_(value), file_(up.file_), up_(&up), key_(key), index_(index) {}

    std::string pointer() const {
        if (!up_) return "";
        return up_->pointer() + "/" + (key_.empty() ? std::to_string(index_) : std::string(key_));
    }

    const Json* value_;  ///< null: there is none
    const std::string* file_;
    const GltfPlace* up_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

constexpr std::array<std::pair<std::string_view, int>, 7> kAccessorTypes{{{"SCALAR", TINYGLTF_TYPE_SCALAR},
                                                                          {"VEC2", TINYGLTF_TYPE_VEC2},
                                                                          {"VEC3", TINYGLTF_TYPE_VEC3},
                                                                          {"VEC4", TINYGLTF_TYPE_VEC4},
                                                                          {"MAT2", TINYGLTF_TYPE_MAT2},
                                                                          {"MAT3", TINYGLTF_TYPE_MAT3},
                                                                          {"MAT4", TINYGLTF_TYPE_MAT4}}};

/// Fills the model section by section: each `read` function checks an element and takes what clips need of it.
class GltfModelReader {
  public:
    GltfModelReader(const GltfPlace& root, const GltfParts& parts, const std::filesystem::path& file)
        : root_(root), parts_(parts), file_(file), name_(file.string()) {}

    GltfModel model() {
        if (!root_.value().is_object()) root_.fail("is not a JSON object; this is not a glTF file");
        check_asset();
        check_required_extensions();
        for (const char* section : {"buffers", "bufferViews", "accessors", "nodes", "skins", "animations"}) {
            if (root_[section].exists()) root_[section].require_array();
        }
        tinygltf::Model& to = out_.model;
        read_section("buffers", to.buffers, &GltfModelReader::read_buffer);
        read_section("bufferViews", to.bufferViews, &GltfModelReader::read_view);
        read_section("accessors", to.accessors, &GltfModelReader::read_accessor);
        read_section("nodes", to.nodes, &GltfModelReader::read_node);
        read_section("skins", to.skins, &GltfModelReader::read_skin);
        read_section("animations", to.animations, &GltfModelReader::read_animation);
        out_.hips = hips();
        return std::move(out_);
    }

  private:
    template <class Element>
    using Read = void (GltfModelReader::*)(const GltfPlace& from, Element& to);

    std::size_t size_of(std::string_view section) const {
        const GltfPlace found = root_[section];
        return found.exists() ? found.size() : 0;
    }

    /// Every element of an array of objects.
    template <class Element>
    void read_elements(const GltfPlace& array, std::vector<Element>& to, Read<Element> read) {
        array.require_array();
        for (std::size_t i = 0; i < array.size(); ++i) {
            const GltfPlace element = array[i];
            element.require_object();
            if (to.size() == to.capacity()) {
                to.reserve(std::max<std::size_t>(4, 2 * to.size()));
                out_.spent.add(sizeof(Element) * to.capacity(), "its JSON", name_);
            }
            (this->*read)(element, to.emplace_back());
        }
    }
    template <class Element>
    void read_section(std::string_view key, std::vector<Element>& to, Read<Element> read) {
        if (root_[key].exists()) read_elements(root_[key], to, read);
    }

    /// In [0, most].
    static std::uint64_t integer(const GltfPlace& value, std::uint64_t most = kMaxInteger) {
        const std::uint64_t number = value.integer();
        if (number > most) value.fail(std::to_string(number) + " is beyond " + std::to_string(most));
        return number;
    }
    /// The same; 0 where there is none.
    static std::uint64_t integer_or_0(const GltfPlace& value, std::uint64_t most = kMaxInteger) {
        return value.exists() ? integer(value, most) : 0;
    }

    /// Of one of so many elements.
    static int index(const GltfPlace& value, std::size_t size, std::string_view what) {
        if (value.integer() >= size) {
            value.fail("refers to " + std::string(what) + "/" + std::to_string(value.integer()) + ", but there are " +
                       std::to_string(size) + "; export the file again");
        }
        return static_cast<int>(integer(value));
    }
    int index(const GltfPlace& value, std::string_view section) const {
        return index(value, size_of(section), section);
    }
    /// The same; -1 where there is none.
    int index_or_none(const GltfPlace& value, std::string_view section) const {
        return value.exists() ? index(value, section) : -1;
    }

    std::vector<int> nodes(const GltfPlace& array) const {
        array.require_array();
        if (array.size() == 0) array.fail("must not be empty; give nodes or leave it out");
        std::vector<int> out;
        for (std::size_t i = 0; i < array.size(); ++i) out.push_back(index(array[i], "nodes"));
        return out;
    }

    static std::string string_or(const GltfPlace& value, const std::string& otherwise = "") {
        return value.exists() ? value.string() : otherwise;
    }

    /// Empty where there are none.
    static std::vector<double> numbers(const GltfPlace& place, std::size_t count) {
        if (!place.exists()) return {};
        const Json& value = place.value();
        const bool fits = value.is_array() && value.size() == count &&
                          std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); });
        if (!fits) place.fail("must be an array of " + std::to_string(count) + " numbers");
        return value.get<std::vector<double>>();
    }

    void check_asset() const {
        const GltfPlace asset = root_["asset"];
        asset.require_object();
        const std::string written = string_or(asset["version"]);
        if (!written.starts_with("2.")) {
            asset["version"].fail("is " + in_quotes(written) + ", but glTF 2.0 is needed; convert the file");
        }
        const std::string least = string_or(asset["minVersion"]);
        if (!least.empty() && least != "2.0") {
            asset["minVersion"].fail("glTF " + in_quotes(least) + " cannot be read; export for 2.0");
        }
    }

    void check_required_extensions() const {
        const GltfPlace names = root_["extensionsRequired"];
        if (!names.exists()) return;
        names.require_array();
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string& name = names[i].string();
            const bool is_harmless = std::find(kHarmless.begin(), kHarmless.end(), name) != kHarmless.end() ||
                                     std::any_of(kHarmlessPrefixes.begin(), kHarmlessPrefixes.end(),
                                                 [&](std::string_view prefix) { return name.starts_with(prefix); });
            if (!is_harmless) names[i].fail("requires " + in_quotes(name) + "; export without it");
        }
    }

    void read_buffer(const GltfPlace& from, tinygltf::Buffer& to) {
        const std::uint64_t length = integer(from["byteLength"]);
        if (length == 0) from["byteLength"].fail("must be over 0");
        const std::size_t number = out_.model.buffers.size() - 1;
        const GltfPlace uri = from["uri"];
        if (!uri.exists()) {
            // One that lies nowhere is allowed: meshes that an extension compresses come so.
            if (number == 0 && parts_.binary && !parts_.binary->empty()) to.data = of_chunk(from["byteLength"], length);
        } else if (uri.string().starts_with("data:")) {
            to.data = of_data_uri(uri, length, number);
        } else {
            to.data = of_file(uri, length, number);
        }
    }

    std::vector<unsigned char> of_chunk(const GltfPlace& place, std::size_t length) const {
        if (length > parts_.binary->size()) {
            place.fail("is " + std::to_string(length) + ", but the binary chunk holds " +
                       std::to_string(parts_.binary->size()) + " bytes; export or copy the file again");
        }
        const std::string_view chunk = parts_.binary->substr(0, length);
        return {chunk.begin(), chunk.end()};
    }

    [[noreturn]] void fail_buffer(std::size_t number, const std::string& message) const {
        throw InputError(file_.string(), "buffer " + std::to_string(number), message);
    }

    std::vector<unsigned char> of_data_uri(const GltfPlace& uri, std::size_t length, std::size_t number) const {
        const std::string& text = uri.string();
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64")) {
            uri.fail("must be a data URI in base64; export the file again");
        }
        std::vector<unsigned char> bytes;
        std::string type;
        // tinygltf knows few media types; what is inside does not depend on them.
        const std::string known = "data:application/octet-stream;base64" + text.substr(comma);
        if (!tinygltf::DecodeDataURI(&bytes, type, known, length, true)) {
            fail_buffer(number, "its data URI does not hold byteLength bytes in base64; export the file again");
        }
        return bytes;
    }

    std::vector<unsigned char> of_file(const GltfPlace& uri, std::size_t length, std::size_t number) const {
        const std::string name = percent_decoded(uri.string());
        if (!is_below(name)) {
            uri.fail(in_quotes(uri.string()) + " must name a file beside this one or in a folder below it");
        }
        const std::filesystem::path path = file_.parent_path() / name;
        std::string bytes;
        try {
            bytes = read_file(path);
        } catch (const InputError& error) {
            fail_buffer(number, error.what());
        }
        if (bytes.size() < length) {
            fail_buffer(number, path.string() + " holds " + std::to_string(bytes.size()) + " bytes of " +
                                    std::to_string(length) + "; export or copy it again");
        }
        bytes.resize(length);
        return {bytes.begin(), bytes.end()};
    }

    void read_view(const GltfPlace& from, tinygltf::BufferView& to) {
        to.buffer = index(from["buffer"], "buffers");
        to.byteOffset = integer_or_0(from["byteOffset"]);
        to.byteLength = integer(from["byteLength"]);
        const GltfPlace stride = from["byteStride"];
        to.byteStride = integer_or_0(stride, 252);
        if (stride.exists() && (to.byteStride < 4 || to.byteStride % 4 != 0)) {
            stride.fail("must be a multiple of 4 from 4 to 252");
        }
    }

    void read_accessor(const GltfPlace& from, tinygltf::Accessor& to) {
        to.bufferView = index_or_none(from["bufferView"], "bufferViews");
        to.byteOffset = integer_or_0(from["byteOffset"]);
        to.componentType = static_cast<int>(integer(from["componentType"]));
        to.count = integer(from["count"]);
        const auto type =
            std::ranges::find(kAccessorTypes, from["type"].string(), &std::pair<std::string_view, int>::first);
        if (type == kAccessorTypes.end()) {
            from["type"].fail(in_quotes(from["type"].string()) + " is not a type of glTF 2.0; export the file again");
        }
        to.type = type->second;
        if (to.componentType < TINYGLTF_COMPONENT_TYPE_BYTE || to.componentType > TINYGLTF_COMPONENT_TYPE_FLOAT ||
            to.componentType == TINYGLTF_COMPONENT_TYPE_INT) {
            from["componentType"].fail(std::to_string(to.componentType) +
                                       " is not one of glTF 2.0; export the file again");
        }
        to.name = string_or(from["name"]);
        if (const GltfPlace normalized = from["normalized"]; normalized.exists()) {
            if (!normalized.value().is_boolean()) normalized.fail("must be true or false");
            to.normalized = normalized.value().get<bool>();
        }
        const GltfPlace sparse = from["sparse"];
        if (!sparse.exists()) return;
        sparse.require_object();
        to.sparse.isSparse = true;
        to.sparse.count = static_cast<int>(integer(sparse["count"]));
        const auto read_part = [this](const GltfPlace& part, auto& of_part) {
            part.require_object();
            of_part.bufferView = index(part["bufferView"], "bufferViews");
            of_part.byteOffset = static_cast<int>(integer_or_0(part["byteOffset"]));
        };
        const GltfPlace indices = sparse["indices"];
        read_part(indices, to.sparse.indices);
        read_part(sparse["values"], to.sparse.values);
        to.sparse.indices.componentType = static_cast<int>(integer(indices["componentType"]));
    }

    void read_node(const GltfPlace& from, tinygltf::Node& to) {
        to.name = string_or(from["name"]);
        if (from["children"].exists()) to.children = nodes(from["children"]);
        to.matrix = numbers(from["matrix"], 16);
        to.translation = numbers(from["translation"], 3);
        to.rotation = numbers(from["rotation"], 4);
        to.scale = numbers(from["scale"], 3);
        if (!to.matrix.empty() && !(to.translation.empty() && to.rotation.empty() && to.scale.empty())) {
            from.fail("has a matrix and translation, rotation or scale; give either");
        }
    }

    void read_skin(const GltfPlace& from, tinygltf::Skin& to) {
        to.name = string_or(from["name"]);
        to.joints = nodes(from["joints"]);
        to.skeleton = index_or_none(from["skeleton"], "nodes");
    }

    /// The node of the hips in VRM's description of a body, which need not be there.
    std::optional<int> hips() const {
        const Json* at = &root_.value();
        for (const char* key : {"extensions", "VRMC_vrm_animation", "humanoid", "humanBones", "hips", "node"}) {
            const auto member = at->find(key);
            if (member == at->end()) return std::nullopt;
            at = &*member;
        }
        const std::size_t nodes = size_of("nodes");
        if (!at->is_number_unsigned() || at->get<std::uint64_t>() >= nodes) {
            root_.fail("VRMC_vrm_animation: its hips refer to " + in_quotes(at->dump()) + ", but there are " +
                       std::to_string(nodes) + " nodes; export the file again");
        }
        return at->get<int>();
    }

    void read_animation(const GltfPlace& from, tinygltf::Animation& to) {
        to.name = string_or(from["name"]);
        read_elements(from["samplers"], to.samplers, &GltfModelReader::read_sampler);
        read_elements(from["channels"], to.channels, &GltfModelReader::read_channel);
        // To be ignored, in the specification's words for extensions to come.
        std::erase_if(to.channels, [](const tinygltf::AnimationChannel& channel) { return channel.target_node < 0; });
    }

    void read_sampler(const GltfPlace& from, tinygltf::AnimationSampler& to) {
        to.input = index(from["input"], "accessors");
        to.output = index(from["output"], "accessors");
        to.interpolation = string_or(from["interpolation"], to.interpolation);
    }

    void read_channel(const GltfPlace& from, tinygltf::AnimationChannel& to) {
        to.sampler = index(from["sampler"], out_.model.animations.back().samplers.size(), "samplers");
        const GltfPlace target = from["target"];
        target.require_object();
        to.target_path = target["path"].string();
        if (to.target_path == "pointer") {
            read_pointer(target, to);
        } else {
            to.target_node = index_or_none(target["node"], "nodes");
        }
    }

    /// Leaves the channel without a node if it leads to no property of one.
    void read_pointer(const GltfPlace& target, tinygltf::AnimationChannel& to) {
        const GltfPlace extensions = target["extensions"];
        extensions.require_object();
        const GltfPlace extension = extensions["KHR_animation_pointer"];
        extension.require_object();
        const GltfPlace place = extension["pointer"];
        const std::string& pointer = place.string();
        if (!pointer.starts_with('/'))
            place.fail(in_quotes(pointer) + " must begin with '/', as in '/nodes/0/rotation'");
        const std::optional<NodePointer> of_node = node_pointer(pointer);
        if (!of_node) {
            out_.unread[out_.model.animations.size() - 1].push_back(pointer);
            return;
        }
        if (!of_node->node || *of_node->node >= size_of("nodes")) {
            place.fail(in_quotes(pointer) + " leads to no node; there are " + std::to_string(size_of("nodes")) +
                       "; export the file again");
        }
        to.target_node = static_cast<int>(*of_node->node);
        to.target_path = std::string(kByPointer) + std::string(of_node->property);
    }

    const GltfPlace& root_;
    const GltfParts& parts_;
    const std::filesystem::path& file_;
    const std::string name_;
    GltfModel out_;
};

}  // namespace

GltfModel read_gltf_model(const GltfParts& parts, const std::filesystem::path& file) {
    const std::string name = file.string();
    const Spent spent = check_shape(parts.json, name);
    const Json value = parse(parts, name);
    return GltfModelReader(GltfPlace(value, name), parts, file).model();
}

}  // namespace mobbscope
