// GoogleTest, of docs/test_frameworks.md.
#include <gtest/gtest.h>
#include <mobbscope/picture_tests.h>

TEST(Crowd, PersonStands) { EXPECT_PICTURE("person.json", "person"); }
