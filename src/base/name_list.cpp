#include <base/name_list.h>
#include <base/text.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kFirstLetters = 3;   // names that share these are taken for names of one kind
constexpr std::size_t kMostNames = 2'000;  // that are read: a millisecond for all that are seen
constexpr const char* kEllipsis = "\u2026";

bool in_letter(std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u;
}

std::string first_letters(std::string_view name) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < kFirstLetters && end < name.size(); ++i) read_code_point(name, end);
    return std::string(name.substr(0, end));
}

std::size_t common_front(std::string_view a, std::string_view b) {
    return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

std::size_t common_back(std::string_view a, std::string_view b) {
    const std::size_t most = std::min(a.size(), b.size());
    std::size_t out = 0;
    while (out < most && a[a.size() - 1 - out] == b[b.size() - 1 - out]) ++out;
    return out;
}

/// Whether a word or a number goes on across that place, or a letter.
bool splits(std::string_view text, std::size_t at) {
    if (at == 0 || at >= text.size()) return false;
    if (in_letter(text, at)) return true;
    const auto kind = [&](std::size_t i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c >= '0' && c <= '9') return 1;
        return c >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? 2 : 0;
    };
    return kind(at) != 0 && kind(at) == kind(at - 1);
}

/// The first or last letters of a text that is shortened, and an ellipsis.
std::string head(std::string_view text, std::size_t letters) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < letters; ++i) read_code_point(text, end);
    return std::string(text.substr(0, end)) + kEllipsis;
}
std::string tail(std::string_view text, std::size_t letters) {
    std::size_t begin = text.size();
    for (std::size_t i = 0; i < letters; ++i) {
        --begin;
        while (in_letter(text, begin)) --begin;
    }
    return kEllipsis + std::string(text.substr(begin));
}

/// A part of a text, by bytes.
struct Part {
    std::size_t begin, end;

    std::string_view of(std::string_view text) const { return text.substr(begin, end - begin); }
};

/// The longest text that fits and has all of that part; nothing if there is none.
std::optional<std::string> fitted_around(std::string_view name, const Part& part, const TextFits& fits) {
    const std::string core(part.of(name));
    const std::string_view begin = name.substr(0, part.begin);
    const std::string_view end = name.substr(part.end);
    const std::size_t letters_before = code_points(begin).size();
    const std::size_t letters_behind = code_points(end).size();
    std::size_t before = letters_before;
    std::size_t behind = letters_behind;
    const auto text = [&] {
        return (before < letters_before ? head(begin, before) : std::string(begin)) + core +
               (behind < letters_behind ? tail(end, behind) : std::string(end));
    };
    // The longer one goes first, and all of it: one ellipsis takes less room than two.
    const bool front_first = letters_before >= letters_behind;
    for (std::size_t* side : {front_first ? &before : &behind, front_first ? &behind : &before}) {
        while (*side > 0) {
            --*side;
            if (std::string shorter = text(); fits(shorter)) return shorter;
        }
    }
    return fits(core) ? std::optional(core) : std::nullopt;
}

/// What of a name is its own among others.
struct OwnParts {
    Part all;    ///< but what all of them begin and end with
    Part first;  ///< of that as much from the beginning as tells it from each of them
};

/// None of a name that is like no other, or that begins as all others do.
std::optional<OwnParts> own_parts(std::string_view name, const std::vector<std::string>& kin) {
    std::size_t front = name.size();
    std::size_t back = name.size();
    std::size_t told = 0;  // bytes that at least one of them begins with, too
    for (const std::string& other : kin) {
        // Twice the same name tells nothing.
        if (other == name) continue;
        const std::size_t same = common_front(name, other);
        front = std::min(front, same);
        told = std::max(told, same);
        back = std::min(back, common_back(name, other));
    }
    // Of two that overlap, as in "walk 1" and "walk 11", what differs is at the end.
    back = std::min(back, name.size() - front);
    while (splits(name, front)) --front;
    while (splits(name, name.size() - back)) --back;
    const Part all{front, name.size() - back};
    if (all.begin == all.end || (front == 0 && back == 0)) return std::nullopt;
    Part first{front, std::min(told + 1, all.end)};
    while (first.end < all.end && splits(name, first.end)) ++first.end;
    return OwnParts{all, first};
}

}  // namespace

NameList::NameList(std::vector<std::string> names) : count_(names.size()) {
    const auto all = std::make_shared<const std::vector<std::string>>(std::move(names));
    name_of_ = [all](std::size_t i) { return (*all)[i]; };
}

void NameList::read() const {
    for (std::size_t i = 0; i < std::min(count_, kMostNames); ++i) {
        std::string name = name_of_(i);
        std::vector<std::string>& kin = kin_[first_letters(name)];
        kin.push_back(std::move(name));
    }
}

std::string NameList::shortened(std::string_view name, const TextFits& fits) const {
    if (std::string whole(name); fits(whole)) return whole;
    if (kin_.empty()) read();
    const auto kin = kin_.find(first_letters(name));
    const auto own = kin == kin_.end() ? std::nullopt : own_parts(name, kin->second);
    if (!own) return shortened_to_fit(name, fits);
    for (const Part& part : {own->all, own->first}) {
        if (const auto text = fitted_around(name, part, fits)) return *text;
    }
    return shortened_to_fit(own->first.of(name), fits);
}

}  // namespace mobbscope
