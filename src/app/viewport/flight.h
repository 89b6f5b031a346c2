/// A camera on its way from one view to another: a jump would lose the person.
#pragma once

#include <render/drawlist/camera.h>
#include <scene/view_state.h>

#include <algorithm>

namespace mobbscope::app {

class Flight {
  public:
    /// Both settled (render/drawlist/camera.h). `now`: seconds.
    Flight(const Camera& from, const Camera& to, double now) : from_(from), to_(to), start_(now) {}

    bool over(double now) const { return now - start_ >= kSeconds; }
    Camera at(double now) const {
        const double t = std::clamp((now - start_) / kSeconds, 0.0, 1.0);
        return between(from_, to_, t * t * (3 - 2 * t));
    }

  private:
    static constexpr double kSeconds = 0.3;

    Camera from_, to_;
    double start_;
};

}  // namespace mobbscope::app
