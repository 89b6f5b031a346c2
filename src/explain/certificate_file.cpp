#include <base/error.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <explain/certificate_file.h>
#include <explain/margins.h>
#include <explain/proof_words.h>
#include <scene/scene_json.h>

#include <set>
#include <sstream>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kVersion = 1;

Tile read_tile(const JsonPlace& place) {
    Tile out;
    // Starts and durations of clips are within kMaxTime, and places within kMaxLength: what is far beyond is no proof.
    constexpr double kFar = 4;
    const auto number = [](const JsonPlace& of, double most) { return of.number(-most, most); };
    out.t0 = number(place.require("t0"), kFar * mobb::kMaxTime);
    out.t1 = number(place.require("t1"), kFar * mobb::kMaxTime);
    if (out.t1 <= out.t0) place.fail("it ends before it begins");
    const JsonPlace direction = place.require("direction");
    direction.require_size(2, "numbers");
    out.direction = {number(direction[0], 2), number(direction[1], 2)};
    if (const auto speed = place.find("speed")) out.speed = number(*speed, mobb::kMaxLength / mobb::kLeastDt);
    out.gap = number(place.require("gap"), kFar * mobb::kMaxLength);
    return out;
}

QueryCertificate read_certificate(const JsonPlace& place, const FittedScene& fitted) {
    QueryCertificate out;
    const JsonPlace index = place.require("query");
    out.query = index.integer(0, kMaxInt);
    const std::size_t queries = fitted.queries().size();
    if (static_cast<std::size_t>(out.query) >= queries)
        index.fail("the scene has " + counted(queries, "query", "queries") + ", counted from 0");
    const SceneQuery query = fitted.queries()[static_cast<std::size_t>(out.query)];
    for (const auto& [key, side] : {std::pair("a", &query.a), std::pair("b", &query.b)}) {
        const JsonPlace name = place.require(key);
        if (name.string() != side->name)
            name.fail("it is about " + in_quotes(name.string()) + ", and the scene's query about " +
                      in_quotes(side->name));
    }
    const auto samples = [&](const PlacedAgent& side) { return fitted.tree(side).clip().count(); };
    const JsonPlace contact = place.require("contact");
    out.proof.contact = read_contact(contact, samples(query.a), samples(query.b));
    const JsonPlace collides = place.require("collides");
    if (collides.boolean() != out.proof.contact.has_value())
        collides.fail("with a contact two collide, and without one they do not");
    std::vector<Tile>& tiles = out.proof.tiles;
    place.require("tiles").each([&](const JsonPlace& tile) {
        const Tile read = read_tile(tile);
        if (!tiles.empty() && read.t0 < tiles.back().t1) tile.fail("it begins before the one before it ends");
        tiles.push_back(read);
    });
    return out;
}

void write_margins(JsonWriter& out, const std::optional<Margins>& margins) {
    if (!margins) return out.null();
    out.begin_object();
    out.members("growth", margins->growth, "shift_in_time", margins->shift_in_time);
    out.list("free_region", margins->free_region, [&](glm::dvec2 corner) { out.value(corner); });
    out.member("bounded", margins->bounded);
    out.end_object();
}

/// An element of `queries`.
void write_certificate(JsonWriter& out, const FittedScene& fitted, const QueryCertificate& certificate) {
    const SceneQuery query = fitted.queries()[static_cast<std::size_t>(certificate.query)];
    const Certificate& proof = certificate.proof;
    out.begin_object();
    out.members("query", certificate.query, "a", query.a.name, "b", query.b.name, "collides",
                proof.contact.has_value());
    out.key("contact");
    write_contact(out, proof.contact);
    out.list("tiles", proof.tiles, [&](const Tile& tile) {
        out.begin_object(JsonWriter::Layout::row);
        out.members("t0", tile.t0, "t1", tile.t1);
        out.member("direction", {tile.direction.x, tile.direction.y});
        out.members("speed", tile.speed, "gap", tile.gap);
        out.end_object();
    });
    out.key("margins");
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    write_margins(out, margins_of(a.placed_clip(), b.placed_clip(), proof));
    const std::string doubt = doubt_words(query.a.name, a.placed_clip(), query.b.name, b.placed_clip());
    if (!doubt.empty()) out.member("not_proven", doubt);
    out.end_object();
}

}  // namespace

std::string certificate_text(const FittedScene& fitted, const std::vector<QueryCertificate>& certificates) {
    refuse_bodies(fitted.scene(), "a proof");
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object();
    out.member("mobbscope_certificate", kVersion);
    out.list("queries", certificates, [&](const QueryCertificate& one) { write_certificate(out, fitted, one); });
    out.end_object();
    return std::move(text).str();
}

std::vector<QueryCertificate> read_certificates(std::string_view text, const std::string& file,
                                                const FittedScene& fitted) {
    const JsonText value = parse_json(text, file);
    const JsonPlace place(value, file);
    const auto version = place.is_object() ? place.find("mobbscope_certificate") : std::nullopt;
    if (!version) throw InputError(file, "is not a certificate: mobbscope query --certificate writes one");
    if (version->integer(1, kMaxInt) > kVersion) version->fail("it is of a newer version of Mobbscope");
    std::vector<QueryCertificate> out;
    std::set<int> known;
    place.require("queries").each([&](const JsonPlace& query) {
        out.push_back(read_certificate(query, fitted));
        if (!known.insert(out.back().query).second) query.fail("the proof of this query is given twice");
    });
    return out;
}

}  // namespace mobbscope
