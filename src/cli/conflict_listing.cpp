#include <base/error.h>
#include <base/file.h>
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
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

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
constexpr int kMostAgents = 10'000'000;  // no file has more samples

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

/// Appends the rows to `rows`.
ConflictListing read_part(const std::filesystem::path& file, std::vector<ListedConflict>& rows) {
    const std::string name = file.string();
    const std::string text = read_file(file);
    const JsonText json = [&] {
        try {
            return parse_json(text, name);
        } catch (const InputError&) {
            // One that was killed while it was written ends anywhere.
            throw InputError(name, "", "is not whole; ask for this part again: mobbscope conflicts ... --part K/N");
        }
    }();
    const JsonPlace in(json, name);
    ConflictListing out;
    const auto part = in.find("part");
    if (!part) in.fail("is no part; give what mobbscope conflicts --part K/N has written");
    const auto [number, of] = read_numbers(in, "part", 1, kMostParts);
    out.part = {number, of};
    out.digest = read_digest(in.require("digest"));
    out.file = in.require("file").string();
    out.t0 = optional_number(in, "t0");
    out.agents = static_cast<std::size_t>(in.require("agents").integer(0, kMostAgents));
    out.radius = optional_number(in, "radius");
    out.pairs = static_cast<std::size_t>(in.require("pairs").count());
    out.pairs_tested = static_cast<std::size_t>(in.require("pairs_tested").count());
    in.require("warnings").each([&](const JsonPlace& one) { out.warnings.push_back(one.string()); });
    if (const auto unforced = in.find("unforced")) out.unforced = unforced->count();
    if (const auto left_out = in.find("left_out")) out.left_out = static_cast<std::size_t>(left_out->count());
    out.within = optional_number(in, "within");
    out.least_seconds = optional_number(in, "min_duration");
    in.require("conflicts").each([&](const JsonPlace& row) { rows.push_back(read_row(row, out.agents)); });
    return out;
}

}  // namespace

bool ConflictListing::is_of_the_same(const ConflictListing& other) const {
    const auto of = [](const ConflictListing& one) {
        return std::tuple(one.file, one.digest, one.t0, one.agents, one.radius, one.pairs, one.unforced, one.within,
                          one.least_seconds, one.left_out.has_value(), one.part ? one.part->parts : 0);
    };
    return of(*this) == of(other);
}

void write_listing(const ConflictListing& listing, ListingFormat format) {
    switch (format) {
        case ListingFormat::text:
            return write_text(listing);
        case ListingFormat::json:
            return write_json(listing);
        case ListingFormat::csv:
            return write_csv(listing);
    }
}

ConflictListing merged_listing(const std::vector<std::filesystem::path>& files) {
    const auto rows = std::make_shared<std::vector<ListedConflict>>();
    std::optional<ConflictListing> whole;
    std::map<int, std::string> seen;  // by part
    for (const std::filesystem::path& file : files) {
        ConflictListing part = read_part(file, *rows);
        const std::string what = std::to_string(part.part->part) + "/" + std::to_string(part.part->parts);
        if (whole && !whole->is_of_the_same(part))
            throw InputError(file.string(), "",
                             "is a part of another whole than " + files.front().string() +
                                 "; give the parts of one file, with the same options and as many parts");
        if (!seen.emplace(part.part->part, file.string()).second)
            throw InputError(file.string(), "",
                             "is part " + what + ", as " + seen[part.part->part] + " is; give each once");
        if (whole) {
            whole->pairs_tested += part.pairs_tested;
            if (whole->left_out) *whole->left_out += part.left_out.value_or(0);
        } else {
            whole = std::move(part);
        }
    }
    int missing = 1;
    while (seen.contains(missing)) ++missing;
    if (missing <= whole->part->parts) {
        const std::string what = std::to_string(missing) + "/" + std::to_string(whole->part->parts);
        throw InputError(files.front().string(), "",
                         "part " + what + " is missing; ask for it with the options of the others and --part " + what);
    }
    std::ranges::sort(*rows, {}, [](const ListedConflict& of) {
        return std::tuple(of.least_clearance, -mobb::seconds_of(of.intervals),
                          mobb::interval_at(of.intervals, of.time).t0, of.a, of.b);
    });
    whole->part.reset();
    whole->size = rows->size();
    for (const ListedConflict& of : *rows) whole->seconds += mobb::seconds_of(of.intervals);
    whole->row = [rows](std::size_t i, bool) { return (*rows)[i]; };
    return std::move(*whole);
}

}  // namespace mobbscope::cli
