#include <base/error.h>
#include <render/gl/gl_objects.h>

#include <glad/gl.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace render_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope {

namespace {

/// What the compiler says of a shader, or the linker of a program, is an error if it failed and else a warning.
void judge(GlContext& context, const std::string& what, GLuint object, GLenum status, PFNGLGETSHADERIVPROC get,
           PFNGLGETSHADERINFOLOGPROC get_log) {
    GLint done = GL_FALSE;
    GLint length = 0;
    get(object, status, &done);
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    get_log(object, static_cast<GLsizei>(log.size()), nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    if (done != GL_TRUE) throw MachineError(std::string(context.name()) + ", compiling shaders: " + what + ": " + log);
    if (!log.empty()) context.warn(what + ": " + log);
}

void compile(GlContext& context, GLuint shader, const std::string& file, std::string_view text) {
    const GLchar* source = text.data();
    const GLint size = static_cast<GLint>(text.size());
    glShaderSource(shader, 1, &source, &size);
    glCompileShader(shader);
    judge(context, file, shader, GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog);
}

constexpr GLenum kOff[] = {GL_BLEND,
                           GL_CULL_FACE,
                           GL_DEPTH_TEST,
                           GL_SCISSOR_TEST,
                           GL_STENCIL_TEST,
                           GL_COLOR_LOGIC_OP,
                           GL_DEPTH_CLAMP,
                           GL_FRAMEBUFFER_SRGB,
                           GL_POLYGON_OFFSET_FILL,
                           GL_POLYGON_SMOOTH,
                           GL_PRIMITIVE_RESTART,
                           GL_RASTERIZER_DISCARD,
                           GL_SAMPLE_ALPHA_TO_COVERAGE,
                           GL_SAMPLE_ALPHA_TO_ONE,
                           GL_SAMPLE_COVERAGE,
                           GL_SAMPLE_MASK};

/// Of how pixels lie in memory.
constexpr GLenum kZero[] = {GL_PACK_SWAP_BYTES,  GL_PACK_LSB_FIRST,    GL_PACK_ROW_LENGTH,  GL_PACK_SKIP_ROWS,
                            GL_PACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH,
                            GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS};

}  // namespace

ShaderProgram::ShaderProgram(GlContext& context, const std::string& vertex, const std::string& fragment)
    : ShaderProgram(context, fragment, render_assets::embedded(vertex + ".vert"),
                    render_assets::embedded(fragment + ".frag")) {}

ShaderProgram::ShaderProgram(GlContext& context, std::string name, std::string_view vertex, std::string_view fragment)
    : context_(&context), name_(std::move(name)), vertex_(vertex), fragment_(fragment) {}

void ShaderProgram::use() {
    if (program_) return glUseProgram(program_->name());
    const GlObject<ShaderKind<GL_VERTEX_SHADER>> vertex_shader;
    const GlObject<ShaderKind<GL_FRAGMENT_SHADER>> fragment_shader;
    compile(*context_, vertex_shader.name(), name_ + ".vert", vertex_);
    compile(*context_, fragment_shader.name(), name_ + ".frag", fragment_);
    GlObject<ProgramKind> program;
    glAttachShader(program.name(), vertex_shader.name());
    glAttachShader(program.name(), fragment_shader.name());
    glLinkProgram(program.name());
    judge(*context_, name_, program.name(), GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog);
    program_ = std::move(program);
    glUseProgram(program_->name());
}

void reset_state() {
    for (const GLenum off : kOff) glDisable(off);
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    glEnable(GL_DITHER);
    glEnable(GL_MULTISAMPLE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDepthRange(0, 1);
    glBlendEquation(GL_FUNC_ADD);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    for (GLuint unit = 0; unit < 3; ++unit) glBindSampler(unit, 0);

    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum zero : kZero) glPixelStorei(zero, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void fill_texture(const Texture& texture, GLenum internal_format, PictureSize size, GLenum format, GLenum type,
                  const void* pixels) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), size.width, size.height, 0, format, type,
                 pixels);
    // The default filter wants all levels.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void blend_over() {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

}  // namespace mobbscope
