#version 330 core
// A unit cylinder, placed and scaled for each sample.
layout(location = 0) in vec3 corner;  // x, y on the unit circle or its centre; z 0 below, 1 above
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 base_and_radius;
layout(location = 3) in float height;
layout(location = 4) in vec4 color;
layout(location = 5) in uvec2 id;

uniform mat4 clip_from_world;

out vec3 surface_normal;
out vec4 surface_color;
out vec2 local;  // 0 in the middle to 1 at the rim; 0 below to 1 above
flat out uvec2 object_id;

void main() {
    vec3 point = base_and_radius.xyz + vec3(corner.xy * base_and_radius.w, corner.z * height);
    gl_Position = clip_from_world * vec4(point, 1.0);
    surface_normal = normal;
    surface_color = color;
    local = vec2(length(corner.xy), corner.z);
    object_id = id;
}
