#version 330 core
// Weighted blended order-independent transparency: sums that do not care which face comes first.
flat in vec4 face_color;
in float nearness;
flat in uvec2 object_id;

layout(location = 0) out vec4 sum;      // colour * opacity * weight is added; alpha multiplies up what still shows through
layout(location = 1) out vec4 weights;  // opacity * weight is added
layout(location = 2) out uvec2 id;

void main() {
    float weight = face_color.a * exp2(7.0 * nearness);
    sum = vec4(face_color.rgb * weight, face_color.a);
    weights = vec4(weight, 0.0, 0.0, face_color.a);
    id = object_id;
}
