#include <base/error.h>
#include <base/text.h>
#include <import/bvh/bvh.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kMaxFrameTime = 1000;       // seconds; a frame rate in its place is no larger either
constexpr int kMaxFrames = 10'000'000;       // a day at 115 frames a second; the rows that are there count, not this
constexpr std::size_t kMaxJoints = 100'000;  // a file of nothing but names would take many times its size
constexpr std::array<std::string_view, kMaxBvhChannels> kChannels{
    "xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation", "xscale", "yscale", "zscale"};

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

/// A number that no double holds: too near to 0, which is 0, or too large.
double tiny_or_huge(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    const bool is_tiny = exponent != std::string_view::npos && number.substr(exponent + 1).starts_with('-');
    return is_tiny ? 0 : std::numeric_limits<double>::infinity();
}

/// Numbers beyond this, in file units or degrees, come from damaged files.
constexpr double kMaxBvhValue = 1e9;

/// Words, numbers and lines of a BVH, taken off the front of its text; lines may end with LF, CRLF or CR. Text and file
/// name must outlive it.
class BvhScanner {
  public:
    BvhScanner(std::string_view text, const std::string& file)
        : at_(text.data()), end_(text.data() + text.size()), file_(file) {}

    const std::string& file() const { return file_; }
    int line() const { return line_; }  ///< from 1
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
    bool at_end() const { return at_ == end_; }
    bool at_line_end() const { return at_ == end_ || is_line_end(*at_); }

    /// Throws InputError for a line of the file.
    [[noreturn]] void fail(int line, const std::string& message) const {
        throw InputError(file_, "line " + std::to_string(line), message);
    }

    [[noreturn]] void fail(const std::string& message) const { fail(line_, message); }

    /// Past a byte order mark. Throws InputError if there is no text, or UTF-16.
    void begin() {
        const std::string_view text = between(at_, end_);
        if (text.empty()) fail("the file is empty; a BVH begins with HIERARCHY");
        if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) fail("is UTF-16 text; save it as UTF-8");
        if (text.starts_with("\xef\xbb\xbf")) at_ += 3;
    }

    /// To the next word or end of this line.
    void skip_blanks() {
        while (at_ != end_ && is_blank(*at_)) ++at_;
    }

    /// To the next word, on this line or a later one; past comments, which begin with #.
    void skip_space() {
        const auto ends_line = [this] {
            skip_blanks();
            if (at_ != end_ && *at_ == '#') at_ = std::find_if(at_, end_, is_line_end);
            return at_ != end_ && is_line_end(*at_);
        };
        while (ends_line()) {
            if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
            ++at_;
            ++line_;
        }
    }

    /// The next word, on this line or a later one: up to a blank, a line end or a brace; a brace is a word of its own.
    /// Empty at the end of the file.
    std::string_view next_word() {
        skip_space();
        const char* const begin = at_;
        const auto is_brace = [](char c) { return c == '{' || c == '}'; };
        if (at_ != end_ && is_brace(*at_)) {
            ++at_;
        } else {
            while (!at_line_end() && !is_blank(*at_) && !is_brace(*at_)) ++at_;
        }
        return between(begin, at_);
    }

    /// Makes the word that was taken last the next one again.
    void put_back(std::string_view word) { at_ = word.data(); }
    /// What is left of this line, without blanks at its ends. Stays before the line end.
    std::string_view rest_of_line() {
        const char* const begin = at_;
        at_ = std::find_if(at_, end_, is_line_end);
        return trimmed(between(begin, at_));
    }

    /// The same, up to a { that may end the line.
    std::string_view rest_before_brace() {
        const std::string_view rest = rest_of_line();
        if (!rest.ends_with('{')) return rest;
        at_ = rest.data() + rest.size() - 1;
        return trimmed(rest.substr(0, rest.size() - 1));
    }

    /// The number that begins here, before at_line_end(), within +-kMaxBvhValue. Throws InputError.
    double number() {
        // from_chars takes no plus sign.
        const char* const begin = at_ + (*at_ == '+' && at_ + 1 != end_ && at_[1] != '-' ? 1 : 0);
        double value = 0;
        auto [after, error] = std::from_chars(begin, end_, value);
        // What goes on behind a comma is a number with a decimal one.
        points_ = points_ || std::find(begin, after, '.') != after;
        if (after != begin && end_ - after > 1 && *after == ',' && is_digit(after[1])) {
            if (points_) fail_number();
            const std::string with_point = number_with_point(begin);
            const auto [end, of_point] =
                std::from_chars(with_point.data(), with_point.data() + with_point.size(), value);
            after = begin + (end - with_point.data());
            error = of_point;
        }
        const bool is_whole = after == end_ || is_blank(*after) || is_line_end(*after) || *after == '}';
        if (error == std::errc::invalid_argument || !is_whole || !std::isfinite(value)) fail_number();
        if (error == std::errc::result_out_of_range) value = tiny_or_huge(between(begin, after));
        if (std::abs(value) > kMaxBvhValue) fail(in_quotes(next_word()) + " is beyond 1e9; the file is damaged");
        at_ = after;
        return value;
    }

    bool has_decimal_commas() const { return decimal_commas_; }
    bool has_decimal_points() const { return points_; }

  private:
    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    /// The word that begins there, with a point in place of its first comma.
    std::string number_with_point(const char* begin) {
        decimal_commas_ = true;
        std::string word(begin, std::find_if(begin, end_, [](char c) { return is_blank(c) || is_line_end(c); }));
        word[word.find(',')] = '.';
        return word;
    }
    [[noreturn]] void fail_number() {
        const std::string_view word = next_word();
        const bool has_comma = word.find(',') != std::string_view::npos;
        fail(in_quotes(word) + " is not a finite number" +
             (has_comma ? "; write decimals with a point and separate numbers with blanks" : "; write it like 12.5"));
    }

    const char* at_;
    const char* end_;
    const std::string& file_;
    int line_ = 1;
    bool points_ = false;  ///< decimal ones, and then no commas
    bool decimal_commas_ = false;
};

