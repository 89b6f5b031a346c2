// Trajectories in columns: which of four formats a text is, and its rows.
#include <base/median.h>
#include <import/clip/column_names.h>
#include <import/clip/sampling.h>
#include <import/tracks/remarks.h>
#include <import/tracks/tracks.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kAnnotationRate = 2.5;  // per second: UCY, ETH and TrajNet, whatever the camera's rate
constexpr double kHermesRate = 16;       // frames per second of the Hermes recordings, which come without a header
constexpr double kDroneRate = 30;        // frames per second of the Stanford Drone Dataset
// Heads are so high, in metres; standing children and adults on stairs included.
constexpr double kLowestHead = 0.8;
constexpr double kHighestHead = 2.5;
constexpr double kHeadHeight = 1.7;  // metres: the contract's, for the unit "auto"

/// Which column is which, from 0; -1: there is none.
struct Columns {
    std::string format;
    std::size_t count = 0;  ///< in a row
    int id = -1, frame = -1, x = -1, y = -1, z = -1;
    int r = -1, a = -1, b = -1;  ///< a radius, or the semi-axes of an ellipse
    bool timed = false;          ///< `frame` holds seconds
};

/// The corners of a box in the image, and whether the annotators had lost it.
enum SddColumn { kXMin = 1, kYMin, kXMax, kYMax, kSddFrame, kLost, kLabel = 9 };

const Columns kObsmat{"obsmat", 8, 1, 0, 2, 4};
const Columns kTrajnet{"trajnet", 4, 1, 0, 2, 3};
const Columns kPetrack{"petrack", 5, 0, 1, 2, 3, 4};
const Columns kPetrackFlat{"petrack", 4, 0, 1, 2, 3};
const Columns kSdd{"sdd", 10, 0, kSddFrame};

constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();

struct Word {
    std::string_view text;
    double number;  ///< of most numbers; kUnread: it is read when it is asked for
};

/// Words between blanks; one in double quotes may hold blanks. More than `limit` + 1 are not looked for. `line`: as
/// TextLines gives it, or an end of it.
void split(std::string_view line, std::size_t limit, std::vector<Word>& words) {
    const auto parts_words = [](char c) { return c == ' ' || c == '\t'; };
    words.clear();
    const char* at = line.data();
    const char* const line_end = at + line.size();
    for (std::size_t left = limit + 1; left > 0; --left) {
        while (at != line_end && (parts_words(*at) || *at == '\r')) ++at;
        if (at == line_end) return;
        const char* const begin = at;
        double number = kUnread;
        if (*at == '"') {
            at = std::find(at + 1, line_end, '"');
            if (at != line_end) ++at;
        } else {
            at = read_plain_double(at, line_end, number);
            if (at != line_end && !parts_words(*at)) number = kUnread;
            while (at != line_end && !parts_words(*at)) ++at;
        }
        words.push_back({{begin, at}, number});
    }
}

class TextTracksParser {
  public:
    TextTracksParser(std::string_view text, const std::string& file) : lines_(text, file), file_(file) {}

    TrackFile parse() {
        while (lines_.next()) {
            if (lines_.line()[0] == '#') {
                if (tracks_.empty()) read_comment(lines_.line().substr(1));
                continue;
            }
            split(lines_.line(), kMaxColumns, words_);
            if (!seen_row_) choose_columns();
            if (words_.size() != columns_.count) {
                lines_.fail("has " + columns(words_.size()) + " but the rows before it have " +
                            std::to_string(columns_.count) + "; give every row all of them");
            }
            columns_.format == kSdd.format ? read_box() : read_point();
        }
        if (tracks_.empty()) lines_.fail("the file has no row; " + std::string(kFormats));
        TrackFile out;
        out.tracks = tracks_.take_sorted();
        out.spent = tracks_.take_spent();
        out.warnings = remarks_.warnings();
        if (columns_.format == kTrajnet.format && is_id_first(out.tracks)) {
            columns_ = kPetrackFlat;
            out.tracks = with_ids_first(out.tracks);
            out.warnings.emplace_back(
                "the rows are taken as id frame x y: as frame ped x y, which TrajNet has, people would jump about; a "
                "comment ahead of them, such as '# frame id x y', says what they are");
        }
        out.format = columns_.format;
        tell_rate(out);
        tell_unit(out);
        tell_radius(out);
        if (lost_ > 0) {
            out.warnings.push_back(counted(lost_, "row is", "rows are") + " marked as lost from view and left out");
        }
        return out;
    }

