#include <base/error.h>
#include <base/text.h>
#include <import/nodes/gltf_json.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace mobbscope {

namespace {

using Json = nlohmann::json;

// Files of the field nest about ten deep, extras a little more; recursion over a value must stay on the stack.
constexpr int kMaxDepth = 100;
// A parsed value takes 16 bytes at least, so this bounds memory whatever the text holds.
constexpr std::size_t kMaxValues = 10'000'000;
constexpr std::uint64_t kMaxInteger = std::numeric_limits<int>::max();

// What a file may require and is only about surfaces, lights and the like, which are not looked at.
constexpr std::array<std::string_view, 6> kHarmlessPrefixes{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                            "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
constexpr std::array<std::string_view, 4> kHarmless{"KHR_draco_mesh_compression", "KHR_mesh_quantization",
                                                    "EXT_mesh_gpu_instancing", "MSFT_texture_dds"};

/// The way to a value, written out only when it is needed.
class Where {
  public:
    Where() = default;
    Where(const Where& up, std::string_view key) : up_(&up), key_(key) {}
    Where(const Where& up, std::size_t index) : up_(&up), index_(index) {}

    std::string pointer() const {
        if (!up_) return "";
        return up_->pointer() + "/" + (key_.empty() ? std::to_string(index_) : std::string(key_));
    }

  private:
    const Where* up_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

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

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percent_decoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
            out += static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2]));
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

/// Builds the text that is left from the one that was read.
class Checker {
  public:
    Checker(Json root, const GltfParts& parts, const std::string& file)
        : root_(std::move(root)), parts_(parts), file_(file) {}

    GltfText text() {
        if (!root_.is_object()) fail({}, "is no JSON object; this is no glTF file");
        check_asset();
        check_required_extensions();
        for (const std::string_view key : {"buffers", "bufferViews", "accessors", "nodes", "skins", "animations"}) {
            const Json* section = find(root_, key);
            if (section && !section->is_array()) fail(Where({}, key), "must be an array");
        }
        kept_["asset"]["version"] = "2.0";
        keep_section("buffers", [this](const Json& v, Json& to, const Where& at) { keep_buffer(v, to, at); });
        keep_section("bufferViews", [this](const Json& v, Json& to, const Where& at) { keep_view(v, to, at); });
        keep_section("accessors", [this](const Json& v, Json& to, const Where& at) { keep_accessor(v, to, at); });
        keep_section("nodes", [this](const Json& v, Json& to, const Where& at) { keep_node(v, to, at); });
        keep_section("skins", [this](const Json& v, Json& to, const Where& at) { keep_skin(v, to, at); });
        keep_section("animations", [this](const Json& v, Json& to, const Where& at) { keep_animation(v, to, at); });
        return {kept_.dump(), std::move(buffer_files_)};
    }

  private:
    [[noreturn]] void fail(const Where& where, const std::string& message) const {
        throw InputError(file_, where.pointer(), message);
    }

    static const Json* find(const Json& object, std::string_view key) {
        const auto member = object.find(key);
        return member == object.end() ? nullptr : &*member;
    }

    std::size_t size_of(std::string_view section) const {
        const Json* found = find(root_, section);
        return found ? found->size() : 0;
    }

    template <typename Keep>
    void keep_section(std::string_view key, const Keep& keep) {
        const Json* section = find(root_, key);
        if (!section) return;
        const Where root;
        const Where at(root, key);
        keep_elements(*section, kept_[std::string(key)], at, keep);
    }

