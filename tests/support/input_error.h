/// What an InputError says.
#pragma once

#include <base/error.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope {
inline namespace testing {

/// The message of the InputError that `action` throws; fails the test if there is none, or if it is not one line.
template <class Action>
std::string input_error(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
}

}  // namespace testing
}  // namespace mobbscope
