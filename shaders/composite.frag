#version 330 core
uniform sampler2D sums;
uniform sampler2D weights;

out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float weight = texelFetch(weights, pixel, 0).r;
    if (weight <= 0.0) discard;
    vec4 sum = texelFetch(sums, pixel, 0);
    color = vec4(sum.rgb / weight, 1.0 - sum.a);
}
