/// Words and numbers as they stand in sentences for people.
#pragma once

#include <string>
#include <utility>

namespace mobbscope {

/// With a capital in front, where an ASCII letter stands there.
std::string as_sentence(std::string text);

/// Two numbers as `usual` writes them, or with as many digits as tell them apart where they differ.
std::pair<std::string, std::string> told_apart(double one, double other, std::string (*usual)(double));

}  // namespace mobbscope
