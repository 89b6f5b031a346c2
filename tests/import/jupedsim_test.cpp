// JuPedSim's databases: the three versions of its format, and what is wrong with others. Damaged ones end soon.
#include <base/error.h>
#include <base/file.h>
#include <import/import.h>
#include <import/tracks/tracks.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <string>

namespace mobbscope {
namespace {

/// Runs statements on a database file.
void run_sql(const std::filesystem::path& file, const std::string& sql) {
    sqlite3* opened = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &opened), SQLITE_OK);
    const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, sqlite3_close);
    ASSERT_EQ(sqlite3_exec(opened, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(opened) << sql;
}

const std::string kMetadata =
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
    "INSERT INTO metadata VALUES('version','2'),('fps','10.0'),('xmin','0');";
const std::string kPoints =
    "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL, pos_y REAL, ori_x REAL, "
    "ori_y REAL);"
    "INSERT INTO trajectory_data "
    "VALUES(0,1,0,0,1,0),(1,1,0.1,0,1,0),(5,2,4,2.5,1,0),(2,1,0.2,0,1,0),(6,2,4.5,2.5,1,0);";
const std::string kGeometry =
    "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL); INSERT INTO geometry VALUES(1,'POLYGON');"
    "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
    "CREATE INDEX frame_id_idx ON trajectory_data(frame, id);";

/// The bytes of a new database.
std::string database(const std::string& sql) {
    const TempFolder folder;
    const auto file = folder.path() / "made.sqlite";
    run_sql(file, sql);
    return slurp(file);
}

std::vector<ImportedClip> jupedsim_clips(const std::string& bytes, const ImportOptions& options = {}) {
    return track_clips(parse_jupedsim(bytes, "f.sqlite"), "f.sqlite", options);
}

std::string jupedsim_refusal(const std::string& sql) {
    const std::string bytes = database(sql);
    return input_error([&] { jupedsim_clips(bytes); });
}

TEST(Jupedsim, PointsAreTracksByTheFramesASecondOfTheMetadata) {
    const auto read = jupedsim_clips(database(kMetadata + kPoints + kGeometry));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].facts.format, "jupedsim");
    EXPECT_EQ(read[0].id, "1");
    EXPECT_EQ(read[0].clip->count(), 3);
    EXPECT_EQ(read[0].clip->dt(), 0.1);
    EXPECT_EQ(read[0].clip->samples()[2].x, 0.2);
    EXPECT_EQ(read[1].start, 0.5);
    EXPECT_EQ(read[1].clip->samples()[0].y, 2.5);
    EXPECT_EQ(read[1].clip->samples()[0].r, kDefaultTrackRadius);
    ASSERT_EQ(read[0].facts.warnings.size(), 1u);
    EXPECT_EQ(read[0].facts.warnings[0].option, "radius");
}

TEST(Jupedsim, EveryVersionIsRead) {
    const std::string without_directions =
        "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y REAL NOT "
        "NULL); INSERT INTO trajectory_data VALUES(0,7,1,3.9),(1,7,1.1,4);";
    for (const char* version : {"1", "2", "3"}) {
        const std::string metadata =
            "CREATE TABLE metadata(key TEXT, value TEXT);INSERT INTO metadata VALUES('version','" +
            std::string(version) + "'),('fps','25');";
        const auto read = jupedsim_clips(database(metadata + without_directions));
        EXPECT_EQ(read.at(0).clip->dt(), 0.04) << version;
        EXPECT_EQ(read.at(0).clip->samples()[1].y, 4);
    }
}

TEST(Jupedsim, WithoutTheFramesASecondAnOptionSaysThem) {
    const std::string bytes =
        database("CREATE TABLE metadata(key, value);INSERT INTO metadata VALUES('version','2');" + kPoints);
    ImportOptions options;
    options.fps = 5;
    EXPECT_EQ(jupedsim_clips(bytes, options).at(1).start, 1);
    EXPECT_EQ(jupedsim_clips(bytes, options).at(0).clip->dt(), 0.2);
    options = {};
    options.dt = 0.5;
    EXPECT_EQ(jupedsim_clips(bytes, options).at(1).start, 2.5);
}

TEST(Jupedsim, IsToldByItsContentAndLeavesNothingBesideTheFile) {
    const TempFolder folder;
    const auto files = [&] { return std::distance(std::filesystem::directory_iterator(folder.path()), {}); };
    for (const char* name : {"a.sqlite", "b.sqlite3", "c.db", "d", "e.dat", "f.txt"}) {
        run_sql(folder.path() / name, kMetadata + kPoints);
        EXPECT_EQ(import_clips(folder.path() / name, {}).size(), 2u) << name;
    }
    EXPECT_EQ(files(), 6);
    // A file that may not be written, in a folder that may not.
    const auto closed = folder.path() / "closed";
    std::filesystem::create_directory(closed);
    run_sql(closed / "w.sqlite", "PRAGMA journal_mode=WAL;" + kMetadata + kPoints);
    std::filesystem::permissions(closed / "w.sqlite", std::filesystem::perms::owner_read);
    std::filesystem::permissions(closed, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const std::string before = slurp(closed / "w.sqlite");
    EXPECT_EQ(import_clips(closed / "w.sqlite", {}).size(), 2u) << "with a write-ahead log";
    EXPECT_EQ(slurp(closed / "w.sqlite"), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(closed), {}), 1);
    std::filesystem::permissions(closed, std::filesystem::perms::owner_all);
    // What is only in the log is not in the file.
    for (const std::string log : {"a.sqlite-wal", "a.sqlite-journal"}) {
        const std::string written = folder.write(log, "pages");
        EXPECT_NE(input_error([&] { import_clips(folder.path() / "a.sqlite", {}); }).find(log + "; close the program"),
                  std::string::npos);
        std::filesystem::remove(written);
    }
}

