#include <base/error.h>
#include <base/input.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/conflict_listing.h>
#include <cli/text_rows.h>
#include <conflicts/conflicts.h>
#include <import/tracks/text_rows.h>
#include <mobb_tracks/encounter.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <queue>
#include <string_view>
#include <tuple>
#include <utility>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

constexpr std::array<std::string_view, 3> kFormatNames{"text", "json", "csv"};  ///< by ListingFormat

/// Keeps who is connected with whom while the rows are written.
class Chains {
  public:
    void add(const ListedConflict& conflict) {
        contacts_.emplace_back(conflict.a, conflict.b);
        names_.emplace(conflict.a, conflict.a_name);
        names_.emplace(conflict.b, conflict.b_name);
    }
    /// The names of each chain, the longest first.
    std::vector<std::vector<std::string>> names(std::size_t agents) const {
        std::vector<std::vector<std::string>> out;
        for (const std::vector<int>& chain : mobb::contact_chains(agents, contacts_)) {
            out.emplace_back();
            for (const int agent : chain) out.back().push_back(names_.at(agent));
        }
        return out;
    }

  private:
    std::vector<std::pair<int, int>> contacts_;
    std::map<int, std::string> names_;
};

void write_seconds(JsonWriter& out, const char* key, const ListedSeconds& of) {
    out.member(key, of.seconds);
    if (!of.seconds) out.member(std::string(key) + "_undefined", of.undefined);
}

void write_conflict(JsonWriter& out, const ListedConflict& conflict, bool of_part) {
    out.begin_object(Layout::row);
    out.members("a", conflict.a_name, "b", conflict.b_name);
    // Parts are merged in the order of agents, whatever their names.
    if (of_part) out.member("agents", glm::dvec2(conflict.a, conflict.b));
    out.list("intervals", conflict.intervals, [&](const mobb::Interval& of) { out.tuple(of.t0, of.t1); });
    out.members("least_clearance", conflict.least_clearance, "time", conflict.time);
    out.members("a_sample", conflict.a_sample, "b_sample", conflict.b_sample, "position", conflict.position);
    if (conflict.invented) out.member("invented", true);
    if (conflict.time_to_collision) write_seconds(out, "time_to_collision", *conflict.time_to_collision);
    if (conflict.post_encroachment) write_seconds(out, "post_encroachment_time", *conflict.post_encroachment);
    if (conflict.plan) {
        out.list("plan", *conflict.plan, [&](const PlanConflict& of) {
            out.row("kind", name(of.kind), "t0", of.t0, "t1", of.t1, "a", of.a, "b", of.b);
        });
    }
    out.end_object();
}

void write_json(const ConflictListing& listing) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.members("file", listing.file, "t0", listing.t0, "agents", listing.agents, "radius", listing.radius);
    out.members("pairs", listing.pairs, "pairs_tested", listing.pairs_tested, "seconds", listing.seconds);
    out.values("warnings", listing.warnings);
    if (listing.unforced) out.member("unforced", *listing.unforced);
    if (listing.left_out) out.member("left_out", *listing.left_out);
    if (listing.within) out.member("within", *listing.within);
    if (listing.least_seconds) out.member("min_duration", *listing.least_seconds);
    if (listing.part) {
        out.member("part", std::initializer_list<double>{double(listing.part->part), double(listing.part->parts)});
        out.member("digest", digest_text(listing.digest));
        out.member("format", kFormatNames[static_cast<std::size_t>(listing.format)]);
    }
    Chains chains;
    out.begin_array("conflicts");
    for (std::size_t i = 0; i < listing.size; ++i) {
        const ListedConflict conflict = listing.row(i, true);
        write_conflict(out, conflict, listing.part.has_value());
        if (listing.within && !listing.part) chains.add(conflict);
    }
    out.end_array();
    if (listing.within && !listing.part)
        out.list("chains", chains.names(listing.agents), [&](const std::vector<std::string>& of) {
            out.begin_object(Layout::row);
            out.values("agents", of);
            out.end_object();
        });
    out.end_object();
}

