#version 330 core
// Rectangles of the picture, pixels from its upper left corner.
layout(location = 0) in vec4 rect;  // x0, y0, x1, y1

uniform vec2 viewport;

void main() {
    vec2 pixel = mix(rect.xy, rect.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    gl_Position = vec4(pixel.x / viewport.x * 2.0 - 1.0, 1.0 - pixel.y / viewport.y * 2.0, 0.0, 1.0);
}
