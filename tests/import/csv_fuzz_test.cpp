// Damaged CSV files give clips or an InputError, nothing else, and soon.
#include <base/error.h>
#include <import/tracks/csv.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

TEST(CsvFuzz, DamagedFilesAreReadOrRefused) {
    const std::string seeds[] = {
        "t,x,y,r\n0,0,0,0.4\n0.1,0.05,0.01,0.42\n0.2,0.11,0.03,0.45\n0.35,0.18,0.04,0.43\n",
        "id,t,x,y,r\r\n1,0,0,0,0.4\r\n\"2\",0,1,1,0.4\r\n1,0.5,0,1,0.4\r\n\"2\",1,2,1,0.4\r\n",
        "\xef\xbb\xbf x , y , r\n 0 , 0 , 0.4 \n\n 1e-1 , -2.5 , 0.4\n",
    };
    std::mt19937 random(20240607);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 30'000; ++round) {
        const std::string text = testing::mutated(seeds[round % 3], random);
        ImportOptions options;
        if (round % 3 == 2 || round % 7 == 0) options.dt = 0.1;
        if (round % 5 == 0) options.trim = {0.05, 0.4};
        if (round % 5 == 1) options.origin = Origin::start_heading;
        try {
            csv_clips(parse_csv(text, "fuzz.csv"), "fuzz.csv", options);
            ++read;
        } catch (const InputError& error) {
            ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace mobbscope
