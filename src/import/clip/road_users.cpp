#include <base/text.h>
#include <import/clip/radii.h>
#include <import/clip/road_users.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace mobbscope {

namespace {

constexpr double kOnFoot = 8;    // m/s: sprinters are faster, for seconds
constexpr double kByMotor = 75;  // on a motorway

/// The first that fits counts.
constexpr RoadUser kRoadUsers[] = {
    {"motorcycl", kByMotor, 1.1, 0.8},
    {"motorbik", kByMotor, 1.1, 0.8},
    {"moped", kByMotor, 1, 0.7},
    {"motor", kByMotor},
    {"ped", kOnFoot, kDefaultTrackRadius},
    {"person", kOnFoot, kDefaultTrackRadius},
    {"people", kOnFoot, kDefaultTrackRadius},
    {"human", kOnFoot, kDefaultTrackRadius},
    {"child", kOnFoot, kDefaultTrackRadius},
    {"adult", kOnFoot, kDefaultTrackRadius},
    {"walk", kOnFoot, kDefaultTrackRadius},
    {"skat", 20, 0.3},
    {"scoot", 20, 0.6, 0.6},
    {"bik", 20, 0.9, 0.6},
    {"cycl", 20, 0.9, 0.6},
    {"robot", 20},
    {.word = "agv", .fastest = 20, .is_whole = true},
    {.word = "drone", .fastest = 40, .flies = true},
    {.word = "uav", .fastest = 40, .is_whole = true, .flies = true},
    {"cart", 20, 1.2, 1.2, true},
    {"car", kByMotor, 2.25, 1.8, true},
    {"taxi", kByMotor, 2.25, 1.8},
    {"auto", kByMotor, 2.25, 1.8, true},
    {"van", kByMotor, 2.75, 2, true},
    {"truck", kByMotor, 5, 2.55},
    {"lorr", kByMotor, 5, 2.55},
    {"heavy", kByMotor, 5, 2.55},
    {"bus", kByMotor, 6, 2.55, true},
    {"buses", kByMotor, 6, 2.55, true},
    {"tram", kByMotor, 15, 2.4},
    {"train", 110, 0, 0, true},
    {"railway", 110},
    {"trailer", kByMotor},
    {"vehicle", kByMotor, 2.25, 1.8},
};

/// In small letters.
bool is_of(std::string_view label, const RoadUser& user) {
    const auto is_letter = [&](std::size_t at) { return at < label.size() && label[at] >= 'a' && label[at] <= 'z'; };
    const std::string_view word = user.word;
    for (std::size_t at = label.find(word); at != std::string_view::npos; at = label.find(word, at + 1)) {
        std::size_t end = at + word.size();
        if (end < label.size() && label[end] == 's') ++end;
        if (!user.is_whole || ((at == 0 || !is_letter(at - 1)) && !is_letter(end))) return true;
    }
    return false;
}

}  // namespace

const RoadUser* road_user(std::string_view label) {
    const std::string small = lower(label);
    const auto* const at = std::ranges::find_if(kRoadUsers, [&](const RoadUser& user) { return is_of(small, user); });
    return at == std::end(kRoadUsers) ? nullptr : at;
}

}  // namespace mobbscope
