/// Draws the disks: opaque, instanced, lit.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/disk_levels.h>
#include <render/gl/gl_objects.h>
#include <render/gl/tiles.h>

#include <map>
#include <optional>
#include <vector>

namespace mobbscope {

/// How true to shape. `coarse` is off by less than a pixel: for what moves.
enum class Detail { fine, coarse };

/// Keeps the shapes of the last list's disks: another picture with these uploads at most their colours.
class DiskPass {
  public:
    explicit DiskPass(GlContext& context);

    /// Neighbouring pieces that are drawn alike; faces that cannot be seen are left out.
    enum class Part { side, side_and_upper_face, side_and_lower_face, all };
    struct Batch {
        int level = 0;
        int sides = 0;
        Part part = Part::all;
        DiskLevels::Range range;
        float depth = 0;  ///< of the nearest
        friend bool operator==(const Batch&, const Batch&) = default;
    };
    /// All that decides which disk is seen in each pixel, and how it is lit: pictures of one size with equal keys
    /// differ in colours alone.
    struct VisibilityKey {
        int shapes = 0;  ///< which, of all that were drawn
        Detail detail = Detail::fine;
        std::vector<Batch> batches;
        glm::mat4 clip_from_world{1};
        glm::vec3 right{0}, back{0};
        glm::vec2 slab{0};
        friend bool operator==(const VisibilityKey&, const VisibilityKey&) = default;
    };

    /// Into the bound framebuffer: to output 0 which disk is seen and how bright, for `tint`; of fine disks ids to
    /// output 1; to output 2 what `tint` would make of the first, if begin was told so.
    void draw(const DrawList& list, Detail detail, DrawStatistics& statistics);
    /// What draw would draw. Another list than the last ends what is drawn in parts. Throws MachineError for more disks
    /// than can be told apart.
    VisibilityKey visibility_key(const DrawList& list, Detail detail);
    /// The same as draw, in parts. Requires that `key` is what visibility_key() returned last: ranges are of the pieces
    /// that are kept of that list. `colored`: whether output 2 is wanted.
    void begin(const VisibilityKey& key, bool colored, DrawStatistics& statistics);
    /// At most so many disks and tubes more (> 0) of the same list; true once that was all.
    bool draw_more(const DrawList& list, std::size_t most, DrawStatistics& statistics);
    /// Brings the colours of the disks of the list that was asked about last into the bound framebuffer, where they are
    /// seen. `visibility`: what was drawn to output 0, with as many samples.
    void tint(const DrawList& list, const Texture& visibility, DrawStatistics& statistics);

  private:
    /// A unit cylinder.
    struct Cylinder {
        int sides = 0;
        VertexArray array;
        Buffer vertices, indices;
    };
    /// The pieces of a level on the GPU.
    struct Stored {
        Buffer pieces, sources;
        bool has_pieces = false;
    };
    void keep(const DrawnWorld& world);
    const Cylinder& cylinder(int sides);
    /// Upload what is missing of a level, or of all disks.
    const Stored& store(int level, DrawStatistics& statistics);
    const Stored& store_fine(DrawStatistics& statistics);
    void store_colors(DrawStatistics& statistics);
    /// For the program in use.
    void use_colors(ShaderProgram& program, const DrawList& list, DrawStatistics& statistics);
    std::vector<Batch> fine_batches(const ViewProjection& projection, glm::vec2 slab) const;
    std::vector<Batch> coarse_batches(const ViewProjection& projection, glm::vec2 slab);
    void draw(const Batch& batch, DrawStatistics& statistics);

    DrawingPolicy policy_;
    ShaderProgram program_, tint_;
    Tiles tiles_;     ///< in which disks may be seen
    Texture colors_;  ///< of all disks in drawing order
    bool has_colors_ = false;
    std::size_t most_disks_ = 0;         ///< of one picture
    int shapes_ = 0;                     ///< counts other ones
    std::map<int, Cylinder> cylinders_;  ///< by the number of sides; made when first needed
    SharedValues<DiskInstance> kept_;    ///< of the last list
    std::optional<DiskLevels> levels_;   ///< of those
    bool drawn_ = false;                 ///< they were drawn before: all levels are worth their while
    Stored fine_;                        ///< all disks in drawing order, on which depends who wins where two are equal
    std::vector<Stored> coarse_{DiskLevels::kLevels};
    Detail detail_ = Detail::fine;
    bool colored_ = false;
    std::vector<Batch> undrawn_;  ///< what is left to be drawn, the last first
};

}  // namespace mobbscope
