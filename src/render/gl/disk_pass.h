/// Draws the disks: opaque, instanced, lit.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/disk_levels.h>
#include <render/gl/gl_objects.h>

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

    /// Into the bound framebuffer: colours to output 0 and, of fine disks, ids to output 1.
    void draw(const DrawList& list, Detail detail, DrawStatistics& statistics);
    /// The same in parts: finds out what is to be drawn; draws at most so many disks and tubes more (> 0) of the same
    /// list, true once that was all.
    void begin(const DrawList& list, Detail detail, DrawStatistics& statistics);
    bool draw_more(const DrawList& list, std::size_t most, DrawStatistics& statistics);

  private:
    /// What is drawn of instances: faces that cannot be seen are left out.
    enum class Part { side, side_and_upper_face, side_and_lower_face, all };
    /// A unit cylinder.
    struct Cylinder {
        int sides = 0;
        VertexArray array;
        Buffer vertices, indices;
    };
    /// The pieces of a level on the GPU.
    struct Stored {
        Buffer pieces, colors;
        bool has_pieces = false, has_colors = false;
    };
    /// Neighbouring pieces that are drawn alike.
    struct Batch {
        int level = 0;
        int sides = 0;
        Part part = Part::all;
        DiskLevels::Range range;
        float depth = 0;  ///< of the nearest
    };

    void keep(const DrawnWorld& world);
    const Cylinder& cylinder(int sides);
    /// Upload what is missing of a level, or of all disks. Colours only of levels that are drawn.
    const Stored& store_shapes(int level, DrawStatistics& statistics);
    const Stored& store(int level, DrawStatistics& statistics);
    const Stored& store_fine(DrawStatistics& statistics);
    std::vector<Batch> fine_batches(const ViewProjection& projection) const;
    std::vector<Batch> coarse_batches(const ViewProjection& projection);
    void draw(const Batch& batch, DrawStatistics& statistics);

    ShaderProgram program_;
    std::map<int, Cylinder> cylinders_;  ///< by the number of sides; made when first needed
    SharedValues<DiskInstance> kept_;    ///< of the last list
    std::optional<DiskLevels> levels_;   ///< of those
    bool stays_ = false;                 ///< they were drawn before: all levels are worth their while
    Stored fine_;                        ///< all disks in drawing order, on which depends who wins where two are equal
    std::vector<Stored> coarse_{DiskLevels::kLevels};
    Detail detail_ = Detail::fine;
    std::vector<Batch> undrawn_;  ///< what is left to be drawn, the last first
};

}  // namespace mobbscope