/// A row for each; the reasons for what is not a number stand in the last column.
void write_csv(const ConflictListing& listing) {
    std::cout << "a,b,begin,end,seconds,longest,intervals,least_clearance,time,x,y,a_sample,b_sample,invented"
              << (listing.within ? ",time_to_collision,post_encroachment_time,undefined\n" : "\n");
    for (std::size_t i = 0; i < listing.size; ++i) {
        const ListedConflict of = listing.row(i, true);
        std::cout << csv_field(of.a_name) << ',' << csv_field(of.b_name) << ','
                  << format_double(of.intervals.front().t0) << ',' << format_double(of.intervals.back().t1) << ','
                  << format_double(mobb::seconds_of(of.intervals)) << ','
                  << format_double(mobb::longest_of(of.intervals)) << ',' << of.intervals.size() << ','
                  << format_double(of.least_clearance) << ',' << format_double(of.time) << ','
                  << format_double(of.position.x) << ',' << format_double(of.position.y) << ',' << of.a_sample << ','
                  << of.b_sample << ',' << (of.invented ? "true" : "false");
        std::string undefined;
        for (const auto& seconds : {of.time_to_collision, of.post_encroachment}) {
            if (!seconds) continue;
            std::cout << ',' << (seconds->seconds ? format_double(*seconds->seconds) : "nan");
            if (!seconds->seconds) undefined += (undefined.empty() ? "" : "; ") + seconds->undefined;
        }
        std::cout << (listing.within ? "," + csv_field(undefined) : "") << '\n';
    }
}

std::string place_in_words(glm::dvec2 place) {
    return "(" + to_thousandth(place.x) + ", " + to_thousandth(place.y) + ")";
}

/// "; vertex conflict at 3 s in (1, 2) and 2 more": the first of each kind.
std::string plan_conflicts_in_words(const std::vector<PlanConflict>& found) {
    std::string out;
    for (const PlanConflictKind kind : {PlanConflictKind::vertex, PlanConflictKind::swap}) {
        const auto first = std::ranges::find(found, kind, &PlanConflict::kind);
        if (first == found.end()) continue;
        out += kind == PlanConflictKind::vertex
                   ? "; vertex conflict at " + brief(first->t0) + " s in " + place_in_words(first->a)
                   : "; swap (edge) conflict from " + brief(first->t0) + " to " + brief(first->t1) + " s between " +
                         place_in_words(first->a) + " and " + place_in_words(first->b);
        const auto all = std::ranges::count(found, kind, &PlanConflict::kind);
        if (all > 1) out += " and " + std::to_string(all - 1) + " more";
    }
    return out;
}

std::string in_words(const char* what, const std::optional<ListedSeconds>& of) {
    if (!of) return "";
    return std::string("; ") + (of->seconds ? what + (" " + brief(*of->seconds)) + " s"
                                            : std::string("no ") + what + ", as " + of->undefined);
}

/// "; 2 chains of contact, the largest of 3: ann, bob, cid".
std::string chains_in_words(const std::vector<std::vector<std::string>>& chains) {
    if (chains.empty()) return "";
    constexpr std::size_t kMostNames = 10;
    std::string out = "; " + counted(chains.size(), "chain", "chains") + " of contact, the largest of " +
                      std::to_string(chains.front().size()) + ":";
    for (std::size_t i = 0; i < std::min(kMostNames, chains.front().size()); ++i)
        out += (i == 0 ? " " : ", ") + cleaned(chains.front()[i]);
    return out + (chains.front().size() > kMostNames ? " ..." : "");
}