/// Quotes what was found where something else was expected: "there is 'x'", or "the file ends".
std::string found(std::string_view word) { return word.empty() ? "the file ends" : "there is " + in_quotes(word); }

/// Whether a word is a keyword, in any case.
bool is_keyword(std::string_view word, std::string_view lower_keyword) { return lower(word) == lower_keyword; }

/// A joint whose } has not come yet.
struct OpenJoint {
    std::size_t index;
    int line;  ///< where it begins
    bool has_offset = false;
    bool has_channels = false;
};

// Published captures have 24 to 120 frames a second; single poses and key poses may be a second or two apart.
constexpr double kDoubtfulFrameTime = 3;  // seconds; less than the milliseconds of 300 frames a second
constexpr double kRates[] = {10, 12, 15,  20,  24,  25,  30,  48,  50,  60,  72,
                             75, 90, 100, 120, 144, 150, 200, 240, 250, 300, 1000};

/// Whether motion is captured at so many frames a second, that much off; NTSC video is a thousandth slower.
bool is_rate(double rate, double off) {
    return std::ranges::any_of(kRates,
                               [=](double known) { return rate > known * (0.999 - off) && rate < known * (1 + off); });
}

/// What else a frame time may be that is far too long; empty if it is not.
std::string doubt_of_frame_time(double seconds) {
    if (seconds < kDoubtfulFrameTime) return "";
    const std::string is = "Frame Time is " + format_double(seconds) + " seconds, which looks like ";
    const auto write = [](double time) { return "write " + formatted("%.6g", time) + " there"; };
    if (is_rate(seconds, 0.0005)) return is + "frames a second; if so, " + write(1 / seconds);
    // Rounded to whole milliseconds it may be 5 % off.
    if (is_rate(1000 / seconds, 0.05)) return is + "milliseconds; if so, " + write(seconds / 1000);
    return is + "frames a second or milliseconds; if so, write the seconds from one frame to the next there";
}

