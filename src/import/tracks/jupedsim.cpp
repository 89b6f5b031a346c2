// JuPedSim's trajectories: an SQLite database with a table of points and one of metadata.
#include <import/tracks/rows.h>

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

namespace mobbscope {

namespace {

constexpr std::string_view kSqliteMark{"SQLite format 3\0", 16};
constexpr std::size_t kSqliteHeader = 100;                  // bytes
constexpr std::array<std::size_t, 2> kJournalMode{18, 19};  // where the header says how the file is written and read
constexpr std::array<std::string_view, 3> kVersions{"1", "2", "3"};

// A row takes more bytes than this. A damaged file can lead through the same rows again and again.
constexpr std::size_t kLeastRow = 8;
// Steps of SQLite's machine that a byte of the file is good for; a row of four columns takes some ten.
constexpr std::int64_t kStepsPerByte = 16;
constexpr int kStepsBetweenChecks = 10'000;
constexpr int kLongestValue = 1 << 20;  // bytes
// Bytes that SQLite needs beside the file's copy: some values, and its two MB of pages.
constexpr sqlite3_uint64 kMostOfSqlite = 8 * kLongestValue;

bool can_allocate(sqlite3_uint64 bytes) {
    void* const space = sqlite3_malloc64(bytes);
    sqlite3_free(space);
    return space != nullptr;
}

class Database {
  public:
    /// Opens a copy in memory: nothing is locked, and nothing is written beside the file.
    Database(std::string_view bytes, const std::string& file)
        : file_(file), steps_left_(static_cast<std::int64_t>(bytes.size()) * kStepsPerByte + kStepsBetweenChecks) {
        for (const char* const ending : {"-wal", "-journal"}) {
            std::error_code none;
            const std::uintmax_t log = std::filesystem::file_size(file + ending, none);
            if (!none && log > 0) {
                fail("a part of it is still in " + file + ending +
                     "; close the program that writes it, or open it once with sqlite3, which puts both together");
            }
        }
        if (bytes.size() < kSqliteHeader) fail("ends within the header of its SQLite database; get the whole file");
        sqlite3* opened = nullptr;
        const int status = sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE, nullptr);
        database_.reset(opened);
        if (status != SQLITE_OK) throw std::bad_alloc();
        // SQLite frees the copy.
        auto* const copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
        if (!copy) throw std::bad_alloc();
        std::copy(bytes.begin(), bytes.end(), copy);
        // Without a log beside it the file is read like any other.
        for (const std::size_t place : kJournalMode) copy[place] = 1;
        const auto size = static_cast<sqlite3_int64>(bytes.size());
        check(sqlite3_deserialize(opened, "main", copy, size, size,
                                  SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_READONLY));
        // What the schema of a file says is data, not to be run.
        sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kLongestValue);
        sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
        sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
        sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
        sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
        sqlite3_progress_handler(
            opened, kStepsBetweenChecks,
            [](void* left) { return static_cast<int>((*static_cast<std::int64_t*>(left) -= kStepsBetweenChecks) < 0); },
            &steps_left_);
        check(sqlite3_exec(opened, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr));
    }

    [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, "", message); }

    /// Calls `row` with each row of a query, as long as there are.
    template <class Row>
    void each(const char* query, const Row& row) {
        sqlite3_stmt* prepared = nullptr;
        check(sqlite3_prepare_v2(database_.get(), query, -1, &prepared, nullptr));
        const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(prepared, sqlite3_finalize);
        int status = SQLITE_ROW;
        while ((status = sqlite3_step(prepared)) == SQLITE_ROW) row(prepared);
        if (status != SQLITE_DONE) check(status);
    }

  private:
    void check(int status) const {
        if (status == SQLITE_OK) return;
        // SQLite says the same of a damaged length that is beyond what it ever allocates.
        if (status == SQLITE_NOMEM && !can_allocate(kMostOfSqlite)) throw std::bad_alloc();
        if (status == SQLITE_NOMEM) fail("the SQLite database is damaged: a value is too long; get the file again");
        if (status == SQLITE_INTERRUPT) fail("the SQLite database is damaged: it never ends; get the file again");
        fail("the SQLite database is damaged or cut off (" + cleaned(sqlite3_errmsg(database_.get())) +
             "); get the file again");
    }

    const std::string& file_;
    std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database_{nullptr, sqlite3_close};
    std::int64_t steps_left_;
};

std::string text_in(sqlite3_stmt* row, int column) {
    const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    return text ? text : "";
}

