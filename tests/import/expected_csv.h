/// The tables of the shared data set that say what must come out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// Column name to field.
using Row = std::map<std::string, std::string>;

/// The fields of a line; one in double quotes may hold commas.
inline std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            out.emplace_back();
        } else if (c != '\r') {
            out.back() += c;
        }
    }
    return out;
}

inline std::vector<Row> read_rows(const std::filesystem::path& table) {
    std::ifstream in(table);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = fields(line);
    std::vector<Row> rows;
    while (std::getline(in, line)) {
        const std::vector<std::string> row = fields(line);
        rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = i < row.size() ? row[i] : "";
    }
    return rows;
}

}  // namespace testing
}  // namespace mobbscope
