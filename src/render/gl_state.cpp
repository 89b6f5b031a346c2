#include <render/gl_state.h>

#include <glad/gl.h>

namespace mobbscope {

namespace {

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
    for (GLuint unit = 0; unit < 2; ++unit) glBindSampler(unit, 0);

    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum zero : kZero) glPixelStorei(zero, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void blend_over() {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

}  // namespace mobbscope
