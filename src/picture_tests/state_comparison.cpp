#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <picture_tests/picture_state.h>
#include <scene/view_options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

/// What a line is about, the cause first. The last ones are told alone: they follow from what comes before them.
enum class Rank { agents, fit, view, query, words, other, tree, camera, count, drawn, order };

using Path = std::vector<std::string>;
using Leaves = std::map<Path, const JsonValue*>;

std::string text_of(const JsonValue& value) {
    const auto* text = value.as<std::string>();
    return text ? *text : "";
}

/// Of an element of an array.
std::string name_of(const JsonValue& element, std::size_t index) {
    if (const auto* members = element.as<JsonValue::Object>()) {
        for (const JsonMember& member : *members) {
            if (member.key() == "name") return text_of(member.value);
        }
    }
    return std::to_string(index);
}

/// What holds no object, by the keys that lead there; an element of an array by its name, or else its index.
void collect(const JsonValue& value, Path path, Leaves& leaves) {
    const auto collect_in = [&](const std::string& key, const JsonValue& of) {
        path.push_back(key);
        collect(of, path, leaves);
        path.pop_back();
    };
    const auto* elements = value.as<JsonValue::Array>();
    const auto is_object = [](const JsonValue& one) { return one.as<JsonValue::Object>() != nullptr; };
    if (const auto* members = value.as<JsonValue::Object>()) {
        for (const JsonMember& member : *members) collect_in(member.key(), member.value);
    } else if (elements && std::ranges::any_of(*elements, is_object)) {
        for (std::size_t i = 0; i < elements->size(); ++i) collect_in(name_of((*elements)[i], i), (*elements)[i]);
    } else {
        leaves.emplace(path, &value);
    }
}

/// Numbers agree within `near`, or `share` of their size.
bool same(const JsonValue& a, const JsonValue& b, double near, double share) {
    if (a.data.index() != b.data.index()) return false;
    if (const auto* x = a.as<double>()) {
        const double y = *b.as<double>();
        return std::abs(*x - y) <= std::max({near, share * std::abs(*x), share * std::abs(y)});
    }
    if (const auto* boolean = a.as<bool>()) return *boolean == *b.as<bool>();
    const auto* elements = a.as<JsonValue::Array>();
    if (!elements) return text_of(a) == text_of(b);
    return std::ranges::equal(*elements, *b.as<JsonValue::Array>(), [&](const JsonValue& one, const JsonValue& other) {
        return same(one, other, near, share);
    });
}

/// On one line; null: "none".
std::string on_one_line(const JsonValue* value) {
    if (!value) return "none";
    if (const auto* number = value->as<double>()) return brief(*number);
    if (const auto* boolean = value->as<bool>()) return *boolean ? "true" : "false";
    if (value->as<std::string>()) return cleaned(text_of(*value));
    const auto* elements = value->as<JsonValue::Array>();
    if (!elements) return "none";
    std::string out;
    for (const JsonValue& element : *elements) out += (out.empty() ? "" : ", ") + on_one_line(&element);
    return '[' + shortened(out, 60) + ']';
}

/// The number, or the one with this index of an array; 0 if there is none.
double number_in(const JsonValue* value, std::size_t index = 0) {
    const auto* elements = value ? value->as<JsonValue::Array>() : nullptr;
    if (elements) value = index < elements->size() ? &(*elements)[index] : nullptr;
    const auto* number = value ? value->as<double>() : nullptr;
    return number ? *number : 0;
}

/// What is told.
class Lines {
  public:
    std::string panel;  ///< "panel 1, ": before what is not of all panels

    /// Of what is found at a path in a panel and is not the same; null where there is none.
    void add(const Path& path, const JsonValue* now, const JsonValue* before) {
        const std::string& about = path.front();
        const std::string& key = path.back();
        const std::string was = cleaned(key) + ' ' + on_one_line(now) + " was " + on_one_line(before);
        if (about == "agents" && path.size() > 2) return add_agent(path, was, now, before);
        if (about == "words" && path.size() == 2) return add_words(cleaned(key), now, before);
        if (about == "drawn" && path.size() == 3) return add_drawn(cleaned(path[1]) + ": ", key, now, before);
        if (about == "fit") return add(Rank::fit, panel + "the fit is another: " + was);
        if (about == "camera") return add(Rank::camera, panel + "the camera is elsewhere: " + was);
        if (about == "view" && key == "levels") return add(Rank::view, panel + "level " + was.substr(key.size() + 1));
        const Rank rank = about == "query"                     ? Rank::query
                          : about == "view" || about == "size" ? Rank::view
                                                               : Rank::other;
        std::string keys;
        for (std::size_t i = rank == Rank::other ? 0 : 1; i + 1 < path.size(); ++i) keys += cleaned(path[i]) + ' ';
        add(rank, panel + keys + was);
    }

    /// The cause first, without what follows from it.
    std::vector<std::string> told() const {
        std::vector<std::string> out;
        for (const auto& [rank, words] : lines_) {
            const bool is_told = rank < Rank::tree || rank == lines_.begin()->first;
            if (is_told && std::ranges::find(out, words) == out.end()) out.push_back(words);
        }
        return out;
    }

  private:
    void add(Rank rank, const std::string& words) { lines_.emplace(rank, words); }

