// SPDX-License-Identifier: MIT
#include "record/database.hpp"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "record/private_index.hpp"
#include "record/store_reading.hpp"

namespace burin::record {
namespace {

// No value of a session file is larger: a compressed block has at most as much as an uncompressed one.
constexpr int kMostValueBytes = 80 << 20;
// How often SQLite asks whether it shall go on, in steps of its machine.
constexpr int kStepsBetweenQuestions = 1000;

// The name by which SQLite opens a file that nobody changes.
std::string immutable_uri(const std::string& path) {
    std::string uri = "file:";
    for (const char c : path) {
        if (c == '%' || c == '?' || c == '#')
            uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
        else
            uri += c;
    }
    return uri + "?immutable=1";
}

int busy_wait_ms(Database::Use use) { return use == Database::Use::write ? 2000 : 500; }

// SQLite calls a write without room a full disk, and any other call without room an error of the disk.
bool lacks_room(int code, int reason) {
    const int kind = code & 0xff;
    return kind == SQLITE_FULL ||
           ((kind == SQLITE_IOERR || kind == SQLITE_CANTOPEN) && (reason == ENOSPC || reason == EDQUOT));
}

Error unwritable(int code, const std::string& path) {
    if (code == SQLITE_READONLY_ROLLBACK || code == SQLITE_READONLY_RECOVERY)
        return {"was left in the middle of a change, which is taken back only where its folder may be written", path,
                "copy it to a folder that you may write to, with all files beside it whose names begin with its own"};
    return {"cannot be written: it is read-only", path, "choose a folder that you may write to"};
}

}  // namespace

const char* store_tables() {
    return R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE hand(hand INTEGER PRIMARY KEY, name TEXT NOT NULL);
CREATE TABLE column(hand INTEGER NOT NULL, position INTEGER NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL,
    frame TEXT NOT NULL, type TEXT NOT NULL, PRIMARY KEY(hand, position)) WITHOUT ROWID;
CREATE TABLE block(id INTEGER PRIMARY KEY, hand INTEGER NOT NULL, tick0 INTEGER NOT NULL, rows INTEGER NOT NULL,
    t0_ns INTEGER NOT NULL, crc INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE line(id INTEGER PRIMARY KEY, time_ns INTEGER NOT NULL, text TEXT NOT NULL);
CREATE TABLE trial(id INTEGER PRIMARY KEY, name TEXT NOT NULL, begun_ns INTEGER NOT NULL, ended_ns INTEGER,
    state TEXT NOT NULL);
CREATE TABLE event(id INTEGER PRIMARY KEY, time_ns INTEGER NOT NULL, trial INTEGER, name TEXT NOT NULL,
    value TEXT NOT NULL);
CREATE TABLE clock(id INTEGER PRIMARY KEY, mono_ns INTEGER NOT NULL, utc_ns INTEGER NOT NULL);
CREATE TABLE derived(id INTEGER PRIMARY KEY, name TEXT NOT NULL, program TEXT NOT NULL, columns TEXT NOT NULL,
    hand INTEGER NOT NULL, tick0 INTEGER NOT NULL, rows INTEGER NOT NULL, t0_ns INTEGER NOT NULL,
    crc INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE object(part TEXT NOT NULL, number INTEGER NOT NULL, name TEXT NOT NULL,
    PRIMARY KEY(part, number)) WITHOUT ROWID;
)";
}

Error database_error(int code, int reason, const std::string& words, const std::string& path,
                     const FileWords& words_of_kind) {
    if (lacks_room(code, reason)) return {"the disk is full", path, words_of_kind.full_disk};
    switch (code & 0xff) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED: return {kInUse, path, "wait until that has ended, or end it"};
        case SQLITE_READONLY: return unwritable(code, path);
        case SQLITE_CANTOPEN: return {"cannot be opened: " + words, path, "check the path and its permissions"};
        case SQLITE_NOTADB: return {"is not an SQLite file", path, words_of_kind.wrong_file};
        case SQLITE_CORRUPT: return {"is damaged: " + words, path, "sqlite3 FILE .recover saves what can be saved"};
        case SQLITE_INTERRUPT:
            return {"takes too long to read: it is damaged or not what it claims", path, words_of_kind.wrong_file};
        case SQLITE_IOERR: return {"cannot be read or written: " + words, path, "check the disk"};
        case SQLITE_NOMEM: return {"there is not enough memory for it", path, "end other programs"};
        default: return {words, path, words_of_kind.wrong_file};
    }
}

namespace {

// The last failure of a connection; none: it could not even be made.
Error failure_of(sqlite3* database, int code, const std::string& path, const FileWords& words) {
    if (database == nullptr) return database_error(code, 0, sqlite3_errstr(code), path, words);
    return database_error(code, sqlite3_system_errno(database), sqlite3_errmsg(database), path, words);
}

}  // namespace

// ---- Statement

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::bind(int at, std::int64_t value) { sqlite3_bind_int64(statement_.get(), at, value); }

void Statement::bind(int at, std::string_view text) {
    sqlite3_bind_text64(statement_.get(), at, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
}

void Statement::bind(int at, std::span<const std::byte> blob) {
    sqlite3_bind_blob64(statement_.get(), at, blob.data(), blob.size(), SQLITE_STATIC);
}

void Statement::bind_nothing(int at) { sqlite3_bind_null(statement_.get(), at); }

Result<bool> Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    return std::unexpected(failure_of(sqlite3_db_handle(statement_.get()), code, path_, words_));
}

Result<void> Statement::run() {
    Result<bool> more = step();
    while (more && *more) more = step();
    reset();
    if (!more) return std::unexpected(more.error());
    return {};
}

void Statement::reset() {
    sqlite3_reset(statement_.get());
    sqlite3_clear_bindings(statement_.get());
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

bool Statement::is_integer(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER; }

bool Statement::is_nothing(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }

std::string Statement::text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    if (text == nullptr) return {};
    return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::span<const std::byte> Statement::blob(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    if (data == nullptr) return {};
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

// ---- Database

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Result<Database> Database::open(const std::string& path, Use use, const std::string& vfs, const FileWords& words) {
    Database opened;
    opened.words_ = words;
    opened.path_ = path;
    opened.limit_ = std::make_unique<StepLimit>();
    sqlite3* raw = nullptr;
    // SQLite would put a new log beside a file that lacks its own, to read it, and could not where nothing may be
    // written.
    const bool is_alone = use == Use::read && lacks_its_log(path);
    const int flags = (use == Use::write ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY) | SQLITE_OPEN_NOMUTEX |
                      (is_alone ? SQLITE_OPEN_URI : 0);
    // A name that begins with "file:" or ":memory:" would not be taken for a file's.
    const std::string plain = path.starts_with('/') ? path : "./" + path;
    const std::string name = is_alone ? immutable_uri(plain) : plain;
    const char* file_system = vfs.empty() ? nullptr : vfs.c_str();
    if (vfs.empty() && use == Use::read && !is_index_shared(path)) file_system = private_index_vfs();
    const int code = sqlite3_open_v2(name.c_str(), &raw, flags, file_system);
    opened.database_.reset(raw);
    if (code != SQLITE_OK) return std::unexpected(failure_of(raw, code, path, words));
    sqlite3_extended_result_codes(raw, 1);
    sqlite3_busy_timeout(raw, busy_wait_ms(use));
    sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kMostValueBytes);
    // What a foreign file's schema says is data, not a program.
    sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    return opened;
}

Result<void> Database::run(const std::string& sql) {
    limit_->left = limit_->most;
    const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return std::unexpected(failure_of(database_.get(), code, path_, words_));
    return {};
}

Result<Statement> Database::prepare(const std::string& sql) {
    limit_->left = limit_->most;
    Statement made;
    made.path_ = path_;
    made.words_ = words_;
    sqlite3_stmt* raw = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), sql.c_str(), static_cast<int>(sql.size()), &raw, nullptr);
    made.statement_.reset(raw);
    if (code != SQLITE_OK) return std::unexpected(failure_of(database_.get(), code, path_, words_));
    return made;
}

