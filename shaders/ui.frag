#version 330 core
in vec2 at;
in vec4 color_in;

uniform sampler2D picture;

out vec4 color;

void main() { color = color_in * texture(picture, at); }
