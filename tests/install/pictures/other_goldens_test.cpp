// A file of the same program whose goldens are elsewhere.
#undef MOBBSCOPE_GOLDENS
#define MOBBSCOPE_GOLDENS "elsewhere"
#include <gtest/gtest.h>
#include <mobbscope/picture_tests.h>

TEST(OtherGoldens, AreThoseOfTheFile) { EXPECT_EQ(mobbscope::picture_options().goldens, "elsewhere"); }