  private:
    static constexpr std::string_view kFormats =
        "a .txt can be TrajNet (4 columns: frame ped x y), PeTrack (5: id frame x y z, or as a comment names them: # "
        "id frame x y), UCY or ETH obsmat (8: frame id x z y vx vz vy) or SDD (9 numbers and a label in quotes)";

    static std::string columns(std::size_t count) {
        if (count > kMaxColumns) return "more than " + std::to_string(kMaxColumns) + " columns";
        return counted(count, "column", "columns");
    }

    /// A comment ahead of the rows may tell the frame rate, the unit and the columns.
    void read_comment(std::string_view comment) {
        remarks_.read(comment);
        read_names(comment);
    }

    /// "id frame x/m y/m z/m" and the like name the columns; anything else is a remark.
    void read_names(std::string_view comment) {
        split(comment, kMaxColumns, words_);
        // What stands in brackets is the unit of a name, or a remark.
        bool bracketed = false;
        std::erase_if(words_, [&bracketed](const Word& word) {
            const bool is_name = !bracketed && word.text[0] != '[' && word.text[0] != '(';
            bracketed = !is_name && word.text.back() != ']' && word.text.back() != ')';
            return !is_name;
        });
        if (words_.size() > kMaxColumns) return;
        Columns named{"petrack", words_.size()};
        int time = -1;
        for (std::size_t i = 0; i < words_.size(); ++i) {
            const std::string word = plain_name(words_[i].text).word;
            const std::optional<KnownColumn> known = known_column(words_[i].text);
            int* column = word == "z"   ? &named.z
                          : word == "a" ? &named.a
                          : word == "b" ? &named.b
                          : !known      ? nullptr
                                        : column_of(known->column, named, time);
            if (!column) continue;
            if (*column >= 0) return;
            *column = static_cast<int>(i);
        }
        if (named.frame < 0) {
            named.frame = time;
            named.timed = true;
        }
        if (named.id < 0 || named.frame < 0 || named.x < 0 || named.y < 0) return;
        columns_ = named;
    }

    static int* column_of(Column column, Columns& named, int& time) {
        switch (column) {
            case Column::id:
                return &named.id;
            case Column::t:
                return &time;
            case Column::frame:
                return &named.frame;
            case Column::x:
                return &named.x;
            case Column::y:
                return &named.y;
            case Column::r:
                return &named.r;
        }
        return nullptr;
    }

    /// Decides by the first row which format this is.
    void choose_columns() {
        seen_row_ = true;
        if (columns_.count > 0) {
            if (words_.size() == columns_.count) return;
            lines_.fail("has " + columns(words_.size()) + " but a comment names " + std::to_string(columns_.count) +
                        "; give every row all of them");
        }
        const bool labelled = words_.size() == kSdd.count && words_.back().text.front() == '"';
        const auto numbers = std::count_if(words_.begin(), words_.end(),
                                           [](const Word& word) { return parse_double(word.text).has_value(); });
        const bool all_numbers = numbers == std::ssize(words_);
        if (labelled && numbers == std::ssize(words_) - 1) {
            columns_ = kSdd;
        } else if (all_numbers && words_.size() == kObsmat.count) {
            columns_ = kObsmat;
        } else if (all_numbers && words_.size() == kPetrack.count) {
            columns_ = kPetrack;
        } else if (all_numbers && words_.size() == kTrajnet.count) {
            columns_ = remarks_.rate() ? kPetrackFlat : kTrajnet;
        } else {
            const std::string found = all_numbers ? "numbers in " + columns(words_.size())
                                                  : columns(words_.size()) + ", not all of them numbers";
            lines_.fail("is not a row of a trajectory file (" + found + "); " + std::string(kFormats));
        }
    }

    // ---- four columns of numbers: frame ped x y, as TrajNet has them, or id frame x y

    /// Of the first kind until all rows are read. Rows of one id that follow each other are a walk, which is what
    /// tells.
    void look_at_order(double x, double y) {
        const double first = number(kTrajnet.frame, kMaxFrame), second = number(kTrajnet.id, kMaxFrame);
        if (rows_++ > 0 && first == last_.first && second > last_.second) {
            ++steps_below_;
            length_below_ += std::hypot(x - last_.x, y - last_.y);
        }
        last_ = {first, second, x, y};
    }

