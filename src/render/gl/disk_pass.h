/// Draws the disks: opaque, instanced, lit.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

#include <map>
#include <vector>

namespace mobbscope {

/// How true to shape. `coarse` is off by less than a pixel: for what moves.
enum class Detail { fine, coarse };

class DiskPass {
  public:
    explicit DiskPass(GlContext& context);

    /// Into the bound framebuffer: colours to output 0 and, of fine disks, ids to output 1.
    void draw(const DrawList& list, Detail detail);

  private:
    struct Instance;
    /// What instances are made of.
    enum class Part { side_and_upper_face, side_and_lower_face, side };
    /// A unit cylinder. Its array reads instances from instances_.
    struct Cylinder {
        int sides = 0;
        VertexArray array;
        Buffer vertices, indices;
    };
    const Cylinder& cylinder(int sides);
    void draw(const Cylinder& cylinder, const std::vector<Instance>& instances, Part part) const;

    ShaderProgram program_;
    Buffer instances_;
    std::map<int, Cylinder> cylinders_;  ///< by the number of sides; made when first needed
};

}  // namespace mobbscope