TEST(Jupedsim, WhatIsMissingOrWrongIsSaid) {
    const std::string other = "is an SQLite database, but not JuPedSim's";
    EXPECT_NE(jupedsim_refusal(kMetadata).find(other), std::string::npos);
    EXPECT_NE(jupedsim_refusal(kPoints).find(other), std::string::npos);
    EXPECT_NE(jupedsim_refusal("CREATE TABLE t(a)").find(other), std::string::npos);
    EXPECT_NE(jupedsim_refusal(kMetadata + "CREATE TABLE trajectory_data(frame, id, x, y)").find(other),
              std::string::npos);
    EXPECT_NE(jupedsim_refusal(kMetadata + "CREATE TABLE trajectory_data(frame, id, pos_x, pos_y)").find("has no row"),
              std::string::npos);
    // A view may go on for ever.
    EXPECT_NE(jupedsim_refusal(kMetadata +
                               "CREATE VIEW trajectory_data AS WITH RECURSIVE n(frame) AS (SELECT 0 UNION ALL SELECT "
                               "frame + 1 FROM n) SELECT frame, 1 AS id, 0.0 AS pos_x, 0.0 AS pos_y FROM n")
                  .find(other),
              std::string::npos);
    const auto metadata = [&](const std::string& rows) {
        return jupedsim_refusal("CREATE TABLE metadata(key, value);INSERT INTO metadata VALUES" + rows + ';' + kPoints);
    };
    EXPECT_NE(metadata("('fps','10')").find("its metadata has no version"), std::string::npos);
    EXPECT_NE(metadata("('version','9'),('fps','10')").find("says version '9'"), std::string::npos);
    EXPECT_NE(metadata("('version',NULL),('fps','10')").find("says version ''"), std::string::npos);
    EXPECT_EQ(
        metadata("('version',2)"),
        "f.sqlite: the rows have frame numbers in place of times: give fps (frames a second), or dt (seconds from "
        "one frame to the next)");
    for (const char* fps : {"0", "-1", "fast", "", "1e300", "nan"})
        EXPECT_NE(metadata("('version','2'),('fps','" + std::string(fps) + "')").find("fps of its metadata is"),
                  std::string::npos);
    const auto row = [&](const std::string& values) {
        return jupedsim_refusal(kMetadata +
                                "CREATE TABLE trajectory_data(frame, id, pos_x, pos_y);INSERT INTO trajectory_data "
                                "VALUES(0,1,2,3),(" +
                                values + ")");
    };
    EXPECT_EQ(row("1,NULL,2,3"), "f.sqlite: row 2 of trajectory_data, id: there is no value; give a number");
    EXPECT_NE(row("1,1,2,'here'").find("row 2 of trajectory_data, pos_y: 'here' is not a number"), std::string::npos);
    EXPECT_NE(row("1,1,x'00ff',3").find("is not a number"), std::string::npos);
    EXPECT_NE(row("1,1,1e12,3").find("is beyond 1e+09"), std::string::npos);
    EXPECT_NE(row("1,1,9e999,3").find("is beyond"), std::string::npos);
    EXPECT_NE(row("1.5,1,2,3").find("frame: '1.5' is not a whole number"), std::string::npos);
    EXPECT_NE(row("1,9223372036854775807,2,3").find("id: '9223372036854775807' is beyond"), std::string::npos);
    EXPECT_NE(row("0,1,2,4").find("already"), std::string::npos);
}

TEST(Jupedsim, DamagedDatabasesAreReadOrRefusedSoon) {
    std::string rows;
    for (int i = 0; i < 400; ++i) rows += ",(" + std::to_string(i) + ",3," + std::to_string(i * 0.01) + ",1,0,1)";
    const std::string good = database("PRAGMA page_size=512;" + kMetadata + kPoints +
                                      "INSERT INTO trajectory_data VALUES(0,4,0,0,0,0)" + rows);
    std::mt19937 random(20240609);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = good;
        if (round % 2 == 0) {
            bytes = mutated(bytes, random);
        } else {
            // Where pages lead, and how long cells are.
            for (int edits = 0; edits < 4; ++edits)
                bytes[(random() % (bytes.size() / 512)) * 512 + random() % 32] = static_cast<char>(random());
        }
        try {
            std::size_t samples = 0;
            for (const ImportedClip& clip : jupedsim_clips(bytes))
                samples += static_cast<std::size_t>(clip.clip->count());
            ASSERT_LE(samples, 10'000 + 100 * bytes.size());
            ++read;
        } catch (const InputError& error) {
            ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 500);
    for (const std::size_t size : {std::size_t{0}, std::size_t{16}, std::size_t{99}, std::size_t{100}, good.size() / 2})
        EXPECT_NE(input_error([&] { jupedsim_clips(good.substr(0, size)); }), "");
}

// SQLite says of it that memory ran out.
TEST(Jupedsim, ALengthBeyondWhatSqliteAllocatesIsDamage) {
    std::string bytes = database("PRAGMA page_size=512;" + kMetadata + kPoints);
    constexpr std::size_t kCells = 108;  // where the places of the schema's rows begin
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
    for (std::size_t cell = 0; cell < 2; ++cell) {
        const std::size_t place = byte(kCells + 2 * cell) * 256 + byte(kCells + 2 * cell + 1);
        bytes.replace(place, 9, 9, '\xff');
    }
    EXPECT_EQ(input_error([&] { jupedsim_clips(bytes); }),
              "f.sqlite: the SQLite database is damaged: a value is too long; get the file again");
}

}  // namespace
}  // namespace mobbscope
