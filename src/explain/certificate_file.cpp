#include <base/error.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <explain/certificate_file.h>
#include <scene/scene_json.h>

#include <sstream>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kVersion = 1;

Tile read_tile(const JsonPlace& place) {
    Tile out;
    out.t0 = place.require("t0").number();
    out.t1 = place.require("t1").number();
    const JsonPlace direction = place.require("direction");
    direction.require_size(2, "numbers");
    out.direction = {direction[0].number(), direction[1].number()};
    if (const auto speed = place.find("speed")) out.speed = speed->number();
    out.gap = place.require("gap").number();
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
    const auto samples = [&](const PlacedAgent& side) { return fitted.tree(side.clip).clip().count(); };
    const JsonPlace contact = place.require("contact");
    out.proof.contact = read_contact(contact, samples(query.a), samples(query.b));
    const JsonPlace collides = place.require("collides");
    if (collides.boolean() != out.proof.contact.has_value())
        collides.fail("with a contact two collide, and without one they do not");
    place.require("tiles").each([&](const JsonPlace& tile) { out.proof.tiles.push_back(read_tile(tile)); });
    return out;
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
    out.end_object();
}

}  // namespace

std::string certificate_text(const FittedScene& fitted, const std::vector<QueryCertificate>& certificates) {
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
    const JsonValue value = parse_json(text, file);
    const JsonPlace place(value, file);
    const auto version = place.is_object() ? place.find("mobbscope_certificate") : std::nullopt;
    if (!version) throw InputError(file, "is no certificate: mobbscope query --certificate writes one");
    if (version->integer(1, kMaxInt) > kVersion) version->fail("it is of a newer version of Mobbscope");
    std::vector<QueryCertificate> out;
    place.require("queries").each([&](const JsonPlace& query) { out.push_back(read_certificate(query, fitted)); });
    return out;
}

}  // namespace mobbscope
