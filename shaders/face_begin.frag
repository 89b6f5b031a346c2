#version 330 core
// What face.frag adds to: nothing yet, and the depth of a multisampled scene.
uniform sampler2DMS depth_samples;

layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 weights;

void main() {
    sum = vec4(0.0, 0.0, 0.0, 1.0);
    weights = vec4(0.0);
    gl_FragDepth = texelFetch(depth_samples, ivec2(gl_FragCoord.xy), 0).r;
}
