// SPDX-License-Identifier: MIT
// One connection to an SQLite file, and what a session file is: its tables, its marks, its version (docs/formats.md).
//
// Threads: one at a time. Failures are Errors that name the file and the remedy. Never called from the haptic thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace burin::record {

// Marks in the header of the SQLite file: "BrnS" as PRAGMA application_id, and the version as PRAGMA user_version.
inline constexpr std::int32_t kApplicationId = 0x42726e53;
inline constexpr std::int32_t kStoreVersion = 1;

// The statements that make the tables.
[[nodiscard]] const char* store_tables();

// What failures advise, for the kind of file that is opened.
struct FileWords {
    const char* wrong_file = "name a file that --record has written";
    const char* full_disk = "free some space or record to another disk";
    const char* no_log = "record to a disk of this machine";
};

// A prepared statement: bind, step, read. Valid as long as its database.
class Statement {
public:
    Statement() = default;

    void bind(int at, std::int64_t value);  // at counts from 1, as SQLite does
    void bind(int at, std::string_view text);
    void bind(int at, std::span<const std::byte> blob);  // copied by step()'s end only: keep it until then
    void bind_nothing(int at);
    // Runs to the next row: true, a row is there; false, the end.
    [[nodiscard]] Result<bool> step();
    // Runs to the end and makes the statement ready for the next values.
    [[nodiscard]] Result<void> run();
    void reset();

    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] bool is_integer(int column) const;
    [[nodiscard]] bool is_nothing(int column) const;
    [[nodiscard]] std::string text(int column) const;
    // Valid until the next step().
    [[nodiscard]] std::span<const std::byte> blob(int column) const;

private:
    friend class Database;
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    std::string path_;
    FileWords words_;
};

// Error::what of a file that another program has locked.
inline constexpr const char* kInUse = "is in use by another program";

class Database {
public:
    enum class Use { write, read };

    // Opens an existing file; vfs: the name of one of SQLite's file systems, empty for the usual one.
    [[nodiscard]] static Result<Database> open(const std::string& path, Use use, const std::string& vfs = {},
                                               const FileWords& words = {});

    // Runs statements without results.
    [[nodiscard]] Result<void> run(const std::string& sql);
    [[nodiscard]] Result<Statement> prepare(const std::string& sql);
    // Returns the first value of the first row as an integer or as text.
    [[nodiscard]] Result<std::int64_t> integer(const std::string& sql);
    [[nodiscard]] Result<std::string> text(const std::string& sql);
    // Interrupts any one statement after about so many steps of SQLite's machine: a hostile file cannot hang a reader.
    void limit_steps(std::int64_t steps);
    // Closes now instead of at the end; fails where the last of the data cannot be brought to the file.
    [[nodiscard]] Result<void> close();
    [[nodiscard]] bool in_transaction() const;
    // Whether it has a plain table of this name: a view could compute for ever, a virtual table call other code.
    [[nodiscard]] Result<bool> has_table(const char* name);

private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    struct StepLimit {
        std::int64_t most = 0, left = 0;
    };
    std::unique_ptr<StepLimit> limit_;  // outlives the connection that points to it
    std::unique_ptr<sqlite3, Close> database_;
    std::string path_;
    FileWords words_;
};

// Returns a failure in words: what and remedy for the codes that users meet. code: SQLite's extended one; reason: the
// operating system's errno behind it, 0 for none; words: SQLite's own.
[[nodiscard]] Error database_error(int code, int reason, const std::string& words, const std::string& path,
                                   const FileWords& words_of_kind);

}  // namespace burin::record