/// One pass over the text of a file.
class BvhParser {
  public:
    BvhParser(std::string_view text, const std::string& file) : in_(text, file) {}

    BvhData parse() {
        in_.begin();
        read_hierarchy();
        read_motion_header();
        read_rows();
        return std::move(data_);
    }

  private:
    // ---- HIERARCHY ----

    void read_hierarchy() {
        const std::string_view first = in_.next_word();
        if (!is_keyword(first, "hierarchy")) {
            in_.fail("a BVH begins with HIERARCHY, but " + found(first) + "; is this another kind of file?");
        }
        for (std::string_view word = in_.next_word(); !is_keyword(word, "motion"); word = in_.next_word()) {
            if (is_keyword(word, "root")) {
                read_root();
            } else if (word == "}") {
                in_.fail("this } closes nothing; remove it");
            } else {
                in_.fail("ROOT or MOTION must stand here, but " + found(word));
            }
        }
        if (data_.joints.empty()) in_.fail("there is no ROOT before MOTION");
        const auto roots = std::ranges::count(data_.joints, -1, &Joint::parent);
        check_character_count(static_cast<std::size_t>(roots), in_.file());
        if (data_.row_length == 0) in_.fail("no joint has a channel, so nothing moves; give CHANNELS to one");
    }

    /// A ROOT and all below it. Without recursion: a file may nest as deep as it likes.
    void read_root() {
        std::vector<OpenJoint> open{begin_joint("ROOT", -1)};
        while (!open.empty()) {
            OpenJoint& joint = open.back();
            const int index = static_cast<int>(joint.index);
            const bool is_tip = data_.joints[joint.index].end_site;
            const std::string_view word = in_.next_word();
            if (word == "}") {
                if (!joint.has_offset) in_.fail(described(joint) + " has no OFFSET; give it one");
                open.pop_back();
            } else if (is_keyword(word, "offset")) {
                read_offset(joint);
            } else if (!is_tip && is_keyword(word, "channels")) {
                read_channels(joint);
            } else if (!is_tip && is_keyword(word, "joint")) {
                open.push_back(begin_joint("JOINT", index));
            } else if (!is_tip && (is_keyword(word, "end") || is_keyword(word, "endsite"))) {
                open.push_back(begin_end_site(index));
            } else {
                in_.fail("in " + described(joint) +
                         (is_tip ? ", OFFSET or }" : ", OFFSET, CHANNELS, JOINT, End Site or }") +
                         " must stand here, but " + found(word));
            }
        }
    }

    std::string described(const OpenJoint& open) const {
        const Joint& joint = data_.joints[open.index];
        return (joint.end_site ? "the End Site" : in_quotes(joint.name)) + " of line " + std::to_string(open.line);
    }

    OpenJoint begin_joint(const std::string& keyword, int parent) {
        const std::string_view name = in_.rest_before_brace();
        if (name.empty()) in_.fail(keyword + " needs a name on its line");
        return open_joint({std::string(name), parent, false});
    }
    OpenJoint begin_end_site(int parent) {
        in_.rest_before_brace();  // "Site", and whatever a program adds
        return open_joint({"", parent, true});
    }
    OpenJoint open_joint(Joint joint) {
        if (data_.joints.size() == kMaxJoints) in_.fail("there are more than 100000 joints; the file is damaged");
        const OpenJoint open{data_.joints.size(), in_.line()};
        data_.joints.push_back(std::move(joint));
        data_.moves.emplace_back().first_value = data_.row_length;
        const std::string_view word = in_.next_word();
        if (word != "{") in_.fail("a { must follow " + described(open) + ", but " + found(word));
        return open;
    }

