#include <explain/fit_sweep.h>
#include <gtest/gtest.h>
TEST(FitSweep, X) {}
