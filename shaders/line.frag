#version 330 core
flat in vec4 line_color;
flat in vec4 pattern;
flat in float half_width;
noperspective in float across;
noperspective in float along;

out vec4 color;

// Coverage of the dash that begins at `begin` by a pixel at `at`.
float dash_at(float at, float begin, float length) {
    return clamp(at - begin + 0.5, 0.0, 1.0) * clamp(begin + length - at + 0.5, 0.0, 1.0);
}

void main() {
    float coverage = clamp(half_width + 0.5 - abs(across), 0.0, 1.0) * min(1.0, 2.0 * half_width);
    float period = pattern.x + pattern.y + pattern.z + pattern.w;
    if (period > 0.0) {
        float at = mod(along, period);
        coverage *= max(max(dash_at(at, 0.0, pattern.x), dash_at(at, pattern.x + pattern.y, pattern.z)),
                        dash_at(at, period, pattern.x));
    }
    color = vec4(line_color.rgb, line_color.a * coverage);
}
