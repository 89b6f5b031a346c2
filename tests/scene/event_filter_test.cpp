// Filters as text, of events and of nodes: every field and sign, words, errors with their place, completion.
#include <base/text.h>
#include <scene/event_filter.h>
#include <scene/node_field.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Terms = std::vector<EventFilter::Term>;

/// "message at N", or "" for a filter.
/// Why the text is no such filter, and at which character; "" if it is one.
template <class Filter>
std::string refusal(std::string_view text) {
    try {
        const Filter filter(text);
        return "";
    } catch (const FilterError& error) {
        return std::string(error.what()) + " at " + std::to_string(error.at());
    }
}

TEST(EventFilter, TheDocumentListsEveryField) {
    const std::string document = slurp(kSource / "docs/command_line.md");
    for (const TableField& field : event_fields()) {
        const std::string name(field.name);
        const std::string row = field.of_side ? "| `" + name + "(a)`, `" + name + "(b)` |" : "| `" + name + "` |";
        EXPECT_NE(document.find(row), std::string::npos) << row;
        for (const std::string_view value : field.values)
            EXPECT_NE(document.find('`' + std::string(value) + '`'), std::string::npos) << value;
    }
}

TEST(EventFilter, TakesEveryFieldWithEverySignThatItHas) {
    for (const TableField& field : event_fields()) {
        const auto number = &field - event_fields().data();
        EXPECT_EQ(&info(static_cast<EventField>(number)), &field);
        const std::string name = std::string(field.name) + (field.of_side ? "(b)" : "");
        if (field.kind == FieldKind::flag) {
            const EventFilter filter(name);
            EXPECT_EQ(filter.terms().front().field, number);
            EXPECT_EQ(filter.terms().front().side, field.of_side ? 1 : 0);
            EXPECT_NE(refusal<EventFilter>(name + " = 1"), "");
            continue;
        }
        const std::string value = field.kind == FieldKind::word   ? std::string(field.values.back())
                                  : field.kind == FieldKind::node ? "2.1"
                                                                  : "3";
        const bool ordered = field.kind == FieldKind::number || field.kind == FieldKind::range;
        for (const std::string sign : {"=", "==", "!=", "\u2260", "<", "<=", "\u2264", ">", ">=", "\u2265"}) {
            const bool equality = sign == "=" || sign == "==" || sign == "!=" || sign == "\u2260";
            EXPECT_EQ(refusal<EventFilter>(name + sign + value).empty(), ordered || equality) << name << sign << value;
        }
        EXPECT_FALSE(field.doc.empty());
        EXPECT_NE(refusal<EventFilter>(name), "") << "a comparison is missing";
    }
}

TEST(EventFilter, BindsNotBeforeAndBeforeOr) {
    using Kind = EventFilter::Term::Kind;
    const EventFilter filter("step = 1 or not step = 2 and step = 3");
    ASSERT_EQ(filter.terms().size(), 6u);
    const EventFilter::Term& last = filter.terms().back();
    EXPECT_EQ(last.kind, Kind::one_of);
    EXPECT_EQ(filter.terms()[static_cast<std::size_t>(last.right)].kind, Kind::all_of);
    const auto passes = [](const EventFilter& of, double step) {
        return of.passes([&](const EventFilter::Term& term) { return term.value == step; });
    };
    EXPECT_TRUE(passes(filter, 1));
    EXPECT_TRUE(passes(filter, 3));
    EXPECT_FALSE(passes(filter, 2));
    const EventFilter grouped("(step = 1 or step = 2) and not (step = 2)");
    EXPECT_TRUE(passes(grouped, 1));
    EXPECT_FALSE(passes(grouped, 2));
}

