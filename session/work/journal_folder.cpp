// SPDX-License-Identifier: MIT
#include "session/work/journal_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

#include "document/journal.hpp"
#include "session/record/input_files.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

// When a journal was written last: what was added last may be in its log.
fs::file_time_type written_last(const std::string& path) {
    std::error_code failed, ignored;
    const auto file = fs::last_write_time(path, ignored), log = fs::last_write_time(path + "-wal", failed);
    return failed ? file : std::max(file, log);
}

std::vector<document::LeftJournal> newest_first(std::vector<document::LeftJournal> left) {
    std::ranges::stable_sort(left, std::greater(),
                             [](const document::LeftJournal& one) { return written_last(one.path); });
    return left;
}

// Returns whether a journal is of the document that was opened from this path, in whatever state: it was then at this
// path, or where nothing is any more.
bool is_journal_of(const document::LeftJournal& left, const OpenedWork& opened, const std::string& path) {
    std::error_code ignored;
    if (left.of.empty()) return false;
    return is_same_file(left.of, path) || is_same_file(left.of, opened.document) ||
           (opened.version && left.base_id == opened.version->id && !fs::exists(left.of, ignored));
}

std::string told_of(const document::LeftJournal& left) {
    if (!left.unreadable.empty())
        return "what a session has left cannot be read, and stays: " + left.path + " " + left.unreadable;
    const std::string command = left.opened_by.empty() ? kOpensWork : left.opened_by;
    return "work that was not saved (" + left.name + ") is kept: " + command + " " + left.path;
}

}  // namespace

std::string usual_journal_folder() {
    const auto folder_named = [](const char* variable) -> fs::path {
        const char* const value = std::getenv(variable);
        return value != nullptr && std::string_view(value).starts_with('/') ? value : "";
    };
    fs::path state = folder_named("XDG_STATE_HOME");
    if (const fs::path home = folder_named("HOME"); state.empty() && !home.empty()) state = home / ".local" / "state";
    return state.empty() ? std::string() : (state / "burin" / "journals").string();
}

Result<std::string> new_journal(const std::string& folder, const std::string& name) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed || ::access(folder.c_str(), W_OK | X_OK) != 0)
        return fail(folder, "takes no journal, so that strokes are lost if the session dies",
                    "give --journal another folder");
    const std::string stem = (fs::path(folder) / fs::path(name).stem()).string() + "-" + std::to_string(::getpid());
    for (int number = 0;; ++number) {
        std::string path = stem + (number > 0 ? "-" + std::to_string(number) : "") + std::string(document::kEnding);
        if (!fs::exists(path, failed)) return path;
    }
}

Result<OpenedWork> open_document_and_journal(const std::string& path, const std::string& folder,
                                             std::size_t undo_bytes) {
    Result<OpenedWork> opened = open_document(path, undo_bytes);
    if (!opened || opened->document.empty() || folder.empty()) return opened;
    std::vector<document::LeftJournal> left = newest_first(document::left_journals(folder));
    const auto is_other = [&](const document::LeftJournal& one) {
        const bool is_of_this = is_journal_of(one, *opened, path) || !one.unreadable.empty();
        return !is_of_this || is_same_file(one.path, path);
    };
    std::erase_if(left, is_other);
    for (auto one = left.begin(); opened->journal.empty() && one != left.end(); ++one) {
        if (!one->unreadable.empty() || document::Version{one->base_id, one->base_saves} != opened->version) continue;
        Result<OpenedWork> recovered = open_document(one->path, undo_bytes);
        if (!recovered) continue;
        recovered->document = opened->document;  // which may have another name by now
        opened = std::move(recovered);
        left.erase(one);
        break;
    }
    for (const document::LeftJournal& one : left) opened->kept.push_back(told_of(one));
    return opened;
}

std::vector<std::string> unsaved_work_in(const std::string& folder) {
    std::vector<std::string> lines;
    if (folder.empty()) return lines;
    for (const document::LeftJournal& one : newest_first(document::left_journals(folder)))
        lines.push_back(told_of(one));
    return lines;
}

}  // namespace burin::session
