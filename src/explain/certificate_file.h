/// Certificates as files (contract, "Certificates"):
///
///     {"mobbscope_certificate": 1, "queries": [{"query": 0, "a": "A", "b": "B", "collides": false, "contact": null,
///      "tiles": [{"t0": 0, "t1": 5, "direction": [1, 0], "speed": 0, "gap": 0.2}],
///      "margins": {"growth": 0.1, "shift_in_time": 0.4, "free_region": [[-0.2, -9], ...], "bounded": true}}]}
///
/// The margins are of a miss, else null; a shift in time of null may be as long as it likes. "not_proven" is there
/// where doubles hold times badly, and says how badly (doubt_words). Who checks a proof needs none of them.
#pragma once

#include <explain/certificate.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// A proof and the query that it is about.
struct QueryCertificate {
    int query = 0;  ///< index
    Certificate proof;
};

/// The file of these. Throws InputError of a scene with bodies, whose disks are proven one by one.
std::string certificate_text(const FittedScene& fitted, const std::vector<QueryCertificate>& certificates);

/// Of a scene: the queries that a text names must be there, under the same names. `file` stands for it in messages.
/// Throws InputError.
std::vector<QueryCertificate> read_certificates(std::string_view text, const std::string& file,
                                                const FittedScene& fitted);

}  // namespace mobbscope
