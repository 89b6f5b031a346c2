#include <tables/methods.h>

namespace mobbscope {

std::vector<Method> hierarchical_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods;
    for (const std::string_view name : mobb::tree_kind_names()) {
        mobb::FitOptions options = base;
        options.tree = *mobb::tree_kind_from_name(name);
        options.levels = 0;
        methods.push_back({std::string(name), options});
    }
    return methods;
}

std::vector<Method> table_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods{{"brute", std::nullopt}};
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb}) {
        mobb::FitOptions options = base;
        options.tree = kind;
        options.levels = 1;
        methods.push_back({std::string(mobb::name(kind)) + "_1level", options});
    }
    for (Method& method : hierarchical_methods(base)) methods.push_back(std::move(method));
    return methods;
}

}  // namespace mobbscope
