// Conflicts of the project's recordings and plans, held against a search of its own.
#include "run_program.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// Somebody's rows of a converted crowd.
struct ConvertedRow {
    double t, x, y, r;
};
using ConvertedCrowd = std::map<std::string, std::vector<ConvertedRow>>;

ConvertedCrowd read_converted(const std::string& csv) {
    ConvertedCrowd out;
    std::istringstream text(csv);
    std::string line, id;
    std::getline(text, line);
    if (!line.starts_with("id,")) return out;
    double last = 0, step = 0;
    while (std::getline(text, line)) {
        ConvertedRow row{};
        const std::size_t comma = line.find(',');
        EXPECT_EQ(std::sscanf(line.c_str() + comma, ",%lf,%lf,%lf,%lf", &row.t, &row.x, &row.y, &row.r), 4) << line;
        if (line.substr(0, comma) == id) step = row.t - last;
        last = row.t;
        out[id = line.substr(0, comma)].push_back(row);
    }
    // A row alone is there for a step.
    for (auto& [name, rows] : out) {
        if (rows.size() == 1) rows.push_back({rows[0].t + step, rows[0].x, rows[0].y, rows[0].r});
    }
    return out;
}

using Times = std::vector<std::pair<double, double>>;

/// When two who run straight from row to row, and are gone after their last one, overlap.
Times overlaps_of(const std::vector<ConvertedRow>& a, const std::vector<ConvertedRow>& b) {
    Times out;
    const auto at = [](const std::vector<ConvertedRow>& rows, std::size_t i, double t) {
        const double s = (t - rows[i].t) / (rows[i + 1].t - rows[i].t);
        const auto mixed = [s](double from, double to) { return from + s * (to - from); };
        return ConvertedRow{t, mixed(rows[i].x, rows[i + 1].x), mixed(rows[i].y, rows[i + 1].y),
                            mixed(rows[i].r, rows[i + 1].r)};
    };
    for (std::size_t i = 0, j = 0; i + 1 < a.size() && j + 1 < b.size();) {
        const double begin = std::max(a[i].t, b[j].t), end = std::min(a[i + 1].t, b[j + 1].t);
        if (end > begin) {
            const auto p = at(a, i, begin), q = at(b, j, begin), p1 = at(a, i, end), q1 = at(b, j, end);
            const double x = p.x - q.x, y = p.y - q.y, r = p.r + q.r;
            const double vx = p1.x - q1.x - x, vy = p1.y - q1.y - y;
            // |d + s v| = r in two moments s, if at all; all have one radius.
            const double vv = vx * vx + vy * vy, dv = x * vx + y * vy, inside = dv * dv - vv * (x * x + y * y - r * r);
            double from = 0, to = 1;
            if (vv > 1e-18) {
                const double root = std::sqrt(std::max(inside, 0.0));
                from = std::max(from, (-dv - root) / vv);
                to = inside > 0 ? std::min(to, (-dv + root) / vv) : 0;
            } else if (x * x + y * y >= r * r) {
                to = 0;
            }
            if (to > from) {
                const double first = begin + from * (end - begin), last = begin + to * (end - begin);
                if (!out.empty() && first - out.back().second < 1e-8) {
                    out.back().second = last;
                } else {
                    out.emplace_back(first, last);
                }
            }
        }
        a[i + 1].t < b[j + 1].t ? ++i : ++j;
    }
    return out;
}

/// Whether a list of conflicts is that of a search over all segments of all pairs.
void expect_exact(const json& found, const ConvertedCrowd& crowd) {
    constexpr double kHair = 1e-6;  // seconds: what is shorter may go either way
    std::map<std::pair<std::string, std::string>, Times> listed;
    for (const json& conflict : found["conflicts"]) {
        const std::string a = conflict["a"], b = conflict["b"];
        Times& times = listed[std::minmax(a, b)];
        for (const json& interval : conflict["intervals"]) times.emplace_back(interval[0], interval[1]);
    }
    for (auto a = crowd.begin(); a != crowd.end(); ++a) {
        for (auto b = std::next(a); b != crowd.end(); ++b) {
            Times expected = overlaps_of(a->second, b->second);
            Times& times = listed[{a->first, b->first}];
            for (Times* of : {&expected, &times})
                std::erase_if(*of, [](const auto& time) { return time.second - time.first < kHair; });
            ASSERT_EQ(times.size(), expected.size()) << a->first << " and " << b->first;
            for (std::size_t k = 0; k < times.size(); ++k) {
                EXPECT_NEAR(times[k].first, expected[k].first, kHair) << a->first << " and " << b->first;
                EXPECT_NEAR(times[k].second, expected[k].second, kHair) << a->first << " and " << b->first;
            }
        }
    }
}

