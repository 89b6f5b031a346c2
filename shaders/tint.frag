#version 330 core
// Gives the disks that are seen their colours. Which are seen stays where the colours are others.
uniform sampler2D surfaces;           // what disk.frag writes
uniform sampler2DMS surface_samples;  // the same of a multisampled picture
uniform int sample_index;             // of those; -1: not multisampled
uniform sampler2D colors;             // of the disks by number, row by row
uniform vec3 background;

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 surface;
    if (sample_index < 0) {
        surface = texelFetch(surfaces, pixel, 0).rg;
    } else {
        surface = texelFetch(surface_samples, pixel, sample_index).rg;
    }
    if (surface.r < 0.5) discard;
    int number = int(surface.r) - 1;
    int columns = textureSize(colors, 0).x;
    vec4 of_disk = texelFetch(colors, ivec2(number % columns, number / columns), 0);
    color = vec4(mix(background, of_disk.rgb * surface.g, of_disk.a), 1.0);
}
