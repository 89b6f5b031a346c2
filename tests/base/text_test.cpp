#include <base/base64.h>
#include <base/markup.h>
#include <base/sentences.h>
#include <base/text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

namespace mobbscope {
namespace {

TEST(Text, NumbersAreWholeFiniteAndDecimal) {
    EXPECT_EQ(parse_double("0.25"), 0.25);
    EXPECT_EQ(parse_double("+1e-3"), 1e-3);
    for (const char* bad : {"", " 1", "1 ", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "1.5m", "+-1", "+"}) {
        EXPECT_FALSE(parse_double(bad)) << bad;
    }
    for (const char* tiny : {"1e-400", "0.00001e-330", "1e-99999999999999999999", "12345e-500"})
        EXPECT_EQ(parse_double(tiny), 0) << tiny;
    EXPECT_TRUE(std::signbit(*parse_double("-1e-400")));
    EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1"), 0);
    EXPECT_FALSE(parse_double("1" + std::string(400, '0')));
    EXPECT_FALSE(parse_double("0.00001e400"));
    EXPECT_FALSE(parse_double("1e99999999999999999999"));
    EXPECT_EQ(parse_int("-7"), -7);
    EXPECT_EQ(parse_int("010"), 10);
    EXPECT_FALSE(parse_int("7.0"));
    EXPECT_FALSE(parse_int("99999999999"));
}

TEST(Text, NumbersThatDifferAreToldApart) {
    const auto four = [](double value) { return figure(value); };
    EXPECT_EQ(told_apart(0.25, 0.5, four), (std::pair<std::string, std::string>("0.25", "0.5")));
    EXPECT_EQ(told_apart(1.209, 1.2094, four), (std::pair<std::string, std::string>("1.209", "1.2094")));
    EXPECT_EQ(told_apart(3, 3, to_thousandth), (std::pair<std::string, std::string>("3", "3")));
    EXPECT_EQ(told_apart(12.3451, 12.3452, to_thousandth), (std::pair<std::string, std::string>("12.3451", "12.3452")));
    std::mt19937_64 random(2);
    for (int i = 0; i < 1000; ++i) {
        const double value = std::ldexp(static_cast<double>(random() >> 11), -static_cast<int>(random() % 80));
        const auto [one, other] = told_apart(value, std::nextafter(value, 1e300), four);
        ASSERT_NE(one, other) << format_double(value);
    }
}

TEST(Text, SeventeenDigitsGiveTheSameDoubleBack) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 100'000; ++i) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value) || std::abs(value) < 1e-300) continue;
        ASSERT_EQ(parse_double(format_double(value)), value) << format_double(value);
    }
    EXPECT_EQ(format_double(0.1), "0.1");
    EXPECT_EQ(format_double(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(format_double(100000), "100000");
    EXPECT_EQ(format_double(0.00025), "0.00025");
    EXPECT_EQ(format_double(1e-9), "1e-09");
    EXPECT_EQ(format_double(2), "2");
    EXPECT_TRUE(std::signbit(*parse_double(format_double(-0.0))));
}

TEST(Text, PlainNumbersAreTheNearestDoubles) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 100'000; ++i) {
        // Of 1 to 20 digits, so that some are more than a double or an integer holds, with a point in any place.
        std::string text = std::to_string(random() >> (random() % 64));
        const std::size_t point = random() % (text.size() + 1);
        if (point < text.size()) text.insert(point, point == 0 ? "0." : ".");
        if (random() % 2 == 0) text.insert(0, "-");
        ASSERT_EQ(parse_double(text), std::strtod(text.c_str(), nullptr)) << text;
    }
    EXPECT_TRUE(std::signbit(*parse_double("-0")));
    EXPECT_EQ(parse_double("5."), 5);
    EXPECT_EQ(parse_double(".5"), 0.5);
    EXPECT_EQ(parse_double("007"), 7);
    for (const char* bad : {"-", ".", "-.", "1.2.3", "--1", "1-"}) EXPECT_FALSE(parse_double(bad)) << bad;
}

TEST(Text, PlainNumbersAreReadOffTheFront) {
    const auto length = [](std::string_view text) {
        double value = 0;
        return read_plain_double(text.data(), text.data() + text.size(), value) - text.data();
    };
    EXPECT_EQ(length("-12.25 7"), 6);
    EXPECT_EQ(length("12"), 2);
    EXPECT_EQ(length("1e5"), 1);  // what follows is for the caller to see
    EXPECT_EQ(length("9007199254740992"), 16);
    for (const char* none : {"", "-", "+1", ".5", "5.", "x", "9007199254740993", "0.0000000000000000001"})
        EXPECT_EQ(length(none), 0) << none;
}

TEST(Text, RangesHaveTwoNumbers) {
    EXPECT_EQ(parse_range("0.5:3"), (std::pair{0.5, 3.0}));
    for (const char* bad : {"", "1", "1:", ":2", "1:2:3", "a:b"}) EXPECT_FALSE(parse_range(bad)) << bad;
}

