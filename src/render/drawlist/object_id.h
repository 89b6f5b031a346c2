/// What a pixel of an id picture means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mobbscope {

/// Something that can be pointed at. It is stored as two 32-bit numbers: 1 + the participant's index; then the sample's
/// or the node's index, with the highest bit set for a node. (0, 0) is nothing.
struct ObjectId {
    enum class Kind { disk, box };

    int participant = 0;  ///< index into DrawList::participants
    Kind kind = Kind::disk;
    int index = 0;  ///< sample of the clip, or node of the tree; below 2^31

    std::uint32_t r() const { return static_cast<std::uint32_t>(participant) + 1; }
    std::uint32_t g() const { return static_cast<std::uint32_t>(index) | (kind == Kind::box ? kBoxBit : 0u); }
    static std::optional<ObjectId> decode(std::uint32_t r, std::uint32_t g) {
        if (r == 0) return std::nullopt;
        return ObjectId{static_cast<int>(r - 1), (g & kBoxBit) ? Kind::box : Kind::disk,
                        static_cast<int>(g & ~kBoxBit)};
    }

    friend bool operator==(const ObjectId&, const ObjectId&) = default;

  private:
    static constexpr std::uint32_t kBoxBit = 0x80000000u;
};

/// Object ids, two numbers a pixel, rows from top to bottom.
struct IdImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> rg;

    /// What is at pixel (x, y), which must lie in the image.
    std::optional<ObjectId> at(int x, int y) const {
        const std::size_t i =
            2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return ObjectId::decode(rg[i], rg[i + 1]);
    }
};

}  // namespace mobbscope
