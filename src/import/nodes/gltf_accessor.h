/// Numbers out of a glTF file's buffers, each access checked.
#pragma once

#include <base/budget.h>
#include <import/nodes/node_scene.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace mobbscope {

/// Reads accessors, each once. Refers to the model and the file's name. The model's indices are those of
/// checked_gltf_text: they exist.
class GltfAccessors {
  public:
    GltfAccessors(const tinygltf::Model& model, const std::string& file);

    /// All elements of an accessor as finite numbers, component after component: sparse ones filled in, normalised
    /// integers scaled to [-1, 1] or [0, 1]. At least one element. `type`: TINYGLTF_TYPE_SCALAR, _VEC3 or _VEC4. Throws
    /// InputError naming the accessor.
    Numbers read(int index, int type);

    /// True if its numbers are floats or normalised integers, not integers taken as they are.
    bool is_real(int index) const;

    /// Throws InputError for an accessor.
    [[noreturn]] void fail(int index, const std::string& message) const;

  private:
    struct Elements;
    Elements elements(int index, const std::string& what, int view, std::size_t offset, std::size_t component_size,
                      std::size_t element_size, std::size_t count, bool may_have_stride) const;
    void fill_dense(int index, std::size_t components, std::vector<double>& numbers) const;
    void fill_sparse(int index, std::size_t components, std::vector<double>& numbers) const;

    const tinygltf::Model& model_;
    const std::string& file_;
    std::size_t numbers_left_;  ///< accessors may overlap, but little data must not become much
    std::map<int, Numbers> read_;
    Spent spent_;
};

}  // namespace mobbscope