    /// Every element of an array of objects.
    template <typename Keep>
    void keep_elements(const Json& from, Json& to, const Where& at, const Keep& keep) {
        to = Json::array();
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Where element(at, i);
            if (!from[i].is_object()) fail(element, "must be an object");
            Json kept = Json::object();
            keep(from[i], kept, element);
            to.push_back(std::move(kept));
        }
    }

    const Json& object_in(const Json& from, std::string_view key, const Where& at) const {
        const Json* value = find(from, key);
        if (!value || !value->is_object()) fail(Where(at, key), "must be an object");
        return *value;
    }

    const Json& array_in(const Json& from, std::string_view key, const Where& at) const {
        const Json* value = find(from, key);
        if (!value || !value->is_array()) fail(Where(at, key), "must be an array");
        return *value;
    }

    /// The schema allows 4.0 for 4.
    std::uint64_t integer(const Json& value, const Where& at) const {
        if (value.is_number_unsigned()) return value.get<std::uint64_t>();
        const double number = value.is_number() ? value.get<double>() : -1;
        if (!(number >= 0 && number <= 1e15) || number != std::floor(number)) {
            fail(at, "must be an integer of 0 or more");
        }
        return static_cast<std::uint64_t>(number);
    }

    /// Keeps an integer in [0, most]; false if it is absent.
    bool keep_integer(const Json& from, Json& to, std::string_view key, const Where& at, std::uint64_t most,
                      bool is_required) const {
        const Json* value = find(from, key);
        const Where here(at, key);
        if (!value) {
            if (is_required) fail(here, "is missing; add it");
            return false;
        }
        const std::uint64_t number = integer(*value, here);
        if (number > most) fail(here, std::to_string(number) + " is beyond " + std::to_string(most));
        to[std::string(key)] = number;
        return true;
    }

    /// Keeps an index of an element of a section.
    bool keep_index(const Json& from, Json& to, std::string_view key, const Where& at, std::string_view section,
                    bool is_required) const {
        const Json* value = find(from, key);
        if (value) check_index(integer(*value, Where(at, key)), size_of(section), section, Where(at, key));
        return keep_integer(from, to, key, at, kMaxInteger, is_required);
    }

    void check_index(std::uint64_t index, std::size_t size, std::string_view what, const Where& at) const {
        if (index >= size) {
            fail(at, "refers to " + std::string(what) + "/" + std::to_string(index) + ", but there are " +
                         std::to_string(size) + "; export the file again");
        }
    }

    void keep_nodes(const Json& from, Json& to, std::string_view key, const Where& at) const {
        const Json& array = array_in(from, key, at);
        const Where here(at, key);
        if (array.empty()) fail(here, "must not be empty; give nodes or leave it out");
        Json kept = Json::array();
        for (std::size_t i = 0; i < array.size(); ++i) {
            const Where element(here, i);
            const std::uint64_t index = integer(array[i], element);
            check_index(index, size_of("nodes"), "nodes", element);
            kept.push_back(index);
        }
        to[std::string(key)] = std::move(kept);
    }

    void keep_string(const Json& from, Json& to, std::string_view key, const Where& at, bool is_required) const {
        const Json* value = find(from, key);
        if (!value && !is_required) return;
        if (!value || !value->is_string()) fail(Where(at, key), "must be a string");
        to[std::string(key)] = *value;
    }

    void keep_numbers(const Json& from, Json& to, std::string_view key, const Where& at, std::size_t count) const {
        const Json* value = find(from, key);
        if (!value) return;
        const bool fits = value->is_array() && value->size() == count &&
                          std::all_of(value->begin(), value->end(), [](const Json& v) { return v.is_number(); });
        if (!fits) fail(Where(at, key), "must be an array of " + std::to_string(count) + " numbers");
        to[std::string(key)] = *value;
    }

    void check_asset() const {
        const Where root;
        const Where at(root, "asset");
        const Json& asset = object_in(root_, "asset", root);
        const auto version = [&](std::string_view key) -> std::string {
            const Json* value = find(asset, key);
            if (value && !value->is_string()) fail(Where(at, key), "must be a string");
            return value ? value->get<std::string>() : "";
        };
        const std::string written = version("version");
        if (!written.starts_with("2.")) {
            fail(Where(at, "version"), "is " + in_quotes(written) + ", but glTF 2.0 is needed; convert the file");
        }
        const std::string least = version("minVersion");
        if (!least.empty() && least != "2.0") {
            fail(Where(at, "minVersion"), "glTF " + in_quotes(least) + " cannot be read; export for 2.0");
        }
    }

    void check_required_extensions() const {
        if (!find(root_, "extensionsRequired")) return;
        const Where root;
        const Where at(root, "extensionsRequired");
        const Json& names = array_in(root_, "extensionsRequired", root);
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!names[i].is_string()) fail(Where(at, i), "must be a string");
            const auto name = names[i].get<std::string>();
            const bool is_harmless = std::find(kHarmless.begin(), kHarmless.end(), name) != kHarmless.end() ||
                                     std::any_of(kHarmlessPrefixes.begin(), kHarmlessPrefixes.end(),
                                                 [&](std::string_view prefix) { return name.starts_with(prefix); });
            if (!is_harmless) fail(Where(at, i), "requires " + in_quotes(name) + "; export without it");
        }
    }

    void keep_buffer(const Json& from, Json& to, const Where& at) {
        keep_integer(from, to, "byteLength", at, kMaxInteger, true);
        const auto length = to["byteLength"].get<std::size_t>();
        if (length == 0) fail(Where(at, "byteLength"), "must be over 0");
        keep_string(from, to, "uri", at, false);
        const std::size_t index = buffers_++;
        if (!to.contains("uri")) {
            if (!parts_.is_glb || index != 0 || !parts_.binary || parts_.binary->empty()) {
                buffer_files_.push_back({index, "", 1});
                to = {{"name", kNowhere}, {"uri", std::to_string(index)}, {"byteLength", 1}};
                return;
            }
            if (length > parts_.binary->size()) {
                fail(Where(at, "byteLength"), "is " + std::to_string(length) + ", but the binary chunk holds " +
                                                  std::to_string(parts_.binary->size()) +
                                                  " bytes; export or copy the file again");
            }
            return;
        }
        const auto& uri = to["uri"].get_ref<const std::string&>();
        if (uri.starts_with("data:")) {
            const std::size_t comma = uri.find(',');
            if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
                fail(Where(at, "uri"), "must be a data URI in base64; export the file again");
            }
            // tinygltf knows few media types; what is inside does not depend on them.
            to["uri"] = "data:application/octet-stream;base64" + uri.substr(comma);
            return;
        }
        std::string path = percent_decoded(uri);
        if (!is_below(path)) {
            fail(Where(at, "uri"), in_quotes(uri) + " must name a file beside this one or in a folder below it");
        }
        buffer_files_.push_back({index, std::move(path), length});
        to["uri"] = std::to_string(index);
    }

    void keep_view(const Json& from, Json& to, const Where& at) const {
        keep_index(from, to, "buffer", at, "buffers", true);
        keep_integer(from, to, "byteOffset", at, kMaxInteger, false);
        keep_integer(from, to, "byteLength", at, kMaxInteger, true);
        if (keep_integer(from, to, "byteStride", at, 252, false)) {
            const auto stride = to["byteStride"].get<int>();
            if (stride < 4 || stride % 4 != 0) fail(Where(at, "byteStride"), "must be a multiple of 4 from 4 to 252");
        }
    }

    void keep_accessor(const Json& from, Json& to, const Where& at) const {
        constexpr std::array<std::string_view, 7> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
        keep_index(from, to, "bufferView", at, "bufferViews", false);
        keep_integer(from, to, "byteOffset", at, kMaxInteger, false);
        keep_integer(from, to, "componentType", at, kMaxInteger, true);
        keep_integer(from, to, "count", at, kMaxInteger, true);
        keep_string(from, to, "type", at, true);
        const auto& type = to["type"].get_ref<const std::string&>();
        if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
            fail(Where(at, "type"), in_quotes(type) + " is no type of glTF 2.0; export the file again");
        }
        const auto component = to["componentType"].get<int>();
        if (component < 5120 || component > 5126 || component == 5124) {
            fail(Where(at, "componentType"), std::to_string(component) + " is none of glTF 2.0; export the file again");
        }
        keep_string(from, to, "name", at, false);
        if (const Json* normalized = find(from, "normalized")) {
            if (!normalized->is_boolean()) fail(Where(at, "normalized"), "must be true or false");
            to["normalized"] = *normalized;
        }
        if (!find(from, "sparse")) return;
        const Json& sparse = object_in(from, "sparse", at);
        const Where in_sparse(at, "sparse");
        Json& kept = to["sparse"];
        keep_integer(sparse, kept, "count", in_sparse, kMaxInteger, true);
        for (const std::string_view part : {"indices", "values"}) {
            const Json& object = object_in(sparse, part, in_sparse);
            const Where here(in_sparse, part);
            Json& kept_part = kept[std::string(part)];
            keep_index(object, kept_part, "bufferView", here, "bufferViews", true);
            keep_integer(object, kept_part, "byteOffset", here, kMaxInteger, false);
            if (part == "indices") keep_integer(object, kept_part, "componentType", here, kMaxInteger, true);
        }
    }

    void keep_node(const Json& from, Json& to, const Where& at) const {
        keep_string(from, to, "name", at, false);
        if (find(from, "children")) keep_nodes(from, to, "children", at);
        keep_numbers(from, to, "matrix", at, 16);
        keep_numbers(from, to, "translation", at, 3);
        keep_numbers(from, to, "rotation", at, 4);
        keep_numbers(from, to, "scale", at, 3);
        if (to.contains("matrix") && (to.contains("translation") || to.contains("rotation") || to.contains("scale"))) {
            fail(at, "has a matrix and translation, rotation or scale; give either");
        }
    }

    void keep_skin(const Json& from, Json& to, const Where& at) const {
        keep_string(from, to, "name", at, false);
        keep_nodes(from, to, "joints", at);
    }

    void keep_animation(const Json& from, Json& to, const Where& at) {
        keep_string(from, to, "name", at, false);
        const Json& samplers = array_in(from, "samplers", at);
        const Where in_samplers(at, "samplers");
        keep_elements(samplers, to["samplers"], in_samplers, [this](const Json& v, Json& kept, const Where& here) {
            keep_index(v, kept, "input", here, "accessors", true);
            keep_index(v, kept, "output", here, "accessors", true);
            keep_string(v, kept, "interpolation", here, false);
        });
        const Json& channels = array_in(from, "channels", at);
        const Where in_channels(at, "channels");
        Json kept_channels = Json::array();
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const Where here(in_channels, i);
            if (!channels[i].is_object()) fail(here, "must be an object");
            Json kept = Json::object();
            keep_integer(channels[i], kept, "sampler", here, kMaxInteger, true);
            check_index(kept["sampler"].get<std::uint64_t>(), samplers.size(), "samplers", Where(here, "sampler"));
            const Json& target = object_in(channels[i], "target", here);
            const Where in_target(here, "target");
            Json& kept_target = kept["target"];
            keep_string(target, kept_target, "path", in_target, true);
            // Without a node, a channel is to be ignored (the specification's words for extensions to come).
            if (keep_index(target, kept_target, "node", in_target, "nodes", false)) {
                kept_channels.push_back(std::move(kept));
            }
        }
        to["channels"] = std::move(kept_channels);
    }

    const Json root_;
    const GltfParts& parts_;
    const std::string& file_;
    Json kept_;
    std::size_t buffers_ = 0;
    std::vector<GltfBufferFile> buffer_files_;
};

}  // namespace

GltfText checked_gltf_text(const GltfParts& parts, const std::string& file) {
    check_shape(parts.json, file);
    return Checker(parse(parts, file), parts, file).text();
}

}  // namespace mobbscope
