// What a command reads, packed or not, large or small, whole or in pieces.
#include <base/file.h>
#include <base/input.h>

#include <support/gzip.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// More than is held in memory.
std::string much() {
    std::string out;
    for (int i = 0; out.size() < (std::size_t{5} << 20); ++i) out += "line " + std::to_string(i) + '\n';
    return out;
}

std::string read_on(const TextPieces& more) {
    std::string out;
    while (more(out)) {
    }
    return out;
}

TEST(Input, IsTheSameWholeAndInPiecesAnyNumberOfTimes) {
    const TempFolder folder;
    const std::string text = much();
    for (const std::string& bytes : {std::string(), std::string("\x1f"), std::string("a\n"), text}) {
        const Input plain = Input::open(folder.write("plain", bytes));
        const Input packed = Input::open(folder.write("packed", gzipped(bytes)));
        for (const Input& input : {plain, packed, Input(bytes), Input(gzipped(bytes))}) {
            for (int time = 0; time < 2; ++time) {
                EXPECT_TRUE(input.all().bytes == bytes);
                EXPECT_TRUE(read_on(input.pieces()) == bytes);
                EXPECT_EQ(input.beginning(10), bytes.substr(0, 10));
            }
        }
        EXPECT_EQ(read_beginning(folder.path() / "packed", 10), bytes.substr(0, 10));
    }
}

TEST(Input, StaysWhatItWasWhenItsFileIsReplaced) {
    const TempFolder folder;
    const std::string text = much();
    const auto file = folder.write("a", text);
    const Input input = Input::open(file);
    std::filesystem::remove(file);
    EXPECT_TRUE(input.all().bytes == text);
}

TEST(Input, TellsInPiecesWhatIsWrong) {
    const std::string packed = gzipped(much());
    for (const auto& [bytes, words] : std::initializer_list<std::pair<std::string, const char*>>{
             {packed.substr(0, packed.size() / 2), "ends within what gzip packed; get the whole file"},
             {packed + "more", "other bytes follow what gzip packed"},
             {packed + std::string(300'000, '\0') + "more", "other bytes follow what gzip packed"}}) {
        const Input input(bytes);
        EXPECT_NE(input_error([&] { read_on(input.pieces()); }).find(words), std::string::npos) << words;
    }
    const Input padded(packed + std::string(300'000, '\0'));
    EXPECT_TRUE(read_on(padded.pieces()) == much());
    const Input twice(packed + packed);
    EXPECT_TRUE(read_on(twice.pieces()) == much() + much());
}

TEST(TextLines, OfPiecesPayForTheLongest) {
    const std::string file = "f";
    constexpr std::size_t kLong = 1 << 20;
    const std::size_t before = Spent::all();
    {
        int pieces = 0;
        TextLines lines(
            [&pieces](std::string& to) {
                to.append(kLong, 'x');
                return ++pieces <= 4;
            },
            file);
        EXPECT_TRUE(lines.next());
        ASSERT_GE(Spent::all(), before + 4 * kLong);
        Spent others;
        for (std::size_t size = std::size_t{1} << 40; size >= kLong; size /= 2) {
            while (others.try_add(size)) {
            }
        }
        EXPECT_NE(input_error([&] {
                      TextLines endless([](std::string& to) { return !to.append(kLong, 'x').empty(); }, file);
                      endless.next();
                  }).find("f: a line would take more than"),
                  std::string::npos);
    }
    EXPECT_EQ(Spent::all(), before);
}

TEST(TextLines, JoinInTimeThatGrowsWithThem) {
    // Minutes, were the blanks looked at again for each line.
    constexpr std::size_t kMany = 300'000;
    const std::string file = "f", text = std::string(kMany, ' ') + "a" + std::string(kMany, '\n') + "b\nc\n";
    TextLines lines(text, file);
    ASSERT_TRUE(lines.next());
    for (std::size_t i = 0; i < kMany; ++i) ASSERT_TRUE(lines.join());
    EXPECT_EQ(lines.line(), "a" + std::string(kMany, '\n') + "b");
    EXPECT_EQ(lines.number(), 1);
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "c");
    EXPECT_EQ(lines.number(), 2 + static_cast<int>(kMany));
}

TEST(TextLines, AreTheSameOfPiecesOfAnySize) {
    using namespace std::string_literals;
    for (const std::string& text : {""s, "\n"s, "\xef\xbb\xbf a \r\n\n# b\nlast"s, "one"s, "\r\n \n x\ty \n"s}) {
        const auto all_of = [](TextLines& lines) {
            std::vector<std::string> out{lines.empty() ? "empty" : ""};
            while (lines.next())
                out.push_back(std::to_string(lines.number()) + std::string(lines.line()) + '|' +
                              std::string(lines.whole_line()));
            return out;
        };
        const std::string file = "f";
        TextLines whole(text, file);
        const auto expected = all_of(whole);
        // The mark, and the first line's end, are looked for in the first piece.
        for (const std::size_t size : {std::size_t{4}, std::size_t{5}, std::size_t{100}}) {
            std::size_t at = 0;
            TextLines pieces(
                [&](std::string& to) {
                    const std::string piece = text.substr(at, size);
                    to += piece;
                    at += piece.size();
                    return !piece.empty();
                },
                file);
            EXPECT_EQ(all_of(pieces), expected) << size << ' ' << text;
        }
    }
}

}  // namespace
}  // namespace mobbscope
