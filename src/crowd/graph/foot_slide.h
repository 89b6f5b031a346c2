/// Feet that should stand and slide.
///
/// A joint carries in a clip if it is at most kCarries above the lowest joint of the pose in a tenth of the frames or
/// more. It stands where it is at most kLow above its own usual lowest height (that of the twentieth of the frames in
/// which it is lowest) and slower than kSlow. A contact is a run of such frames that lasts kLeastContact or longer.
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace mobbscope {

inline constexpr double kCarries = 0.01;      ///< metres
inline constexpr double kLow = 0.03;          ///< metres
inline constexpr double kSlow = 0.2;          ///< metres per second, in space
inline constexpr double kLeastContact = 0.1;  ///< seconds from the first frame to the last

/// The joints of the body: the root and all below it. Indices into the skeleton's joints.
std::vector<int> body_of(const Skeleton& skeleton);

/// Frames in which a joint stands.
struct Contact {
    int joint = 0;  ///< index into the skeleton's joints
    int first = 0;
    int count = 0;
};

/// Whether what stands over so many frames is a contact.
bool lasts(int frames, double dt);

/// All runs of frames in which a joint stands, however short: those at a clip's ends may go on in another. By joint,
/// then by frame. Frames are those in [first, end) of the clip, and counted from `first`.
std::vector<Contact> standing(const mobb::Clip& clip, const Skeleton& skeleton, int first, int end);

/// Where a joint is on the floor in the frames of a contact, in the clip's axes. The contact may be of another clip
/// whose joints and frames are the same, such as the one that this was made of.
std::vector<glm::dvec2> places_of(const Contact& contact, const mobb::Clip& clip, const Skeleton& skeleton);

/// How far what should stand gets from where it stood first, metres. At least one place.
double slide_of(std::span<const glm::dvec2> places);

}  // namespace mobbscope
