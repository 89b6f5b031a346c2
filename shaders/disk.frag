#version 330 core
in vec3 surface_normal;
in float upper;
in float face_shade;
flat in uint number;
in vec2 local;
flat in uvec2 object_id;

uniform vec3 light;  // towards the light, unit
uniform sampler2D colors;  // as in tint.frag
uniform vec3 background;

layout(location = 0) out vec2 visibility;  // which disk (1 + its number), and how bright: see tint.frag
layout(location = 1) out uvec2 id;
layout(location = 2) out vec4 color;  // what tint.frag makes of the visibility, where that is not kept

// How dark a line along the edge at `to_edge` = 0 is here: one pixel wide, and gone where disks are thinner than that.
float seam(float to_edge) {
    float pixel = fwidth(to_edge);
    float line = 1.0 - smoothstep(0.6 * pixel, 1.6 * pixel, to_edge);
    return line * (1.0 - smoothstep(0.25, 0.7, pixel));
}

void main() {
    // Of a side what lies along the floor is a unit vector, however it leans.
    bool cap = dot(surface_normal.xy, surface_normal.xy) < 0.25;
    vec3 n = normalize(surface_normal);
    float shade = mix(0.54 + 0.36 * (0.5 + 0.5 * dot(n, light)), face_shade, upper);
    float edge = cap ? seam(1.0 - local.x) : seam(local.y);
    float brightness = shade * (1.0 - 0.38 * edge);
    visibility = vec2(float(number) + 1.0, brightness);
    int columns = textureSize(colors, 0).x;
    vec4 of_disk = texelFetch(colors, ivec2(int(number) % columns, int(number) / columns), 0);
    color = vec4(mix(background, of_disk.rgb * brightness, of_disk.a), 1.0);
    id = object_id;
}
