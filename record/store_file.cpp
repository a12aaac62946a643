// SPDX-License-Identifier: MIT
#include "record/store_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/flush_folder.hpp"
#include "base/try.hpp"

namespace burin::record {
namespace {

namespace fs = std::filesystem;

Result<void> use_log(Database& database, const std::string& path, const StoreKind& kind) {
    // Exclusive before WAL: the connection keeps the lock and needs no memory shared with other programs.
    BURIN_TRY_DO(database.run("PRAGMA locking_mode = EXCLUSIVE"));
    BURIN_TRY(mode, database.text("PRAGMA journal_mode = WAL"));
    if (mode != "wal") return fail(path, "its file system takes no write-ahead log", kind.words.no_log);
    // Reading opens the log: without it beside the file, whoever reads that would take it for lost.
    BURIN_TRY_DO(database.integer("SELECT count(*) FROM sqlite_schema"));
    return database.run("PRAGMA synchronous = FULL");
}

// SQLite takes what is shorter than its smallest page for a database that is still empty.
constexpr std::uintmax_t kSmallestDatabase = 512;

// Says what a file is that has not the mark it should.
std::string what_else(Database& database, const std::string& path, std::int64_t mark) {
    std::error_code unknown;
    const std::uintmax_t bytes = fs::file_size(path, unknown);
    if (!unknown && bytes == 0) return "is empty";
    if (!unknown && bytes < kSmallestDatabase)
        return "is not an SQLite file: it has " + std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
    if ((mark & ~0xff) == (kApplicationId & ~0xff))
        return mark == kApplicationId ? "is a recording" : "is another file of Burin, such as a document";
    const Result<std::int64_t> tables = database.integer("SELECT count(*) FROM sqlite_schema");
    return tables && *tables == 0 ? "is an SQLite file that holds nothing" : "is an SQLite file of another program";
}

}  // namespace

std::unexpected<Error> cannot_make(const std::string& path, int code, const StoreKind& kind) {
    const std::string why = std::generic_category().message(code);
    switch (code) {
        case EEXIST:
            return fail(path, "exists, and " + std::string(kind.name) + " never overwrites a file",
                        "choose another name");
        case ENOENT: return fail(path, "cannot be made: " + why, "create the folder first");
        case ENOSPC:
        case EDQUOT: return fail(path, "the disk is full", kind.words.full_disk);
        default: return fail(path, "cannot be made: " + why, "choose a folder that you may write to");
    }
}

void remove_log_of(const std::string& path) {
    std::error_code ignored;
    for (const char* ending : {"-wal", "-shm", "-journal"}) fs::remove(path + ending, ignored);
}

void remove_with_log(const std::string& path) {
    std::error_code ignored;
    fs::remove(path, ignored);
    remove_log_of(path);
}

Result<void> check_no_log_of(const std::string& path) {
    for (const char* ending : {"-wal", "-journal"}) {
        std::error_code ignored;
        if (fs::exists(path + ending, ignored))
            return fail(path + ending, "belongs to another recording, whose file has been taken away",
                        "choose another name; with its own file beside it, it can still be read");
    }
    return {};
}

Result<void> check_marks(Database& database, const std::string& path, const StoreKind& kind) {
    BURIN_TRY(mark, database.integer("PRAGMA application_id"));
    if (mark != kind.application_id) return fail(path, what_else(database, path, mark), kind.words.wrong_file);
    const Result<std::int64_t> version = database.integer("PRAGMA user_version");
    if (!version) return std::unexpected(version.error());
    if (*version > kind.version)
        return fail(path,
                    "has version " + std::to_string(*version) + " of the format, and this program knows up to " +
                        std::to_string(kind.version),
                    "read it with a newer Burin; its tables can be read with any SQLite");
    if (*version < 1) return fail(path, "has no version of the format", kind.words.wrong_file);
    return {};
}

// ---- StoreFile

StoreFile::StoreFile(StoreFile&& other) noexcept
    : path_(std::move(other.path_)),
      place_(std::exchange(other.place_, -1)),
      made_(other.made_),
      database_(std::move(other.database_)) {
    other.database_.reset();
}

StoreFile::~StoreFile() {
    database_.reset();
    if (place_ >= 0) ::close(place_);
}

Result<void> StoreFile::hold() {
    place_ = ::open(path_.c_str(), O_PATH | O_CLOEXEC);
    if (place_ >= 0 && ::fstat(place_, &made_) == 0) return {};
    return fail(path_, "cannot be opened: " + std::generic_category().message(errno),
                "check the path and its permissions");
}

Result<void> StoreFile::connect(const StoreKind& kind, const std::string& vfs) {
    BURIN_TRY(opened, Database::open(path_, Database::Use::write, vfs, kind.words));
    database_.emplace(std::move(opened));
    return {};
}

Result<StoreFile> StoreFile::make(const std::string& path, const StoreKind& kind, const Fill& fill,
                                  const std::string& vfs) {
    BURIN_TRY_DO(check_no_log_of(path));
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) return cannot_make(path, errno, kind);
    ::close(fd);
    StoreFile file(path);
    Result<void> ready = file.hold();
    if (ready) ready = file.connect(kind, vfs);
    // Whole before it has a log: a kill leaves no file that is marked and holds nothing, and a large file is not
    // written twice.
    if (ready)
        ready = file.database_->run(
            "PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL; BEGIN IMMEDIATE;"
            "PRAGMA application_id = " +
            std::to_string(kind.application_id) + "; PRAGMA user_version = " + std::to_string(kind.version));
    if (ready) ready = fill(*file.database_);
    if (ready) ready = file.database_->run("COMMIT");
    if (ready) ready = use_log(*file.database_, path, kind);
    if (ready) {
        flush_folder_of(path);
        return file;
    }
    file.database_.reset();
    remove_with_log(path);
    return std::unexpected(ready.error());
}

Result<StoreFile> StoreFile::open(const std::string& path, const StoreKind& kind, const std::string& vfs) {
    StoreFile file(path);
    Result<void> ready = file.hold();
    if (ready) ready = file.connect(kind, vfs);
    if (ready) ready = check_marks(*file.database_, path, kind);
    if (ready) ready = use_log(*file.database_, path, kind);
    return ready ? Result<StoreFile>(std::move(file)) : std::unexpected(ready.error());
}

bool StoreFile::is_in_place() const {
    struct stat now{};
    return ::stat(path_.c_str(), &now) == 0 && now.st_dev == made_.st_dev && now.st_ino == made_.st_ino;
}

bool StoreFile::is_deleted() const {
    struct stat now{};
    return ::fstat(place_, &now) == 0 && now.st_nlink == 0;
}

Result<void> StoreFile::end_without_room() {
    BURIN_TRY_DO(database_->run("PRAGMA wal_checkpoint(TRUNCATE)"));
    BURIN_TRY(mode, database_->text("PRAGMA journal_mode = MEMORY"));
    if (mode == "memory") return {};
    return fail(path_, "its log cannot be brought into it", "free some space and open it again");
}

Result<void> StoreFile::close() {
    if (!database_) return {};
    // Then it can be read where nothing can be written. On a full disk there is no room for the journal of that last
    // change, of one page that is there already: without the change the file would ask for a log that has gone.
    Result<void> ended = database_->run("PRAGMA wal_checkpoint(TRUNCATE)");
    if (ended) ended = database_->run("PRAGMA journal_mode = DELETE");
    if (!ended) ended = end_without_room();
    const Result<void> closed = database_->close();
    database_.reset();
    return ended ? closed : ended;
}

}  // namespace burin::record