TEST(EventFilter, ReadsUnitsAndNodes) {
    EXPECT_DOUBLE_EQ(EventFilter("gap < 5 cm").terms()[0].value, 0.05);
    EXPECT_DOUBLE_EQ(EventFilter("gap < 5mm").terms()[0].value, 0.005);
    EXPECT_DOUBLE_EQ(EventFilter("shared > 250 ms").terms()[0].value, 0.25);
    EXPECT_DOUBLE_EQ(EventFilter("gap < 1e-3 m and step > 2").terms()[0].value, 0.001);
    EXPECT_DOUBLE_EQ(EventFilter("clearance < -0.5").terms()[0].value, -0.5);
    const EventFilter::Term node = EventFilter("NODE(B) = 2.10").terms()[0];
    EXPECT_EQ(node.level, 2);
    EXPECT_EQ(node.value, 10) << "a place, not a fraction";
    EXPECT_EQ(EventFilter("node(a) = 17").terms()[0].level, -1);
}

TEST(EventFilter, SaysInWordsWhatItMeans) {
    EXPECT_EQ(EventFilter("gap < 0.05 and level(b) >= 3 and outcome = disjoint_in_time").words(),
              "the gap is below 0.05 m, and the level of B's node is at least 3, and the outcome is disjoint in time");
    EXPECT_EQ(EventFilter("not (leaf(a) or leaf(b)) and node(a) != 2.1").words(),
              "not (A's node is a leaf, or B's node is a leaf), and A's node is not 2.1");
    EXPECT_EQ(EventFilter("avoidable").words(), "the overlap was avoidable");
    EXPECT_EQ(EventFilter("(pairs > 3 or hit_below) and step = 7").words(),
              "(the number of measured pairs is above 3, or a hit was found in it or below it), and the step is 7");
}

