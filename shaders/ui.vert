#version 330 core
// Triangles of the window's panels, in pixels from the upper left corner.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel;  // 0..1
layout(location = 2) in vec4 tint;

uniform vec2 viewport;

out vec2 at;
out vec4 color_in;

void main() {
    gl_Position = vec4(position.x / viewport.x * 2.0 - 1.0, 1.0 - position.y / viewport.y * 2.0, 0.0, 1.0);
    at = texel;
    color_in = tint;
}
