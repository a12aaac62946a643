// SPDX-License-Identifier: MIT
#include "document/document_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

#include "base/flush_folder.hpp"
#include "base/try.hpp"
#include "document/document_rows.hpp"
#include "document/leftovers.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;
using record::Database, record::StoreFile;

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::string new_id() {
    constexpr const char* kDigits = "0123456789abcdef";
    std::random_device random;
    std::string id;
    for (int i = 0; i < 4; ++i)
        for (unsigned bits = random(), digit = 0; digit < 8; ++digit, bits >>= 4) id += kDigits[bits & 15];
    return id;
}

// Writes the content within a transaction.
Result<void> put_all(Database& database, const Content& content, Saved& saved) {
    BURIN_TRY_DO(put_content(database, content, saved));
    BURIN_TRY_DO(put_fact(database, kIdFact, saved.version.id));
    BURIN_TRY_DO(put_fact(database, kSavesFact, std::to_string(saved.version.saves)));
    return put_fact(database, kSavedFact, utc_now());
}

Result<Version> version_in(Database& database) {
    BURIN_TRY(id, database.text("SELECT value FROM meta WHERE key = '" + std::string(kIdFact) + "'"));
    BURIN_TRY(saves, database.integer("SELECT value FROM meta WHERE key = '" + std::string(kSavesFact) + "'"));
    return Version{std::move(id), saves};
}

// Returns whether a file is at rest as the last who wrote it has closed it (bytes 18 and 19 of SQLite's header): then
// it is read without leaving anything beside it.
bool is_at_rest(const std::string& path) {
    std::array<char, 20> header{};
    std::ifstream in(path, std::ios::binary);
    return in.read(header.data(), header.size()) && header[18] == 1 && header[19] == 1;
}

Result<void> check_version(Database& database, const std::string& path, const Version& known) {
    BURIN_TRY(there, version_in(database));
    if (there == known) return {};
    return fail(path, "was saved by another window or program meanwhile",
                "save this one under another name, so that both are kept");
}

// Gives the file its name; a place that must hold nothing is not overwritten, whoever comes between.
Result<void> rename_to(const std::string& from, const std::string& to, Place place) {
    if (place == Place::replaced) {
        if (std::rename(from.c_str(), to.c_str()) == 0) return {};
        return record::cannot_make(to, errno, kDocumentKind);
    }
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
    if (errno != EINVAL && errno != ENOSYS) return record::cannot_make(to, errno, kDocumentKind);
    if (::link(from.c_str(), to.c_str()) != 0) return record::cannot_make(to, errno, kDocumentKind);
    ::unlink(from.c_str());
    return {};
}

Result<void> check_replaceable(const std::string& path) {
    struct stat there{};
    if (::lstat(path.c_str(), &there) != 0) return record::check_no_log_of(path);
    if (S_ISREG(there.st_mode)) return {};
    return fail(path, "is not a regular file", "choose another name");
}

// Brings a document that a kill has left with a log to rest, so that no log of it lies beside the one that takes its
// place, into which SQLite would bring it.
Result<void> bring_to_rest(const std::string& path) {
    bool has_log = false;
    std::error_code ignored;
    for (const char* ending : {"-wal", "-journal"}) has_log = has_log || fs::exists(path + ending, ignored);
    if (!has_log) return {};
    if (is_locked(path)) return fail(path, record::kInUse, "wait until that has ended, or end it");
    if (Result<StoreFile> file = StoreFile::open(path, kDocumentKind)) static_cast<void>(file->close());
    // Removes the log of a file that could not be opened as well: damaged, or of another program.
    record::remove_log_of(path);
    return {};
}

}  // namespace

Result<Saved> write_document(const std::string& path, const Content& content, Place place, const std::string& vfs) {
    std::error_code ignored;
    Saved saved{.version = {new_id(), 1}, .replaced = fs::exists(path, ignored)};
    if (place == Place::nothing && saved.replaced) return record::cannot_make(path, EEXIST, kDocumentKind);
    BURIN_TRY_DO(check_replaceable(path));
    remove_left_saves(path);
    const std::string made_as = name_while_saving(path);
    const auto name_the_place = [&](Error error) {
        if (error.where == made_as) error.where = path;
        record::remove_with_log(made_as);
        return std::unexpected(std::move(error));
    };
    Result<StoreFile> file = StoreFile::make(
        made_as, kDocumentKind,
        [&](Database& database) -> Result<void> {
            BURIN_TRY_DO(database.run(document_tables()));
            return put_all(database, content, saved);
        },
        vfs);
    if (!file) return name_the_place(file.error());
    if (const auto closed = file->close(); !closed) return name_the_place(closed.error());
    if (place == Place::replaced)
        if (const auto rests = bring_to_rest(path); !rests) return name_the_place(rests.error());
    if (const auto named = rename_to(made_as, path, place); !named) return name_the_place(named.error());
    flush_folder_of(path);
    return saved;
}

Result<Saved> update_document(const std::string& path, const Content& changed, const Version& known,
                              const std::string& vfs) {
    if (is_at_rest(path)) {  // another's is not even opened to write to it
        BURIN_TRY(reader, Database::open(path, Database::Use::read, vfs, kDocumentKind.words));
        BURIN_TRY_DO(record::check_marks(reader, path, kDocumentKind));
        BURIN_TRY_DO(check_version(reader, path, known));
    }
    BURIN_TRY(file, StoreFile::open(path, kDocumentKind, vfs));
    Database& database = file.database();
    Saved saved{.version = {known.id, known.saves + 1}, .replaced = true};
    Result<void> done = database.run("BEGIN IMMEDIATE");
    if (done) done = check_version(database, path, known);
    if (done) done = put_all(database, changed, saved);
    if (done) done = database.run("COMMIT");
    if (!done) {
        if (database.in_transaction()) static_cast<void>(database.run("ROLLBACK"));
        static_cast<void>(file.close());  // at rest, as it was
        return std::unexpected(done.error());
    }
    // The commit is on the disk. Where its log cannot be merged into the file now, the next to open it does that.
    static_cast<void>(file.close());
    return saved;
}

}  // namespace burin::document
