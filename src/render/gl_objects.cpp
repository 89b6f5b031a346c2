#include <render/gl_objects.h>

#include <array>

namespace render_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope {

GLuint BufferKind::create() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
}
void BufferKind::destroy(GLuint name) { glDeleteBuffers(1, &name); }

GLuint VertexArrayKind::create() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
}
void VertexArrayKind::destroy(GLuint name) { glDeleteVertexArrays(1, &name); }

GLuint TextureKind::create() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
}
void TextureKind::destroy(GLuint name) { glDeleteTextures(1, &name); }

GLuint RenderbufferKind::create() {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    return name;
}
void RenderbufferKind::destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }

GLuint FramebufferKind::create() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
}
void FramebufferKind::destroy(GLuint name) { glDeleteFramebuffers(1, &name); }

namespace {

GLuint compile(GlContext& context, GLenum stage, const std::string& file) {
    const std::string_view text = render_assets::embedded(file);
    const GLuint shader = glCreateShader(stage);
    const GLchar* source = text.data();
    const GLint length = static_cast<GLint>(text.size());
    glShaderSource(shader, 1, &source, &length);
    glCompileShader(shader);
    std::array<GLchar, 2048> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    if (log[0] != '\0') context.complain(file + ": " + log.data());
    return shader;
}

}  // namespace

ShaderProgram::ShaderProgram(GlContext& context, const std::string& name) : name_(glCreateProgram()) {
    const GLuint vertex = compile(context, GL_VERTEX_SHADER, name + ".vert");
    const GLuint fragment = compile(context, GL_FRAGMENT_SHADER, name + ".frag");
    glAttachShader(name_, vertex);
    glAttachShader(name_, fragment);
    glLinkProgram(name_);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    std::array<GLchar, 2048> log{};
    glGetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    if (log[0] != '\0') context.complain(name + ": " + log.data());
}

ShaderProgram::~ShaderProgram() { glDeleteProgram(name_); }

void ShaderProgram::use() const { glUseProgram(name_); }

GLint ShaderProgram::uniform(const char* uniform_name) const { return glGetUniformLocation(name_, uniform_name); }

}  // namespace mobbscope
