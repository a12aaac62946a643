// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/folder/study_folder.hpp"
#include "study/replay/folder_replay.hpp"

namespace burin::app {
namespace {

void tell_replays(const study::FolderReplay& replays) {
    std::printf("%zu recordings, %llu ticks of %zu columns", replays.recordings,
                static_cast<unsigned long long>(replays.ticks), replays.columns);
    if (const std::size_t again = replays.recordings - replays.of_session; again > 0)
        std::printf("; %zu of them went through the haptic tick again", again);
    if (replays.interrupted > 0) std::printf("; %zu of them end where they were interrupted", replays.interrupted);
    if (replays.of_session > 0)
        std::printf(
            "; %zu of them are of a session: their stages, trials and figures were computed again from the ticks "
            "as stored",
            replays.of_session);
    if (replays.without > 0) std::printf("; %zu were erased or hold nothing yet", replays.without);
    std::printf("\n");
}

}  // namespace

Result<void> study_replay(const StudyReplayOptions& options) {
    BURIN_TRY(study, study::StudyFolder::open(options.study, study::StudyAccess::read));
    warn_of_journal(study);
    const auto tell = [](const std::string& fault) { std::fprintf(stderr, "%s\n", fault.c_str()); };
    BURIN_TRY(replays, study::replay_folder(study, {options.participant, options.threads, tell}));
    if (replays.recordings == 0) return fail(options.study, "has no recorded motion", "run it first: burin study run");
    if (!options.quiet) tell_replays(replays);
    if (replays.faults > 0)
        return fail(options.study, formatted("%zu recordings do not give what was stored", replays.faults),
                    "see above; the others do, to the bit");
    if (!options.quiet) std::printf("All equal what was stored, to the bit.\n");
    return {};
}

namespace {

CommandAction add_study_replay(Command command) {
    const auto options = std::make_shared<StudyReplayOptions>();
    command.option("STUDY", options->study, kStudyHelp).required();
    command.option("--participant", options->participant, "Of this participant only");
    command.option("--threads", options->threads, "Recordings at a time; 0: one for each core").within(0, 1024);
    return action([options] { return study_replay(*options); });
}

}  // namespace

CommandRow study_replay_row() {
    return {"replay", "Recorded motion through the haptic tick again, compared to the bit", add_study_replay};
}

}  // namespace burin::app
