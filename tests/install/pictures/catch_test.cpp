// Catch2, of docs/test_frameworks.md.
#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#else
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
#include <mobbscope/picture_tests.h>

TEST_CASE("a person stands") { EXPECT_PICTURE("person.json", "person"); }
