// SPDX-License-Identifier: MIT
// An SQLite file that one connection writes: how a recording and a document are made, opened, kept in place and closed.
//
// The connection keeps the file's lock until the end, so that no other program reads or writes it meanwhile.
// WAL with synchronous FULL: what is committed survives a kill and a power cut. close() brings all into the one file,
// which then travels alone.
// Failures are Errors that name the file and the remedy; make() never touches an existing file and leaves none behind
// where it fails. Threads: one at a time. Never called from the haptic thread.
#pragma once

#include <sys/stat.h>

#include <functional>
#include <optional>
#include <string>

#include "record/database.hpp"

namespace burin::record {

// A kind of file: the marks in its header, and what messages call it.
struct StoreKind {
    std::int32_t application_id = 0, version = 0;  // PRAGMA application_id, user_version
    const char* name = "a recording";
    FileWords words = {};
};

inline constexpr StoreKind kRecordingKind{.application_id = kApplicationId, .version = kStoreVersion};

class StoreFile {
public:
    using Fill = std::function<Result<void>(Database&)>;
    // Makes a file and has it filled, within the transaction that makes it: a kill leaves it whole, or empty. vfs: the
    // name of one of SQLite's file systems, empty for the usual one.
    [[nodiscard]] static Result<StoreFile> make(const std::string& path, const StoreKind& kind, const Fill& fill,
                                                const std::string& vfs = {});
    // Opens a file of this kind and version to write to it.
    [[nodiscard]] static Result<StoreFile> open(const std::string& path, const StoreKind& kind,
                                                const std::string& vfs = {});
    ~StoreFile();
    StoreFile(StoreFile&& other) noexcept;
    StoreFile& operator=(StoreFile&&) = delete;
    StoreFile(const StoreFile&) = delete;
    StoreFile& operator=(const StoreFile&) = delete;

    [[nodiscard]] Database& database() { return *database_; }
    // Returns whether its path still leads to this file.
    [[nodiscard]] bool is_in_place() const;
    // Returns whether no path leads to it any more; it exists as long as it is open.
    [[nodiscard]] bool is_deleted() const;
    // Brings all into the one file, with no log beside it, and closes it.
    [[nodiscard]] Result<void> close();

private:
    explicit StoreFile(std::string path) : path_(std::move(path)) {}
    [[nodiscard]] Result<void> hold();
    [[nodiscard]] Result<void> connect(const StoreKind& kind, const std::string& vfs);

    [[nodiscard]] Result<void> end_without_room();

    std::string path_;
    int place_ = -1;      // keeps the file's identity; O_PATH, so that closing it drops no lock
    struct stat made_{};  // the file as it was made
    std::optional<Database> database_;
};

// Checks that the open file has the marks of the kind, in a version that this program knows.
[[nodiscard]] Result<void> check_marks(Database& database, const std::string& path, const StoreKind& kind);
// Removes what SQLite puts beside a file: its log and that log's index.
void remove_log_of(const std::string& path);
// Removes a file with what SQLite has put beside it.
void remove_with_log(const std::string& path);
// Fails where a log of SQLite lies there without its file. The index of a log holds nothing of a file.
[[nodiscard]] Result<void> check_no_log_of(const std::string& path);
// The failure to make a file, by the code of errno.
[[nodiscard]] std::unexpected<Error> cannot_make(const std::string& path, int code, const StoreKind& kind);

}  // namespace burin::record