/// Nobody runs so fast: who is said to is somebody else, or was not seen.
TEST(ConflictsData, NoPeopleMeetUnmarkedInAStepThatIsTooFastForThem) {
    const std::filesystem::path data = kSharedData / "trajectories";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    constexpr double kFastest = 8 + 1e-6;
    std::size_t steps = 0, marked = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data)) {
        if (!entry.is_regular_file()) continue;
        const std::string file = entry.path().string();
        SCOPED_TRACE(entry.path().filename());
        const bool in_pixels = file.find("sdd_") != std::string::npos;
        // Where a pixel counts as a metre all is too fast.
        for (const std::vector<std::string>& options :
             {std::vector<std::string>{"--radius", in_pixels ? "15" : "0.3"}, {"--radius", "0.5", "--unit", "0.04"}}) {
            if (!in_pixels && options.size() > 2) continue;
            std::vector<std::string> ask{"conflicts", file, "--json"}, tell{"info", file, "--json"};
            ask.insert(ask.end(), options.begin(), options.end());
            tell.insert(tell.end(), options.begin(), options.end());
            const TempFolder folder;
            const std::string csv = folder.path() / "crowd.csv";
            std::vector<std::string> write{"convert", file, "-o", csv};
            write.insert(write.end(), options.begin(), options.end());
            ASSERT_EQ(run_program(write).status, 0);
            const ConvertedCrowd crowd = read_converted(slurp(csv));
            std::map<std::string, std::string> classes;
            const json info = json::parse(run_program(tell).out);
            if (info["clips"][0]["format"] == "mapf") continue;
            for (const json& clip : info["clips"])
                classes[clip["name"]] = clip["class"].is_string() ? clip["class"].get<std::string>() : "";
            const json found = json::parse(run_program(ask).out);
            for (const json& conflict : found["conflicts"]) {
                marked += conflict.contains("invented");
                if (conflict.contains("invented")) continue;
                for (const auto& [who, sample] : {std::pair("a", "a_sample"), {"b", "b_sample"}}) {
                    const std::string name = conflict[who];
                    if (!classes[name].empty() && classes[name] != "Pedestrian") continue;
                    const std::vector<ConvertedRow>& rows = crowd.at(name);
                    const auto at = std::min(conflict[sample].get<std::size_t>(), rows.size() - 2);
                    const double way = std::hypot(rows[at + 1].x - rows[at].x, rows[at + 1].y - rows[at].y);
                    EXPECT_LE(way / (rows[at + 1].t - rows[at].t), kFastest) << conflict;
                    ++steps;
                }
            }
        }
    }
    EXPECT_GT(steps, 100u);
    EXPECT_GT(marked, 0u);
}

TEST(ConflictsData, EveryTrajectoryFileIsAsAnExactSearchHasIt) {
    const std::filesystem::path data = kSharedData / "trajectories";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    std::size_t files = 0;
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
        if (!entry.is_regular_file()) continue;
        const std::string file = entry.path().string();
        SCOPED_TRACE(entry.path().filename());
        // Pixels and cells are wider than metres.
        const std::string radius = file.find("sdd_") != std::string::npos ? "10" : "0.3";
        const json direct = json_of({"conflicts", file, "--radius", radius, "--tree", "brute"});
        for (const std::string tree : {"mobb", "umobb"}) {
            const json trees = json_of({"conflicts", file, "--radius", radius, "--tree", tree});
            EXPECT_EQ(trees["conflicts"], direct["conflicts"]) << tree;
            EXPECT_LE(trees["pairs_tested"], direct["pairs_tested"]);
        }
        const TempFolder folder;
        const std::string csv = folder.path() / "crowd.csv";
        ASSERT_EQ(run_program({"convert", file, "--radius", radius, "-o", csv}).status, 0);
        const ConvertedCrowd crowd = read_converted(slurp(csv));
        EXPECT_EQ(crowd.size(), crowd.empty() ? 0 : direct["agents"].get<std::size_t>());
        expect_exact(direct, crowd);
        found += direct["conflicts"].size();
        ++files;
    }
    EXPECT_EQ(files, 13u);
    EXPECT_GT(found, 200u);
}

}  // namespace
}  // namespace mobbscope
