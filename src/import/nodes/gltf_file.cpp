#include <base/error.h>
#include <base/json.h>
#include <import/nodes/gltf_file.h>

#include <algorithm>
#include <cstdint>

namespace mobbscope {

namespace {

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
        if (size % 4 != 0) fail(place, "its length of " + std::to_string(size) + " bytes is not a multiple of 4");
        if ((type == kJsonChunk) != (chunk == 0)) fail(place, "the first chunk, and no other, must be JSON");
        if (type == kBinaryChunk && chunk != 1) fail(place, "a binary chunk can only be the second");
        if (type == kJsonChunk) parts.json = bytes.substr(offset, size);
        if (type == kBinaryChunk) parts.binary = bytes.substr(offset, size);
        offset += size;
    }
    if (chunk == 0) fail("GLB header", "has no chunk");
    return parts;
}

bool begins_as_json(std::string_view text) {
    const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

GltfParts split_gltf(std::string_view bytes, bool named_glb, const std::string& file) {
    if (bytes.starts_with(kMagic)) return split_glb(bytes, file);
    if (named_glb && !begins_as_json(bytes)) {
        throw InputError(file, "GLB header", "does not begin with 'glTF'; it is not a GLB file, or a damaged one");
    }
    return {bytes, std::nullopt, false};
}

bool looks_like_gltf(std::string_view head) {
    if (head.starts_with(kMagic)) return true;
    const JsonHead json = json_head(head);
    // Without the asset, which may stand beyond what is looked at, these tell.
    if (!json.has_any({"asset"})) return json.cut_off && json.has_any({"accessors", "bufferViews"});
    return std::ranges::any_of(json.keys,
                               [](const JsonKey& key) { return key.in == "asset" && key.name == "version"; });
}

}  // namespace mobbscope
