// TrajNet++: a JSON object a line (vita-epfl/trajnetplusplustools, "Data format").
#include <import/tracks/tracks.h>
#include <mobb/clip.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

using Json = nlohmann::json;

constexpr double kUsualRate = 2.5;  // points per second of TrajNet++

class TrajnetppParser {
  public:
    TrajnetppParser(std::string_view text, const std::string& file) : lines_(text, file), file_(file) {}

    TrackFile parse() {
        while (lines_.next()) read_line();
        if (tracks_.empty() && predictions_ > 0) {
            throw InputError(file_, "",
                             "holds predictions of TrajNet++ alone, " + counted(predictions_, "point", "points") +
                                 ": give the file with the recorded tracks that they were made from, or, to see one "
                                 "prediction, its lines without prediction_number");
        }
        if (tracks_.empty())
            lines_.fail(R"(the file has no track; give lines such as {"track": {"f": 0, "p": 1, "x": 0.5, "y": 2}})");
        TrackFile out;
        out.format = "trajnetpp";
        out.tracks = tracks_.take_sorted();
        out.spent = tracks_.take_spent();
        out.rate = rate_.value_or(kUsualRate);
        out.rate_of_steps = true;
        out.least_step = 10;
        if (!rate_) {
            out.rate_assumption =
                "no scene says its fps: 2.5 points a second are assumed; give dt (seconds a frame) if that is wrong";
        }
        if (predictions_ > 0) {
            out.warnings.push_back({counted(predictions_, "predicted point is", "predicted points are") +
                                    " ignored; only what was recorded is used"});
        }
        return out;
    }

  private:
    void read_line() {
        // Whatever stands in it: brackets become 64 bytes each. It is given back with the line.
        constexpr std::size_t kOfByte = 64;
        Spent spent;
        spent.add(kOfByte * lines_.line().size(), "a line", file_);
        const Json line = Json::parse(lines_.line(), nullptr, false);
        if (line.is_discarded()) lines_.fail("is not JSON; give one object a line");
        if (line.is_object() && line.contains("track")) {
            read_track(object(line, "track"));
        } else if (line.is_object() && line.contains("scene")) {
            read_scene(object(line, "scene"));
        } else {
            lines_.fail(R"(is neither {"scene": {...}} nor {"track": {...}}; remove it)");
        }
    }

    const Json& object(const Json& line, const char* key) const {
        const Json& value = line[key];
        if (!value.is_object()) lines_.fail(in_quotes(key) + " must be an object");
        return value;
    }

    void read_scene(const Json& scene) {
        if (!scene.contains("fps")) return;
        const double fps = number(scene, "fps", kMaxFrameRate);
        if (fps <= 0) lines_.fail("fps must be over 0");
        if (rate_ && *rate_ != fps) {
            lines_.fail("the scene has " + brief(fps) + " points a second, those before it " + brief(*rate_) +
                        "; put them in files of their own");
        }
        rate_ = fps;
    }

    void read_track(const Json& track) {
        if (track.contains("prediction_number") && !track["prediction_number"].is_null()) {
            ++predictions_;
            return;
        }
        const double frame = number(track, "f", kMaxFrame);
        if (frame != std::floor(frame)) lines_.fail("f is not a whole number; frames are");
        tracks_.add(person(track), {frame, number(track, "x", mobb::kMaxLength), number(track, "y", mobb::kMaxLength),
                                    lines_.number()});
    }

    /// Who it is: a whole number, or a name.
    std::string person(const Json& track) const {
        if (track.contains("p") && track["p"].is_string() && !track["p"].get_ref<const std::string&>().empty())
            return track["p"].get<std::string>();
        const double id = number(track, "p", kMaxFrame);
        if (id != std::floor(id)) lines_.fail("p is not a whole number; give one, or a name in quotes");
        return std::to_string(static_cast<long long>(id));
    }

    double number(const Json& object, const char* key, double largest) const {
        const auto at = object.find(key);
        if (at == object.end()) lines_.fail("there is no " + std::string(key) + "; add it");
        if (!at->is_number()) lines_.fail(std::string(key) + " must be a number");
        const double value = at->get<double>();
        if (!(std::abs(value) <= largest))
            lines_.fail(std::string(key) + " is beyond " + format_double(largest) + "; check it");
        return value;
    }

    TextLines lines_;
    const std::string& file_;
    TrackCollector tracks_{file_};
    std::optional<double> rate_;
    int predictions_ = 0;
};

}  // namespace

bool looks_like_trajnetpp(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\xef\xbb\xbf"), text.size()));
    if (!text.starts_with('{')) return false;
    text.remove_prefix(1);
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    return text.starts_with("\"track\"") || text.starts_with("\"scene\"");
}

TrackFile parse_trajnetpp(std::string_view text, const std::string& file) {
    return TrajnetppParser(text, file).parse();
}

}  // namespace mobbscope
