#include <app/script/script_expectation.h>
#include <app/script/state_json.h>
#include <base/text.h>
#include <render/drawlist/font.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mobbscope::app {

namespace {

constexpr std::size_t kLongestText = 200;  // characters of what a message repeats

using Json = nlohmann::ordered_json;

constexpr double kRelative = 1e-9;

bool agree(const Json& a, const Json& b) {
    if (a.is_number() && b.is_number()) {
        const double x = a.get<double>();
        const double y = b.get<double>();
        return std::abs(x - y) <= kRelative * std::max(std::abs(x), std::abs(y));
    }
    if (a.type() != b.type() || a.size() != b.size()) return false;
    if (a.is_array()) return std::equal(a.begin(), a.end(), b.begin(), agree);
    if (a.is_object()) {
        return std::all_of(a.items().begin(), a.items().end(), [&](const auto& item) {
            return b.contains(item.key()) && agree(item.value(), b[item.key()]);
        });
    }
    return a == b;
}

/// Null if there is nothing.
Json value_at(const Session& session, const Json::json_pointer& pointer) {
    const Json state = state_json(session);
    return state.contains(pointer) ? state.at(pointer) : Json(nullptr);
}

Json parse_value(std::string_view text) {
    Json value = Json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        throw std::invalid_argument(in_quotes(std::string(text)) + " is no JSON; texts stand in double quotes");
    }
    return value;
}

Json::json_pointer parse_pointer(const std::string& text) {
    try {
        return Json::json_pointer(text);
    } catch (const Json::exception&) {
        throw std::invalid_argument(in_quotes(text) + " is no JSON pointer; write it like /query/collides");
    }
}

/// Takes the first word off a text; one in double quotes may hold blanks.
std::string_view take_word(std::string_view& text) {
    const bool quoted = text.starts_with('"');
    if (quoted) text.remove_prefix(1);
    const std::size_t end = std::min(text.find_first_of(quoted ? "\"" : " \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + (quoted ? 1 : 0), text.size()));
    text = trimmed(text);
    return word;
}

double take_number(std::string_view& text, const char* what) {
    if (text.empty()) throw std::invalid_argument(std::string("it needs ") + what);
    const std::string_view word = take_word(text);
    const std::optional<double> value = parse_double(word);
    if (!value) {
        throw std::invalid_argument(in_quotes(std::string(word)) + " is no number: it needs " + what);
    }
    return *value;
}

std::string instead(const std::string& pointer, const Json& is, const std::string& expected) {
    return shortened(pointer, kLongestText) + " is " + shortened(state_text(is), kLongestText) + ", expected " +
           shortened(expected, kLongestText);
}

}  // namespace

ScriptExpectation parse_expectation(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) throw std::invalid_argument("it needs a JSON pointer and a value");
    const std::string name(take_word(text));
    const Json::json_pointer pointer = parse_pointer(name);
    if (text.starts_with("~ ")) {
        text = trimmed(text.substr(2));
        const double number = take_number(text, "a number behind ~");
        const double tolerance = take_number(text, "a tolerance");
        if (!text.empty()) throw std::invalid_argument(in_quotes(std::string(text)) + " is too much here");
        return [=](const Session& session) -> std::optional<std::string> {
            const Json is = value_at(session, pointer);
            if (is.is_number() && std::abs(is.get<double>() - number) <= tolerance) return std::nullopt;
            return instead(name, is, brief(number) + " within " + brief(tolerance));
        };
    }
    const bool other = text.starts_with("!= ");
    const Json wanted = parse_value(other ? text.substr(3) : text);
    return [=](const Session& session) -> std::optional<std::string> {
        const Json is = value_at(session, pointer);
        if (agree(is, wanted) != other) return std::nullopt;
        return instead(name, is, (other ? "anything but " : "") + wanted.dump());
    };
}

}  // namespace mobbscope::app
