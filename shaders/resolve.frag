#version 330 core
// The mean of a pixel's samples.
uniform sampler2DMS scene;
uniform int samples;

out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < samples; ++i) sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum * (1.0 / float(samples));
}