void write_text(const ConflictListing& listing) {
    const std::size_t listed = std::min(listing.size, TextRows::kMost);
    Chains chains;
    for (std::size_t i = 0; i < listing.size && (i < listed || listing.within); ++i) {
        const ListedConflict conflict = listing.row(i, i < listed);
        if (listing.within) chains.add(conflict);
        if (i >= listed) continue;
        std::cout << cleaned(conflict.a_name) << " and " << cleaned(conflict.b_name) << ": "
                  << brief(mobb::seconds_of(conflict.intervals)) << " s, ";
        const char* separator = "";
        for (const mobb::Interval& interval : conflict.intervals) {
            std::cout << separator << brief(interval.t0) << " to " << brief(interval.t1);
            separator = ", ";
        }
        std::cout << " s; least clearance " << brief(conflict.least_clearance) << " m at " << brief(conflict.time)
                  << " s near " << place_in_words(conflict.position) << ", samples " << conflict.a_sample << " and "
                  << conflict.b_sample << (conflict.invented ? "; rests on invented motion" : "")
                  << in_words("time to collision", conflict.time_to_collision)
                  << in_words("post-encroachment time", conflict.post_encroachment)
                  << (conflict.plan ? plan_conflicts_in_words(*conflict.plan) : "") << '\n';
    }
    tell_left_out(std::cout, listing.size - listed);
    if (listing.within) {
        std::cout << counted(listing.size, "encounter", "encounters") << " within " << brief(*listing.within)
                  << " m among " << counted(listing.agents, "agent", "agents") << ", " << figure(listing.seconds)
                  << " s in all";
    } else {
        std::cout << conflict_count(listing.size, listing.agents, listing.seconds);
    }
    std::cout << "; " << listing.pairs_tested << " of " << counted(listing.pairs, "pair", "pairs") << " tested"
              << chains_in_words(chains.names(listing.agents)) << '\n';
    if (listing.left_out.value_or(0) > 0) {
        std::cout << counted(*listing.left_out, "conflict rests on invented motion and is left out",
                             "conflicts rest on invented motion and are left out")
                  << '\n';
    }
    for (const std::string& warning : listing.warnings) std::cout << "in doubt: " << cleaned(warning) << '\n';
    if (listing.unforced.value_or(0) > 0)
        std::cout << counted(*listing.unforced, "contact", "contacts")
                  << " without a forced play: an answer was wrong, or the run was edited\n";
}

// Reading parts.

constexpr double kFar = std::numeric_limits<double>::max();
constexpr int kMostAgents = 500'000'000;  // no file has more bytes for them

std::optional<double> optional_number(const JsonPlace& in, const char* key) {
    const auto at = in.find(key);
    return !at || at->is_null() ? std::nullopt : std::optional(at->number(-kFar, kFar));
}

std::optional<ListedSeconds> read_seconds(const JsonPlace& in, const std::string& key) {
    if (!in.find(key)) return std::nullopt;
    const auto reason = in.find(key + "_undefined");
    return ListedSeconds{optional_number(in, key.c_str()), reason ? reason->string() : ""};
}

glm::dvec2 read_place(const JsonPlace& in, const char* key) {
    return in.require(key).vector<glm::dvec2>(kFar, "[x, y]");
}

/// Two whole numbers, the earlier the lesser or the same.
std::pair<int, int> read_numbers(const JsonPlace& in, const char* key, int least, int most) {
    const JsonPlace at = in.require(key);
    const glm::dvec2 read = at.vector<glm::dvec2>(kFar, "[a, b]");
    if (read.x != std::floor(read.x) || read.y != std::floor(read.y) || read.x < least || read.x > read.y ||
        read.y > most)
        at.fail("must be two whole numbers from " + std::to_string(least) + " to " + std::to_string(most) +
                ", the lesser first; ask for this part again");
    return {static_cast<int>(read.x), static_cast<int>(read.y)};
}

ListedConflict read_row(const JsonPlace& in, std::size_t agents) {
    constexpr int kMost = std::numeric_limits<int>::max();
    ListedConflict out;
    std::tie(out.a, out.b) = read_numbers(in, "agents", 0, static_cast<int>(agents) - 1);
    if (out.a == out.b) in.fail("names one agent twice; ask for this part again");
    out.a_name = in.require("a").string();
    out.b_name = in.require("b").string();
    in.require("intervals").each([&](const JsonPlace& of) {
        const glm::dvec2 interval = of.vector<glm::dvec2>(kFar, "[t0, t1]");
        out.intervals.push_back({interval.x, interval.y});
    });
    if (out.intervals.empty()) in.fail("it has no interval");
    out.least_clearance = in.require("least_clearance").number(-kFar, kFar);
    out.time = in.require("time").number(-kFar, kFar);
    out.a_sample = in.require("a_sample").integer(0, kMost);
    out.b_sample = in.require("b_sample").integer(0, kMost);
    out.position = read_place(in, "position");
    out.invented = in.find("invented").has_value();
    out.time_to_collision = read_seconds(in, "time_to_collision");
    out.post_encroachment = read_seconds(in, "post_encroachment_time");
    if (const auto plan = in.find("plan")) {
        out.plan.emplace();
        plan->each([&](const JsonPlace& of) {
            const bool swap = of.require("kind").string() == name(PlanConflictKind::swap);
            out.plan->push_back({swap ? PlanConflictKind::swap : PlanConflictKind::vertex,
                                 of.require("t0").number(-kFar, kFar), of.require("t1").number(-kFar, kFar),
                                 read_place(of, "a"), read_place(of, "b")});
        });
    }
    return out;
}

