#include <base/text.h>
#include <import/fbx/objects.h>

#include <algorithm>

namespace mobbscope {

namespace {

/// "Model::Hips" in text and "Hips", NUL, 1, "Model" in binary: "Hips".
std::string object_name(const FbxValue& value) {
    using namespace std::string_view_literals;
    std::string name = fbx_text(value);
    if (const std::size_t end = name.find("\0\1"sv); end != name.npos) {
        name.resize(end);
    } else if (const std::size_t separator = name.find("::"); separator != name.npos) {
        name.erase(0, separator + 2);
    }
    return is_utf8(name) ? name : cleaned(name);
}

/// Whether a value is there and of that kind.
bool has(std::span<const FbxValue> values, std::size_t at, FbxValue::Kind kind) {
    return at < values.size() && values[at].kind == kind;
}

}  // namespace

FbxObjects::FbxObjects(const FbxDocument& document) : document_(document) {
    using Kind = FbxValue::Kind;
    document.each_inside(FbxDocument::kFile, [&](FbxDocument::Index top) {
        const std::string_view name = document.record(top).name;
        if (name == "Definitions") {
            document.each_inside(top, [&](FbxDocument::Index type) {
                const std::span<const FbxValue> values = document.values(type);
                const FbxDocument::Index of = document.find(type, "PropertyTemplate");
                const FbxDocument::Index properties = document.find(of, "Properties70");
                if (has(values, 0, Kind::text) && properties != FbxDocument::kNone)
                    templates_.try_emplace(values[0].text, properties);
            });
        } else if (name == "Objects") {
            document.each_inside(top, [&](FbxDocument::Index record) {
                std::span<const FbxValue> values = document.values(record);
                FbxObject object{0, record, document.record(record).name, {}, {}};
                if (document.is_old()) {
                    if (!has(values, 0, Kind::text)) return;
                    object.id =
                        ids_.try_emplace(values[0].text, static_cast<std::int64_t>(ids_.size()) + 1).first->second;
                } else {
                    if (!has(values, 0, Kind::integer)) return;
                    object.id = values[0].integer;
                    values = values.subspan(1);
                }
                if (has(values, 0, Kind::text)) object.name = object_name(values[0]);
                if (has(values, 1, Kind::text)) object.type = values[1].text;
                objects_.push_back(std::move(object));
            });
        } else if (name == "Connections") {
            document.each_inside(top, [&](FbxDocument::Index record) {
                const std::span<const FbxValue> values = document.values(record);
                const Kind kind = document.is_old() ? Kind::text : Kind::integer;
                if (!has(values, 0, Kind::text) || !has(values, 1, kind) || !has(values, 2, kind)) return;
                FbxConnection connection{values[1].integer, values[2].integer, {}};
                if (document.is_old()) connection = {id_of(values[1].text), id_of(values[2].text), {}};
                // "OO" joins objects, "OP" an object to a property; what comes from a property moves nothing here.
                if (values[0].text == "OP" && has(values, 3, Kind::text)) {
                    connection.property = values[3].text;
                } else if (values[0].text != "OO") {
                    return;
                }
                connections_.push_back(connection);
            });
        }
    });
    by_id_.resize(objects_.size());
    for (std::size_t i = 0; i < by_id_.size(); ++i) by_id_[i] = i;
    std::ranges::stable_sort(by_id_, {}, [&](std::size_t i) { return objects_[i].id; });
    by_target_ = connections_;
    std::ranges::stable_sort(by_target_, {}, &FbxConnection::to);
}

const FbxObject* FbxObjects::find(std::int64_t id) const {
    const auto at = std::ranges::lower_bound(by_id_, id, {}, [&](std::size_t i) { return objects_[i].id; });
    return at != by_id_.end() && objects_[*at].id == id ? &objects_[*at] : nullptr;
}

std::int64_t FbxObjects::id_of(std::string_view name) const {
    const auto at = ids_.find(name);
    return at == ids_.end() ? 0 : at->second;
}

std::span<const FbxConnection> FbxObjects::to(std::int64_t id) const {
    return {std::ranges::lower_bound(by_target_, id, {}, &FbxConnection::to),
            std::ranges::upper_bound(by_target_, id, {}, &FbxConnection::to)};
}

glm::dvec3 fbx_vector(std::span<const FbxValue> values, glm::dvec3 otherwise) {
    for (int i = 0; i < 3 && i < static_cast<int>(values.size()); ++i) {
        const FbxValue& value = values[static_cast<std::size_t>(i)];
        if (value.kind == FbxValue::Kind::integer || value.kind == FbxValue::Kind::real) otherwise[i] = value.real;
    }
    return otherwise;
}

}  // namespace mobbscope
