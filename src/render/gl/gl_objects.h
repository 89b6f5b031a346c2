/// OpenGL objects that free themselves. All need a current context, also when they are destroyed.
#pragma once

#include <render/gl/gl_context.h>
#include <render/image/image.h>

#include <glad/gl.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
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

/// A linked pair of shaders, compiled when they are first used: few pictures need all programs. What the compiler
/// remarks goes to the context's warnings.
class ShaderProgram {
  public:
    /// From shaders/<name>.vert and .frag, which are part of the program. The context outlives the program.
    ShaderProgram(GlContext& context, const std::string& name) : ShaderProgram(context, name, name) {}
    /// The same from two shaders of different names.
    ShaderProgram(GlContext& context, const std::string& vertex, const std::string& fragment);
    /// The same from texts, which outlive the program; `name` is what messages call them.
    ShaderProgram(GlContext& context, std::string name, std::string_view vertex, std::string_view fragment);

    /// Throws MachineError with what the compiler says if it does not take the shaders.
    void use();

    // Of the program in use; where the compiler dropped the uniform they do nothing.
    void set(const char* uniform, GLint value) const { glUniform1i(location(uniform), value); }
    void set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
    void set(const char* uniform, glm::vec2 value) const { glUniform2f(location(uniform), value.x, value.y); }
    void set(const char* uniform, glm::vec3 value) const { glUniform3f(location(uniform), value.x, value.y, value.z); }
    void set(const char* uniform, const glm::mat4& value) const {
        glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
    }
    void set(const char* uniform, PictureSize value) const { set(uniform, glm::vec2(value.width, value.height)); }

  private:
    GLint location(const char* uniform) const { return glGetUniformLocation(program_->name(), uniform); }

    GlContext* context_;
    std::string name_;
    std::string_view vertex_, fragment_;
    std::optional<GlObject<ProgramKind>> program_;  ///< none before the first use
};

/// As in a new context, except that rows of pixels are packed without gaps: whatever else draws in the context, a
/// picture begins with the same state. Passes set depth test, blending and culling as they need them; the rest stays as
/// it is here.
void reset_state();

/// Colours over what is there, by their opacity. What is there is opaque and stays so.
void blend_over();

/// Which elements of a buffer are drawn; OpenGL 3.3 has no first instance: attributes begin there instead.
struct InstanceRange {
    std::size_t first = 0;
    std::size_t step = 1;
};

/// Attributes of the elements of a buffer, described in order of location while the vertex array is bound. Binds the
/// buffer.
template <class Element>
class VertexLayout {
  public:
    /// `divisor`: 1 for instances, 0 for vertices.
    explicit VertexLayout(const Buffer& buffer, GLuint divisor = 1, InstanceRange range = {})
        : begin_(range.first * sizeof(Element)),
          stride_(static_cast<GLsizei>(range.step * sizeof(Element))),
          divisor_(divisor) {
        glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    }

    void floats(GLuint location, GLint count, std::size_t offset) const {
        glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, stride_, at(offset));
        enable(location);
    }
    void integers(GLuint location, GLint count, std::size_t offset) const {
        glVertexAttribIPointer(location, count, GL_UNSIGNED_INT, stride_, at(offset));
        enable(location);
    }

  private:
    const void* at(std::size_t offset) const { return reinterpret_cast<const void*>(begin_ + offset); }
    void enable(GLuint location) const {
        glEnableVertexAttribArray(location);
        glVertexAttribDivisor(location, divisor_);
    }

    std::size_t begin_;
    GLsizei stride_;
    GLuint divisor_;
};

/// Binds a texture to the active unit and gives it pixels, one level of them and unblended; null: none yet.
void fill_texture(const Texture& texture, GLenum internal_format, PictureSize size, GLenum format, GLenum type,
                  const void* pixels);

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
