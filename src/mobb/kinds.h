/// The kinds of boxes, tests and trees. A new kind is an enumerator and its row here; a new box also needs its fit
/// (fit.cpp) and its test (separation.h). What is missing does not compile. All that else depends on a kind asks its
/// row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mobb {

/// What a box is, and so which test two boxes get.
enum class BoxKind : std::uint8_t {
    obb2d,   ///< an oriented rectangle extruded in time: a MOBB node (paper, Section 3)
    obb3d,   ///< a free oriented box: a UMOBB node (paper, Section 4)
    moving,  ///< an oriented rectangle whose centre moves at a constant velocity, as in TPR-trees (Saltenis et al.
             ///< 2000)
    aabb,    ///< a rectangle along x and y, of the clip and again of the world, extruded in time
    block,   ///< a disk whose centre moves at a constant velocity, around consecutive samples
};

enum class TreeKind : std::uint8_t {
    mobb,     ///< 2D oriented boxes extruded in time
    umobb,    ///< free boxes in space-time
    hybrid1,  ///< MOBB root, UMOBB below (paper, Section 5)
    hybrid2,  ///< UMOBB root, MOBB below
    moving,   ///< 2D oriented boxes that move with the walk
    aabb,     ///< boxes along the axes: the baseline of other fields
    blocks,   ///< blocks of 16 samples and of 8 blocks, tested several at a time (mobb/blocks.h)
};

/// The axes of a box, and so those that separate two of its kind.
enum class BoxAxes : std::uint8_t {
    floor,       ///< two of its own on the floor: a test tries both boxes' axes, 4
    space_time,  ///< three of its own: a test tries both boxes' axes and each pair's cross product, 15
    world,       ///< the world's x and y: a test tries these 2
    centers,     ///< none of its own: a test tries the line between the centres, where they are nearest
};

struct BoxInfo {
    std::string_view name;     ///< as in files
    std::string_view title;    ///< for people: "2D box"
    std::string_view plural;   ///< "2D boxes"
    std::string_view heading;  ///< the shortest that is understood: "2D"
    std::string_view test;     ///< what its test tries, for people
    // Its shape.
    BoxAxes axes = BoxAxes::floor;
    bool round = false;      ///< the cylinder inside the box, whose first half extent is the radius; else the box
    bool moves = false;      ///< its centre moves evenly as long as it lasts; else it stands still
    bool of_blocks = false;  ///< comes with the blocks of its clip (mobb/blocks.h); else it is fitted

    std::string_view meets = "the boxes overlap";  ///< what a test says that does not separate two
    bool in_paper = true;
    std::string_view looks{};  ///< what a picture's legend says of it; empty where nothing needs saying

    /// Whether it is at any time the same on the floor.
    constexpr bool is_upright() const { return axes != BoxAxes::space_time && !moves; }
};

struct TreeInfo {
    std::string_view name;   ///< as in files and on the command line
    std::string_view title;  ///< in sentences
    std::string_view label;  ///< in a list of kinds
    std::string_view help;   ///< one line
    BoxKind root = BoxKind::obb2d;
    BoxKind below = BoxKind::obb2d;  ///< of all other levels
    std::string_view formerly{};     ///< its name once, which is refused with the present one

    constexpr bool has(BoxAxes axes) const;
    constexpr bool has_blocks() const;
    /// Whether FitOptions::leaf and levels matter.
    constexpr bool splits() const { return !has_blocks(); }
    /// Whether FitOptions::axes matters.
    constexpr bool chooses_axes() const { return has(BoxAxes::floor) || has(BoxAxes::space_time); }
    /// Whether FitOptions::time_scale matters.
    constexpr bool uses_time_scale() const { return has(BoxAxes::space_time); }
};