/// What stands first in the order of conflicts.
using Rank = std::tuple<double, double, double, int, int>;

/// A part, read row by row: all of them may be too much for the memory.
class PartReader {
  public:
    explicit PartReader(const std::filesystem::path& file)
        : file_(file.string()), lines_(Input::open(file).pieces(), file_) {
        // As it is written, but for the rows, of which each has a line.
        std::string rest;
        while (!has_lines_ && lines_.next()) {
            rest.append(lines_.line()) += '\n';
            has_lines_ = lines_.line() == "\"conflicts\": [";
        }
        if (!rest.empty() && rest.front() != '{')
            throw InputError(file_, "", "is no part; give what mobbscope conflicts --part K/N has written");
        if (has_lines_) rest += "]}";
        read_head(parsed(rest));
    }

    const ConflictListing& head() const { return head_; }
    const ListedConflict& row() const { return row_; }
    const Rank& rank() const { return rank_; }

    /// Moves to the next row; false at the end.
    bool next() {
        if (is_done_) return false;
        if (!has_lines_ || !lines_.next()) fail();
        std::string_view line = lines_.line();
        if (line == "]") {
            is_done_ = true;
            if (!lines_.next() || lines_.line() != "}" || lines_.next()) fail();
            return false;
        }
        if (line.ends_with(',')) line.remove_suffix(1);
        const JsonText json = parsed(line);
        try {
            row_ = read_row(JsonPlace(json, file_), head_.agents);
        } catch (const InputError&) {
            lines_.fail("is not as it was written; ask for this part again");
        }
        const Rank before = std::exchange(rank_, {row_.least_clearance, -mobb::seconds_of(row_.intervals),
                                                  mobb::interval_at(row_.intervals, row_.time).t0, row_.a, row_.b});
        if (++rows_ > 1 && rank_ < before) lines_.fail("is not in its place; ask for this part again");
        return true;
    }

  private:
    /// One that was killed while it was written ends anywhere.
    [[noreturn]] void fail() const {
        throw InputError(file_, "", "is not whole; ask for this part again: mobbscope conflicts ... --part K/N");
    }
    JsonText parsed(std::string_view text) const {
        try {
            return parse_json(text, file_);
        } catch (const InputError&) {
            fail();
        }
    }
    void read_head(const JsonText& json) {
        const JsonPlace in(json, file_);
        const auto part = in.find("part");
        if (!part) in.fail("is no part; give what mobbscope conflicts --part K/N has written");
        const auto [number, of] = read_numbers(in, "part", 1, kMostParts);
        head_.part = {number, of};
        head_.digest = read_digest(in.require("digest"));
        // Of older versions nobody knows.
        if (const auto format = in.find("format")) {
            const auto name = std::ranges::find(kFormatNames, format->string());
            if (name == kFormatNames.end()) format->fail("is none of text, json and csv; ask for this part again");
            head_.format = static_cast<ListingFormat>(name - kFormatNames.begin());
        }
        head_.file = in.require("file").string();
        head_.t0 = optional_number(in, "t0");
        head_.agents = static_cast<std::size_t>(in.require("agents").integer(0, kMostAgents));
        head_.radius = optional_number(in, "radius");
        head_.pairs = static_cast<std::size_t>(in.require("pairs").count());
        head_.pairs_tested = static_cast<std::size_t>(in.require("pairs_tested").count());
        in.require("warnings").each([&](const JsonPlace& one) { head_.warnings.push_back(one.string()); });
        if (const auto unforced = in.find("unforced")) head_.unforced = unforced->count();
        if (const auto left_out = in.find("left_out")) head_.left_out = static_cast<std::size_t>(left_out->count());
        head_.within = optional_number(in, "within");
        head_.least_seconds = optional_number(in, "min_duration");
        is_done_ = in.require("conflicts").size() == 0 && !has_lines_;
    }

