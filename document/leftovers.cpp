// SPDX-License-Identifier: MIT
#include "document/leftovers.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/places.hpp"
#include "document/document_file.hpp"
#include "document/document_reader.hpp"
#include "document/log_check.hpp"
#include "record/store_file.hpp"
#include "record/store_reading.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;
using record::Database;

constexpr const char* kSaving = ".saving-";

std::optional<pid_t> process_in(std::string_view text) {
    pid_t number = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || wrong != std::errc() || end != text.data() + text.size() || number <= 0) return std::nullopt;
    return number;
}

bool is_dead(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

// Takes the number off the end of NAME-NUMBER.
std::optional<pid_t> take_number_off(std::string& name) {
    const std::size_t dash = name.rfind('-');
    if (dash == std::string::npos) return std::nullopt;
    const std::optional<pid_t> number = process_in(std::string_view(name).substr(dash + 1));
    if (number) name.resize(dash);
    return number;
}

// Returns whether the process of a journal NAME-PROCESS.burin or NAME-PROCESS-COUNT.burin is dead. Where the name has
// two numbers at its end, either may be the process.
bool is_of_dead_process(const std::string& path) {
    std::string name = fs::path(path).stem().string();
    const std::optional<pid_t> last = take_number_off(name);
    if (!last || !is_dead(*last)) return false;
    const std::optional<pid_t> before = take_number_off(name);
    return !before || is_dead(*before);
}

// SQLite takes what is shorter than its smallest page for an empty database.
constexpr std::uintmax_t kShortestDatabase = 512;

// Returns whether a file is one of SQLite's that has no table and no mark of another program.
bool has_no_tables(const std::string& path) {
    std::error_code failed;
    if (const std::uintmax_t bytes = fs::file_size(path, failed); failed || bytes < kShortestDatabase) return false;
    Result<Database> database = Database::open(path, Database::Use::read, {}, kDocumentKind.words);
    if (!database) return false;
    const Result<std::int64_t> tables = database->integer("SELECT count(*) FROM sqlite_schema");
    const Result<std::int64_t> mark = database->integer("PRAGMA application_id");
    return tables && *tables == 0 && mark && (*mark == 0 || *mark == kDocumentKind.application_id);
}

// Returns whether a file was made for a journal and holds nothing.
bool is_hollow(const std::string& path) {
    if (is_log_damaged(path) || record::lacks_its_log(path)) return false;
    record::take_back_what_was_interrupted(path);
    std::error_code failed;
    if (fs::file_size(path, failed) == 0 && !failed) return !fs::exists(path + "-wal", failed);
    const Result<DocumentReader> reader = DocumentReader::open(path);
    if (!reader) return reader.error().what != record::kInUse && has_no_tables(path);
    return reader->facts().empty() && reader->parts().empty() && reader->commands().empty() && reader->changes() == 0;
}

}  // namespace

std::string name_while_saving(const std::string& path) { return path + kSaving + std::to_string(::getpid()); }

bool is_locked(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return true;
    struct flock lock{};
    lock.l_type = F_WRLCK;
    const bool is_free = ::fcntl(fd, F_OFD_GETLK, &lock) == 0 && lock.l_type == F_UNLCK;
    ::close(fd);
    return !is_free;
}

void remove_left_saves(const std::string& path) {
    const std::string begin = fs::path(path).filename().string() + kSaving;
    const fs::path folder = fs::path(path).parent_path();
    std::set<std::string> left;
    for (const fs::path& file : entries_of(folder.empty() ? "." : folder).value_or(std::vector<fs::path>())) {
        const std::string name = file.filename().string();
        if (!name.starts_with(begin)) continue;
        std::string_view process = std::string_view(name).substr(begin.size());
        // A log may be there without its file.
        for (const std::string_view ending : {"-wal", "-shm", "-journal"})
            if (process.ends_with(ending)) process.remove_suffix(ending.size());
        const std::optional<pid_t> number = process_in(process);
        if (number && is_dead(*number)) left.insert((folder / (begin + std::string(process))).string());
    }
    std::error_code ignored;
    for (const std::string& file : left)
        if (!fs::exists(file, ignored) || !is_locked(file)) record::remove_with_log(file);
}

bool remove_hollow_journal(const std::string& path) {
    if (!is_of_dead_process(path) || !is_hollow(path) || is_locked(path)) return false;
    record::remove_with_log(path);
    return true;
}

}  // namespace burin::document