    void read_offset(OpenJoint& joint) {
        if (joint.has_offset) in_.fail("a second OFFSET in " + described(joint) + "; remove one");
        joint.has_offset = true;
        for (int i = 0; i < 3; ++i) {
            in_.skip_blanks();
            if (in_.at_line_end()) in_.fail("OFFSET needs three numbers, but has " + std::to_string(i));
            data_.moves[joint.index].offset[i] = in_.number();
        }
        end_statement("OFFSET takes three numbers");
    }

    void read_channels(OpenJoint& joint) {
        if (joint.has_channels) in_.fail("a second CHANNELS in " + described(joint) + "; remove one");
        joint.has_channels = true;
        const std::string_view number = in_.next_word();
        const std::optional<int> count = parse_int(number);
        if (!count || *count < 0 || *count > static_cast<int>(kMaxBvhChannels)) {
            in_.fail("CHANNELS needs their number, 0 to " + std::to_string(kMaxBvhChannels) + ", but " + found(number));
        }
        BvhJoint& move = data_.moves[joint.index];
        move.first_value = data_.row_length;
        for (int i = 0; i < *count; ++i) {
            in_.skip_blanks();
            if (in_.at_line_end()) {
                in_.fail("CHANNELS says " + std::to_string(*count) + ", but names only " + std::to_string(i));
            }
            add_channel(move, in_.next_word());
        }
        end_statement("CHANNELS says " + std::to_string(*count) + ", but names more");
        data_.row_length += move.channel_count;
    }

    void add_channel(BvhJoint& move, std::string_view word) const {
        const auto known = std::find_if(kChannels.begin(), kChannels.end(),
                                        [word](std::string_view channel) { return is_keyword(word, channel); });
        if (known == kChannels.end()) {
            in_.fail(in_quotes(word) + " is not a channel; give Xposition, Xrotation or Xscale, or such of Y or Z");
        }
        const auto channel = static_cast<BvhChannel>(known - kChannels.begin());
        const auto given = std::span(move.channels).first(move.channel_count);
        // Turning about one axis twice is an Euler order like XYX; a coordinate given twice is a mistake.
        const bool is_rotation = channel >= BvhChannel::x_rotation && channel <= BvhChannel::z_rotation;
        if (!is_rotation && std::find(given.begin(), given.end(), channel) != given.end()) {
            in_.fail(in_quotes(word) + " stands twice in CHANNELS; remove one");
        }
        move.channels[move.channel_count++] = channel;
    }

    void end_statement(const std::string& complaint) {
        in_.skip_blanks();
        if (in_.at_line_end()) return;
        const std::string_view word = in_.next_word();
        if (word != "}") in_.fail(complaint + "; there is " + in_quotes(word));
        in_.put_back(word);
    }

    // ---- MOTION ----

    /// The text after "Frames:" or "Frame Time:". `words` are those of the key in lower case.
    std::string_view setting(const char* key, std::initializer_list<std::string_view> words) {
        in_.skip_space();
        const std::string_view line = in_.rest_of_line();
        const std::size_t colon = line.find(':');
        bool matches = colon != std::string_view::npos;
        std::string_view rest = line.substr(0, colon);
        for (const std::string_view word : words) {
            matches = matches && is_keyword(rest.substr(0, word.size()), word);
            rest = trimmed(rest.substr(std::min(word.size(), rest.size())));
        }
        if (!matches || !rest.empty()) {
            in_.fail("'" + std::string(key) + ": <number>' must stand here, but " + found(line));
        }
        return trimmed(line.substr(colon + 1));
    }

