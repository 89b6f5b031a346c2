/// The objects of an FBX document and what connects them.
#pragma once

#include <import/fbx/document.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace mobbscope {

struct FbxObject {
    std::int64_t id = 0;
    FbxDocument::Index record = 0;
    std::string_view kind;  ///< "Model", "AnimationCurve", ...
    std::string_view type;  ///< of a Model "LimbNode", "Null", "Mesh", ...
    std::string name;       ///< without its class; cleaned, may be empty
};

/// From a part to what it belongs to.
struct FbxConnection {
    std::int64_t from = 0;
    std::int64_t to = 0;        ///< 0: the scene's root
    std::string_view property;  ///< of `to`; empty: to the object itself
};

/// Refers to the document, which must outlive it.
class FbxObjects {
  public:
    /// Throws InputError.
    explicit FbxObjects(const FbxDocument& document);

    /// In the order of the file; of several with one id the first.
    std::span<const FbxObject> all() const { return objects_; }
    /// Null if there is none with that id.
    const FbxObject* find(std::int64_t id) const;
    /// FBX 6: the id that was made for an object's name, as it stands in the file; 0 if there is none.
    std::int64_t id_of(std::string_view name) const;
    /// In the order of the file.
    std::span<const FbxConnection> connections() const { return connections_; }
    std::span<const FbxConnection> to(std::int64_t id) const;

    /// Calls `visit(name, values)` with each property of the object's template, then with each of its own.
    template <class Visit>
    void each_property(const FbxObject& object, const Visit& visit) const {
        constexpr std::size_t kMostInTemplate = 1000;  // the longest ones have some hundred, and each object reads them
        const auto from = templates_.find(object.kind);
        if (from != templates_.end()) each_listed(from->second, visit, kMostInTemplate);
        each_property_in(object.record, visit);
    }

    /// Calls `visit` with each property in the Properties70, or Properties60, of a record.
    template <class Visit>
    void each_property_in(FbxDocument::Index record, const Visit& visit) const {
        each_listed(document_.find(record, document_.is_old() ? "Properties60" : "Properties70"), visit, SIZE_MAX);
    }

  private:
    /// With each property of those, at most `most`.
    template <class Visit>
    void each_listed(FbxDocument::Index properties, const Visit& visit, std::size_t most) const {
        document_.each_inside(properties, [&](FbxDocument::Index at) {
            // P: name, type, label, flags, values; FBX 6 has no label.
            const std::size_t head = document_.is_old() ? 3 : 4;
            if (most == 0) return;
            --most;
            const std::span<const FbxValue> values = document_.values(at);
            if (values.size() > head && values[0].kind == FbxValue::Kind::text)
                visit(values[0].text, values.subspan(head));
        });
    }

    const FbxDocument& document_;
    std::vector<FbxObject> objects_;
    std::vector<std::size_t> by_id_;  ///< indices of objects, by rising id
    std::vector<FbxConnection> connections_;
    std::vector<FbxConnection> by_target_;
    std::unordered_map<std::string_view, FbxDocument::Index> templates_;  ///< by kind, their Properties70
    std::unordered_map<std::string_view, std::int64_t> ids_;              ///< FBX 6: by name
};

/// The first three numbers of a property; those that it lacks stay as in `otherwise`.
glm::dvec3 fbx_vector(std::span<const FbxValue> values, glm::dvec3 otherwise);

}  // namespace mobbscope
