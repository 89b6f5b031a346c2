// doctest, of docs/test_frameworks.md.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
#include <mobbscope/picture_tests.h>

TEST_CASE("a person stands") { EXPECT_PICTURE("person.json", "person"); }
