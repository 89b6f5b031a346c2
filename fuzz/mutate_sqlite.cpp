#include <fuzz/mutate.h>

#include <sqlite3.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

namespace mobbscope::fuzz {

namespace {

using Cell = std::variant<std::nullptr_t, std::int64_t, double, std::string>;

struct Table {
    std::string name;
    std::vector<std::pair<std::string, std::string>> columns;  ///< names and types
    std::vector<std::vector<Cell>> rows;
};

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;

Database memory_database() {
    sqlite3* opened = nullptr;
    sqlite3_open(":memory:", &opened);
    return {opened, &sqlite3_close};
}

template <class Row>
bool each_row(sqlite3* database, const std::string& query, const Row& row) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(database, query.c_str(), -1, &prepared, nullptr) != SQLITE_OK) return false;
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(prepared, &sqlite3_finalize);
    int status = SQLITE_ROW;
    while ((status = sqlite3_step(prepared)) == SQLITE_ROW) row(prepared);
    return status == SQLITE_DONE;
}

std::string text_of(sqlite3_stmt* row, int column) {
    const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    return text ? text : "";
}

Cell cell_of(sqlite3_stmt* row, int column) {
    switch (sqlite3_column_type(row, column)) {
        case SQLITE_INTEGER:
            return sqlite3_column_int64(row, column);
        case SQLITE_FLOAT:
            return sqlite3_column_double(row, column);
        case SQLITE_NULL:
            return nullptr;
        default:
            return text_of(row, column);
    }
}

std::string sql_name(const std::string& name, char quote = '"') {
    std::string out(1, quote);
    for (const char c : name) out += c == quote ? std::string(2, c) : std::string(1, c == '\0' ? '?' : c);
    return out + quote;
}

std::vector<Table> tables_in(const std::string& bytes) {
    const Database database = memory_database();
    auto* const copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
    if (!copy) return {};
    std::memcpy(copy, bytes.data(), bytes.size());
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    if (sqlite3_deserialize(database.get(), "main", copy, size, size, SQLITE_DESERIALIZE_FREEONCLOSE) != SQLITE_OK)
        return {};
    std::vector<Table> out;
    each_row(database.get(), "SELECT name FROM sqlite_schema WHERE type = 'table' LIMIT 20", [&](sqlite3_stmt* row) {
        out.push_back({text_of(row, 0), {}, {}});
    });
    for (Table& table : out) {
        each_row(database.get(), "PRAGMA table_info(" + sql_name(table.name) + ")",
                 [&](sqlite3_stmt* row) { table.columns.emplace_back(text_of(row, 1), text_of(row, 2)); });
        each_row(database.get(), "SELECT * FROM " + sql_name(table.name) + " LIMIT 500", [&](sqlite3_stmt* row) {
            std::vector<Cell> cells;
            for (int i = 0; i < sqlite3_column_count(row); ++i) cells.push_back(cell_of(row, i));
            table.rows.push_back(std::move(cells));
        });
    }
    return out;
}

