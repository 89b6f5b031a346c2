#include <base/error.h>
#include <base/json.h>
#include <base/text.h>
#include <review/held_table.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

using HeldJson = nlohmann::ordered_json;
/// Throws InputError if it is no JSON, or nested deeper than what recurses can go.
HeldJson parsed(const std::string& text) {
    parse_json(text, "a golden");
    return HeldJson::parse(text);
}

/// Paths and what stands there, in the order of the file.
using Leaves = std::vector<std::pair<std::string, const HeldJson*>>;

bool is_inner_list(const std::string& key) { return key == "nodes" || key == "trace"; }

bool names_entry(const std::string& key) {
    return key == "panel" || key == "query" || key == "a" || key == "b" || key == "clip";
}

void add_leaves(const HeldJson& value, const std::string& path, Leaves& out) {
    if (value.is_array() || value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            const std::string inner = value.is_array() ? path + '[' + key + ']' : path + ' ' + key;
            add_leaves(member, path.empty() ? key : inner, out);
        }
        return;
    }
    if (!value.is_null()) out.emplace_back(path, &value);
}

/// Of an entry without what names it and its list of nodes or events.
Leaves leaves_of_entry(const HeldJson& entry) {
    Leaves out;
    for (const auto& [key, member] : entry.items()) {
        if (!names_entry(key) && !is_inner_list(key)) add_leaves(member, key, out);
    }
    return out;
}

std::string shown_leaf(const HeldJson* leaf) {
    if (!leaf) return "";
    if (leaf->is_string()) return cleaned(leaf->get<std::string>());
    return leaf->is_number() ? format_double(leaf->get<double>()) : leaf->dump();
}

bool is_same_leaf(const HeldJson* one, const HeldJson* other, bool may_be_rounded) {
    constexpr double kRounding = 1e-9;
    if (!one || !other) return one == other;
    if (!one->is_number() || !other->is_number() || !may_be_rounded) return *one == *other;
    const double before = one->get<double>();
    return std::abs(before - other->get<double>()) <= kRounding * std::max(1.0, std::abs(before));
}

/// Rows of two objects' leaves; whether any changed. The golden may be missing.
bool add_rows(const std::string& of, const Leaves* golden, const Leaves& actual, bool may_be_rounded,
              std::vector<HeldRow>& out) {
    const auto in = [](const Leaves* leaves, const std::string& path) -> const HeldJson* {
        if (!leaves) return nullptr;
        const auto at = std::ranges::find(*leaves, path, [](const auto& leaf) { return leaf.first; });
        return at == leaves->end() ? nullptr : at->second;
    };
    std::vector<std::string> paths;
    for (const auto& [path, unused] : actual) paths.push_back(path);
    if (golden) {
        for (const auto& [path, unused] : *golden) {
            if (!in(&actual, path)) paths.push_back(path);
        }
    }
    const HeldJson *kind = in(golden, "kind"), *other_kind = in(&actual, "kind");
    // Boxes of two kinds have other members.
    if (kind && other_kind && *kind != *other_kind) paths = {"kind"};
    bool any = false;
    for (const std::string& path : paths) {
        const HeldJson *before = in(golden, path), *now = in(&actual, path);
        HeldRow row{of, path, shown_leaf(before), shown_leaf(now), "", false};
        row.changed = golden && !is_same_leaf(before, now, may_be_rounded);
        const bool is_tests = path.starts_with("tests ");
        if (is_tests && (row.golden.empty() || row.golden == "0") && row.actual == "0") continue;
        if (row.changed && is_tests && before && now && before->is_number() && now->is_number())
            row.ratio = ratio_words(now->get<double>(), before->get<double>());
        any |= row.changed;
        out.push_back(std::move(row));
    }
    return any;
}

/// Of nodes, or of the events of a trace.
void add_inner_rows(const std::string& of, const HeldJson* golden, const HeldJson& actual, std::vector<HeldRow>& out) {
    for (const auto& [key, list] : actual.items()) {
        if (!is_inner_list(key) || !list.is_array()) continue;
        const bool is_trace = key == "trace";
        const HeldJson* before =
            golden && golden->contains(key) && (*golden)[key].is_array() ? &(*golden)[key] : nullptr;
        for (std::size_t i = 0; i < std::max(list.size(), before ? before->size() : 0); ++i) {
            Leaves now, then;
            if (i < list.size()) add_leaves(list[i], "", now);
            if (before && i < before->size()) add_leaves((*before)[i], "", then);
            std::vector<HeldRow> rows;
            const std::string inner = of + (is_trace ? ", step " : ", node ") + std::to_string(i);
            const bool any = add_rows(inner, golden ? &then : nullptr, now, true, rows);
            if (golden && !any) continue;
            if (golden) std::erase_if(rows, [](const HeldRow& row) { return !row.changed; });
            out.insert(out.end(), rows.begin(), rows.end());
            if (golden && is_trace) break;
        }
    }
}

std::string text_in(const HeldJson& entry, const char* key) {
    return entry.contains(key) && entry[key].is_string() ? cleaned(entry[key].get<std::string>()) : "";
}

/// "panel 1, query 0, A and B"
std::string title_of_entry(const HeldJson& entry) {
    std::string out;
    if (entry.contains("panel")) out = "panel " + entry["panel"].dump() + ", ";
    if (entry.contains("clip")) return out + "fit of '" + text_in(entry, "clip") + "'";
    const std::string query = entry.contains("query") ? entry["query"].dump() : "";
    return out + "query " + query + ", " + text_in(entry, "a") + " and " + text_in(entry, "b");
}

/// The entries of a golden by their titles, in order; empty if it is none.
std::vector<std::pair<std::string, const HeldJson*>> entries_in(const HeldJson& root) {
    std::vector<std::pair<std::string, const HeldJson*>> out;
    if (!root.is_object()) return out;
    for (const auto& [unused, list] : root.items()) {
        if (!list.is_array()) continue;
        for (const HeldJson& entry : list) {
            if (entry.is_object()) out.emplace_back(title_of_entry(entry), &entry);
        }
    }
    return out;
}

}  // namespace

std::vector<HeldRow> held_rows(const std::optional<std::string>& golden, const std::string& actual) {
    std::vector<HeldRow> out;
    HeldJson before = HeldJson::object(), now;
    try {
        if (golden) before = parsed(*golden);
        now = parsed(actual);
    } catch (const InputError&) {
        return out;
    }
    const auto stored = entries_in(before), present = entries_in(now);
    const auto in = [](const auto& entries, const std::string& title) -> const HeldJson* {
        const auto at = std::ranges::find(entries, title, [](const auto& entry) { return entry.first; });
        return at == entries.end() ? nullptr : at->second;
    };
    const auto add = [&](const std::string& title, const HeldJson* then, const HeldJson& entry) {
        const bool is_answer = entry.contains("tests");
        std::vector<HeldRow> rows;
        const Leaves leaves = then ? leaves_of_entry(*then) : Leaves();
        const bool any = add_rows(title, golden ? &leaves : nullptr, leaves_of_entry(entry), !is_answer, rows);
        if (golden && !(is_answer && any)) std::erase_if(rows, [](const HeldRow& row) { return !row.changed; });
        out.insert(out.end(), rows.begin(), rows.end());
        add_inner_rows(title, golden ? (then ? then : &now) : nullptr, entry, out);
    };
    for (const auto& [title, entry] : present) add(title, in(stored, title), *entry);
    const HeldJson nothing = HeldJson::object();
    for (const auto& [title, entry] : stored) {
        if (!in(present, title)) add(title, entry, nothing);
    }
    return out;
}

}  // namespace mobbscope::app
