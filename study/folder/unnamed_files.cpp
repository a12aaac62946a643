// SPDX-License-Identifier: MIT
#include "study/folder/unnamed_files.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>
#include <vector>

#include "base/places.hpp"

namespace burin::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRestore =
    "restore the journal from a copy; where there is none, move the file out of the study, which goes on without it";

enum class NamedAs { whole, without_end };

// What the journal names, by the place within the folder. Of a stage that was begun, both of its files.
std::map<std::string, NamedAs> named_files(const StudyFolder& study) {
    std::map<std::string, NamedAs> named;
    for (const Participant& p : study.participants()) {
        for (const StageVisit& v : p.visits) {
            const std::string begin = files_begin(p.id, v.day, v.place, v.run);
            const bool open = v.status != StageStatus::ended && !p.has_ended(v.day, v.place);
            named[begin + ".session"] = NamedAs::whole;
            named[begin + ".json"] = open ? NamedAs::without_end : NamedAs::whole;
            for (const std::string& file : {v.file, v.recording})
                if (!file.empty()) named.emplace(file, NamedAs::whole);
        }
    }
    return named;
}

// "x.session" of "x.session-wal".
std::string without_sqlite_ends(const std::string& file) {
    for (const std::string end : {"-journal", "-wal", "-shm", ".saved"})
        if (file.ends_with(end)) return file.substr(0, file.size() - end.size());
    return file;
}

}  // namespace

std::vector<UnnamedFile> unnamed_files(const StudyFolder& study) {
    const std::map<std::string, NamedAs> named = named_files(study);
    std::vector<UnnamedFile> found;
    const Result<std::vector<fs::path>> files = entries_below(study.path() / kDataFolder);
    if (!files)
        found.push_back({kDataFolder, files.error().what, "restore the folder from a copy, or see to its permissions"});
    for (const fs::path& path : files.value_or(std::vector<fs::path>{})) {
        std::error_code error;
        if (fs::is_directory(path, error)) continue;
        const std::string file = path.lexically_relative(study.path()).generic_string();
        const auto one = named.find(without_sqlite_ends(file));
        if (one == named.end())
            found.push_back({file, "is named by no line of the journal, whose end may have been cut off", kRestore});
        else if (one->second == NamedAs::without_end)
            found.push_back({file, "is written when its stage ends, and no line of the journal tells that end",
                             "restore the journal from a copy; where there is none, have the stage done again, which "
                             "leaves this file as it is"});
    }
    std::ranges::sort(found, {}, &UnnamedFile::file);
    return found;
}

}  // namespace burin::study