    bool is_id_first(const std::vector<Track>& as_trajnet) const {
        // Where nobody has two points in the other order, who walks takes steps of less than so many metres.
        constexpr double kLongestStep = 1;
        constexpr double kClearly = 4;
        if (2 * steps_below_ < rows_) return false;
        double length = 0;
        std::size_t steps = 0;
        for (const Track& track : as_trajnet) {
            steps += track.points.size() - 1;
            for (std::size_t i = 1; i < track.points.size(); ++i)
                length +=
                    std::hypot(track.points[i].x - track.points[i - 1].x, track.points[i].y - track.points[i - 1].y);
        }
        const double usual = steps > 0 ? length / static_cast<double>(steps) : kClearly * kLongestStep;
        return kClearly * length_below_ < usual * static_cast<double>(steps_below_);
    }

    std::vector<Track> with_ids_first(const std::vector<Track>& as_trajnet) const {
        std::vector<TrackPoint> points;
        for (const Track& track : as_trajnet) {
            const double frame = *parse_double(track.id);
            for (const TrackPoint& point : track.points)
                points.push_back({frame, point.x, point.y, point.line, point.frame});
        }
        std::ranges::sort(points, {}, &TrackPoint::line);
        TrackCollector out(file_);
        for (TrackPoint& point : points) {
            const double id = std::exchange(point.r, 0);
            out.add(std::to_string(static_cast<long long>(id)), point);
        }
        return out.take_sorted();
    }

    double number(int column, double largest) const {
        const auto& [word, known] = words_[static_cast<std::size_t>(column)];
        const std::optional<double> value = std::isnan(known) ? parse_double(word) : known;
        if (!value) fail(column, in_quotes(word) + " is not a finite number; write it like 0.25");
        if (std::abs(*value) > largest)
            fail(column, in_quotes(word) + " is beyond " + format_double(largest) + "; check the row");
        return *value;
    }

    double whole_number(int column) const {
        const double value = number(column, kMaxFrame);
        if (value != static_cast<double>(static_cast<std::int64_t>(value))) {
            fail(column, in_quotes(words_[static_cast<std::size_t>(column)].text) +
                             " is not a whole number, as ids and frames of this format (" + columns_.format +
                             ") are; check the columns");
        }
        return value;
    }

    [[noreturn]] void fail(int column, const std::string& message) const {
        lines_.fail("column " + std::to_string(column + 1) + ": " + message);
    }

    void add(double x, double y, double r = 0, std::string_view label = {}) {
        const double frame = columns_.timed ? number(columns_.frame, mobb::kMaxTime) : whole_number(columns_.frame);
        in_milliseconds_ = in_milliseconds_ && is_in_milliseconds(frame);
        const double id = whole_number(columns_.id);
        if (id != id_) {
            id_ = id;
            id_text_ = std::to_string(static_cast<long long>(id));
        }
        tracks_.add(id_text_, {frame, x, y, lines_.number(), r}, label);
    }

    void read_point() {
        const double x = number(columns_.x, mobb::kMaxLength), y = number(columns_.y, mobb::kMaxLength);
        add(x, y, radius());
        if (columns_.format == kTrajnet.format) look_at_order(x, y);
        if (columns_.z >= 0) heights_.push_back(number(columns_.z, mobb::kMaxLength));
    }

    /// In file units; of an ellipse that of the disk which holds it.
    double radius() const {
        double largest = 0;
        for (const int column : {columns_.r, columns_.a, columns_.b}) {
            if (column < 0) continue;
            const double value = number(column, mobb::kMaxLength);
            if (value < 0) fail(column, "the radius is negative; give 0 or more");
            largest = std::max(largest, value);
        }
        return largest;
    }

    void read_box() {
        if (number(kLost, 1) == 1) {
            ++lost_;
            return;
        }
        const auto centre = [this](int low, int high) {
            return (number(low, mobb::kMaxLength) + number(high, mobb::kMaxLength)) / 2;
        };
        add(centre(kXMin, kXMax), centre(kYMin, kYMax), 0, label());
    }

    /// The class, without its quotes.
    std::string_view label() const {
        std::string_view word = words_[kLabel].text;
        if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
        if (!is_utf8(word)) fail(kLabel, "the label is not UTF-8 text; save the file as UTF-8");
        return word;
    }