void edit_tables(std::vector<Table>& tables, Mutation& by) {
    if (tables.empty()) return;
    Table& table = tables[by.below(tables.size())];
    const auto a_row = [&]() -> std::vector<Cell>& { return table.rows[by.below(table.rows.size())]; };
    switch (by.below(10)) {
        case 0:
            if (by.one_in(4)) {
                table.name = by.bytes(table.name);
            } else if (!table.columns.empty()) {
                auto& [name, type] = table.columns[by.below(table.columns.size())];
                constexpr const char* kTypes[] = {"", "TEXT", "REAL", "INTEGER", "BLOB", "NUMERIC"};
                if (by.one_in(2)) {
                    type = kTypes[by.below(std::size(kTypes))];
                } else {
                    name = by.bytes(name);
                }
            }
            break;
        case 1:
            if (by.one_in(4)) tables.erase(tables.begin() + (&table - tables.data()));
            break;
        case 2:
            if (!table.rows.empty()) table.rows.insert(table.rows.end(), by.one_in(8) ? 50 : 1, std::vector(a_row()));
            break;
        case 3:
            if (!table.rows.empty()) table.rows.erase(table.rows.begin() + (&a_row() - table.rows.data()));
            break;
        default: {
            if (table.rows.empty() || table.columns.empty()) break;
            std::vector<Cell>& row = a_row();
            if (row.empty()) break;
            Cell& cell = row[by.below(row.size())];
            constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
            if (by.one_in(6)) {
                const std::vector<Cell> odd{
                    nullptr, kMost,         -kMost,         std::numeric_limits<double>::infinity(),
                    1e300,   std::string(), by.odd_number()};
                cell = odd[by.below(odd.size())];
            } else if (auto* whole = std::get_if<std::int64_t>(&cell)) {
                const double number = by.other_number(static_cast<double>(*whole));
                cell = number > -9e18 && number < 9e18 ? Cell(static_cast<std::int64_t>(number)) : Cell(number);
            } else if (auto* real = std::get_if<double>(&cell)) {
                *real = by.other_number(*real);
            } else if (auto* text = std::get_if<std::string>(&cell)) {
                *text = by.one_in(2) ? by.odd_number() : by.bytes(*text);
            }
        }
    }
}

std::string database_of(const std::vector<Table>& tables, Mutation& by) {
    const Database database = memory_database();
    const auto run = [&](const std::string& sql) { each_row(database.get(), sql, [](sqlite3_stmt*) {}); };
    run("PRAGMA page_size = 512");
    run("BEGIN");
    for (const Table& table : tables) {
        std::string columns, places;
        for (const auto& [name, type] : table.columns) {
            columns += (columns.empty() ? "" : ", ") + sql_name(name) + ' ' + type;
            places += places.empty() ? "?" : ", ?";
        }
        run("CREATE TABLE " + sql_name(table.name) + '(' + columns + ')');
        sqlite3_stmt* prepared = nullptr;
        sqlite3_prepare_v2(database.get(), ("INSERT INTO " + sql_name(table.name) + " VALUES(" + places + ')').c_str(),
                           -1, &prepared, nullptr);
        const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> insert(prepared, &sqlite3_finalize);
        if (!insert) continue;
        for (const std::vector<Cell>& row : table.rows) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                const int at = static_cast<int>(i) + 1;
                if (std::holds_alternative<std::nullptr_t>(row[i])) sqlite3_bind_null(prepared, at);
                if (const auto* whole = std::get_if<std::int64_t>(&row[i])) sqlite3_bind_int64(prepared, at, *whole);
                if (const auto* real = std::get_if<double>(&row[i])) sqlite3_bind_double(prepared, at, *real);
                if (const auto* text = std::get_if<std::string>(&row[i]))
                    sqlite3_bind_text(prepared, at, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
            }
            sqlite3_step(prepared);
            sqlite3_reset(prepared);
        }
    }
    if (by.one_in(16)) {
        run("ALTER TABLE trajectory_data RENAME TO points");
        run(by.one_in(2)
                ? "CREATE VIEW trajectory_data AS SELECT * FROM points"
                : "CREATE VIEW trajectory_data AS WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n) "
                  "SELECT i AS frame, 1 AS id, 0 AS pos_x, 0 AS pos_y FROM n");
    }
    run("COMMIT");
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
        sqlite3_serialize(database.get(), "main", &size, 0), &sqlite3_free);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)) : "";
}

}  // namespace

std::string mutated_sqlite(const std::string& bytes, Mutation& mutation) {
    std::vector<Table> tables = tables_in(bytes);
    if (tables.empty()) return "";
    for (std::size_t edits = mutation.edits(); edits > 0; --edits) edit_tables(tables, mutation);
    return database_of(tables, mutation);
}

}  // namespace mobbscope::fuzz
