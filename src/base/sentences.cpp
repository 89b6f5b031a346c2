#include <base/sentences.h>
#include <base/text.h>

namespace mobbscope {

std::string as_sentence(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

std::pair<std::string, std::string> told_apart(double one, double other, std::string (*usual)(double)) {
    std::pair<std::string, std::string> out{usual(one), usual(other)};
    for (int digits = 5; out.first == out.second && one != other && digits <= 17; ++digits)
        out = {figure(one, digits), figure(other, digits)};
    return out;
}

}  // namespace mobbscope