    void tell_rate(TrackFile& out) const {
        if (columns_.timed) {
            out.timed = true;
            if (in_milliseconds_) out.rounding = kMillisecond;
        } else if (remarks_.rate()) {
            out.rate = *remarks_.rate();
        } else if (columns_.format == kSdd.format) {
            out.rate = kDroneRate;
            out.rate_assumption =
                "30 frames a second are assumed, as in the Stanford Drone Dataset; give dt (seconds "
                "a frame) if that is wrong";
        } else if (columns_.format == kPetrack.format) {
            out.rate = kHermesRate;
            out.rate_assumption =
                "the file does not say its frame rate: 16 a second are assumed, as in the Hermes "
                "recordings; give dt (seconds a frame) if that is wrong";
        } else {
            out.rate = kAnnotationRate;
            out.rate_of_steps = true;
            out.least_step = 10;
            out.rate_assumption =
                "the file does not say its frame rate: 2.5 points a second are assumed, as in UCY, "
                "ETH and TrajNet recordings; give dt (seconds a frame) if that is wrong";
        }
    }

    void tell_radius(TrackFile& out) const {
        const bool has_axes = columns_.a >= 0 || columns_.b >= 0;
        out.has_radius = has_axes || columns_.r >= 0;
        if (has_axes) {
            out.warnings.push_back("the columns A and B are semi-axes of ellipses: people are disks of the larger one");
        }
    }

    /// PeTrack has heads in the third column of space, whose height tells metres from centimetres.
    void tell_unit(TrackFile& out) {
        if (columns_.format == kSdd.format) {
            out.unit_assumption =
                "lengths are in pixels of the image, y down: one pixel counts as one metre; give "
                "unit (metres a pixel)";
        }
        if (columns_.format != kPetrack.format) return;
        if (remarks_.unit()) {
            out.unit = *remarks_.unit();
            return;
        }
        const std::string otherwise = " give unit if that is wrong";
        if (!heights_.empty()) {
            const double read = median(heights_);
            const std::array<double, 3> units{1, 0.01, 0.001};
            const double unit = *std::min_element(units.begin(), units.end(), [&](double a, double b) {
                return std::abs(a * read - kHeadHeight) < std::abs(b * read - kHeadHeight);
            });
            const double height = unit * read;
            if (height >= kLowestHead && height <= kHighestHead) {
                out.unit = unit;
                out.guessed_height = height;
                out.unit_assumption = "the file does not say its unit: " +
                                      std::string(unit == 1      ? "metres"
                                                  : unit == 0.01 ? "centimetres"
                                                                 : "millimetres") +
                                      " are assumed, as heads are " + brief(std::round(height * 100) / 100) +
                                      " m high then;" + otherwise;
                return;
            }
        }
        out.unit_assumption =
            "the file does not say its unit, and has no heights of heads that would tell: metres are "
            "assumed;" +
            otherwise;
    }

    TextLines lines_;
    const std::string& file_;
    std::vector<Word> words_;  ///< of the line in hand
    Columns columns_;
    bool seen_row_ = false;
    Remarks remarks_;
    std::optional<double> id_;  ///< of the last row
    std::string id_text_;
    TrackCollector tracks_{file_};
    std::vector<double> heights_;
    bool in_milliseconds_ = true;  ///< all frames; of use where they are times
    int lost_ = 0;

    /// A row of kTrajnet.
    struct Row {
        double first = 0, second = 0, x = 0, y = 0;
    };
    Row last_;
    std::size_t rows_ = 0;
    std::size_t steps_below_ = 0;  ///< rows that may be the next point of the one in the row before
    double length_below_ = 0;      ///< of the way from there to here
};

}  // namespace

bool looks_like_text_tracks(std::string_view text) {
    constexpr std::size_t kFewest = 3;  // columns: what lacks one is told so
    std::vector<Word> words;
    split(take_row(text), kMaxColumns, words);
    const auto numbers =
        std::ranges::count_if(words, [](const Word& word) { return parse_double(word.text).has_value(); });
    return words.size() >= kFewest && static_cast<std::size_t>(numbers) + 1 >= words.size();
}

TrackFile parse_text_tracks(std::string_view text, const std::string& file) {
    return TextTracksParser(text, file).parse();
}

}  // namespace mobbscope
