/// OpenGL objects that free themselves. All need a current context, also when they are destroyed.
#pragma once

#include <render/gl/gl_context.h>

#include <glad/gl.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// What drawing one picture took. A camera that moves needs none of the world's bytes anew.
struct DrawStatistics {
    std::size_t world_bytes = 0;    ///< uploaded: shapes of disks and boxes
    std::size_t state_bytes = 0;    ///< ... their colours and lines
    std::size_t overlay_bytes = 0;  ///< ... lines, words and all else
    std::size_t triangles = 0;      ///< that were asked for
    std::size_t draw_calls = 0;
};

/// What the current context says of itself, as GL_VERSION; empty if nothing.
std::string gl_string(GLenum name);

/// Owns one OpenGL name; 0 is none.
template <class Kind>
class GlObject {
  public:
    GlObject() : name_(Kind::create()) {}
    ~GlObject() {
        if (name_ != 0) Kind::destroy(name_);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }

    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

/// What OpenGL makes and destroys by the number. The functions are glad's pointers, which are set at run time.
template <PFNGLGENBUFFERSPROC& make, PFNGLDELETEBUFFERSPROC& remove>
struct CountedKind {
    static GLuint create() {
        GLuint name = 0;
        make(1, &name);
        return name;
    }
    static void destroy(GLuint name) { remove(1, &name); }
};
template <GLenum stage>
struct ShaderKind {
    static GLuint create() { return glCreateShader(stage); }
    static void destroy(GLuint name) { glDeleteShader(name); }
};
struct ProgramKind {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

using Buffer = GlObject<CountedKind<glGenBuffers, glDeleteBuffers>>;
using VertexArray = GlObject<CountedKind<glGenVertexArrays, glDeleteVertexArrays>>;
using Texture = GlObject<CountedKind<glGenTextures, glDeleteTextures>>;
using Renderbuffer = GlObject<CountedKind<glGenRenderbuffers, glDeleteRenderbuffers>>;
using Framebuffer = GlObject<CountedKind<glGenFramebuffers, glDeleteFramebuffers>>;

/// A linked pair of shaders. What the compiler remarks goes to the context's warnings.
class ShaderProgram {
  public:
    /// From shaders/<name>.vert and .frag, which are part of the program. Throws MachineError with what the compiler
    /// says if it does not take them.
    ShaderProgram(GlContext& context, const std::string& name) : ShaderProgram(context, name, name) {}
    /// The same from two shaders of different names.
    ShaderProgram(GlContext& context, const std::string& vertex, const std::string& fragment);
    ShaderProgram(GlContext& context, const std::string& name, std::string_view vertex, std::string_view fragment);

    void use() const;
    /// The uniform's location; -1, which OpenGL ignores, where the compiler dropped it.
    GLint uniform(const char* uniform_name) const;

  private:
    GlObject<ProgramKind> program_;
};

/// As in a new context, except that rows of pixels are packed without gaps: whatever else draws in the context, a
/// picture begins with the same state. Passes set depth test, blending and culling as they need them; the rest stays as
/// it is here.
void reset_state();

/// Colours over what is there, by their opacity. What is there is opaque and stays so.
void blend_over();

/// Attributes of one buffer, described in order of location while the vertex array and the buffer are bound.
class VertexLayout {
  public:
    /// `stride`: bytes from one instance to the next. `divisor`: 1 for instances, 0 for vertices.
    VertexLayout(std::size_t stride, GLuint divisor) : stride_(static_cast<GLsizei>(stride)), divisor_(divisor) {}

    void floats(GLuint location, GLint count, std::size_t offset) const {
        glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, stride_, reinterpret_cast<const void*>(offset));
        enable(location);
    }
    void integers(GLuint location, GLint count, std::size_t offset) const {
        glVertexAttribIPointer(location, count, GL_UNSIGNED_INT, stride_, reinterpret_cast<const void*>(offset));
        enable(location);
    }

  private:
    void enable(GLuint location) const {
        glEnableVertexAttribArray(location);
        glVertexAttribDivisor(location, divisor_);
    }

    GLsizei stride_;
    GLuint divisor_;
};

/// Replaces the contents of a buffer. Returns how many bytes these are.
template <class T>
std::size_t upload(const Buffer& buffer, const std::vector<T>& items, GLenum target = GL_ARRAY_BUFFER) {
    const std::size_t bytes = items.size() * sizeof(T);
    glBindBuffer(target, buffer.name());
    glBufferData(target, static_cast<GLsizeiptr>(bytes), items.data(), GL_STREAM_DRAW);
    return bytes;
}

/// The items in their drawing order, which is the same however the list is shuffled.
template <class Items, class T = typename Items::value_type>
std::vector<const T*> in_order(const Items& items) {
    std::vector<const T*> sorted;
    sorted.reserve(items.size());
    for (const T& item : items) sorted.push_back(&item);
    const auto before = [](const T* a, const T* b) { return a->order < b->order; };
    // Lists come in order, but for what is added last.
    if (!std::is_sorted(sorted.begin(), sorted.end(), before)) std::stable_sort(sorted.begin(), sorted.end(), before);
    return sorted;
}

}  // namespace mobbscope