    void read_motion_header() {
        const std::string_view frames = setting("Frames", {"frames"});
        const std::optional<int> count = parse_int(frames);
        if (!count || *count < 0 || *count > kMaxFrames) {
            in_.fail("Frames needs a whole number from 1 to " + std::to_string(kMaxFrames) + ", but has " +
                     in_quotes(frames));
        }
        frames_ = static_cast<std::size_t>(*count);
        frames_line_ = in_.line();

        const std::string_view time = setting("Frame Time", {"frame", "time"});
        std::string with_point(time);
        if (!in_.has_decimal_points()) std::ranges::replace(with_point, ',', '.');
        const std::optional<double> seconds = parse_double(with_point);
        if (!seconds || !(*seconds > 0) || *seconds > kMaxFrameTime) {
            in_.fail("Frame Time needs seconds, over 0 and at most " + std::to_string(static_cast<int>(kMaxFrameTime)) +
                     ", such as 0.033333, but has " + in_quotes(time));
        }
        data_.frame_time = *seconds;
        data_.time_doubt = doubt_of_frame_time(*seconds);
        if (!data_.time_doubt.empty()) data_.time_doubt += " (" + at_line(in_.line()) + ")";
    }

    /// What the file has is believed, not what it says of it: exporters count wrong, and files are cut off. So the
    /// memory is bounded by the size of the text, whatever Frames says.
    void read_rows() {
        for (in_.skip_space(); !in_.at_end(); in_.skip_space()) {
            read_line();
            // With what becomes of a row: a sample, and where each joint is.
            const std::size_t row = sizeof(double) * data_.row_length + sizeof(glm::dvec3) * (2 + data_.joints.size());
            data_.spent.cover(row * (data_.frames() + 1), "its frames", in_.file());
        }
        if (data_.values.empty() && frames_ == 0)
            in_.fail(frames_line_, "Frames says 0: the file holds a body and no motion; export the motion with it");
        if (data_.values.empty())
            in_.fail(frames_line_, "Frames says " + std::to_string(frames_) +
                                       ", but no row follows; fetch the file again if it was cut off");
        const std::size_t rows = data_.frames();
        if (short_line_ && (in_row_ > 0 || rows != frames_)) fail_as_row(*short_line_);
        if (in_.has_decimal_commas())
            data_.warnings.emplace_back("commas within numbers are read as decimal points: 0,5 is a half");
        if (rows == frames_) return;
        data_.warnings.push_back("Frames says " + std::to_string(frames_) + ", but " + counted(rows, "row", "rows") +
                                 (rows == 1 ? " follows" : " follow") + ": all that are there are taken" +
                                 (rows < frames_ ? "; fetch the file again if it was cut off" : "") + " (" +
                                 at_line(frames_line_) + ")");
    }

    /// A row, or a part of one that goes over several lines: which of them it is shows at the end, as rows that are too
    /// short do not add up to whole ones.
    void read_line() {
        std::size_t count = 0;
        for (; !in_.at_line_end(); in_.skip_blanks(), ++count) {
            const double value = in_.number();
            if (in_row_ + count < data_.row_length) data_.values.push_back(value);
        }
        if (in_row_ + count < data_.row_length && !short_line_) short_line_ = {in_.line(), count, in_.at_end()};
        if (in_row_ + count > data_.row_length)
            fail_as_row(short_line_.value_or(RowLine{in_.line(), count, in_.at_end()}));
        in_row_ = (in_row_ + count) % data_.row_length;
    }

    /// A line of values, and whether the file ends with it.
    struct RowLine {
        int line;
        std::size_t count;
        bool at_end;
    };

    [[noreturn]] void fail_as_row(const RowLine& row) const {
        in_.fail(row.line, "the row has " + counted(row.count, "value", "values") + ", but there are " +
                               counted(data_.row_length, "channel", "channels") +
                               (row.at_end ? "; the file is cut off" : "; correct the row"));
    }

    BvhScanner in_;
    std::size_t frames_ = 0;  ///< as the file says
    int frames_line_ = 0;
    std::size_t in_row_ = 0;               ///< values of a row that goes on in the next line
    std::optional<RowLine> short_line_{};  ///< the first with too few values
    BvhData data_;
};

}  // namespace

BvhData parse_bvh(std::string_view text, const std::string& file) { return BvhParser(text, file).parse(); }

}  // namespace mobbscope
