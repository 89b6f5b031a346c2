#version 330 core
// A unit cylinder, placed and scaled for each sample or run of them, leaning and tapered where it moves on.
layout(location = 0) in vec4 corner;  // x, y on the unit circle; z 0 below, 1 above; w 0 inside of a face, 1 at its rim
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 base_and_radius;
layout(location = 3) in vec4 top_and_radius;
layout(location = 4) in uint source;  // number of the disk that has its colour
layout(location = 5) in uvec2 id;  // x is 0 of a run; for y see run_id in disk_levels.h
layout(location = 6) in vec3 above;  // of the disk that stands on it: its centre from this one's, and its radius; or 0
layout(location = 7) in vec3 below;  // likewise of the one that it stands on

uniform mat4 clip_from_world;
uniform vec3 back;  // towards the eye
uniform vec2 across;  // where x goes on the floor: cylinders are turned about their axes
uniform float scale;  // pixels of a metre at distance 1, or anywhere without perspective
uniform float inner;  // radius of the circle inside the corners, in that of the corners
uniform float near_depth;  // what is nearer to the eye is not drawn
uniform float most_lean;  // metres over the floor that a disk goes at most
uniform int agent_depths;  // agents that have depths of their own
uniform float agent_depth_step;
uniform vec2 slab;  // lowest and highest height that is drawn: disks are cut there

out vec3 surface_normal;
out float upper;       // share of the disks' faces, the rest being their sides
out float face_shade;  // of those faces
flat out uint number;
out vec2 local;  // 0 in the middle to 1 at the rim; 0 below to 1 above
flat out uvec2 object_id;

// How far from the middle towards a corner a face is hidden, so much that nobody can tell: by the disk that stands on
// this one, or that it stands on. A share of the way; with a margin of many times what depths are rounded by.
float hidden_until(vec2 at, vec3 by, float radius, vec4 middle) {
    // One that is cut away hides nothing.
    if (normal.z > 0.0 ? top_and_radius.z >= slab.y : base_and_radius.z <= slab.x) return 0.0;
    float reach = inner * by.z - 0.02 * radius;
    float height = top_and_radius.z - base_and_radius.z;
    if (length(by.xy) >= reach || height * scale / middle.w < 0.02) return 0.0;
    // The other one must be drawn, all of it.
    if (middle.w - near_depth < length(by.xy) + by.z + height + most_lean) return 0.0;
    vec2 way = at / radius;
    float along = dot(way, by.xy);
    return clamp((along + sqrt(along * along + reach * reach - dot(by.xy, by.xy))) / radius, 0.0, 1.0);
}

void main() {
    float low = base_and_radius.z;
    float high = top_and_radius.z;
    if (high <= slab.x || (low >= slab.y && low > slab.x)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    vec4 end = corner.z > 0.5 ? top_and_radius : base_and_radius;
    if (high > slab.y || low < slab.x) {
        float within = clamp(end.z, slab.x, slab.y);
        end = mix(base_and_radius, top_and_radius, (within - low) / (high - low));
        end.z = within;
    }
    mat2 turn = mat2(across, vec2(-across.y, across.x));
    vec2 at = turn * corner.xy * end.w;
    float rim = corner.w;
    if (rim == 0.0 && id.x != 0u) {
        // What is hidden in the middle of a face is not drawn.
        rim = hidden_until(at, normal.z > 0.0 ? above : below, end.w, clip_from_world * vec4(end.xyz, 1.0));
    }
    gl_Position = clip_from_world * vec4(end.xyz + vec3(at * rim, 0.0), 1.0);
    surface_normal = vec3(turn * normal.xy, normal.z);
    upper = abs(normal.z);
    face_shade = 1.0;
    number = source;
    local = vec2(rim, corner.z);
    if (abs(normal.z) < 0.5) {
        vec4 step = top_and_radius - base_and_radius;
        // How far this line of the side leans inwards, on the way up.
        float inwards = -(dot(step.xy, surface_normal.xy) + step.w);
        if (id.x == 0u && (id.y & 1u) == 0u) {
            // Of each disk as much of the face is seen as its successor leaves free, beside its side.
            float face = max(0.0, inwards * back.z);
            float side = max(0.0, step.z * dot(surface_normal.xy, back.xy));
            upper = face / max(face + side, 1e-6);
            // What is left free is narrow: all of it lies in the line along the rim (see disk.frag).
            face_shade = 1.0 - 0.38 * (1.0 - smoothstep(0.25, 0.7, gl_Position.w / (scale * end.w)));
        } else {
            surface_normal.z = inwards / max(step.z, 1e-9);
        }
        if (id.x == 0u) local.y += 10.0;  // far from an edge
    }
    uint agent = id.x == 0u ? id.y >> 1 : id.x - 1u;
    gl_Position.z += agent_depth_step * float(agent % uint(agent_depths));
    object_id = id;
}
