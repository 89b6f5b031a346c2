/// Tells a vertex array where the numbers of an instance lie.
#pragma once

#include <render/gl/gl_objects.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mobbscope {

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

/// Replaces the contents of a buffer.
template <class T>
void upload(const Buffer& buffer, const std::vector<T>& items, GLenum target = GL_ARRAY_BUFFER) {
    glBindBuffer(target, buffer.name());
    glBufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(T)), items.data(), GL_STREAM_DRAW);
}

/// The items in their drawing order, which is the same however the list is shuffled.
template <class T>
std::vector<const T*> in_order(const std::vector<T>& items) {
    std::vector<const T*> sorted;
    sorted.reserve(items.size());
    for (const T& item : items) sorted.push_back(&item);
    const auto before = [](const T* a, const T* b) { return a->order < b->order; };
    // Lists come in order, but for what is added last.
    if (!std::is_sorted(sorted.begin(), sorted.end(), before)) std::stable_sort(sorted.begin(), sorted.end(), before);
    return sorted;
}

}  // namespace mobbscope
