// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "app/study_command.hpp"
#include "app/study_trials.hpp"
#include "base/file_io.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {
namespace {

Result<void> check_protocol(const std::string& file) {
    const auto text = read_text_file(file, study::kMostProtocolBytes);
    if (!text) return std::unexpected(text.error());
    const study::ParsedProtocol parsed = study::parse_protocol(*text);
    for (const study::ProtocolFault& f : parsed.faults) std::printf("%s\n", line_of(f, file).c_str());
    std::fflush(stdout);
    if (!parsed.faults.empty())
        return fail(file, std::to_string(parsed.faults.size()) + " faults", "correct what is listed");
    const study::Protocol& p = parsed.protocol;
    std::printf("%s: %zu groups, %zu strata, %zu worlds, %zu stages, %zu days; no faults\n", file.c_str(),
                p.groups.size(), p.strata.size(), p.worlds.size(), p.stages.size(), p.days.size());
    return {};
}

Result<void> check_folder(const std::string& folder) {
    const auto study = study::StudyFolder::open(folder, study::StudyAccess::read);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    std::size_t faults = study->journal().faults.size(), files = 0;
    const auto& entries = study->journal().entries;
    if (entries.empty() || entries.front().value.value("event", std::string()) != "study made") {
        ++faults;
        std::fprintf(stderr,
                     "%s/journal.jsonl: has lost its beginning, which says how the study was made; restore it\n",
                     folder.c_str());
    }
    if (const auto ok = study->check_allocation(); !ok) {
        ++faults;
        std::fprintf(stderr, "%s\n", ok.error().line().c_str());
    }
    for (const study::Participant& p : study->participants()) {
        for (const study::StageVisit& visit : p.visits) {
            if (p.erased || visit.status != study::StageStatus::ended) continue;
            const auto look = [&](const auto& checked) {
                ++files;
                if (checked) return;
                ++faults;
                std::fprintf(stderr, "%s\n", checked.error().line().c_str());
            };
            if (!visit.file.empty()) look(study->recorded(visit));
            if (!visit.recording.empty()) look(study->check_recording(visit));
        }
    }
    if (faults > 0)
        return fail(folder, std::to_string(faults) + " faults", "see above; what is not named there can be used");
    std::printf("%s: protocol as frozen, %zu lines of journal chained, %zu files of data as recorded\n", folder.c_str(),
                study->journal().entries.size(), files);
    return {};
}

}  // namespace

Result<void> study_check(const std::string& place) {
    std::error_code ignored;
    return std::filesystem::is_directory(place, ignored) ? check_folder(place) : check_protocol(place);
}

}  // namespace burin::app
