// SPDX-License-Identifier: MIT
#include "session/document/journal_folder.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "document/journal.hpp"
#include "session/record/input_files.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

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

Result<OpenedWork> open_work_and_journal(const sculpt::WorkpieceOptions& options, const std::string& folder,
                                         WorkerPool& pool) {
    Result<OpenedWork> opened = open_work(options, pool);
    if (!opened || opened->document.empty() || folder.empty()) return opened;
    for (const document::LeftJournal& left : document::left_journals(folder)) {
        const document::Version base{left.base_id, left.base_saves};
        if (left.of.empty() || base != opened->version || !is_same_file(left.of, options.source)) continue;
        Result<OpenedWork> recovered = open_work({.source = left.path}, pool);
        if (recovered) return recovered;
    }
    return opened;
}

std::vector<std::string> unsaved_work_in(const std::string& folder) {
    std::vector<std::string> lines;
    if (folder.empty()) return lines;
    for (const document::LeftJournal& left : document::left_journals(folder))
        if (left.of.empty())
            lines.push_back("work that was not saved (" + left.name + ") is kept: burin sculpt " + left.path);
    return lines;
}

}  // namespace burin::session