    std::string file_;
    TextLines lines_;
    ConflictListing head_;
    ListedConflict row_;
    Rank rank_;
    std::size_t rows_ = 0;
    bool has_lines_ = false;  ///< of its own each row has
    bool is_done_ = false;
};

/// The rows of all parts, worst first.
class MergedRows {
  public:
    explicit MergedRows(const std::vector<std::filesystem::path>& files) {
        for (const std::filesystem::path& file : files) parts_.push_back(std::make_unique<PartReader>(file));
    }

    const PartReader& part(std::size_t i) const { return *parts_[i]; }

    /// Null at the end; else it lasts until the next is asked for.
    const ListedConflict* next() {
        for (std::size_t i = last_.value_or(0); i < (last_ ? *last_ + 1 : parts_.size()); ++i) {
            if (parts_[i]->next()) ranks_.emplace(parts_[i]->rank(), i);
        }
        last_.reset();
        if (ranks_.empty()) return nullptr;
        last_ = ranks_.top().second;
        ranks_.pop();
        return &parts_[*last_]->row();
    }

  private:
    std::vector<std::unique_ptr<PartReader>> parts_;
    using Ranked = std::pair<Rank, std::size_t>;
    std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>> ranks_;
    std::optional<std::size_t> last_;  ///< the part whose row is in hand
};

}  // namespace

bool ConflictListing::is_of_the_same(const ConflictListing& other) const {
    const auto of = [](const ConflictListing& one) {
        return std::tuple(one.file, one.digest, one.t0, one.agents, one.radius, one.pairs, one.unforced, one.within,
                          one.least_seconds, one.left_out.has_value(), one.part ? one.part->parts : 0);
    };
    return of(*this) == of(other);
}

void write_listing(const ConflictListing& listing) {
    switch (listing.part ? ListingFormat::json : listing.format) {
        case ListingFormat::text:
            return write_text(listing);
        case ListingFormat::json:
            return write_json(listing);
        case ListingFormat::csv:
            return write_csv(listing);
    }
}

ConflictListing merged_listing(const std::vector<std::filesystem::path>& files) {
    MergedRows rows(files);
    std::optional<ConflictListing> whole;
    std::map<int, std::string> seen;  // by part
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string file = files[i].string();
        const ConflictListing& part = rows.part(i).head();
        const std::string what = std::to_string(part.part->part) + "/" + std::to_string(part.part->parts);
        if (whole && !whole->is_of_the_same(part))
            throw InputError(file, "",
                             "is a part of another whole than " + files.front().string() +
                                 "; give the parts of one file, with the same options and as many parts");
        if (!seen.emplace(part.part->part, file).second)
            throw InputError(file, "", "is part " + what + ", as " + seen[part.part->part] + " is; give each once");
        if (whole) {
            whole->pairs_tested += part.pairs_tested;
            if (whole->left_out) *whole->left_out += part.left_out.value_or(0);
        } else {
            whole = part;
        }
    }
    int missing = 1;
    while (seen.contains(missing)) ++missing;
    if (missing <= whole->part->parts) {
        const std::string what = std::to_string(missing) + "/" + std::to_string(whole->part->parts);
        throw InputError(files.front().string(), "",
                         "part " + what + " is missing; ask for it with the options of the others and --part " + what);
    }
    whole->part.reset();
    // Every row is looked at before one is written.
    while (const ListedConflict* row = rows.next()) {
        ++whole->size;
        whole->seconds += mobb::seconds_of(row->intervals);
    }
    whole->row = [again = std::make_shared<MergedRows>(files)](std::size_t, bool) { return *again->next(); };
    return std::move(*whole);
}

}  // namespace mobbscope::cli
