#version 330 core
// Gives the disks that are seen their colours. Which are seen stays where the colours are others.
uniform sampler2D visibility;           // what disk.frag writes
uniform sampler2DMS visibility_samples;  // the same of a multisampled picture
uniform int sample_index;             // of those; -1: not multisampled
uniform sampler2D colors;             // of the disks by number, row by row
uniform vec3 background;

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 seen;
    if (sample_index < 0) {
        seen = texelFetch(visibility, pixel, 0).rg;
    } else {
        seen = texelFetch(visibility_samples, pixel, sample_index).rg;
    }
    if (seen.r < 0.5) discard;
    int number = int(seen.r) - 1;
    int columns = textureSize(colors, 0).x;
    vec4 of_disk = texelFetch(colors, ivec2(number % columns, number / columns), 0);
    color = vec4(mix(background, of_disk.rgb * seen.g, of_disk.a), 1.0);
}
