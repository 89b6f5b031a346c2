// Damaged CSV files give clips or an InputError, nothing else, and soon.
#include <base/error.h>
#include <import/tracks/text_rows.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

#include <iterator>

namespace mobbscope {
namespace {

TEST(CsvFuzz, DamagedFilesAreReadOrRefused) {
    const std::string seeds[] = {
        "t,x,y,r\n0,0,0,0.4\n0.1,0.05,0.01,0.42\n0.2,0.11,0.03,0.45\n0.35,0.18,0.04,0.43\n",
        "id,t,x,y,r\r\n1,0,0,0,0.4\r\n\"2\",0,1,1,0.4\r\n1,0.5,0,1,0.4\r\n\"2\",1,2,1,0.4\r\n",
        "\xef\xbb\xbf x , y , r\n 0 , 0 , 0.4 \n\n 1e-1 , -2.5 , 0.4\n",
        "# framerate: 5\nframe,id,x,y,width,height,kind\n1,7,0,0,4,2,car\n2,7,0,1,4,2,\n2,8,1,1,4,2,\"a, b\"\n",
        "\ttrack_id\ttime [ms]\tx_cm\ty_cm\n0\t1\t0\t1,5\t2\n1\t1\t100\t1,5\t2\n2\t2\t0\t9\t9\n",
    };
    std::mt19937 random(20240607);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 30'000; ++round) {
        const std::string text = mutated(seeds[static_cast<std::size_t>(round) % std::size(seeds)], random);
        ImportOptions options;
        if (round % 5 == 2 || round % 7 == 0) options.dt = 0.1;
        if (round % 13 == 0) options.columns = "x=y*2-x/y,r=(x+1)*(x+1)";
        if (round % 5 == 0) options.trim = {0.05, 0.4};
        if (round % 5 == 1) options.origin = Origin::start_heading;
        try {
            track_clips(parse_csv(text, "fuzz.csv", options), "fuzz.csv", options);
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
