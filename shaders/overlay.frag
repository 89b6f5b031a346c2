#version 330 core
in vec2 local;
flat in vec2 extent;
flat in vec4 fill_color;
flat in vec4 border_color;
flat in vec2 panel;
flat in vec2 atlas_origin;

uniform sampler2D atlas;

out vec4 color;

void main() {
    if (atlas_origin.x >= 0.0) {
        color = vec4(fill_color.rgb, fill_color.a * texelFetch(atlas, ivec2(atlas_origin + local), 0).r);
        return;
    }
    // Distance to the outline of a rectangle with round corners, negative inside.
    vec2 q = abs(local - 0.5 * extent) - 0.5 * extent + panel.x;
    float outside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - panel.x;
    float covered = clamp(0.5 - outside, 0.0, 1.0);
    float inner = clamp(0.5 - outside - panel.y, 0.0, 1.0);
    vec4 paint = panel.y > 0.0 ? mix(border_color, fill_color, inner) : fill_color;
    color = vec4(paint.rgb, paint.a * covered);
}
