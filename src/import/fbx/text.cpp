#include <base/error.h>
#include <base/text.h>
#include <import/fbx/fbx.h>
#include <import/fbx/readers.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace mobbscope {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kFirstRecord = "FBXHeaderExtension";
constexpr std::string_view kWordEnds = " \t\r\n,;:{}\"";
constexpr std::size_t kHeadSize = std::size_t{1} << 16;

/// "; FBX 7.4.0 project file": 7400.
std::optional<int> version_in_comment(std::string_view text) {
    constexpr std::string_view kBegin = "; FBX ";
    if (!text.starts_with(kBegin)) return {};
    const std::string_view rest = text.substr(kBegin.size(), 4);
    if (rest.size() < 3 || rest[1] != '.') return {};
    const auto major = parse_int(rest.substr(0, 1));
    const auto minor = parse_int(rest.substr(2, 1));
    return major && minor ? std::optional(*major * 1000 + *minor * 100) : std::nullopt;
}

}  // namespace

FbxValue fbx_word(std::string_view word) {
    FbxValue out;
    const char* const end = word.data() + word.size();
    const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
    if (const auto read = std::from_chars(begin, end, out.integer); read.ptr == end && read.ec == std::errc{}) {
        out.real = static_cast<double>(out.integer);
        return out;
    }
    out.kind = FbxValue::Kind::real;
    const auto read = std::from_chars(begin, end, out.real);
    if (read.ptr == end && read.ec == std::errc::result_out_of_range) {
        // Too near to zero, or too far from it.
        out.real = parse_double(word).value_or(std::numeric_limits<double>::infinity());
    } else if (word.find("#I") != word.npos || word.find("#Q") != word.npos) {  // "-1.#IND" of old C libraries
        out.real = std::numeric_limits<double>::quiet_NaN();
    } else if (read.ptr != end || read.ec != std::errc{}) {
        out.kind = FbxValue::Kind::text;
        out.text = word;
    }
    out.integer = fbx_whole(out.real);
    return out;
}

bool looks_like_fbx(std::string_view head) {
    if (head.starts_with(kFbxBinaryMark)) return true;
    if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
    const auto skip_blanks = [&] { head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size())); };
    for (skip_blanks(); head.starts_with(';'); skip_blanks()) head.remove_prefix(fbx_line_end(head, 0));
    return head.starts_with(kFirstRecord);
}

/// One pass over a text file.
class FbxTextReader {
  public:
    explicit FbxTextReader(FbxDocument& document) : document_(document), bytes_(document.bytes_) {}

