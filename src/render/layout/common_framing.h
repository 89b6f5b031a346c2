/// One camera for the pictures of a sequence, so that nothing jumps from one to the next.
#pragma once

#include <render/drawlist/draw_list.h>

#include <optional>
#include <vector>

namespace mobbscope {

/// Told of all pictures, each framed by itself; all of one scene in one size, with time drawn equally high.
class CommonFraming {
  public:
    void add(const DrawList& list);

    /// The explicit camera (see resolved_camera) that sees all pictures from where `camera` looks, as large as can be.
    Camera still(const Camera& camera) const;

    /// Likewise, but it shows all from every side: it may be turned about its target.
    Camera turning(const Camera& camera) const;

  private:
    void tidy();

    DrawnSpace space_;
    PictureSize size_;
    std::vector<glm::vec3> points_;  ///< of what is drawn, drawn space
    std::size_t tidy_at_ = 0;        ///< so many points are looked through for equal ones
    std::optional<Frame> frame_;     ///< left for the scene in every picture
};

}  // namespace mobbscope
