/// BVH texts that tests read, and damage.
#pragma once

#include <string>

namespace mobbscope {
inline namespace testing {

/// A walker of three joints, Y up, about 1.7 m tall in cm: two frames a tenth of a second apart. The hips go 10 cm
/// along X and turn by 90 degrees about Y; an arm reaches 50 cm forward (Z), its tip 20 cm farther.
inline const std::string kWalker = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Left Arm
  {
    OFFSET 0 75 50
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 20
    }
  }
  JOINT Foot
  {
    OFFSET 0 -95 0
    CHANNELS 3 Zrotation Xrotation Yrotation
  }
}
MOTION
Frames: 2
Frame Time: 0.1
0 95 30 0 0 0 0 0 0 0 0 0
10 95 30 0 0 90 0 0 0 0 0 0
)";

/// The text with one piece replaced.
inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
    return text.replace(text.find(what), what.size(), with);
}

}  // namespace testing
}  // namespace mobbscope
