// Numbers are found in sentences, with their digits; names with digits are not.
#include <base/numbers_in_text.h>

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

std::vector<double> values(std::string_view text, std::vector<double> exact = {}) {
    std::vector<double> out;
    for (const NumberInText& number : ShownNumbers(std::move(exact)).in(text)) out.push_back(number.value);
    return out;
}

using Values = std::vector<double>;

TEST(NumbersInText, AreFoundInSentences) {
    EXPECT_EQ(values("They never collide: at least 0.183 m apart, at 2.4 s."), (Values{0.183, 2.4}));
    EXPECT_EQ(values("1.200..1.533 s"), (Values{1.2, 1.533}));
    EXPECT_EQ(values("-0.500, +2 m"), (Values{-0.5, 2}));
    EXPECT_EQ(values("6..10 (5)"), (Values{6, 10, 5}));
    EXPECT_EQ(values("1.2e+07 ns and 3e-05"), (Values{1.2e7, 3e-5}));
    EXPECT_EQ(values("steps 3-5"), (Values{3, 5})) << "a dash is not a sign";
    EXPECT_EQ(values(""), Values{});
    EXPECT_EQ(values("131,072 of 5,321,004 placements"), (Values{131072, 5321004})) << "large counts are in groups";
    EXPECT_EQ(values("3,4 and 1234,567 and 1,2345"), (Values{3, 4, 1234, 567, 1, 2345})) << "these are not";
}

TEST(NumbersInText, LargeCountsAreInGroups) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(131072), "131,072");
    EXPECT_EQ(grouped(5321004), "5,321,004");
}

TEST(NumbersInText, DigitsOfNamesAreNone) {
    EXPECT_EQ(values("walk4_subject1 against 07_05x"), Values{});
    EXPECT_EQ(values("obb2d, L7, 2D"), Values{});
    EXPECT_EQ(values("3D boxes: 13.9 tests x 14 ns"), (Values{13.9, 14}));
}

TEST(NumbersInText, HaveAllTheirDigits) {
    EXPECT_EQ(values("at 0.183 m", {2.5, 0.18320412345}), (Values{0.18320412345}));
    EXPECT_EQ(values("at 0.183 m", {0.1836}), (Values{0.183})) << "that is shown as 0.184";
    EXPECT_EQ(values("1.200, 1.200 m", {1.2004, 1.1996}), (Values{1.2004, 1.1996})) << "in their order";
    EXPECT_EQ(values("938 ns", {937.6}), (Values{937.6}));
    EXPECT_EQ(values("1.24e+04", {12437.5}), (Values{12437.5}));
    EXPECT_EQ(values("-0.500", {-0.50049}), (Values{-0.50049}));
    // From one text to the next.
    ShownNumbers numbers({1.2001, 1.2002});
    EXPECT_EQ(numbers.in("1.200").front().value, 1.2001);
    EXPECT_EQ(numbers.in("1.200").front().value, 1.2002);
    EXPECT_EQ(numbers.in("1.200").front().value, 1.2);
}

TEST(NumbersInText, HaveTheirUnits) {
    const std::string text = "0.183 m, 2 m/s, 4 m\u00B2\u00B7s, 27 %, 90\u00B0, 12 samples, 5 ns";
    std::vector<std::string> units;
    for (const NumberInText& number : ShownNumbers().in(text)) units.push_back(number.unit);
    EXPECT_EQ(units, (std::vector<std::string>{"m", "m/s", "m\u00B2\u00B7s", "%", "\u00B0", "", "ns"}));
    const NumberInText first = ShownNumbers().in(text).front();
    EXPECT_EQ(text.substr(first.begin, first.end - first.begin), "0.183");
}

}  // namespace
}  // namespace mobbscope