    void read() {
        if (bytes_.substr(0, kHeadSize).find(kFirstRecord) == bytes_.npos) {
            throw InputError(document_.file_, "header",
                             "is neither binary nor text FBX; the file is damaged or of another kind");
        }
        if (bytes_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
        std::vector<FbxRecord>& records = document_.records_;
        std::vector<FbxDocument::Index> open;
        const auto close = [&](FbxDocument::Index record) {
            records[record].end = static_cast<std::uint32_t>(records.size());
            if (document_.version_ == 0 && open.empty() && records[record].name == kFirstRecord) find_version();
        };
        while (skip_blanks()) {
            if (bytes_[at_] == '}') {
                if (open.empty()) fail("a brace is closed that none opens");
                ++at_;
                const FbxDocument::Index record = open.back();
                open.pop_back();
                close(record);
                continue;
            }
            FbxRecord record;
            record.place = line_;
            if (!begins_record()) fail("here should be a name and a colon");
            record.name = take_word();
            at_ = bytes_.find(':', at_) + 1;
            take_values(record);
            records.push_back(record);
            document_.charge_records();
            const auto index = static_cast<FbxDocument::Index>(records.size() - 1);
            if (at_ < bytes_.size() && bytes_[at_] == '{') {
                ++at_;
                open.push_back(index);
            } else {
                close(index);
            }
        }
        if (!open.empty()) {
            fail("the file ends inside " + in_quotes(records[open.back()].name) + " of " +
                 at_line(static_cast<int>(records[open.back()].place)));
        }
        if (document_.version_ == 0) find_version();
    }

  private:
    void fail(const std::string& message) const {
        throw InputError(document_.file_, at_line(static_cast<int>(line_)), message + "; export the file again");
    }

    /// Past blanks and comments; false at the end.
    bool skip_blanks() {
        const std::size_t begin = at_;
        do {
            if (at_ < bytes_.size() && bytes_[at_] == ';') at_ = fbx_line_end(bytes_, at_);
            at_ = std::min(bytes_.find_first_not_of(" \t\r\n", at_), bytes_.size());
        } while (at_ < bytes_.size() && bytes_[at_] == ';');
        count_lines(bytes_.substr(begin, at_ - begin));
        return at_ < bytes_.size();
    }

    void count_lines(std::string_view text) {
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '\n' || (text[i] == '\r' && !text.substr(i + 1).starts_with('\n'))) ++line_;
        }
    }

    std::string_view take_word() {
        const std::size_t end = std::min(bytes_.find_first_of(kWordEnds, at_), bytes_.size());
        const std::string_view word = bytes_.substr(at_, end - at_);
        at_ = end;
        return word;
    }

    bool begins_record() const {
        const std::size_t end = bytes_.find_first_of(kWordEnds, at_);
        if (end == bytes_.npos || end == at_) return false;
        const std::size_t colon = bytes_.find_first_not_of(" \t", end);
        return colon != bytes_.npos && bytes_[colon] == ':';
    }

    void take_values(FbxRecord& record) {
        std::vector<FbxValue>& values = document_.values_;
        record.first_value = static_cast<std::uint32_t>(values.size());
        while (skip_blanks()) {
            const char c = bytes_[at_];
            if (c == ',') {
                ++at_;
                continue;
            }
            if (c == '{' || c == '}' || begins_record()) break;
            FbxValue value;
            if (c == '"') {
                const std::size_t end = bytes_.find('"', at_ + 1);
                if (end == bytes_.npos) fail("a quote is not closed");
                value.kind = FbxValue::Kind::text;
                value.text = bytes_.substr(at_ + 1, end - at_ - 1);
                count_lines(value.text);
                at_ = end + 1;
            } else {
                const std::string_view word = take_word();
                if (word.empty()) fail(std::string("'") + c + "' does not begin a value");
                value = fbx_word(word.starts_with('*') ? word.substr(1) : word);
                if (word.starts_with('*')) take_array(value);
            }
            values.push_back(value);
            document_.charge_records();
        }
        record.values = static_cast<std::uint32_t>(values.size()) - record.first_value;
    }

    void take_array(FbxValue& array) {
        if (array.kind != FbxValue::Kind::integer || array.integer < 0)
            fail("an array needs a count after its asterisk");
        array.kind = FbxValue::Kind::array;
        array.type = kFbxTextArray;
        if (!skip_blanks() || bytes_[at_] != '{') fail("an array needs its numbers in braces");
        ++at_;
        if (!skip_blanks()) fail("the file ends inside an array");
        if (begins_record()) at_ = bytes_.find(':', at_) + 1;  // "a:"
        const std::size_t begin = at_;
        while (at_ < bytes_.size() && bytes_[at_] != '}') {
            at_ = std::min(bytes_.find_first_of(";}", at_), bytes_.size());
            if (at_ < bytes_.size() && bytes_[at_] == ';') at_ = fbx_line_end(bytes_, at_);
        }
        if (at_ == bytes_.size()) fail("the file ends inside an array");
        array.text = bytes_.substr(begin, at_ - begin);
        count_lines(array.text);
        ++at_;
    }

    void find_version() const {
        const FbxDocument::Index version =
            document_.find(document_.find(FbxDocument::kFile, kFirstRecord), "FBXVersion");
        if (const std::span<const FbxValue> values = document_.values(version); !values.empty()) {
            const FbxValue& said = values[0];
            const std::int64_t number = said.integer;
            if (number < 1000) {
                throw InputError(
                    document_.file_, document_.place_of(version),
                    "FBXVersion is " +
                        (said.kind == FbxValue::Kind::text ? in_quotes(said.text) : std::to_string(number)) +
                        ", which is not a version; export the file again as FBX 7.4 (FBX 2014/2015) or newer");
            }
            document_.set_version(static_cast<int>(std::clamp<std::int64_t>(number, 0, 100'000)));
        } else if (const auto told = version_in_comment(bytes_)) {
            document_.set_version(*told);
        } else {
            throw InputError(document_.file_, std::string(kFirstRecord),
                             "does not say FBXVersion; export the file again as FBX 7.4 (FBX 2014/2015) or newer");
        }
    }

    FbxDocument& document_;
    std::string_view bytes_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

void read_fbx_text(FbxDocument& document) { FbxTextReader(document).read(); }

}  // namespace mobbscope