namespace rows {

constexpr BoxInfo of(BoxKind kind) {
    switch (kind) {
        case BoxKind::obb2d:
            return {.name = "obb2d",
                    .title = "2D box",
                    .plural = "2D boxes",
                    .heading = "2D",
                    .test = "Four axes on the floor"};
        case BoxKind::obb3d:
            return {.name = "obb3d",
                    .title = "3D box",
                    .plural = "3D boxes",
                    .heading = "3D",
                    .test = "Up to fifteen axes in space-time",
                    .axes = BoxAxes::space_time};
        case BoxKind::moving:
            return {.name = "moving",
                    .title = "moving box",
                    .plural = "moving boxes",
                    .heading = "moving",
                    .test = "Four axes on the floor, at both ends of the common time",
                    .moves = true,
                    .in_paper = false,
                    .looks = "boxes lean: each moves with its walk"};
        case BoxKind::aabb:
            return {.name = "aabb",
                    .title = "AABB",
                    .plural = "AABBs",
                    .heading = "aabb",
                    .test = "The world's x and y",
                    .axes = BoxAxes::world,
                    .in_paper = false,
                    .looks = "boxes lie along the world's x and y"};
        case BoxKind::block:
            return {.name = "block",
                    .title = "block",
                    .plural = "blocks",
                    .heading = "block",
                    .test = "The line between the centres, where they are nearest",
                    .axes = BoxAxes::centers,
                    .round = true,
                    .moves = true,
                    .of_blocks = true,
                    .meets = "the blocks may meet",
                    .in_paper = false,
                    .looks = "a block is the cylinder inside its box"};
    }
    return {};
}

constexpr TreeInfo of(TreeKind kind) {
    switch (kind) {
        case TreeKind::mobb:
            return {"mobb", "MOBB", "MOBB", "Boxes upright in time", BoxKind::obb2d, BoxKind::obb2d};
        case TreeKind::umobb:
            return {"umobb", "UMOBB", "UMOBB", "Free boxes in space-time", BoxKind::obb3d, BoxKind::obb3d};
        case TreeKind::hybrid1:
            return {"hybrid1", "hybrid1", "hybrid 1", "MOBB root, UMOBB below", BoxKind::obb2d, BoxKind::obb3d};
        case TreeKind::hybrid2:
            return {"hybrid2", "hybrid2", "hybrid 2", "UMOBB root, MOBB below", BoxKind::obb3d, BoxKind::obb2d};
        case TreeKind::moving:
            return {"moving",        "moving boxes", "moving", "Boxes that move with the walk",
                    BoxKind::moving, BoxKind::moving};
        case TreeKind::aabb:
            return {"aabb",        "AABB",       "AABB", "Boxes along x and y: the baseline of other fields",
                    BoxKind::aabb, BoxKind::aabb};
        case TreeKind::blocks:
            return {
                "blocks",       "blocks",       "blocks",    "Blocks of samples, tested several at a time: the fastest",
                BoxKind::block, BoxKind::block, "production"};
    }
    return {};
}

/// How many enumerators there are: 0, 1, ... up to the first without a row.
template <class Kind>
consteval std::size_t count() {
    std::size_t n = 0;
    while (!of(static_cast<Kind>(n)).name.empty()) ++n;
    return n;
}

/// One value per enumerator.
template <class Kind>
consteval auto table(auto value) {
    std::array<decltype(value(Kind{})), count<Kind>()> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = value(static_cast<Kind>(i));
    return out;
}

inline constexpr auto kBoxes = table<BoxKind>([](BoxKind kind) { return of(kind); });
inline constexpr auto kTrees = table<TreeKind>([](TreeKind kind) { return of(kind); });

}  // namespace rows

inline constexpr std::size_t kBoxKindCount = rows::count<BoxKind>();
inline constexpr std::size_t kTreeKindCount = rows::count<TreeKind>();
inline constexpr auto kBoxKinds = rows::table<BoxKind>([](BoxKind kind) { return kind; });
inline constexpr auto kTreeKinds = rows::table<TreeKind>([](TreeKind kind) { return kind; });

/// The row of an enumerator.
constexpr const BoxInfo& info(BoxKind kind) { return rows::kBoxes[static_cast<std::size_t>(kind)]; }
constexpr const TreeInfo& info(TreeKind kind) { return rows::kTrees[static_cast<std::size_t>(kind)]; }

constexpr bool TreeInfo::has(BoxAxes axes) const { return info(root).axes == axes || info(below).axes == axes; }
constexpr bool TreeInfo::has_blocks() const { return info(below).of_blocks; }

/// What a query tests: the times of two nodes, their boxes (a test is of the kind of box that it is made for), or
/// their samples.
class TestKind {
  public:
    static const TestKind time, samples;
    constexpr TestKind() = default;  ///< of times
    constexpr TestKind(BoxKind box) : index_(static_cast<std::uint8_t>(1 + static_cast<std::size_t>(box))) {}

    constexpr bool is_box() const { return index_ > 0 && index_ <= kBoxKindCount; }
    /// Requires is_box().
    constexpr BoxKind box() const { return static_cast<BoxKind>(index_ - 1); }
    /// In the order in which files list the tests.
    constexpr std::size_t index() const { return index_; }

    friend constexpr bool operator==(TestKind, TestKind) = default;

  private:
    std::uint8_t index_ = 0;
};

inline constexpr TestKind TestKind::time{};
inline constexpr TestKind TestKind::samples{static_cast<BoxKind>(kBoxKindCount)};

inline constexpr std::size_t kTestKindCount = kBoxKindCount + 2;
/// In the order of index().
inline constexpr auto kTestKinds = [] {
    std::array<TestKind, kTestKindCount> out{};
    for (std::size_t i = 0; i < kBoxKindCount; ++i) out[i + 1] = kBoxKinds[i];
    out.back() = TestKind::samples;
    return out;
}();

}  // namespace mobb
