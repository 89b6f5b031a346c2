/// What scripts expect of the state (state_json.h).
#pragma once

#include <app/document/session.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace mobbscope::app {

/// What is there instead, in words; none if it is as expected.
using ScriptExpectation = std::function<std::optional<std::string>(const Session&)>;

/// `text`: "POINTER VALUE", "POINTER != VALUE" or "POINTER ~ NUMBER TOLERANCE", see script.h. Throws
/// std::invalid_argument, in words, if it is none of them.
ScriptExpectation parse_expectation(std::string_view text);

}  // namespace mobbscope::app
