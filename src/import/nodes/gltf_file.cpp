#include <base/error.h>
#include <base/text.h>
#include <import/nodes/gltf_file.h>
#include <import/nodes/gltf_pointer.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace mobbscope {

namespace {

// ---- GLB

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

/// The little-endian number at an offset that lies within.
std::uint32_t number_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= std::uint32_t{static_cast<unsigned char>(bytes[offset + i])} << (8 * i);
    }
    return value;
}

GltfParts split_glb(std::string_view bytes, const std::string& file) {
    const auto fail = [&file](const std::string& place, const std::string& message) {
        throw InputError(file, place, message + "; export or copy it again");
    };
    if (bytes.size() < kHeaderSize + kChunkHeaderSize) {
        fail("GLB header", "the file ends after " + std::to_string(bytes.size()) + " bytes");
    }
    if (const std::uint32_t version = number_at(bytes, 4); version != 2) {
        fail("GLB header", "is version " + std::to_string(version) + ", but only version 2 can be read");
    }
    const std::size_t length = number_at(bytes, 8);
    if (length > bytes.size()) {
        fail("GLB header",
             "announces " + std::to_string(length) + " bytes, but the file ends after " + std::to_string(bytes.size()));
    }
    GltfParts parts;
    parts.is_glb = true;
    int chunk = 0;
    for (std::size_t offset = kHeaderSize; offset < length; ++chunk) {
        const std::string place = "GLB chunk " + std::to_string(chunk);
        if (length - offset < kChunkHeaderSize) fail(place, "its header is cut off");
        const std::size_t size = number_at(bytes, offset);
        const std::uint32_t type = number_at(bytes, offset + 4);
        offset += kChunkHeaderSize;
        if (size > length - offset) {
            fail(place,
                 "announces " + std::to_string(size) + " bytes, but " + std::to_string(length - offset) + " are left");
        }
        if (size % 4 != 0) fail(place, "its length of " + std::to_string(size) + " bytes is no multiple of 4");
        if ((type == kJsonChunk) != (chunk == 0)) fail(place, "the first chunk, and no other, must be JSON");
        if (type == kBinaryChunk && chunk != 1) fail(place, "a binary chunk can only be the second");
        if (type == kJsonChunk) parts.json = bytes.substr(offset, size);
        if (type == kBinaryChunk) parts.binary = bytes.substr(offset, size);
        offset += size;
    }
    if (chunk == 0) fail("GLB header", "announces no chunk");
    return parts;
}

bool begins_as_json(std::string_view text) {
    const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

/// What the keys of a JSON text, or of its beginning, say about its being glTF.
struct GltfKeys {
    bool asset = false;
    bool version = false;  ///< of the asset
    bool arrays = false;   ///< accessors or bufferViews
    bool cut_off = false;  ///< the text ends within its object

    void scan(std::string_view text) {
        int depth = 0;
        std::string_view in;      // the key at depth 1 that what stands here belongs to
        std::string_view string;  // the last one
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            if (c == '"') {
                const std::size_t begin = i + 1;
                for (++i; i < text.size() && text[i] != '"'; ++i) {
                    if (text[i] == '\\') ++i;
                }
                string = text.substr(begin, i - begin);
            } else if (c == '{' || c == '[') {
                ++depth;
            } else if (c == '}' || c == ']') {
                --depth;
            } else if (c == ':' && depth == 1) {
                in = string;
                asset = asset || in == "asset";
                arrays = arrays || in == "accessors" || in == "bufferViews";
            } else if (c == ':' && depth == 2 && in == "asset") {
                version = version || string == "version";
            }
        }
        cut_off = depth > 0;
    }
};

// ---- its JSON

using Json = nlohmann::json;

// Files of the field nest about ten deep, extras a little more; recursion over a value must stay on the stack.
constexpr int kMaxDepth = 100;
// A parsed value takes 16 bytes at least, so this bounds memory whatever the text holds.
constexpr std::size_t kMaxValues = 10'000'000;
constexpr std::uint64_t kMaxInteger = std::numeric_limits<int>::max();

