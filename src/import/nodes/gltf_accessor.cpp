#include <base/error.h>
#include <base/text.h>
#include <import/nodes/gltf_accessor.h>
#include <import/nodes/node_scene.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace mobbscope {

namespace {

// Zeros need no bytes, so nothing in the file bounds how many there are.
constexpr std::size_t kMostZeros = 1'000'000;
// How often a file's bytes may be read, beyond the numbers that any file may have.
constexpr std::size_t kMostReadings = 2;
constexpr std::size_t kFreeNumbers = 2'000'000;

/// In bytes.
std::size_t component_size(int type) {
    return as_index(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

template <typename T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

double component(const unsigned char* bytes, int type, bool normalized) {
    const auto scaled = [normalized](double value, double most) {
        return normalized ? std::max(value / most, -1.0) : value;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(load<std::int8_t>(bytes), 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(load<std::uint8_t>(bytes), 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(load<std::int16_t>(bytes), 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(load<std::uint16_t>(bytes), 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load<std::uint32_t>(bytes);
        default:
            return load<float>(bytes);
    }
}

std::size_t bytes_of(const tinygltf::Model& model) {
    std::size_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    return bytes;
}

}  // namespace

/// Equal elements at a constant distance, all within their buffer.
struct GltfAccessors::Elements {
    const unsigned char* first;
    std::size_t stride;
    const unsigned char* operator[](std::size_t i) const { return first + i * stride; }
};

GltfAccessors::GltfAccessors(const tinygltf::Model& model, const std::string& file)
    : model_(model), file_(file), numbers_left_(kMostReadings * bytes_of(model) + kFreeNumbers) {}

void GltfAccessors::fail(int index, const std::string& message) const {
    const std::string& name = model_.accessors[as_index(index)].name;
    throw InputError(file_, "accessor " + std::to_string(index) + (name.empty() ? "" : " " + in_quotes(name)), message);
}

bool GltfAccessors::is_real(int index) const {
    const tinygltf::Accessor& accessor = model_.accessors[as_index(index)];
    return accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.normalized;
}

Numbers GltfAccessors::read(int index, int type) {
    const tinygltf::Accessor& accessor = model_.accessors[as_index(index)];
    const std::size_t components = as_index(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    if (accessor.type != type) {
        const std::string wanted = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
        fail(index, "must be of type " + wanted + " where an animation uses it; export the file again");
    }
    if (const auto known = read_.find(index); known != read_.end()) return known->second;

    if (accessor.count == 0) fail(index, "has no element; take its animation out or give it keys");
    if (accessor.bufferView < 0 && accessor.count > kMostZeros) {
        fail(index, "has no bufferView for " + std::to_string(accessor.count) + " elements; export the file again");
    }
    // Before memory is spent: with a bufferView the count was not yet held against its bytes.
    if (accessor.count > numbers_left_ / components) {
        fail(index, "has " + std::to_string(accessor.count) +
                        " elements, more than the file's bytes can mean; export the file again");
    }
    spent_.add(sizeof(double) * accessor.count * components, "its accessors", file_);
    std::vector<double> numbers;
    if (accessor.bufferView >= 0) {
        fill_dense(index, components, numbers);
    } else {
        numbers.resize(accessor.count * components);
    }
    if (accessor.sparse.isSparse) fill_sparse(index, components, numbers);
    const auto bad = std::find_if(numbers.begin(), numbers.end(), [](double v) { return !std::isfinite(v); });
    if (bad != numbers.end()) {
        const auto element = static_cast<std::size_t>(bad - numbers.begin()) / components;
        fail(index, "element " + std::to_string(element) + " is not finite; correct it");
    }
    numbers_left_ -= numbers.size();
    return read_[index] = std::make_shared<const std::vector<double>>(std::move(numbers));
}

GltfAccessors::Elements GltfAccessors::elements(int index, const std::string& what, int view, std::size_t offset,
                                                std::size_t component_size, std::size_t element_size, std::size_t count,
                                                bool may_have_stride) const {
    const tinygltf::BufferView& buffer_view = model_.bufferViews[as_index(view)];
    const std::vector<unsigned char>& bytes = model_.buffers[as_index(buffer_view.buffer)].data;
    const std::string where = what + "bufferView " + std::to_string(view);
    if (bytes.empty()) {
        fail(index, where + ": buffer " + std::to_string(buffer_view.buffer) + " has no data; export the file with it");
    }
    if (buffer_view.byteLength == 0) fail(index, where + " is empty; export the file again");
    if (buffer_view.byteOffset > bytes.size() || buffer_view.byteLength > bytes.size() - buffer_view.byteOffset) {
        fail(index, where + " reaches beyond the " + std::to_string(bytes.size()) + " bytes of buffer " +
                        std::to_string(buffer_view.buffer) + "; export or copy the file again");
    }
    if ((buffer_view.byteOffset + offset) % component_size != 0) {
        fail(index, where + ": its data is not aligned to " + std::to_string(component_size) +
                        " bytes; export the file again");
    }
    const std::size_t stride = may_have_stride && buffer_view.byteStride != 0 ? buffer_view.byteStride : element_size;
    if (stride < element_size) {
        fail(index, where + ": byteStride " + std::to_string(stride) + " is less than an element's " +
                        std::to_string(element_size) + " bytes; export the file again");
    }
    const std::size_t room = offset > buffer_view.byteLength ? 0 : buffer_view.byteLength - offset;
    if (room < element_size || (room - element_size) / stride < count - 1) {
        fail(index, std::to_string(count) + " elements do not fit into the " + std::to_string(room) + " bytes of " +
                        where + "; export or copy the file again");
    }
    return {bytes.data() + buffer_view.byteOffset + offset, stride};
}

void GltfAccessors::fill_dense(int index, std::size_t components, std::vector<double>& numbers) const {
    const tinygltf::Accessor& accessor = model_.accessors[as_index(index)];
    const std::size_t size = component_size(accessor.componentType);
    const Elements from =
        elements(index, "", accessor.bufferView, accessor.byteOffset, size, size * components, accessor.count, true);
    numbers.reserve(accessor.count * components);
    for (std::size_t i = 0; i < accessor.count; ++i) {
        for (std::size_t c = 0; c < components; ++c) {
            numbers.push_back(component(from[i] + c * size, accessor.componentType, accessor.normalized));
        }
    }
}

void GltfAccessors::fill_sparse(int index, std::size_t components, std::vector<double>& numbers) const {
    const tinygltf::Accessor& accessor = model_.accessors[as_index(index)];
    const auto& sparse = accessor.sparse;
    const std::size_t count = as_index(sparse.count);
    if (count == 0 || count > accessor.count) {
        fail(index, "sparse: a count of " + std::to_string(count) + " is not within 1 and " +
                        std::to_string(accessor.count) + "; export the file again");
    }
    const int index_type = sparse.indices.componentType;
    if (index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        fail(index, "sparse: indices must be unsigned integers of 1, 2 or 4 bytes");
    }
    const std::size_t index_size = component_size(index_type);
    const std::size_t value_size = component_size(accessor.componentType);
    const Elements indices = elements(index, "sparse indices, ", static_cast<int>(sparse.indices.bufferView),
                                      as_index(sparse.indices.byteOffset), index_size, index_size, count, false);
    const Elements values =
        elements(index, "sparse values, ", static_cast<int>(sparse.values.bufferView),
                 as_index(sparse.values.byteOffset), value_size, value_size * components, count, false);
    double last = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const double target = component(indices[i], index_type, false);
        if (target <= last || target >= static_cast<double>(accessor.count)) {
            fail(index, "sparse: index " + std::to_string(i) + " does not increase or is beyond the accessor's " +
                            std::to_string(accessor.count) + " elements; export the file again");
        }
        last = target;
        for (std::size_t c = 0; c < components; ++c) {
            numbers[static_cast<std::size_t>(target) * components + c] =
                component(values[i] + c * value_size, accessor.componentType, accessor.normalized);
        }
    }
}

}  // namespace mobbscope
