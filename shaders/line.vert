#version 330 core
// A line as a rectangle that is so many pixels wide, whatever the distance.
// Of a box the twelve edges are drawn, six vertices each.
layout(location = 0) in vec3 from;  // of a box: its centre
layout(location = 1) in vec3 to;    // ... and half its edges
layout(location = 2) in vec3 extent1;
layout(location = 3) in vec3 extent2;
layout(location = 4) in vec4 color;
layout(location = 5) in vec4 dash;
layout(location = 6) in vec3 shape;  // width and cap in pixels, opacity kept when hidden

layout(location = 7) in uvec2 id;   // of a box

uniform bool edges;
uniform vec2 slab;  // boxes outside are not drawn
uniform bool cut;   // ... or they are cut there
uniform mat4 clip_from_world;
uniform vec2 viewport;
uniform bool hidden;
uniform float depth_bias;  // of depths from -1 to 1
uniform float most_bias;   // of clip space

flat out vec4 line_color;
flat out vec4 pattern;
flat out float half_width;
noperspective out float across;  // pixels from the middle
noperspective out float along;   // pixels from the start

const int corners[6] = int[6](0, 1, 2, 2, 1, 3);

vec3 box_corner(int bits) {
    vec3 along = vec3(bits & 1, (bits >> 1) & 1, (bits >> 2) & 1) * 2.0 - 1.0;
    return from + along.x * to + along.y * extent1 + along.z * extent2;
}

void main() {
    vec3 begin = from;
    vec3 finish = to;
    int vertex = gl_VertexID;
    if (edges) {
        vertex = corners[gl_VertexID % 6];
        int edge = gl_VertexID / 6;
        int axis = edge / 4;
        // The corners that are low along the axis, one after the other.
        int low = ((edge % 4) & ((1 << axis) - 1)) | (((edge % 4) >> axis) << (axis + 1));
        begin = box_corner(low);
        finish = box_corner(low | (1 << axis));
        // As in face.vert.
        float half_height = abs(to.z) + abs(extent1.z) + abs(extent2.z);
        float lowest = from.z - half_height;
        float highest = from.z + half_height;
        bool outside = half_height > 0.0 && (highest <= slab.x || (lowest >= slab.y && lowest > slab.x));
        if (half_height > 0.0 && (cut || id == uvec2(0u, 2u))) {
            vec3 a = begin;
            vec3 b = finish;
            float rise = b.z - a.z;
            outside = outside || max(a.z, b.z) < slab.x || min(a.z, b.z) > slab.y;
            if (rise != 0.0) {
                begin = mix(a, b, clamp(((rise > 0.0 ? slab.x : slab.y) - a.z) / rise, 0.0, 1.0));
                finish = mix(a, b, clamp(((rise > 0.0 ? slab.y : slab.x) - a.z) / rise, 0.0, 1.0));
            }
        }
        if (outside) {
            gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
            return;
        }
    }
    line_color = vec4(color.rgb, color.a * (hidden ? shape.z : 1.0));
    pattern = dash;
    half_width = 0.5 * shape.x;
    across = 0.0;
    along = 0.0;
    vec4 a = clip_from_world * vec4(begin, 1.0);
    vec4 b = clip_from_world * vec4(finish, 1.0);
    // What is behind the eye would be mirrored by the division; it is cut off at the near plane.
    float da = a.z + a.w;
    float db = b.z + b.w;
    if (line_color.a <= 0.0 || (da <= 0.0 && db <= 0.0)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    if (da < 0.0) a = mix(a, b, da / (da - db));
    if (db < 0.0) b = mix(b, a, db / (db - da));

    vec2 pa = a.xy / a.w * 0.5 * viewport;
    vec2 pb = b.xy / b.w * 0.5 * viewport;
    vec2 run = pb - pa;
    float span = length(run);
    vec2 direction = span > 1e-4 ? run / span : vec2(1.0, 0.0);
    bool end = vertex >= 2;
    float side = (vertex & 1) == 0 ? -1.0 : 1.0;
    across = side * (half_width + 0.5);
    along = end ? span + shape.y : -shape.y;
    vec2 pixel = (end ? pb : pa) + direction * (end ? shape.y : -shape.y) + vec2(-direction.y, direction.x) * across;
    vec4 clip = end ? b : a;
    gl_Position = vec4(pixel / (0.5 * viewport) * clip.w, clip.z - min(depth_bias * clip.w, most_bias), clip.w);
}
