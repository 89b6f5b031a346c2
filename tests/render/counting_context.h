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
    std::size_t textures = 0;     ///< of several samples
    std::size_t programs = 0;     ///< compiled
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
        if (asked == "glDrawArrays") return before(draw_whole, &count_whole);
        if (asked == "glLinkProgram") return before(link, &count_program);
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
    static void count_program(GLuint program) {
        ++counts.programs;
        link(program);
    }
    /// All else is drawn in instances.
    static void count_whole(GLenum mode, GLint first, GLsizei count) {
        ++counts.whole;
        draw_whole(mode, first, count);
    }
    static void allocate_samples(GLenum target, GLsizei samples, GLenum format, GLsizei width, GLsizei height,
                                 GLboolean fixed) {
        ++counts.textures;
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
    static inline PFNGLDRAWARRAYSPROC draw_whole;
    static inline PFNGLLINKPROGRAMPROC link;
    static inline PFNGLTEXIMAGE2DMULTISAMPLEPROC allocate;

    std::unique_ptr<GlContext> draws_;
};

}  // namespace testing
}  // namespace mobbscope
