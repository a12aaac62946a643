// SPDX-License-Identifier: MIT
#include "record/store_reading.hpp"

#include "base/try.hpp"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace burin::record {

Result<void> check_regular(const std::string& path, const char* if_empty, const char* remedy) {
    struct stat info{};
    if (::stat(path.c_str(), &info) != 0)
        return fail(path, "cannot be read: " + std::generic_category().message(errno), "check the path");
    if (!S_ISREG(info.st_mode)) return fail(path, "is not a regular file", remedy);
    if (info.st_size == 0) return fail(path, if_empty, remedy);
    return {};
}

// The version for readers in the header of SQLite's files, sqlite.org/fileformat2.html: 2 asks for a log. A file that
// is being written has its log, and is not opened here: see check_regular().
bool lacks_its_log(const std::string& path) {
    struct stat log{};
    if (::stat((path + "-wal").c_str(), &log) == 0 || errno != ENOENT) return false;
    constexpr std::size_t kReadVersion = 19;
    std::array<char, kReadVersion + 1> header{};
    std::ifstream file(path, std::ios::binary);
    return file.read(header.data(), header.size()) && header[kReadVersion] == 2;
}

void take_back_what_was_interrupted(const std::string& path) {
    struct stat journal{};
    if (::stat((path + "-journal").c_str(), &journal) != 0 || journal.st_size == 0) return;
    Result<Database> opened = Database::open(path, Database::Use::write);
    // Exclusive, so that it needs no FILE-shm.
    if (opened && opened->run("PRAGMA locking_mode = EXCLUSIVE"))
        static_cast<void>(opened->integer("SELECT count(*) FROM sqlite_schema"));
}

Result<void> check_tables(Database& database, const std::string& path, std::initializer_list<const char*> tables,
                          const char* remedy) {
    for (const char* name : tables) {
        BURIN_TRY(there, database.has_table(name));
        if (!there) return fail(path, "has no table " + std::string(name), remedy);
    }
    return {};
}

Result<std::map<std::string, std::string>> read_facts(Database& database) {
    BURIN_TRY(read, database.prepare("SELECT key, value FROM meta WHERE length(key) + length(value) <= " +
                                     std::to_string(kMostTextBytes) + " LIMIT " + std::to_string(kMostFacts)));
    std::map<std::string, std::string> facts;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) facts[read.text(0)] = read.text(1);
    if (!row) return std::unexpected(row.error());
    return facts;
}

}  // namespace burin::record
