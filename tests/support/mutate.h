/// Damaged copies of valid files, the same ones in every run.
#pragma once

#include <random>
#include <string>

namespace mobbscope {
inline namespace testing {

/// Changes one to six places: a byte flipped, removed, doubled or replaced by one that grammars care about, a slice
/// repeated or cut, or the rest cut off.
inline std::string mutated(std::string bytes, std::mt19937& random) {
    static constexpr char kTelling[] = "0123456789-+.eE,;:\"'[]{}\n\r\t \\/\0\x7f\xc3\xff";
    const auto below = [&random](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
    for (std::size_t edits = 1 + below(6); edits > 0 && !bytes.empty(); --edits) {
        const std::size_t at = below(bytes.size());
        switch (below(7)) {
            case 0:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 1:
                bytes.erase(at, 1);
                break;
            case 2:
                bytes.insert(at, 1, bytes[at]);
                break;
            case 3:
                bytes[at] = kTelling[below(sizeof kTelling - 1)];
                break;
            case 4:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
                break;
            case 5:
                bytes.erase(at, below(40));
                break;
            default:
                if (below(4) == 0) bytes.resize(at);
        }
    }
    return bytes;
}

}  // namespace testing
}  // namespace mobbscope
