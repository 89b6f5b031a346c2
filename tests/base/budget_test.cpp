#include <base/budget.h>
#include <base/error.h>
#include <base/json.h>

#include <support/input_error.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace mobbscope {
namespace {

TEST(Budget, WhatIsSpentIsGivenBack) {
    const std::size_t before = Spent::all();
    {
        Spent spent;
        spent.add(1000, "its rows", "a.csv");
        EXPECT_EQ(Spent::all(), before + 1000);
        Spent moved = std::move(spent);
        EXPECT_EQ(Spent::all(), before + 1000);
        moved.cover(900, "its rows", "a.csv");
        EXPECT_EQ(moved.bytes(), 1000u) << "is covered already";
        moved.cover(1001, "its rows", "a.csv");
        EXPECT_EQ(moved.bytes(), 2000u) << "twice as much, so that it is seldom asked for";
        EXPECT_FALSE(moved.try_add(SIZE_MAX - 10));
        EXPECT_EQ(Spent::all(), before + 2000);
    }
    EXPECT_EQ(Spent::all(), before);
}

TEST(Budget, WhatIsTooMuchIsRefusedAndFilesRaiseIt) {
    Spent spent;
    spent.add(kFreeBytes, "its rows", "a.csv");
    EXPECT_EQ(input_error([&] {
                  spent.add(kBytesPerByteRead * 1'000'000'000, "its rows", "a.csv");
              }).find("a.csv: its rows would take more than "),
              0u);
    raise_budget(1'000'000);
    EXPECT_TRUE(spent.try_add(kBytesPerByteRead * 1'000'000));
}

TEST(Budget, ParsedJsonIsPaidFor) {
    const std::size_t before = Spent::all();
    std::string objects = "[{}";
    for (int i = 0; i < 1000; ++i) objects += ",{}";
    {
        const JsonText text = parse_json(objects + "]", "a.json");
        EXPECT_GT(Spent::all(), before + 500'000) << "each may become a query";
    }
    EXPECT_EQ(Spent::all(), before);
}

}  // namespace
}  // namespace mobbscope
