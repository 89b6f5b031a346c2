/// Draws the disks: opaque, instanced, lit.
#pragma once

#include <render/draw_list.h>
#include <render/gl_objects.h>

#include <vector>

namespace mobbscope {

/// How true to shape. `coarse` is off by less than half a pixel, as edges without multisampling are anyway.
enum class Detail { fine, coarse };

class DiskPass {
  public:
    explicit DiskPass(GlContext& context);

    /// Into the bound framebuffer: colours to output 0 and, of fine disks, ids to output 1.
    void draw(const DrawList& list, Detail detail);

  private:
    struct Instance;
    /// Instances and where their numbers lie.
    struct Batch {
        VertexArray array;
        Buffer instances;
    };
    void describe(const Batch& batch) const;
    void make_cylinder(int segments);
    enum class Face { upper, lower };
    void draw_single(const std::vector<Instance>& disks, Face face);

    ShaderProgram program_;
    Buffer vertices_;
    Buffer indices_;
    Batch single_;
    Batch runs_;
    int segments_ = 0;
};

}  // namespace mobbscope
