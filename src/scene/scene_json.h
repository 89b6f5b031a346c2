/// Parts of the scene file that stand in other JSON too: fits, contacts and traces.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <mobb/query.h>
#include <mobb/trace.h>
#include <mobb/tree.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mobbscope {

/// The kind of trees of that name, if there is one. Throws std::invalid_argument, naming the new name, for an old one.
std::optional<mobb::TreeKind> find_tree_kind(std::string_view name);
/// Throws InputError for a member `tree`, at any depth, that is an old name.
void refuse_old_tree_names(const JsonPlace& place);

/// The `fit` of a scene file over `base`: a key that is not there keeps its value. Each has FitOptions' name for it:
///
///     {"tree": "mobb", "leaf": 10, "levels": 0, "axes": "endpoints", "time_scale": 1}
///
/// Throws InputError.
mobb::FitOptions read_fit(const JsonPlace& place, mobb::FitOptions base = {});
void write_fit(JsonWriter& out, const mobb::FitOptions& fit);

/// mobb::digest as files have it: 16 hexadecimal digits.
std::string digest_text(std::uint64_t digest);
/// Throws InputError.
std::uint64_t read_digest(const JsonPlace& place);

/// An object, or null for no contact.
void write_contact(JsonWriter& out, const std::optional<mobb::Contact>& contact);
/// `samples_a`, `samples_b`: how many samples the two clips have. Throws InputError.
std::optional<mobb::Contact> read_contact(const JsonPlace& place, int samples_a, int samples_b);

/// How many tests of the kinds that are named, by mobb::TestKind::index(). Throws InputError.
std::array<std::optional<std::int64_t>, mobb::kTestKindCount> read_test_counts(const JsonPlace& place);

/// One event a line. `axis` and `gap` are null where nothing is separated, `pairs` is empty where none is measured.
/// `avoidable`: events that are marked so, in order.
void write_trace(JsonWriter& out, const mobb::Trace& trace, std::span<const int> avoidable = {});
/// One of them, an object.
void write_event(JsonWriter& out, const mobb::Trace& trace, int step, bool avoidable = false);
/// The events of these steps alone.
void write_events(JsonWriter& out, const mobb::Trace& trace, std::span<const int> steps,
                  std::span<const int> avoidable);
/// Checks that steps count from 0, parents come earlier, depths follow from them, outcomes fit their tests, and nodes
/// and samples exist in clips of so many samples. Throws InputError.
mobb::Trace read_trace(const JsonPlace& place, int samples_a, int samples_b);

}  // namespace mobbscope
