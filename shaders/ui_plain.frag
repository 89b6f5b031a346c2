#version 330 core
// What needs no texture: the grounds of panels, which are most of the window.
in vec4 color_in;

out vec4 color;

void main() { color = color_in; }
