#version 330 core
// Glyphs and panels: rectangles in pixels from the upper left corner.
layout(location = 0) in vec4 rect;   // x0, y0, x1, y1
layout(location = 1) in vec4 fill;
layout(location = 2) in vec4 border;
layout(location = 3) in vec2 corner;  // radius and border width of a panel
layout(location = 4) in vec2 texel;   // of a glyph in the atlas; x < 0: a panel

uniform vec2 viewport;

out vec2 local;  // pixels from the rectangle's upper left corner
flat out vec2 extent;
flat out vec4 fill_color;
flat out vec4 border_color;
flat out vec2 panel;
flat out vec2 atlas_origin;

void main() {
    vec2 unit = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 pixel = mix(rect.xy, rect.zw, unit);
    gl_Position = vec4(pixel.x / viewport.x * 2.0 - 1.0, 1.0 - pixel.y / viewport.y * 2.0, 0.0, 1.0);
    extent = rect.zw - rect.xy;
    local = unit * extent;
    fill_color = fill;
    border_color = border;
    panel = corner;
    atlas_origin = texel;
}