// What a file may require: what is read here, and what is only about surfaces, lights and the like, which are not
// looked at.
constexpr std::array<std::string_view, 7> kHarmlessPrefixes{
    "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "EXT_lights_", "KHR_xmp", "VRMC_vrm"};
constexpr std::array<std::string_view, 5> kHarmless{"KHR_animation_pointer", "KHR_draco_mesh_compression",
                                                    "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                                    "MSFT_texture_dds"};

/// Refuses text that nests too deep or holds too many values, before any memory is spent on it.
void check_shape(std::string_view text, const std::string& file) {
    int depth = 0;
    std::size_t values = 0;
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

enum class Need : bool { optional, required };

/// Builds the text that is left from the one that was read: each `keep` function checks a value and puts what is kept
/// of it into `to`.
class GltfChecker {
  public:
    GltfChecker(const GltfPlace& root, const GltfParts& parts) : root_(root), parts_(parts) {}

    GltfText text() {
        if (!root_.value().is_object()) root_.fail("is no JSON object; this is no glTF file");
        check_asset();
        check_required_extensions();
        constexpr std::array<std::pair<const char*, Keep>, 6> kSections{{{"buffers", &GltfChecker::keep_buffer},
                                                                         {"bufferViews", &GltfChecker::keep_view},
                                                                         {"accessors", &GltfChecker::keep_accessor},
                                                                         {"nodes", &GltfChecker::keep_node},
                                                                         {"skins", &GltfChecker::keep_skin},
                                                                         {"animations", &GltfChecker::keep_animation}}};
        for (const auto& [key, keep] : kSections) {
            if (root_[key].exists()) root_[key].require_array();
        }
        Json kept;
        kept["asset"]["version"] = "2.0";
        for (const auto& [key, keep] : kSections) {
            if (root_[key].exists()) keep_elements(root_, kept, key, keep);
        }
        return {kept.dump(), std::move(outside_), std::move(unread_), hips()};
    }

  private:
    using Keep = void (GltfChecker::*)(const GltfPlace& from, Json& to);

    std::size_t size_of(std::string_view section) const {
        const GltfPlace found = root_[section];
        return found.exists() ? found.size() : 0;
    }

    /// Every element of an array of objects.
    void keep_elements(const GltfPlace& from, Json& to, const char* key, Keep keep) {
        const GltfPlace array = from[key];
        array.require_array();
        Json& kept = to[key] = Json::array();
        for (std::size_t i = 0; i < array.size(); ++i) {
            const GltfPlace element = array[i];
            element.require_object();
            Json of_element = Json::object();
            (this->*keep)(element, of_element);
            if (!of_element.is_null()) kept.push_back(std::move(of_element));
        }
    }

    /// An integer in [0, most]; false if it is absent.
    bool keep_integer(const GltfPlace& from, Json& to, const char* key, Need need,
                      std::uint64_t most = kMaxInteger) const {
        const GltfPlace value = from[key];
        if (!value.exists()) {
            if (need == Need::required) value.fail("is missing; add it");
            return false;
        }
        const std::uint64_t number = value.integer();
        if (number > most) value.fail(std::to_string(number) + " is beyond " + std::to_string(most));
        to[key] = number;
        return true;
    }

    /// The index of an element of a section.
    bool keep_index(const GltfPlace& from, Json& to, const char* key, std::string_view section, Need need) const {
        if (from[key].exists()) check_index(from[key], size_of(section), section);
        return keep_integer(from, to, key, need);
    }

    static void check_index(const GltfPlace& index, std::size_t size, std::string_view what) {
        if (index.integer() < size) return;
        index.fail("refers to " + std::string(what) + "/" + std::to_string(index.integer()) + ", but there are " +
                   std::to_string(size) + "; export the file again");
    }

    void keep_nodes(const GltfPlace& from, Json& to, const char* key) const {
        const GltfPlace array = from[key];
        array.require_array();
        if (array.size() == 0) array.fail("must not be empty; give nodes or leave it out");
        for (std::size_t i = 0; i < array.size(); ++i) {
            check_index(array[i], size_of("nodes"), "nodes");
            to[key].push_back(array[i].integer());
        }
    }

    static void keep_string(const GltfPlace& from, Json& to, const char* key, Need need) {
        if (need == Need::required || from[key].exists()) to[key] = from[key].string();
    }

    static void keep_numbers(const GltfPlace& from, Json& to, const char* key, std::size_t count) {
        const GltfPlace place = from[key];
        if (!place.exists()) return;
        const Json& value = place.value();
        const bool fits = value.is_array() && value.size() == count &&
                          std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); });
        if (!fits) place.fail("must be an array of " + std::to_string(count) + " numbers");
        to[key] = value;
    }

    void check_asset() const {
        const GltfPlace asset = root_["asset"];
        asset.require_object();
        const auto version = [&asset](std::string_view key) {
            return asset[key].exists() ? asset[key].string() : std::string();
        };
        const std::string written = version("version");
        if (!written.starts_with("2.")) {
            asset["version"].fail("is " + in_quotes(written) + ", but glTF 2.0 is needed; convert the file");
        }
        const std::string least = version("minVersion");
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

    void keep_buffer(const GltfPlace& from, Json& to) {
        keep_integer(from, to, "byteLength", Need::required);
        const auto length = to["byteLength"].get<std::size_t>();
        if (length == 0) from["byteLength"].fail("must be over 0");
        const auto index = static_cast<int>(buffers_++);
        const GltfPlace uri = from["uri"];
        if (!uri.exists()) {
            const bool in_chunk = parts_.is_glb && index == 0 && parts_.binary && !parts_.binary->empty();
            if (in_chunk && length > parts_.binary->size()) {
                from["byteLength"].fail("is " + std::to_string(length) + ", but the binary chunk holds " +
                                        std::to_string(parts_.binary->size()) +
                                        " bytes; export or copy the file again");
            }
            outside_.push_back({index, "", in_chunk ? length : 0});
        } else if (const std::string& text = uri.string(); text.starts_with("data:")) {
            const std::size_t comma = text.find(',');
            if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64")) {
                uri.fail("must be a data URI in base64; export the file again");
            }
            // tinygltf knows few media types; what is inside does not depend on them.
            to["uri"] = "data:application/octet-stream;base64" + text.substr(comma);
            return;
        } else {
            std::string path = percent_decoded(text);
            if (!is_below(path)) {
                uri.fail(in_quotes(text) + " must name a file beside this one or in a folder below it");
            }
            outside_.push_back({index, std::move(path), length});
        }
        // tinygltf refuses a buffer that holds nothing.
        to = {{"uri", "data:application/octet-stream;base64,AA=="}, {"byteLength", 1}};
    }

    void keep_view(const GltfPlace& from, Json& to) {
        keep_index(from, to, "buffer", "buffers", Need::required);
        keep_integer(from, to, "byteOffset", Need::optional);
        keep_integer(from, to, "byteLength", Need::required);
        if (!keep_integer(from, to, "byteStride", Need::optional, 252)) return;
        const auto stride = to["byteStride"].get<int>();
        if (stride < 4 || stride % 4 != 0) from["byteStride"].fail("must be a multiple of 4 from 4 to 252");
    }

    void keep_accessor(const GltfPlace& from, Json& to) {
        constexpr std::array<std::string_view, 7> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
        keep_index(from, to, "bufferView", "bufferViews", Need::optional);
        keep_integer(from, to, "byteOffset", Need::optional);
        keep_integer(from, to, "componentType", Need::required);
        keep_integer(from, to, "count", Need::required);
        keep_string(from, to, "type", Need::required);
        const auto& type = to["type"].get_ref<const std::string&>();
        if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
            from["type"].fail(in_quotes(type) + " is no type of glTF 2.0; export the file again");
        }
        const auto component = to["componentType"].get<int>();
        if (component < 5120 || component > 5126 || component == 5124) {
            from["componentType"].fail(std::to_string(component) + " is none of glTF 2.0; export the file again");
        }
        keep_string(from, to, "name", Need::optional);
        if (const GltfPlace normalized = from["normalized"]; normalized.exists()) {
            if (!normalized.value().is_boolean()) normalized.fail("must be true or false");
            to["normalized"] = normalized.value();
        }
        const GltfPlace sparse = from["sparse"];
        if (!sparse.exists()) return;
        sparse.require_object();
        keep_integer(sparse, to["sparse"], "count", Need::required);
        for (const char* key : {"indices", "values"}) {
            const GltfPlace part = sparse[key];
            part.require_object();
            Json& kept = to["sparse"][key];
            keep_index(part, kept, "bufferView", "bufferViews", Need::required);
            keep_integer(part, kept, "byteOffset", Need::optional);
        }
        const GltfPlace indices = sparse["indices"];
        keep_integer(indices, to["sparse"]["indices"], "componentType", Need::required);
    }

    void keep_node(const GltfPlace& from, Json& to) {
        keep_string(from, to, "name", Need::optional);
        if (from["children"].exists()) keep_nodes(from, to, "children");
        keep_numbers(from, to, "matrix", 16);
        keep_numbers(from, to, "translation", 3);
        keep_numbers(from, to, "rotation", 4);
        keep_numbers(from, to, "scale", 3);
        if (to.contains("matrix") && (to.contains("translation") || to.contains("rotation") || to.contains("scale"))) {
            from.fail("has a matrix and translation, rotation or scale; give either");
        }
    }

    void keep_skin(const GltfPlace& from, Json& to) {
        keep_string(from, to, "name", Need::optional);
        keep_nodes(from, to, "joints");
        keep_index(from, to, "skeleton", "nodes", Need::optional);
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

    void keep_animation(const GltfPlace& from, Json& to) {
        keep_string(from, to, "name", Need::optional);
        keep_elements(from, to, "samplers", &GltfChecker::keep_sampler);
        samplers_ = to["samplers"].size();
        keep_elements(from, to, "channels", &GltfChecker::keep_channel);
        ++animations_;
    }

    void keep_sampler(const GltfPlace& from, Json& to) {
        keep_index(from, to, "input", "accessors", Need::required);
        keep_index(from, to, "output", "accessors", Need::required);
        keep_string(from, to, "interpolation", Need::optional);
    }

    void keep_channel(const GltfPlace& from, Json& to) {
        keep_integer(from, to, "sampler", Need::required);
        check_index(from["sampler"], samplers_, "samplers");
        const GltfPlace target = from["target"];
        target.require_object();
        const std::string& path = target["path"].string();
        // Without a node, a channel is to be ignored (the specification's words for extensions to come).
        const bool is_kept = path == "pointer" ? keep_pointer(target, to["target"])
                                               : keep_index(target, to["target"], "node", "nodes", Need::optional);
        if (!is_kept) {
            to = nullptr;
        } else if (path != "pointer") {
            to["target"]["path"] = path;
        }
    }

    /// False if it leads to no property of a node.
    bool keep_pointer(const GltfPlace& target, Json& to) {
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
            unread_.push_back({animations_, pointer});
            return false;
        }
        if (!of_node->node || *of_node->node >= size_of("nodes")) {
            place.fail(in_quotes(pointer) + " leads to no node; there are " + std::to_string(size_of("nodes")) +
                       "; export the file again");
        }
        to = {{"node", *of_node->node}, {"path", std::string(kByPointer) + std::string(of_node->property)}};
        return true;
    }

    const GltfPlace& root_;
    const GltfParts& parts_;
    std::size_t buffers_ = 0;
    std::size_t samplers_ = 0;    ///< of the animation at hand
    std::size_t animations_ = 0;  ///< before the one at hand
    std::vector<GltfOutsideBuffer> outside_;
    std::vector<GltfUnreadPointer> unread_;
};

}  // namespace

GltfParts split_gltf(std::string_view bytes, bool named_glb, const std::string& file) {
    if (bytes.starts_with(kMagic)) return split_glb(bytes, file);
    if (named_glb && !begins_as_json(bytes)) {
        throw InputError(file, "GLB header", "does not begin with 'glTF'; this is no GLB file, or a damaged one");
    }
    return {bytes, std::nullopt, false};
}

bool looks_like_gltf(std::string_view head) {
    if (head.starts_with(kMagic)) return true;
    if (!begins_as_json(head)) return false;
    GltfKeys keys;
    keys.scan(head);
    return keys.asset ? keys.version : keys.cut_off && keys.arrays;
}

GltfText checked_gltf_text(const GltfParts& parts, const std::string& file) {
    check_shape(parts.json, file);
    const Json value = parse(parts, file);
    return GltfChecker(GltfPlace(value, file), parts).text();
}

}  // namespace mobbscope
