// The tables of kinds: what they say of every kind of box, test and tree.
#include <mobb/trace.h>
#include <mobb/tree.h>

#include <gtest/gtest.h>

#include <set>

namespace mobb {
namespace {

TEST(Kinds, EveryRowSaysAllThatPeopleRead) {
    for (const BoxKind kind : kBoxKinds) {
        const BoxInfo& row = info(kind);
        EXPECT_FALSE(row.title.empty() || row.plural.empty() || row.heading.empty() || row.test.empty()) << row.name;
        EXPECT_TRUE(row.in_paper || !row.looks.empty()) << row.name;
    }
    for (const TreeKind kind : kTreeKinds) {
        const TreeInfo& row = info(kind);
        EXPECT_FALSE(row.title.empty() || row.label.empty() || row.help.empty()) << row.name;
    }
}

TEST(Kinds, NamesTellThemApartAndAreRead) {
    std::set<std::string_view> trees, tests;
    for (const TreeKind kind : kTreeKinds) {
        EXPECT_TRUE(trees.insert(name(kind)).second) << name(kind);
        EXPECT_EQ(tree_kind_from_name(name(kind)), kind);
    }
    for (const TestKind test : kTestKinds) {
        EXPECT_TRUE(tests.insert(name(test)).second) << name(test);
        EXPECT_EQ(test_from_name(name(test)), test);
        EXPECT_EQ(kTestKinds[test.index()], test);
    }
    EXPECT_EQ(tests.size(), kBoxKinds.size() + 2);
    EXPECT_FALSE(test_from_name("blocks"));
}

TEST(Kinds, OnlyFreeBoxesUseTheTimeScaleAndAabbsAndBlocksHaveNoAxesToChoose) {
    for (const TreeKind kind : {TreeKind::umobb, TreeKind::hybrid1, TreeKind::hybrid2}) {
        EXPECT_TRUE(info(kind).uses_time_scale() && info(kind).chooses_axes()) << name(kind);
    }
    for (const TreeKind kind : {TreeKind::mobb, TreeKind::moving}) {
        EXPECT_TRUE(!info(kind).uses_time_scale() && info(kind).chooses_axes()) << name(kind);
    }
    for (const TreeKind kind : {TreeKind::aabb, TreeKind::blocks}) {
        EXPECT_TRUE(!info(kind).uses_time_scale() && !info(kind).chooses_axes()) << name(kind);
    }
}

TEST(Kinds, ATestHasAsManyAxesAsTheContractSays) {
    EXPECT_EQ(axis_count(BoxKind::obb2d), 4);
    EXPECT_EQ(axis_count(BoxKind::obb3d), 15);
    EXPECT_EQ(axis_count(BoxKind::moving), 4);
    EXPECT_EQ(axis_count(BoxKind::aabb), 2);
    EXPECT_EQ(axis_count(BoxKind::block), 1);
    EXPECT_EQ(axis_count(TestKind::time), 0);
    EXPECT_EQ(axis_count(TestKind::samples), 0);
}

}  // namespace
}  // namespace mobb
