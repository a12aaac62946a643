// SPDX-License-Identifier: MIT
#include "activities/train/live_visit.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "activities/train/participant_session.hpp"
#include "activities/train/recorded_visit.hpp"
#include "base/places.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "session/record/session_recording.hpp"
#include "study/folder/interruption.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

// Checks where a visit's session is recorded: beside the study, whose files a withdrawal erases, and so that it can be
// done again.
Result<void> check_record(const std::string& record, const fs::path& study) {
    if (record.empty()) return {};
    BURIN_TRY_DO(check_working_folder(record));
    const fs::path there = resolved_path(record).value_or(record), folder = resolved_path(study).value_or(study);
    if (const auto below = there.lexically_relative(folder); !below.empty() && *below.begin() != "..")
        return fail(record,
                    "lies in the study's folder, whose files are its own: a withdrawal would not erase it there",
                    "record it elsewhere");
    if (session::is_session_file(record)) return {};
    return fail(record, "is a log as text, which cannot be done again with its activity",
                "record into a session file: --record FILE.session");
}

// Returns nothing where there is no file: a pipe would be waited for.
std::string first_line_of(const std::string& file) {
    std::error_code ignored;
    std::string first;
    if (!fs::is_regular_file(file, ignored)) return first;
    std::ifstream in(file, std::ios::binary);
    std::getline(in, first);
    return first;
}

}  // namespace

bool is_session_log(const std::string& file) { return first_line_of(file).starts_with("burin-input "); }

Result<void> check_visit_input(const std::string& file) {
    if (!first_line_of(file).starts_with("burin-input 2")) return {};
    return fail(
        file, "is a recording, whose ticks were another visit's",
        "give a written log, which begins with burin-input 1; burin study replay STUDY does recorded stages again");
}

Result<std::unique_ptr<LiveVisit>> LiveVisit::prepare(study::StudyFolder& study, const LiveVisitOptions& options) {
    BURIN_TRY_DO(check_record(options.session.record.path, study.path()));
    BURIN_TRY(plan, plan_visit(study, options.participant, options.leave, study::now_utc_ns()));
    const auto people = study.participants();
    const auto person = std::ranges::find(people, options.participant, &study::Participant::id);
    const auto group = std::ranges::find(study.protocol().groups, person->group, &study::Group::code);
    if (group == study.protocol().groups.end())
        return fail(options.participant, "is in a group that the protocol has not", "restore the journal from a copy");
    BURIN_TRY(worlds, felt_worlds(study.protocol()));
    if (!options.session.hands.named.empty())
        return fail("--device", "gives several hands, and a participant's visit has one", "name one device");
    BURIN_TRY(device, participant_device(options.session.hands.device, study, *group));
    if (group->feels_tube && !device.held.felt_by_person())
        plan.deviations.push_back("group " + group->code + " feels the tube, and the visit was with " +
                                  text_of(device.held));
    return std::unique_ptr<LiveVisit>(
        new LiveVisit(study, options, *group, std::move(plan), std::move(worlds), std::move(device)));
}

LiveVisit::LiveVisit(study::StudyFolder& study, const LiveVisitOptions& options, const study::Group& group,
                     VisitPlan plan, FeltWorlds worlds, ParticipantDevice device)
    : study_(study),
      participant_(options.participant),
      setup_(options.session),
      plan_(std::move(plan)),
      device_(std::move(device)),
      worlds_(std::move(worlds)),
      disk_(study, participant_, group, options.records_motion ? StageOnDisk::Motion::ticks : StageOnDisk::Motion::none,
            device_.held, options.provenance),
      activity_(std::make_shared<StudyActivity>(
          study.protocol(), group, worlds_, plan_.places,
          visit_settings(study.facts().protocol_digest, group, plan_.places),
          StudyDevice{device_.wand, participant_, true}, keeper(),
          std::vector<std::pair<std::string, std::string>>{{kProtocolTextFact, study.protocol_text()}})) {
    setup_.hands.device = device_.opened;
}

Result<void> LiveVisit::begin(const TrainingRun& run) {
    if (!std::exchange(has_begun_, true)) BURIN_TRY_DO(begin_visit(study_, participant_, device_.held, plan_));
    return disk_.begin(run);
}

StageKeeper LiveVisit::keeper() {
    return {[this](const TrainingRun& run) { return begin(run); },
            [this](const TrainingRun::Ticked& ticked) { disk_.take(ticked); },
            [this](const std::vector<RunEvent>& events) { return disk_.take(events); },
            [this](const EndedStage& ended) { return disk_.end(ended); }, [this] { return disk_.close(); }};
}

session::SessionSetup LiveVisit::session() const {
    session::SessionSetup session = participant_session(setup_, activity_);
    if (device_.wand) session.hands.points = devices::usual_points(*device_.wand);
    return session;
}

}  // namespace burin::activities
