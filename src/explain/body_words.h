/// Bodies of a query in words, and as `query --bodies --json` has them.
#pragma once

#include <base/json_writer.h>
#include <explain/bodies.h>
#include <scene/scene.h>

#include <string>
#include <vector>

namespace mobbscope {

/// "the clip 'walk' has no skeleton: ...", for one of a query's sides; empty if both have one.
std::string why_no_bodies(const Scene& scene, const SceneQuery& query);

/// "LeftArm-LeftForeArm of A and Neck-Head of B", with en dashes.
std::string bones_words(const PlacedBody& a, const std::string& name_a, const PlacedBody& b, const std::string& name_b,
                        const NearestBones& bones);

/// Whether the bodies touch, when and where, and when they may: sentences, the most telling first. Requires that the
/// clips share time.
std::vector<std::string> body_sentences(const PlacedBody& a, const std::string& name_a, const PlacedBody& b,
                                        const std::string& name_b, const BodyDistances& distances);

/// A value.
void write_bodies(JsonWriter& out, const PlacedBody& a, const PlacedBody& b, const BodyDistances& distances);

}  // namespace mobbscope