    void add_agent(const Path& path, const std::string& was, const JsonValue* now, const JsonValue* before) {
        const std::string name = cleaned(path[1]);
        const std::string& key = path[2];
        const auto by = [&](std::size_t index) {
            const double way = number_in(now, index) - number_in(before, index);
            return std::abs(way) < 1e-9 ? "0" : brief(way);
        };
        if (key == "name") add(Rank::agents, name + (now ? " is new" : " is missing"));
        if (key == "name" || !now || !before) return;
        if (key == "tree") return add(Rank::tree, "the tree of " + name + " is another");
        add(Rank::agents, key == "translate"    ? name + " moved by (" + by(0) + ", " + by(1) + ')'
                          : key == "rotate_deg" ? name + " turned by " + by(0) + " degrees"
                          : key == "start"      ? name + "'s start moved by " + by(0) + " s"
                          : key == "clip"       ? name + "'s clip is another"
                                                : name + ": " + was);
    }

    /// Of texts with one role.
    void add_words(const std::string& role, const JsonValue* now, const JsonValue* before) {
        const auto texts = [](const JsonValue* value) {
            std::vector<std::string> out;
            const auto* elements = value ? value->as<JsonValue::Array>() : nullptr;
            for (std::size_t i = 0; elements && i < elements->size(); ++i) out.push_back(text_of((*elements)[i]));
            return out;
        };
        std::vector<std::string> here = texts(now), there = texts(before);
        std::erase_if(here, [&](const std::string& text) { return std::erase(there, text) > 0; });
        // Where ticks stand follows from how far the scene reaches.
        const Rank rank = role == "tick" ? Rank::camera : Rank::words;
        for (std::size_t i = 0; i < std::max(here.size(), there.size()); ++i) {
            std::string line = panel + role + ' ' + in_quotes(i < here.size() ? here[i] : there[i]);
            line += i >= there.size() ? " is new" : i >= here.size() ? " is missing" : " was " + in_quotes(there[i]);
            add(rank, line);
        }
        if (here.empty() && there.empty()) add(rank, panel + role + " texts: another number or order");
    }

    void add_drawn(const std::string& part, const std::string& key, const JsonValue* now, const JsonValue* before) {
        if (key == "count") return add(Rank::count, panel + part + on_one_line(now) + ", was " + on_one_line(before));
        if (key == "order") return add(Rank::order, panel + part + "another order");
        add(Rank::drawn, panel + part + (key == "digest" ? "others" : "other " + (key == "colors" ? "colours" : key)));
    }

    std::multimap<Rank, std::string> lines_;
};

/// A view with nothing left out, as a panel has it.
std::string usual_view() {
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.begin_object("view");
    for (const ViewOption& option : view_options()) {
        json.key(option.key);
        option.write(json, ViewState{});
    }
    json.end_object();
    json.end_object();
    return std::move(text).str();
}

Leaves leaves_of(const JsonText& text) {
    Leaves out;
    collect(text.root(), {}, out);
    return out;
}

const JsonValue* find(const Leaves& leaves, const Path& path) {
    const auto found = leaves.find(path);
    return found == leaves.end() ? nullptr : found->second;
}

}  // namespace

StateDifferences compare_states(const std::string& actual, const std::string& golden, const std::string& file) {
    const std::string usual_name = "the usual view", name = "the state";
    const JsonText usual_text = parse_json(usual_view(), usual_name), text = parse_json(actual, name);
    const JsonText golden_text = parse_json(golden, file);
    const JsonPlace root(golden_text, file);
    const JsonPlace version = root.require("mobbscope_state");
    if (version.number() != kStateVersion) version.fail("the program reads version " + std::to_string(kStateVersion));
    const Leaves usual = leaves_of(usual_text), now = leaves_of(text), before = leaves_of(golden_text);
    const JsonValue *imgui = find(now, {"imgui"}), *golden_imgui = find(before, {"imgui"});
    Leaves all = now;
    all.insert(before.begin(), before.end());
    std::erase_if(all, [](const auto& leaf) { return leaf.first.size() < 3 || leaf.first.front() != "panels"; });
    const bool several = !all.empty() && all.begin()->first[1] != all.rbegin()->first[1];
    Lines lines;
    for (const auto& [whole, unused] : all) {
        if (several) lines.panel = "panel " + cleaned(whole[1]) + ", ";
        Path path(whole.begin() + 2, whole.end());
        if (path.front() == "scene" && path.size() > 1) path.erase(path.begin());  // of a window
        const JsonValue *a = find(now, whole), *b = find(before, whole);
        if (!a) a = find(usual, path);
        if (!b) b = find(usual, path);
        const bool is_drawn = imgui || path.front() == "camera" || path.front() == "drawn";
        if (!a || !b || !same(*a, *b, is_drawn ? 1e-4 : 1e-9, is_drawn ? 2e-5 : 1e-8)) lines.add(path, a, b);
    }
    StateDifferences out{lines.told(), {}};
    if (imgui && golden_imgui && on_one_line(imgui) != on_one_line(golden_imgui))
        out.other_imgui = on_one_line(imgui) + " for " + on_one_line(golden_imgui);
    return out;
}

}  // namespace mobbscope::picture_tests