TEST(Text, Utf8IsToldFromOtherBytes) {
    for (const char* good : {"", "abc", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x9a\xb6", "\xed\x9f\xbf"})
        EXPECT_TRUE(is_utf8(good)) << good;
    for (const char* bad : {"caf\xe9", "\x80", "\xc3", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                            "\xff", "\xf8\x88\x80\x80"}) {
        EXPECT_FALSE(is_utf8(bad)) << bad;
    }
}

TEST(Text, QuotesAreShortAndOnOneLine) {
    EXPECT_EQ(in_quotes("a\nb"), R"('a\u000ab')");
    EXPECT_EQ(in_quotes("A" + std::string(10'000, 'x') + "Z"),
              "'A" + std::string(29, 'x') + "\u2026" + std::string(28, 'x') + "Z'");
    EXPECT_TRUE(is_utf8(in_quotes(std::string(10'000, '\xe9')))) << "whatever a file holds";
}

TEST(Text, FiguresForPeopleHaveFewDigits) {
    EXPECT_EQ(figure(6.33056), "6.331");
    EXPECT_EQ(figure(100), "100");
    EXPECT_EQ(figure(0.000123456), "0.0001235");
    EXPECT_EQ(figure(12345.6), "12346") << "all before the point";
    EXPECT_EQ(figure(1234.56, 3), "1235");
    EXPECT_EQ(figure(999.7, 3), "1000");
    EXPECT_EQ(figure(-99999.5, 3), "-100000");
    EXPECT_EQ(figure(1.5e12), "1.5e+12");
}

TEST(Text, WhatIsLongIsCutInTheMiddle) {
    EXPECT_EQ(shortened("walker", 10), "walker");
    EXPECT_EQ(shortened("recording number 17", 9), "reco\u2026r 17");
    EXPECT_EQ(shortened("\u00e9\u00e9\u00e9\u00e9\u00e9", 5), "\u00e9\u00e9\u00e9\u00e9\u00e9")
        << "characters, not bytes";
    EXPECT_EQ(shortened("\u00e9\u00e9\u00e9\u00e9\u00e9\u00e9", 5), "\u00e9\u00e9\u2026\u00e9\u00e9");
    EXPECT_EQ(shortened(std::string(100, '\x80'), 5), "\x80\x80\u2026\x80\x80") << "no UTF-8";
}

TEST(Text, WhatSteersATerminalIsCleaned) {
    EXPECT_EQ(cleaned("a\x1b[2J\r\n\t\x7f"), R"(a\u001b[2J\u000d\u000a\u0009\u007f)");
    EXPECT_EQ(cleaned("\xc2\x9b"
                      "1m \xc2\xa0\xc3\xa9"),
              "\\u009b1m \xc2\xa0\xc3\xa9");
    EXPECT_EQ(cleaned("caf\xe9\x1b"), "caf?\\u001b");
}

TEST(Text, WhatMisleadsTheEyeIsCleaned) {
    EXPECT_EQ(cleaned("walk\u202egpj.exe"), "walk\\u202egpj.exe");
    for (const char32_t code :
         {0xadU, 0x61cU, 0x200bU, 0x200dU, 0x200fU, 0x2028U, 0x2029U, 0x202aU, 0x2066U, 0x2069U, 0xfeffU}) {
        const std::string text{static_cast<char>(code < 0x800 ? 0xc0 | code >> 6 : 0xe0 | code >> 12),
                               static_cast<char>(0x80 | (code < 0x800 ? code & 0x3f : code >> 6 & 0x3f)),
                               static_cast<char>(0x80 | (code & 0x3f))};
        EXPECT_EQ(cleaned(text.substr(0, code < 0x800 ? 2 : 3)), formatted("\\u%04x", static_cast<unsigned>(code)));
    }
    EXPECT_EQ(cleaned("\U000e0041"), R"(\udb40\udc41)");
    EXPECT_EQ(cleaned("\u05d0\u2026\u2190\ufffd\U0001f6b6"), "\u05d0\u2026\u2190\ufffd\U0001f6b6");
}

TEST(Text, TheNearestNameIsFoundAndOnlyNamedWhenMeant) {
    const std::vector<std::string> names{"leaf", "levels", "axes"};
    EXPECT_EQ(nearest("level", names), "levels");
    EXPECT_EQ(did_you_mean("laef", names), " (did you mean 'leaf'?)");
    EXPECT_EQ(did_you_mean(std::string(5000, 'x'), names), "");
    EXPECT_EQ(did_you_mean("quixotic", names), "");
    EXPECT_EQ(nearest("tpo", std::vector<std::string>{"iso", "top"}), "top") << "two letters that changed places";
}

TEST(Base64, ReadsWhatItWrites) {
    std::string bytes;
    for (int i = 0; i < 300; ++i) {
        EXPECT_EQ(from_base64(base64(bytes)), bytes);
        bytes += static_cast<char>(i * 37);
    }
    for (const char* bad : {"A", "AB=C", "A===", "====", "AA A", "AAA\n"}) EXPECT_FALSE(from_base64(bad)) << bad;
}

TEST(Markup, EverythingThatMeansSomethingIsEscaped) {
    EXPECT_EQ(escaped("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
    EXPECT_EQ(escaped(std::string("a\0b\x1b\n", 5)), R"(a\u0000b\u001b\u000a)");
    EXPECT_EQ(escaped("a\u202eb"), "a\\u202eb");
    EXPECT_EQ(escaped("\xff"), "?");
    EXPECT_EQ(escaped("\xef\xbf\xbe\xef\xbf\xbd\xef\xbf\xbf"), "?\xef\xbf\xbd?");
    EXPECT_EQ(escaped("\xc3\xa9"), "\xc3\xa9");
}

}  // namespace
}  // namespace mobbscope
