/// Disks in levels of detail, which do not depend on the camera: it chooses a level for each block of disks.
#pragma once

#include <render/drawlist/draw_list.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mobbscope {

/// How many pixels of the picture a metre at `point` makes up, for many points.
class PixelScale {
  public:
    explicit PixelScale(const ViewProjection& projection);
    /// A point nearer than what is drawn counts as if it lay there, for it may be the middle of what is seen.
    float at(glm::vec3 point) const { return at_depth(projection_->depth(point)); }
    float at_depth(float depth) const;
    /// At distance 1 from the eye; without perspective anywhere.
    float near() const { return scale_; }

  private:
    const ViewProjection* projection_;
    float scale_;
};

/// A disk, upright or leaning, or a tube from the lower face of a disk to that of another farther up the path.
struct DiskPiece {
    glm::vec3 base{0};  ///< centre below, drawn space
    float radius = 0;   ///< below
    glm::vec3 top{0};   ///< centre above
    float top_radius = 0;
    std::array<std::uint32_t, 2> id{0, 0};  ///< of a disk, or run_id of a tube, which has no upper face
    /// Of the disks that stand on it and that it stands on: how far from its own the centre lies, and the radius; what
    /// they hide of its faces need not be drawn. Radius 0: there is none.
    glm::vec3 above{0}, below{0};
};

/// Of a tube that stands for disks of an agent: upright ones, which leave some of each other's faces free, or `smooth`
/// for leaning ones that go on where the last ended. The first number is 0, the lowest bit of the second is `smooth`
/// and the others are the agent.
inline std::array<std::uint32_t, 2> run_id(int agent, bool smooth) {
    return {0, static_cast<std::uint32_t>(agent) << 1 | (smooth ? 1u : 0u)};
}

/// Disks in drawing order as pieces.
std::vector<DiskPiece> pieces_of(const std::vector<DiskInstance>& disks);

/// Successive disks of a path. Far away they are drawn as tubes, as many as keep within a tolerance.
struct DiskBlock {
    std::size_t first = 0;  ///< in drawing order
    std::size_t count = 0;
    bool continues = false;  ///< the next disk in order stands on the last one
    bool mixed = false;      ///< neighbours differ in colour: drawn disk by disk
    glm::vec3 middle{0};     ///< of a ball around it
    float reach = 0;         ///< the ball's radius
    float lowest = 0;        ///< of the bases
    float highest = 0;       ///< ... and of the tops
    float widest = 0;        ///< radius
    float usual_radius = 0;  ///< the mean, or more where one is far wider: what the number of sides is chosen for
    float tallest = 0;       ///< disk
    float most_lean = 0;     ///< of a disk (DiskInstance::lean)
    float longest_step = 0;  ///< longer ones are leaps, which only coarse tubes go over
    float widest_step = 0;   ///< the widest that is no leap: what a disk's successor leaves free of its face, metres
};

class DiskLevels {
  public:
    /// Level 0 has all disks. The others have tubes that are off by so many metres at most.
    static constexpr int kLevels = 20;
    static float tolerance(int level);

    struct Range {
        std::size_t first = 0, count = 0;
        friend bool operator==(const Range&, const Range&) = default;
    };
    struct Level {
        std::vector<DiskPiece> pieces;       ///< first tubes, then disks
        std::vector<std::uint32_t> sources;  ///< of each piece: the disk that has its colour, in drawing order
        std::vector<Range> tubes, disks;     ///< of each block
    };

    /// `disks`: in drawing order. They are copied.
    explicit DiskLevels(std::vector<DiskInstance> disks);

    const std::vector<DiskInstance>& disks() const { return disks_; }
    /// Near ones near one another.
    const std::vector<DiskBlock>& blocks() const { return blocks_; }
    float most_lean() const { return most_lean_; }  ///< of all blocks
    /// Made when first asked for.
    const Level& level(int index);

    /// True if `disks` (in drawing order) are these but for their colours; then they take those.
    bool take_colors(const std::vector<const DiskInstance*>& disks);

    /// The coarsest level whose tubes nobody tells from the disks of a block. `pixels`: of a metre, at its nearest.
    static int choose(const DiskBlock& block, float pixels, const ViewProjection& projection);

  private:
    void note_colors();

    std::vector<DiskInstance> disks_;
    std::vector<DiskBlock> blocks_;
    float most_lean_ = 0;
    std::array<std::optional<Level>, kLevels> levels_;
};

}  // namespace mobbscope
