#version 330 core
// The six faces of a parallelepiped, each two triangles. Corner bits give the sign along the extents.
layout(location = 0) in vec3 center;
layout(location = 1) in vec3 extent0;
layout(location = 2) in vec3 extent1;
layout(location = 3) in vec3 extent2;
layout(location = 4) in vec4 fill;
layout(location = 5) in uvec2 id;  // x is 0 of what cannot be pointed at; then see box_buffer.h

uniform mat4 clip_from_world;
uniform vec2 depth_range;  // nearest and farthest of the scene along the line of sight
uniform bool perspective;
uniform vec3 light;
uniform bool ids;  // of all boxes that have one, faces drawn or not
uniform vec2 slab;  // what is outside is not drawn: boxes as a whole
uniform bool cut;   // ... or they are cut there

flat out vec4 face_color;
out float nearness;  // 1 at the nearest of the scene, 0 at the farthest
flat out uvec2 object_id;

const int corners[36] = int[36](0, 2, 4, 4, 2, 6, 1, 5, 3, 5, 7, 3,
                                0, 4, 1, 1, 4, 5, 2, 3, 6, 3, 7, 6,
                                0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7);

void main() {
    // A level sheet is where the picture has it on purpose.
    float half_height = abs(extent0.z) + abs(extent1.z) + abs(extent2.z);
    float low = center.z - half_height;
    float high = center.z + half_height;
    bool outside = half_height > 0.0 && (high <= slab.x || (low >= slab.y && low > slab.x));
    bool other_half = id == uvec2(0u, 1u) && gl_VertexID % 6 > 2;
    gl_ClipDistance[0] = 1.0;
    gl_ClipDistance[1] = 1.0;
    if (outside || other_half || (ids ? id.x == 0u : fill.a <= 0.0)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    int corner = corners[gl_VertexID];
    vec3 along = vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * 2.0 - 1.0;
    vec3 place = center + along.x * extent0 + along.y * extent1 + along.z * extent2;
    gl_Position = clip_from_world * vec4(place, 1.0);
    if (half_height > 0.0 && (cut || id == uvec2(0u, 2u))) {
        gl_ClipDistance[0] = place.z - slab.x;
        gl_ClipDistance[1] = slab.y - place.z;
    }
    float t = perspective ? (gl_Position.w - depth_range.x) / (depth_range.y - depth_range.x)
                          : 0.5 + 0.5 * gl_Position.z;
    nearness = 1.0 - clamp(t, 0.0, 1.0);

    // Faces that differ in direction differ a little in strength, so that a box has sides.
    int face = gl_VertexID / 12;
    vec3 normal = face == 0 ? cross(extent1, extent2) : face == 1 ? cross(extent0, extent2) : cross(extent0, extent1);
    float facing = abs(dot(normal, light)) / max(length(normal), 1e-12);
    face_color = vec4(fill.rgb, fill.a * (0.75 + 0.5 * facing));

    // A box shares planes with the disks that it bounds; it lies in front of them.
    gl_Position.z -= 4e-4 * gl_Position.w;
    object_id = id;
}
