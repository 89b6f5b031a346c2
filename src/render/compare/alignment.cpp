#include <render/compare/alignment.h>

#include <algorithm>
#include <unordered_map>

namespace mobbscope::compare {

namespace {

constexpr std::size_t kMostCompared = 16;  // elements that one is held against where nothing names its like

class Aligner {
  public:
    Aligner(const NamedElements& actual, const NamedElements& golden, const ElementTerms& terms)
        : actual_(actual),
          golden_(golden),
          terms_(terms),
          of_golden_(golden.elements.size()),
          of_actual_(actual.elements.size()) {
        for (std::size_t i = 0; i < of_golden_.size(); ++i) out_.missing.push_back(i);
        for (std::size_t i = 0; i < of_actual_.size(); ++i) out_.added.push_back(i);
    }

    Alignment aligned() {
        for (const bool rounded : {false, true}) pair_equal(rounded);
        for (const bool alike : {true, false}) {
            pair_beside(alike);
            pair_groups(alike);
        }
        pair_rest();
        for (std::size_t i = 0; i < of_golden_.size(); ++i) {
            if (of_golden_[i]) out_.pairs.emplace_back(i, *of_golden_[i]);
        }
        return std::move(out_);
    }

  private:
    using Places = std::vector<std::size_t>;
    using Groups = std::unordered_map<std::string, std::pair<Places, Places>>;  ///< golden, actual

    void pair(std::size_t golden, std::size_t actual) {
        of_golden_[golden] = actual;
        of_actual_[actual] = golden;
    }
    void drop_paired() {
        std::erase_if(out_.missing, [&](std::size_t i) { return of_golden_[i].has_value(); });
        std::erase_if(out_.added, [&](std::size_t i) { return of_actual_[i].has_value(); });
    }
    Likeness likeness_of(std::size_t golden, std::size_t actual) const {
        return likeness(terms_, actual_.elements[actual], golden_.elements[golden]);
    }
    /// How much has to agree of two that have this name.
    static Agreeing least_of(const std::string& name, bool alike) {
        if (alike) return Agreeing::all;
        return name.empty() ? Agreeing::half : Agreeing::any;
    }

    /// Those that have no like yet, by what `key` makes of them.
    template <class Key>
    Groups grouped(const Key& key) const {
        Groups groups;
        if (out_.all_there()) return groups;
        for (const std::size_t i : out_.missing) groups[key(golden_, i)].first.push_back(i);
        for (const std::size_t i : out_.added) groups[key(actual_, i)].second.push_back(i);
        return groups;
    }

    /// The first with the first.
    void pair_equal(bool rounded) {
        const Groups groups = grouped([&](const NamedElements& side, std::size_t i) {
            return side.names[i] + fingerprint(terms_, side.elements[i], rounded);
        });
        for (const auto& [key, group] : groups) {
            const auto& [golden, actual] = group;
            for (std::size_t i = 0; i < std::min(golden.size(), actual.size()); ++i) pair(golden[i], actual[i]);
        }
        drop_paired();
    }

    /// Those that come after, or before, two that belong together.
    void pair_beside(bool alike) {
        const auto try_pair = [&](std::size_t golden, std::size_t actual) {
            if (of_golden_[golden] || of_actual_[actual] || golden_.names[golden] != actual_.names[actual]) return;
            if (likeness_of(golden, actual).enough(least_of(golden_.names[golden], alike))) pair(golden, actual);
        };
        const std::size_t size = of_golden_.size();
        for (const std::size_t i : out_.added) {
            const auto before = i > 0 ? of_actual_[i - 1] : std::nullopt;
            const std::size_t next = i == 0 ? 0 : before ? *before + 1 : size;
            if (next < size) try_pair(next, i);
        }
        for (auto i = out_.added.rbegin(); i != out_.added.rend(); ++i) {
            const std::size_t after = *i + 1 < of_actual_.size() ? of_actual_[*i + 1].value_or(0) : size;
            if (after > 0) try_pair(after - 1, *i);
        }
        drop_paired();
    }

    void pair_groups(bool alike) {
        const Groups groups = grouped([](const NamedElements& side, std::size_t i) { return side.names[i]; });
        for (const auto& [name, group] : groups) pair_near(group.first, group.second, least_of(name, alike));
        drop_paired();
    }

    /// Those whose names differ; of an array that is none of a draw list, whatever is left of as many.
    void pair_rest() {
        if (terms_.kind.renamed) pair_near(out_.missing, out_.added, Agreeing::all_but_one);
        if (terms_.kind.list.empty() && out_.missing.size() == out_.added.size()) {
            for (std::size_t i = 0; i < out_.missing.size(); ++i) pair(out_.missing[i], out_.added[i]);
        }
        drop_paired();
    }

    /// Each with the most alike of those about where the last one was found.
    void pair_near(const Places& golden, const Places& actual, Agreeing least) {
        std::size_t next = 0;  // in `actual`
        for (std::size_t i = 0; i < golden.size(); ++i) {
            while (next < actual.size() && of_actual_[actual[next]]) ++next;
            std::optional<std::pair<Likeness, std::size_t>> best;
            std::size_t at = next - std::min(next, kMostCompared / 4);
            for (const std::size_t end = std::min(actual.size(), next + kMostCompared); at < end; ++at) {
                if (of_actual_[actual[at]]) continue;
                const Likeness like = likeness_of(golden[i], actual[at]);
                if (like.enough(least) && (!best || like > best->first)) best.emplace(like, at);
            }
            if (best) {
                pair(golden[i], actual[best->second]);
                next = std::max(next, best->second + 1);
            } else if (actual.size() - next >= golden.size() - i) {
                ++next;
            }
        }
    }

    const NamedElements& actual_;
    const NamedElements& golden_;
    const ElementTerms& terms_;
    std::vector<std::optional<std::size_t>> of_golden_, of_actual_;  ///< places in the other array
    Alignment out_;
};

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> Alignment::out_of_order() const {
    for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
        if (pairs[i].second > pairs[i + 1].second) return std::pair(pairs[i].first, pairs[i + 1].first);
    }
    return std::nullopt;
}

Alignment align(const NamedElements& actual, const NamedElements& golden, const ElementTerms& terms) {
    return Aligner(actual, golden, terms).aligned();
}

}  // namespace mobbscope::compare
