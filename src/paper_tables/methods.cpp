#include <base/text.h>
#include <paper_tables/methods.h>

#include <utility>

namespace mobbscope {

namespace {

Method method_of(mobb::TreeKind kind, mobb::FitOptions options, const std::string& suffix = "") {
    options.tree = kind;
    return {std::string(mobb::name(kind)) + suffix, options};
}

Method one_level(mobb::TreeKind kind, mobb::FitOptions options) {
    options.levels = 1;
    return method_of(kind, options, "_1level");
}

std::vector<Method> all_kinds(const mobb::FitOptions& base) {
    std::vector<Method> methods;
    for (const mobb::TreeKind kind : mobb::kTreeKinds) methods.push_back(method_of(kind, base));
    return methods;
}

void append(std::vector<Method>& methods, std::vector<Method> more) {
    for (Method& method : more) methods.push_back(std::move(method));
}

std::vector<Method> baselines(const mobb::FitOptions& base) {
    return {{"brute", std::nullopt}, one_level(mobb::TreeKind::mobb, base), one_level(mobb::TreeKind::umobb, base)};
}

constexpr mobb::TreeKind kVaried[] = {mobb::TreeKind::mobb, mobb::TreeKind::umobb};

}  // namespace

std::vector<Method> table_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods = baselines(base);
    append(methods, all_kinds(base));
    methods.push_back(method_of(mobb::TreeKind::blocks, base, "_batch"));
    methods.back().batch = true;
    return methods;
}

std::vector<Method> sweep_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods = baselines(base);
    for (const int leaf : {1, 2, 3, 5, 8, 10, 15, 20, 30, 50, 70, 100, 150, 200}) {
        mobb::FitOptions options = base;
        options.leaf = leaf;
        append(methods, all_kinds(options));
    }
    return methods;
}

std::vector<Method> variant_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods{one_level(mobb::TreeKind::mobb, base)};
    for (const mobb::TreeKind kind : kVaried) methods.push_back(method_of(kind, base));
    for (const mobb::TreeKind kind : kVaried) {
        for (const mobb::Axes axes : {mobb::Axes::endpoints, mobb::Axes::covariance, mobb::Axes::minarea}) {
            if (axes == base.axes) continue;
            mobb::FitOptions options = base;
            options.axes = axes;
            methods.push_back(method_of(kind, options, "_" + std::string(mobb::name(axes))));
        }
    }
    for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
        mobb::FitOptions options = base;
        options.time_scale = factor * base.time_scale;
        if (options.time_scale < 1 / mobb::kMaxTimeScale || options.time_scale > mobb::kMaxTimeScale) continue;
        methods.push_back(method_of(mobb::TreeKind::umobb, options, "_w" + brief(options.time_scale)));
    }
    for (const mobb::TreeKind kind : kVaried) {
        methods.push_back(method_of(kind, base, "_walk_boxes"));
        methods.back().boxes_in_walk = true;
    }
    return methods;
}

}  // namespace mobbscope
