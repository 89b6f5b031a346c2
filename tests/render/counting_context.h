/// A context that stands before another one and counts what pictures ask of it.
#pragma once

#include <render/gl/gl_context.h>

#include <glad/gl.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope {
inline namespace testing {

inline constexpr const char* kGraphicsCard = "NVIDIA GeForce RTX 4070/PCIe/SSE2";
inline constexpr const char* kProcessor = "llvmpipe (LLVM 15.0.6, 256 bits)";

struct GlCounts {
    std::size_t finishes = 0;     ///< glFinish
    std::size_t disk_calls = 0;   ///< draw calls of disks
    std::size_t whole = 0;        ///< scenes of several samples that became pictures
    bool errors_at_once = false;  ///< was asked for
};

/// Draws in the other context, whatever device it claims to be. One at a time: OpenGL's functions do not say in which
/// context they are called.
class CountingContext final : public GlContext {
  public:
    CountingContext(std::unique_ptr<GlContext> draws, std::string device) : draws_(std::move(draws)) {
        counts = {};
        lacks_memory = false;
        claimed = std::move(device);
    }

    static inline GlCounts counts;
    static inline bool lacks_memory = false;  ///< for several samples of a pixel

    std::string_view name() const override { return draws_->name(); }
    bool bind() noexcept override { return draws_->bind(); }
    Function function(const char* name) const noexcept override {
        const std::string_view asked = name;
        const Function own = draws_->function(name);
        const auto before = [&](auto& real, auto counting) {
            real = reinterpret_cast<std::decay_t<decltype(real)>>(own);
            return reinterpret_cast<Function>(counting);
        };
        if (asked == "glFinish") return before(finish, &count_finish);
        if (asked == "glGetString") return before(get_string, &claim);
        if (asked == "glGetError") return before(get_error, &next_error);
        if (asked == "glEnable") return before(enable, &note_enabled);
        if (asked == "glDrawElementsInstanced") return before(draw_disks, &count_disks);
        if (asked == "glBlitFramebuffer") return before(blit, &count_whole);
        if (asked == "glTexImage2DMultisample") return before(allocate, &allocate_samples);
        return own;
    }

  private:
    static void count_finish() {
        ++counts.finishes;
        finish();
    }
    static const GLubyte* claim(GLenum name) {
        return name == GL_RENDERER ? reinterpret_cast<const GLubyte*>(claimed.c_str()) : get_string(name);
    }
    static GLenum next_error() {
        return std::exchange(is_out_of_memory, false) ? GLenum{GL_OUT_OF_MEMORY} : get_error();
    }
    static void note_enabled(GLenum what) {
        counts.errors_at_once |= what == GL_DEBUG_OUTPUT_SYNCHRONOUS;
        enable(what);
    }
    static void count_disks(GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances) {
        ++counts.disk_calls;
        draw_disks(mode, count, type, indices, instances);
    }
    static void count_whole(GLint x0, GLint y0, GLint x1, GLint y1, GLint to_x0, GLint to_y0, GLint to_x1, GLint to_y1,
                            GLbitfield what, GLenum filter) {
        counts.whole += what == GL_COLOR_BUFFER_BIT && filter == GL_NEAREST;
        blit(x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, what, filter);
    }
    static void allocate_samples(GLenum target, GLsizei samples, GLenum format, GLsizei width, GLsizei height,
                                 GLboolean fixed) {
        is_out_of_memory = lacks_memory;
        if (!lacks_memory) allocate(target, samples, format, width, height, fixed);
    }

    static inline std::string claimed;
    static inline bool is_out_of_memory = false;
    static inline PFNGLFINISHPROC finish;
    static inline PFNGLGETSTRINGPROC get_string;
    static inline PFNGLGETERRORPROC get_error;
    static inline PFNGLENABLEPROC enable;
    static inline PFNGLDRAWELEMENTSINSTANCEDPROC draw_disks;
    static inline PFNGLBLITFRAMEBUFFERPROC blit;
    static inline PFNGLTEXIMAGE2DMULTISAMPLEPROC allocate;

    std::unique_ptr<GlContext> draws_;
};

}  // namespace testing
}  // namespace mobbscope
