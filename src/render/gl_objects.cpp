#include <render/gl_objects.h>

#include <import/error.h>

#include <algorithm>

namespace render_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope {

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

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

GLuint ProgramKind::create() { return glCreateProgram(); }
void ProgramKind::destroy(GLuint name) { glDeleteProgram(name); }

namespace {

/// What the compiler says of a shader, or the linker of a program, is an error if it failed and else a warning.
void judge(GlContext& context, const std::string& what, bool done, std::string log) {
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    if (!done) throw MachineError(std::string(context.name()) + ", compiling shaders: " + what + ": " + log);
    if (!log.empty()) context.warn(what + ": " + log);
}

void compile(GlContext& context, GLuint shader, const std::string& file, std::string_view text) {
    const GLchar* source = text.data();
    const GLint size = static_cast<GLint>(text.size());
    glShaderSource(shader, 1, &source, &size);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    GLint length = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    judge(context, file, done == GL_TRUE, log);
}

}  // namespace

ShaderProgram::ShaderProgram(GlContext& context, const std::string& name) : ShaderProgram(context, name, name) {}

ShaderProgram::ShaderProgram(GlContext& context, const std::string& vertex, const std::string& fragment)
    : ShaderProgram(context, fragment, render_assets::embedded(vertex + ".vert"),
                    render_assets::embedded(fragment + ".frag")) {}

ShaderProgram::ShaderProgram(GlContext& context, const std::string& name, std::string_view vertex,
                             std::string_view fragment) {
    const GlObject<ShaderKind<GL_VERTEX_SHADER>> vertex_shader;
    const GlObject<ShaderKind<GL_FRAGMENT_SHADER>> fragment_shader;
    compile(context, vertex_shader.name(), name + ".vert", vertex);
    compile(context, fragment_shader.name(), name + ".frag", fragment);
    glAttachShader(program_.name(), vertex_shader.name());
    glAttachShader(program_.name(), fragment_shader.name());
    glLinkProgram(program_.name());
    GLint done = GL_FALSE;
    GLint length = 0;
    glGetProgramiv(program_.name(), GL_LINK_STATUS, &done);
    glGetProgramiv(program_.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program_.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    judge(context, name, done == GL_TRUE, log);
}

void ShaderProgram::use() const { glUseProgram(program_.name()); }

GLint ShaderProgram::uniform(const char* uniform_name) const {
    return glGetUniformLocation(program_.name(), uniform_name);
}

}  // namespace mobbscope
