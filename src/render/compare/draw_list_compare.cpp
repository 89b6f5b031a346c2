#include <base/text.h>
#include <render/compare/alignment.h>
#include <render/compare/draw_list_compare.h>
#include <render/compare/word_room.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace mobbscope {

namespace compare {

namespace {

constexpr double kFewPixels = 16;
constexpr double kNearPixels = 0.01;
constexpr double kOtherFontPixels = 12;
constexpr double kOtherFontShare = 0.04;  // of the picture's longer side

using Words = std::vector<std::string>;

/// The first of many lines.
Words first_of(Words lines, std::size_t most) {
    if (lines.size() <= most) return lines;
    const std::string more = "and " + std::to_string(lines.size() - most) + " more";
    lines.resize(most);
    lines.push_back(more);
    return lines;
}

/// An array of two draw lists.
struct ComparedArray {
    ElementTerms terms;
    NamedElements actual, golden;
    Alignment alignment{};
};

bool has_roles(const Elements& texts) {
    return std::ranges::all_of(texts, [](const JsonValue& text) { return held<std::string>(text, "role") != nullptr; });
}

/// One that is called otherwise keeps its number: those of whom neither name is in the other list.
void take_names(Words& actual, const Words& golden) {
    if (actual.size() != golden.size()) return;
    const std::set<std::string> here(actual.begin(), actual.end()), there(golden.begin(), golden.end());
    for (std::size_t i = 0; i < actual.size(); ++i) {
        if (!there.contains(actual[i]) && !here.contains(golden[i])) actual[i] = golden[i];
    }
}

/// What the picture is of, whose labels and lines follow it.
bool is_of_scene(const ElementKind& kind) { return kind.is_object() || kind.list == "participants"; }

/// "x " of the first of two or three numbers that are a place, and so on; else nothing.
std::string coordinate_of(const JsonValue* place, const Unlike& unlike) {
    const auto* numbers = place ? place->as<Elements>() : nullptr;
    if (!numbers || numbers->size() > 3) return "";
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        if (&(*numbers)[i] == unlike.golden && unlike.golden->as<double>()) return {"xyz"[i], ' '};
    }
    return "";
}

class Comparer {
  public:
    explicit Comparer(bool other_fonts) : other_fonts_(other_fonts) {}

    void compare(const JsonValue& actual, const JsonValue& golden) {
        if (is_draw_list(golden) && is_draw_list(actual)) return compare_lists("", actual, golden);
        const auto* pictures = actual.as<Elements>();
        const auto* others = golden.as<Elements>();
        if (!pictures || !others ||
            !(std::ranges::any_of(*others, is_draw_list) || std::ranges::any_of(*pictures, is_draw_list)))
            return compare_values("", &actual, &golden);
        for (std::size_t i = 0; i < std::max(pictures->size(), others->size()); ++i) {
            const std::string picture = "picture " + std::to_string(i + 1);
            const JsonValue* a = element_at(*pictures, i);
            const JsonValue* g = element_at(*others, i);
            if (!a || !g) {
                gone_.push_back(picture + (g ? " is missing" : " is not in the golden"));
            } else if (is_draw_list(*a) && is_draw_list(*g)) {
                compare_lists(picture + ", ", *a, *g);
            } else {
                compare_values(picture, a, g);
            }
        }
    }

    /// `most`: lines in each part.
    DrawListComparison result(std::size_t most) && {
        // The camera frames the scene, and moves where that does.
        Words all;
        for (Words* words : {&objects_gone_, &objects_other_, &gone_, &other_, &cameras_}) {
            all.insert(all.end(), std::make_move_iterator(words->begin()), std::make_move_iterator(words->end()));
        }
        if (all.empty()) all = std::move(follows_);
        const std::size_t count = all.size();
        return {first_of(std::move(all), most), count, first_of(std::move(pixels_), most)};
    }

  private:
    // --- draw lists

