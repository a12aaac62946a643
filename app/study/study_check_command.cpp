// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_reach.hpp"
#include "app/study/study_trials.hpp"
#include "base/file_io.hpp"
#include "base/try.hpp"
#include "study/felt/stage_touch.hpp"
#include "study/folder/interruption.hpp"
#include "study/folder/study_folder.hpp"
#include "study/folder/unnamed_files.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::app {
namespace {

// Says where a hand has to be for the start cap, in the maker's frame, and by how much a world was moved for the wand.
Result<void> place_worlds(const study::Protocol& protocol) {
    const devices::WandDescription wand = study::study_wand(protocol);
    for (const study::StudyWorld& world : protocol.worlds) {
        BURIN_TRY(felt, study::FeltWorld::create(world));
        const Vec3 moved_m =
            devices::scene_from_device(wand).position_m - study::world_from_wand(wand, (felt)->bounds()).position_m;
        const study::CapBox cap = study::start_cap(world);
        const Vec3 middle_m = cap.centre_m + 0.5 * cap.depth_m * cap.z + moved_m;
        if (moved_m == Vec3(0.0))
            std::printf("world %s: in the wand's workspace as it stands", world.name.c_str());
        else
            std::printf("world %s: centred in the wand's workspace, as it reaches beyond; moved by %.1f, %.1f, %.1f mm",
                        world.name.c_str(), 1e3 * moved_m.x, 1e3 * moved_m.y, 1e3 * moved_m.z);
        std::printf("; the middle of its start cap is at %.4f, %.4f, %.4f m in the maker's frame\n", middle_m.x,
                    middle_m.y, middle_m.z);
    }
    return {};
}

Result<void> check_protocol(const std::string& file) {
    BURIN_TRY(text, read_text_file(file, study::kMostProtocolBytes));
    const study::ParsedProtocol parsed = study::parse_protocol(text);
    for (const study::ProtocolFault& f : parsed.faults) std::printf("%s\n", line_of(f, file).c_str());
    std::fflush(stdout);
    if (!parsed.faults.empty())
        return fail(file, std::to_string(parsed.faults.size()) + (parsed.faults.size() == 1 ? " fault" : " faults"),
                    "correct what is listed");
    const study::Protocol& p = parsed.protocol;
    BURIN_TRY_DO(check_reach(p, file));
    std::printf("%s: %zu groups, %zu strata, %zu worlds, %zu stages, %zu days; no faults\n", file.c_str(),
                p.groups.size(), p.strata.size(), p.worlds.size(), p.stages.size(), p.days.size());
    return place_worlds(p);
}

Result<void> check_folder(const std::string& folder) {
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    warn_of_journal(study);
    std::size_t faults = study.journal().faults.size(), files = 0;
    const auto& entries = study.journal().entries;
    if (entries.empty() || entries.front().value.value("event", std::string()) != "study made") {
        ++faults;
        std::fprintf(stderr,
                     "%s/journal.jsonl: has lost its beginning, which says how the study was made; restore it\n",
                     folder.c_str());
    }
    if (const auto ok = study.check_allocation(); !ok) {
        ++faults;
        std::fprintf(stderr, "%s\n", ok.error().line().c_str());
    }
    for (const study::Participant& p : study.participants()) {
        for (const study::StageVisit& visit : p.visits) {
            if (p.erased || visit.status != study::StageStatus::ended) continue;
            const auto look = [&](const auto& checked) {
                ++files;
                if (checked) return;
                ++faults;
                std::fprintf(stderr, "%s\n", checked.error().line().c_str());
            };
            if (!visit.file.empty()) look(study.recorded(visit));
            if (!visit.recording.empty()) look(study.check_recording(visit));
        }
    }
    for (const study::UnnamedFile& unnamed : study::unnamed_files(study)) {
        ++faults;
        std::fprintf(stderr, "%s\n",
                     Error{unnamed.what, (study.path() / unnamed.file).string(), unnamed.remedy}.line().c_str());
    }
    const std::vector<study::Interruption> interruptions = study::interruptions_of(study);
    for (const study::Interruption& one : interruptions) {
        faults += one.unreadable ? 1 : 0;
        std::fprintf(stderr, "interrupted: %s\n", one.text().c_str());
    }
    if (faults > 0)
        return fail(folder, std::to_string(faults) + (faults == 1 ? " fault" : " faults"),
                    "see above; what is not named there can be used");
    std::printf(
        "%s: protocol as frozen, %zu lines of journal chained, %zu files of data as recorded, %zu stages interrupted\n",
        folder.c_str(), study.journal().entries.size(), files, interruptions.size());
    BURIN_TRY_DO(check_reach(study.protocol(), folder));
    return place_worlds(study.protocol());
}

}  // namespace

Result<void> study_check(const std::string& place) {
    std::error_code ignored;
    return std::filesystem::is_directory(place, ignored) ? check_folder(place) : check_protocol(place);
}

namespace {

CommandAction add_study_check(Command command) {
    const auto place = std::make_shared<std::string>();
    command.option("PLACE", *place, "A protocol (.toml) or a study's folder").required();
    return action([place] { return study_check(*place); });
}

}  // namespace

CommandRow study_check_row() { return {"check", "Every fault of a protocol, or of a study's folder", add_study_check}; }

}  // namespace burin::app