class JupedsimReader final : public Cells {
  public:
    JupedsimReader(std::string_view bytes, const std::string& file)
        : Cells(file), most_rows_(bytes.size() / kLeastRow), database_(bytes, file), rows_(file) {}

    TrackFile read() {
        check_tables();
        const std::optional<double> rate = read_metadata();
        std::size_t place = 0;
        for (const Column column : {Column::frame, Column::id, Column::x, Column::y}) rows_[column].emplace(place++);
        rows_.whole_in = "jupedsim";
        count_ = 0;
        database_.each("SELECT frame, id, pos_x, pos_y FROM trajectory_data", [&](sqlite3_stmt* row) {
            check_count();
            row_ = row;
            rows_.add(*this);
        });
        if (rows_.empty()) database_.fail("the table trajectory_data has no row; nobody is there");
        TrackFile out = rows_.finish();
        out.format = "jupedsim";
        out.rate = rate;
        out.fps_is_rate = !rate;
        return out;
    }

    double number(std::size_t column) const override {
        const int type = sqlite3_column_type(row_, static_cast<int>(column));
        if (type == SQLITE_NULL) fail(column, "there is no value; give a number");
        if (type != SQLITE_INTEGER && type != SQLITE_FLOAT)
            fail(column, in_quotes(text(column)) + " is not a number; give one");
        return sqlite3_column_double(row_, static_cast<int>(column));
    }
    std::string_view text(std::size_t column) const override { return text_ = text_in(row_, static_cast<int>(column)); }
    bool is_empty(std::size_t column) const override {
        return sqlite3_column_type(row_, static_cast<int>(column)) == SQLITE_NULL;
    }
    int line() const override { return static_cast<int>(count_); }
    std::string place(std::size_t column) const override {
        constexpr std::array<const char*, 4> kNames{"frame", "id", "pos_x", "pos_y"};
        return "row " + std::to_string(count_) + " of trajectory_data, " + kNames[column];
    }

  private:
    /// The two tables with their columns. A view could be anything.
    void check_tables() {
        std::size_t found = 0;
        database_.each(
            "SELECT m.name, c.name FROM sqlite_master m, pragma_table_info(m.name) c WHERE m.type = 'table' AND "
            "m.sql LIKE 'CREATE TABLE%' AND (m.name = 'trajectory_data' AND c.name IN ('frame', 'id', 'pos_x', "
            "'pos_y') "
            "OR m.name = 'metadata' AND c.name IN ('key', 'value'))",
            [&](sqlite3_stmt*) { ++found; });
        constexpr std::size_t kColumns = 6;
        if (found == kColumns) return;
        database_.fail(
            "is an SQLite database, but not JuPedSim's: it needs a table trajectory_data with frame, id, pos_x and "
            "pos_y, and a table metadata with key and value");
    }

    /// Frames per second; none: it does not say them.
    std::optional<double> read_metadata() {
        std::optional<std::string> version, fps;
        database_.each("SELECT key, value FROM metadata", [&](sqlite3_stmt* row) {
            check_count();
            const std::string key = text_in(row, 0);
            if (key == "version") version = text_in(row, 1);
            if (key == "fps") fps = text_in(row, 1);
        });
        if (!version) database_.fail("its metadata has no version; JuPedSim writes one");
        if (std::ranges::find(kVersions, *version) == kVersions.end()) {
            database_.fail("its metadata says version " + in_quotes(*version) + " of JuPedSim's format; versions " +
                           listed(kVersions) + " are read");
        }
        if (!fps) return std::nullopt;
        const std::optional<double> rate = parse_double(*fps);
        if (!rate || !(*rate > 0 && *rate <= kMaxFrameRate)) {
            database_.fail("fps of its metadata is " + in_quotes(*fps) + "; it must be over 0 and up to 1000000");
        }
        return rate;
    }

    void check_count() {
        if (++count_ > most_rows_)
            database_.fail("the SQLite database is damaged: it repeats rows; get the file again");
    }

    std::size_t most_rows_;
    std::size_t count_ = 0;  ///< rows read so far of the table in hand
    Database database_;
    RowReader rows_;
    sqlite3_stmt* row_ = nullptr;  ///< in hand
    mutable std::string text_;
};

}  // namespace

bool is_sqlite(std::string_view bytes) { return bytes.starts_with(kSqliteMark); }

TrackFile parse_jupedsim(std::string_view bytes, const std::string& file) { return JupedsimReader(bytes, file).read(); }

}  // namespace mobbscope