TEST(EventFilter, PointsAtWhatIsWrong) {
    EXPECT_EQ(refusal<EventFilter>(""), "a field is missing at 0");
    EXPECT_EQ(refusal<EventFilter>("gapp < 1"), "'gapp' is not a field (did you mean 'gap'?) at 0");
    EXPECT_EQ(refusal<EventFilter>("gap < "), "a number is missing at 6");
    EXPECT_EQ(refusal<EventFilter>("gap 0.5"), "a comparison is missing: =, !=, <, <=, > or >= at 4");
    EXPECT_EQ(refusal<EventFilter>("gap < 0.5 s"), "'s' is not a unit of the gap: m, cm or mm at 10");
    EXPECT_EQ(refusal<EventFilter>("gap < 5 km"), "'km' is not a unit of the gap: m, cm or mm at 8");
    EXPECT_EQ(refusal<EventFilter>("gap < 5e"), "'e' is not a unit of the gap: m, cm or mm at 7");
    EXPECT_EQ(refusal<EventFilter>("time = 2 min and step > 3"), "'min' is not a unit of the time: s or ms at 9");
    EXPECT_EQ(refusal<EventFilter>("step < 5 m"), "the step has no unit at 9");
    EXPECT_EQ(refusal<EventFilter>("level(a) > 2 x"), "the level has no unit at 13");
    EXPECT_EQ(refusal<EventFilter>("node(a) = 2.1 m"), "the node has no unit at 14");
    EXPECT_EQ(refusal<EventFilter>("gap < 0,5"), "write '0.5' with a point at 7");
    EXPECT_EQ(refusal<EventFilter>("clearance > -0,25 m"), "write '-0.25' with a point at 14");
    EXPECT_EQ(refusal<EventFilter>("node(b) = 2,1"), "write '2.1' with a point at 11");
    EXPECT_EQ(refusal<EventFilter>("gap < 5, step > 2"), "'and' or 'or' is missing at 7");
    EXPECT_EQ(refusal<EventFilter>("step = = 3"), "a number is missing at 7");
    EXPECT_EQ(refusal<EventFilter>("outcome === hit").substr(0, 17), "a word is missing");
    EXPECT_EQ(refusal<EventFilter>("level > 2"), "whose? Give level(a) or level(b) at 6");
    EXPECT_EQ(refusal<EventFilter>("level(c) > 2"), "a or b must stand here at 6");
    EXPECT_EQ(refusal<EventFilter>("outcome = overlapp"),
              "'overlapp' is not one of them: disjoint_in_time, separated, overlap, hit, no_hit at 10");
    EXPECT_EQ(refusal<EventFilter>("outcome < hit"), "only = and != compare outcome at 8");
    EXPECT_EQ(refusal<EventFilter>("gap < 1 gap > 2"), "'and' or 'or' is missing at 8");
    EXPECT_EQ(refusal<EventFilter>("step = 1 not step = 2"), "'and' or 'or' is missing at 9");
    EXPECT_EQ(refusal<EventFilter>("gap < 1 a"), "'and' or 'or' is missing at 8") << "it is begun";
    EXPECT_EQ(refusal<EventFilter>("step = 1 adn step = 2"), "'and' or 'or' is missing at 9") << "it is meant";
    EXPECT_EQ(refusal<EventFilter>("(gap < 1"), "')' is missing at 8");
    EXPECT_EQ(refusal<EventFilter>("gap < 1.2.3"), "'1.2.3' is not a number at 6");
    EXPECT_EQ(refusal<EventFilter>("gap < 1e999"), "'1e999' is not a number at 6");
    EXPECT_EQ(refusal<EventFilter>("node(a) = 2.x"), "a node is missing: its level and place (2.1) or its index at 10");
    EXPECT_EQ(refusal<EventFilter>("gap < 1 and"), "a field is missing at 11");
    EXPECT_EQ(refusal<EventFilter>("gap < 1 & pairs > 2"), "'and' or 'or' is missing at 8");
    EXPECT_EQ(refusal<EventFilter>(std::string(100'000, '(')).substr(0, 23), "it is nested too deep a");
    EXPECT_EQ(refusal<EventFilter>(std::string("gap\0< 1", 7)).empty(), false);
}

TEST(EventFilter, CountsAreWholeNumbers) {
    for (const TableField& field : event_fields()) {
        if (field.kind != FieldKind::number && field.kind != FieldKind::range) continue;
        const std::string name(field.name), whose = name + (field.of_side ? "(a)" : "");
        for (const std::string sign : {" = ", " != "}) {
            const std::string begin = whose + sign;
            const std::string why = "the " + name + " is a whole number at " + std::to_string(begin.size());
            EXPECT_EQ(refusal<EventFilter>(begin + "2.5"), field.unit.empty() ? why : "");
            EXPECT_EQ(refusal<EventFilter>(begin + "2.0"), "");
        }
        EXPECT_EQ(refusal<EventFilter>(whose + " < 2.5"), "") << "it passes something";
    }
}

TEST(EventFilter, HasAThousandPartsAtMost) {
    const auto with_parts = [](int count) {
        std::string text = "step = 1";
        for (int i = 1; i < count; ++i) text += " or step = 2";
        return text;
    };
    const EventFilter most(with_parts(1000));
    EXPECT_FALSE(most.passes([](const EventFilter::Term&) { return false; }));
    EXPECT_TRUE(most.words().ends_with("or the step is 2"));
    const std::string why = "it has too many parts: at most 1000 at 12000";
    EXPECT_EQ(refusal<EventFilter>(with_parts(1001)), why);
    EXPECT_EQ(refusal<EventFilter>(with_parts(100'000)), why);
    EXPECT_EQ(refusal<EventFilter>('(' + with_parts(600) + ") and (" + with_parts(600) + ')').substr(0, 21),
              "it has too many parts");
}

TEST(NodeFilter, TakesTheFieldsOfNodesAndNoOthers) {
    const std::string document = slurp(kSource / "docs/command_line.md");
    for (const NodeFieldInfo& field : node_fields()) {
        EXPECT_EQ(&info(field.field), &field);
        const std::string name(field.name);
        EXPECT_NE(document.find("| `" + name + "` |"), std::string::npos) << name;
        if (field.kind == FieldKind::flag) {
            EXPECT_EQ(NodeFilter::field(NodeFilter(name).terms().front()), field.field);
            continue;
        }
        EXPECT_EQ(NodeFilter::field(NodeFilter(name + " = 3").terms().front()), field.field);
    }
    EXPECT_EQ(refusal<NodeFilter>("gap < 1"), "'gap' is not a field at 0");
    EXPECT_EQ(refusal<NodeFilter>("level(a) = 1"), "a comparison is missing: =, !=, <, <=, > or >= at 5");
    EXPECT_EQ(refusal<EventFilter>("fill < 1"), "'fill' is not a field at 0");
}

TEST(NodeFilter, ReadsPartsInPercent) {
    EXPECT_EQ(NodeFilter("fill < 50 %").terms()[0].value, 50);
    EXPECT_EQ(NodeFilter("fill < 50%and leaf").terms()[0].value, 50);
    EXPECT_EQ(NodeFilter("fill < 50").words(), "the fill is below 50 %");
    EXPECT_EQ(NodeFilter("empty > 0.5 and not leaf").words(),
              "the empty space is above 0.5 m\u00B2\u00B7s, and not (it is a leaf)");
    EXPECT_EQ(refusal<NodeFilter>("fill < 5 m"), "'m' is not a unit of the fill: % at 9");
    EXPECT_EQ(refusal<NodeFilter>("empty > 5 m"), "the empty is given without its unit at 10");
    EXPECT_EQ(refusal<NodeFilter>("tests > 5 %"), "the tests has no unit at 10");
    EXPECT_EQ(refusal<EventFilter>("gap < 5 %"), "'%' is not a unit of the gap: m, cm or mm at 8");
    EXPECT_EQ(completion_of(node_field_table(), "fill < 50 ").words, (std::vector<std::string>{"and", "or"}));
}

TEST(EventFilter, PutsACaretUnderTheCharacter) {
    const std::string text = "gap \u2264 0.5 and levl(a) > 1";
    try {
        const EventFilter filter(text);
        FAIL();
    } catch (const FilterError& error) {
        EXPECT_EQ(with_caret(text, error), text + "\n              ^");
    }
}

TEST(EventFilter, ShowsOfALongTextWhatIsNearTheMistake) {
    std::string text;
    while (text.size() < 45'000) text += "gap \u2264 0.5 and " + std::string(100, ' ');
    text += "levl(a) > 1";
    while (text.size() < 90'000) text += " and gap \u2264 0.5" + std::string(100, ' ');
    try {
        const EventFilter filter(text);
        FAIL();
    } catch (const FilterError& error) {
        const std::string shown = with_caret(text, error);
        EXPECT_LT(shown.size(), 400u);
        EXPECT_LT(std::string(error.what()).size(), 200u);
        const std::size_t line = shown.find('\n');
        const std::size_t caret = shown.size() - line - 2;  // blanks before it
        std::vector<char32_t> characters = code_points(shown.substr(0, line));
        ASSERT_LT(caret, characters.size());
        EXPECT_EQ(characters[caret], U'l');
        EXPECT_EQ(characters.front(), U'\u2026');
        EXPECT_EQ(characters.back(), U'\u2026');
    }
}

TEST(EventFilter, CompletesWhatIsBegun) {
    const auto words = [](std::string_view text) { return completion_of(event_field_table(), text).words; };
    EXPECT_EQ(words("ga"), std::vector<std::string>{"gap"});
    EXPECT_EQ(words("gap < 1 a"), std::vector<std::string>{"and"});
    EXPECT_EQ(words("outcome = s"), std::vector<std::string>{"separated"});
    EXPECT_EQ(words("gap "), (std::vector<std::string>{"=", "!=", "<", "<=", ">", ">="}));
    EXPECT_EQ(words("lev"), (std::vector<std::string>{"level(a)", "level(b)"}));
    EXPECT_EQ(completion_of(event_field_table(), "gap < 1 and le").from, 12u);
    EXPECT_TRUE(words("nonsense and ga").empty()) << "what comes before is to be mended first";
    // Whatever is proposed goes on to a filter, or is one.
    for (const std::string& word : words("")) {
        const std::string text = word;
        EXPECT_TRUE(refusal<EventFilter>(text).empty() || !words(text + ' ').empty() || word == "not" || word == "(")
            << word;
    }
}

}  // namespace
}  // namespace mobbscope