Result<std::int64_t> Database::integer(const std::string& sql) {
    Result<Statement> asked = prepare(sql);
    if (!asked) return std::unexpected(asked.error());
    const Result<bool> row = asked->step();
    if (!row) return std::unexpected(row.error());
    return *row ? asked->integer(0) : 0;
}

Result<std::string> Database::text(const std::string& sql) {
    Result<Statement> asked = prepare(sql);
    if (!asked) return std::unexpected(asked.error());
    const Result<bool> row = asked->step();
    if (!row) return std::unexpected(row.error());
    return *row ? asked->text(0) : std::string();
}

void Database::limit_steps(std::int64_t steps) {
    limit_->most = limit_->left = steps;
    const auto ask = [](void* limit) -> int {
        auto& steps_left = static_cast<StepLimit*>(limit)->left;
        steps_left -= kStepsBetweenQuestions;
        return steps_left < 0 ? 1 : 0;
    };
    sqlite3_progress_handler(database_.get(), steps > 0 ? kStepsBetweenQuestions : 0, ask, limit_.get());
}

Result<void> Database::close() {
    const int code = sqlite3_close(database_.get());
    if (code != SQLITE_OK) return std::unexpected(failure_of(database_.get(), code, path_, words_));
    static_cast<void>(database_.release());
    return {};
}

Result<bool> Database::has_table(const char* name) {
    Result<Statement> find =
        prepare("SELECT count(*) FROM sqlite_schema WHERE name = ? AND type = 'table' AND rootpage > 0");
    if (!find) return std::unexpected(find.error());
    find->bind(1, std::string_view(name));
    const Result<bool> row = find->step();
    if (!row) return std::unexpected(row.error());
    return *row && find->integer(0) == 1;
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(database_.get()) == 0; }

}  // namespace burin::record