    /// `in`: "picture 2, " or nothing.
    void compare_lists(const std::string& in, const JsonValue& actual, const JsonValue& golden) {
        in_ = in;
        rows_told_.clear();
        golden_names_ = participants_of(golden);
        actual_names_ = participants_of(actual);
        take_names(actual_names_, golden_names_);
        room_.reset();
        if (other_fonts_) room_.emplace(actual, golden);
        std::map<std::string, ComparedArray> arrays;
        bool ids = true;
        each_member(actual, golden, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            static const Elements kNone;
            const ElementKind* kind = kind_of(key);
            const auto* here = a ? a->as<Elements>() : &kNone;
            const auto* there = g ? g->as<Elements>() : &kNone;
            if (!kind || !here || !there) return;
            const ComparedArray& array = arrays.try_emplace(key, aligned(*kind, *here, *there, golden)).first->second;
            tell_gone(array);
            if (kind->is_object() || key == "participants") ids = ids && array.alignment.all_there();
        });
        if (room_) {
            if (const auto words = room_->caption_words()) other_.push_back(in_ + *words);
        }
        each_member(actual, golden, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            const auto array = arrays.find(key);
            if (array != arrays.end()) return compare_pairs(array->second, ids);
            if (key == "camera" && a && g) return compare_cameras(*a, *g);
            compare_values(in_ + cleaned(key), a, g);
        });
    }

    ComparedArray aligned(const ElementKind& kind, const Elements& actual, const Elements& golden,
                          const JsonValue& list) const {
        double side = 0;
        const auto* size = held<Elements>(list, "size");
        for (std::size_t i = 0; size && i < size->size(); ++i) {
            if (const auto* length = (*size)[i].as<double>()) side = std::max(side, *length);
        }
        const double bound = std::max(kOtherFontPixels, kOtherFontShare * side);
        const ElementTerms terms{kind, other_fonts_, bound, has_roles(actual) && has_roles(golden)};
        const auto named = [&](const Elements& elements, const Words& participants) {
            NamedElements out{elements, {}};
            for (std::size_t i = 0; i < elements.size(); ++i) {
                out.names.push_back(key_of(terms, elements[i], i, participants));
            }
            return out;
        };
        ComparedArray out{terms, named(actual, actual_names_), named(golden, golden_names_)};
        out.alignment = align(out.actual, out.golden, out.terms);
        return out;
    }

    void tell_gone(const ComparedArray& array) {
        const auto tell_one = [&](const JsonValue& element, std::size_t i, WordRoom::Side side) {
            if (excuse_of(array, element, side) != WordRoom::Excuse::none) return;
            const bool added = side == WordRoom::in_actual;
            const std::string what = element_words(array.terms.kind, element, i, added ? actual_names_ : golden_names_);
            tell(is_of_scene(array.terms.kind) ? objects_gone_ : gone_, array,
                 "the " + what + (added ? " is not in the golden" : " is missing"));
        };
        for (const std::size_t i : array.alignment.missing) tell_one(array.golden.elements[i], i, WordRoom::in_golden);
        for (const std::size_t i : array.alignment.added) tell_one(array.actual.elements[i], i, WordRoom::in_actual);
    }

    WordRoom::Excuse excuse_of(const ComparedArray& array, const JsonValue& element, WordRoom::Side side) const {
        return room_ ? room_->excuse(array.terms.kind, element, side) : WordRoom::Excuse::none;
    }

    /// The row of a legend is in two arrays, as an entry and as a text.
    void tell(Words& lines, const ComparedArray& array, const std::string& line) {
        if (array.terms.kind.list == "legend") rows_told_.insert(line);
        if (!array.terms.kind.is_text() || !rows_told_.contains(line)) lines.push_back(in_ + line);
    }

    /// `ids`: whether the numbers of objects are the same ones.
    void compare_pairs(const ComparedArray& array, bool ids) {
        const ElementKind& kind = array.terms.kind;
        bool same = array.alignment.all_there();
        const auto words_of = [&](std::size_t i) {
            return element_words(kind, array.golden.elements[i], i, golden_names_);
        };
        for (const auto& [there, here] : array.alignment.pairs) {
            const JsonValue& actual = array.actual.elements[here];
            const JsonValue& golden = array.golden.elements[there];
            const std::string what = difference(array, actual, golden, ids);
            if (!what.empty()) tell(is_of_scene(kind) ? objects_other_ : other_, array, words_of(there) + what);
            same = same && what.empty();
            const auto* seen = kind.is_object() ? held<double>(actual, "pixels") : nullptr;
            const auto* before = held<double>(golden, "pixels");
            if (!seen || !before || agree(*seen, *before, std::max(kFewPixels, kNearPixels * std::max(*seen, *before))))
                continue;
            pixels_.push_back(in_ + words_of(there) + ": " + brief(*seen) + (*seen == 1 ? " pixel" : " pixels") +
                              " instead of " + brief(*before));
        }
        if (!same || !kind.in_order || other_fonts_) return;
        if (const auto turned = array.alignment.out_of_order())
            other_.push_back(in_ + words_of(turned->second) + " comes before " + words_of(turned->first));
    }

    /// What differs and no other width of words excuses.
    std::string difference(const ComparedArray& array, const JsonValue& actual, const JsonValue& golden,
                           bool ids) const {
        std::string out = members_unlike(array.terms, actual, golden, ids);
        if (out.empty()) return out;
        const auto excuse =
            std::max(excuse_of(array, actual, WordRoom::in_actual), excuse_of(array, golden, WordRoom::in_golden));
        if (excuse == WordRoom::Excuse::none) return out;
        if (excuse == WordRoom::Excuse::all) return "";
        ElementTerms anywhere = array.terms;
        anywhere.bound = std::numeric_limits<double>::infinity();
        return members_unlike(anywhere, actual, golden, ids);
    }

    /// ", extents: 1.02 instead of 1 (also center, fill)", or nothing.
    std::string members_unlike(const ElementTerms& terms, const JsonValue& actual, const JsonValue& golden,
                               bool ids) const {
        std::string first, also;
        const auto add = [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
            // Its number and index tell of whom it is, its name does already.
            if (key == "id" ? !ids && terms.kind.is_object() : key == "participant" || !terms.counts(key)) return;
            const Unlike unlike = first_unlike(a, g, terms.bound_of(key));
            if (!unlike || (key == "text" && terms.kind.is_text() && may_read(a, golden))) return;
            if (first.empty()) {
                first = ", " + cleaned(key) + ": " + coordinate_of(g, unlike) + unlike.words();
            } else {
                also += (also.empty() ? " (also " : ", ") + cleaned(key);
            }
        };
        if (each_member(actual, golden, add)) return first + (also.empty() ? "" : also + ')');
        const Unlike unlike = first_unlike(&actual, &golden);
        if (unlike && terms.kind.list == "participants") return " is called " + shown(&actual);
        return unlike ? ": " + unlike.words() : "";
    }

    /// Whether other fonts may make the words of a text of these.
    bool may_read(const JsonValue* words, const JsonValue& golden) const {
        const auto* here = words ? words->as<std::string>() : nullptr;
        const auto* there = held<std::string>(golden, "text");
        return room_ && here && there && (is_caption(golden) || are_cut_alike(*here, *there));
    }

    void compare_cameras(const JsonValue& actual, const JsonValue& golden) {
        ElementTerms terms;
        terms.kind.list = "camera";
        const std::string words = members_unlike(terms, actual, golden, true);
        if (!words.empty()) return cameras_.push_back(in_ + "camera" + words);
        const std::string follows = members_unlike(ElementTerms{}, actual, golden, true);
        if (!follows.empty()) follows_.push_back(in_ + "camera" + follows);
    }

    // --- any JSON

    /// Either may be null, not both.
    void compare_values(const std::string& place, const JsonValue* actual, const JsonValue* golden) {
        if (!actual) return gone_.push_back(place + " is missing: " + shown(golden));
        if (!golden) return gone_.push_back(place + " is not in the golden: " + shown(actual));
        const bool objects =
            each_member(*actual, *golden, [&](const std::string& key, const JsonValue* a, const JsonValue* g) {
                compare_values(place + pointer_token(key), a, g);
            });
        if (objects) return;
        const auto* there = golden->as<Elements>();
        const auto* here = actual->as<Elements>();
        if (there && here) return compare_arrays(place, *here, *there);
        if (const Unlike unlike = first_unlike(actual, golden))
            other_.push_back((place.empty() ? "the whole" : place) + ": " + unlike.words());
    }

    void compare_arrays(const std::string& place, const Elements& actual, const Elements& golden) {
        const auto at = [&](std::size_t i) { return place + '/' + std::to_string(i); };
        const auto is_number = [](const JsonValue& value) { return value.as<double>() != nullptr; };
        if (actual.size() == golden.size() && std::ranges::all_of(golden, is_number)) {
            // A vector is one thing.
            for (std::size_t i = 0; i < golden.size(); ++i) {
                if (const Unlike unlike = first_unlike(&actual[i], &golden[i]))
                    return other_.push_back(at(i) + ": " + unlike.words());
            }
            return;
        }
        const auto unnamed = [](const Elements& elements) { return NamedElements{elements, Words(elements.size())}; };
        const Alignment alignment = align(unnamed(actual), unnamed(golden), ElementTerms{});
        for (const std::size_t i : alignment.missing) compare_values(at(i), nullptr, &golden[i]);
        for (const std::size_t i : alignment.added) compare_values(at(i), &actual[i], nullptr);
        for (const auto& [there, here] : alignment.pairs) compare_values(at(there), &actual[here], &golden[there]);
        if (const auto turned = alignment.out_of_order())
            other_.push_back(at(turned->second) + " comes before " + at(turned->first) + ": " +
                             shown(&golden[turned->second]) + " before " + shown(&golden[turned->first]));
    }

    bool other_fonts_;
    // Participants, disks and boxes come first: labels, ticks and the camera follow them.
    Words objects_gone_, objects_other_;
    Words gone_;     ///< what is missing or not in the golden
    Words other_;    ///< what differs
    Words cameras_;  ///< ... and what differs in cameras
    Words follows_;  ///< what differs where something else does
    Words pixels_;
    // Of the draw lists that are compared:
    std::string in_;
    Words actual_names_, golden_names_;  ///< of participants, as the golden calls them
    std::optional<WordRoom> room_;       ///< where fonts are other ones
    std::set<std::string> rows_told_;
};

}  // namespace

}  // namespace compare

DrawListComparison compare_draw_lists(std::string_view actual, const std::string& actual_name, std::string_view golden,
                                      const std::string& golden_name, const DrawListTerms& terms) {
    compare::Comparer comparer(terms.other_fonts);
    comparer.compare(parse_json(actual, actual_name).root(), parse_json(golden, golden_name).root());
    return std::move(comparer).result(terms.most);
}

}  // namespace mobbscope
