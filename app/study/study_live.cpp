// SPDX-License-Identifier: MIT
#include "app/study/study_live.hpp"
#include "app/recordings/live_replay.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "activities/train/recorded_visit.hpp"
#include "activities/train/stage_on_disk.hpp"
#include "activities/train/study_activity.hpp"
#include "app/study/study_device.hpp"
#include "app/study/study_trials.hpp"
#include "base/places.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "desk/run/session.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "session/record/session_recording.hpp"
#include "study/folder/interruption.hpp"

namespace burin::app {
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

// Empty where there is no file: a pipe would be waited for.
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

session::SculptOptions participant_session(const session::LiveOptions& live,
                                           std::shared_ptr<activities::StudyActivity> activity) {
    session::SculptOptions session;
    session.scene = activity->scene();
    session.activity = std::move(activity);
    session.no_workpiece = true;
    session.tool.shape = "ball:0.001";  // a point, as far as a session's tool can be one
    session.live = live;
    session.live.panel_window = true;
    return session;
}

Result<void> run_live_visit(study::StudyFolder& study, const StudyRunOptions& options) {
    BURIN_TRY_DO(check_record(options.live.record, study.path()));
    BURIN_TRY(plan, activities::plan_visit(study, options.participant,
                                           {.resumes_late = options.resume, .any_delay = options.any_delay},
                                           study::now_utc_ns()));
    const std::vector<study::StagePlace>& places = plan.places;
    const auto people = study.participants();
    const auto person = std::ranges::find(people, options.participant, &study::Participant::id);
    const auto group = std::ranges::find(study.protocol().groups, person->group, &study::Group::code);
    if (group == study.protocol().groups.end())
        return fail(options.participant, "is in a group that the protocol has not", "restore the journal from a copy");
    BURIN_TRY(worlds, activities::felt_worlds(study.protocol()));
    session::LiveOptions live = options.live;
    if (!live.hands.empty())
        return fail("--device", "gives several hands, and a participant's visit has one", "name one device");
    BURIN_TRY(device, participant_device(live.device, study, *group));
    live.device = device.opened;
    const std::optional<devices::WandDescription>& wand = device.wand;
    activities::VisitPlan begun = plan;
    if (group->feels_tube && !device.held.felt_by_person())
        begun.deviations.push_back("group " + group->code + " feels the tube, and the visit was with " +
                                   text_of(device.held));
    activities::StageOnDisk disk(
        study, options.participant, *group,
        options.without_motion ? activities::StageOnDisk::Motion::none : activities::StageOnDisk::Motion::session_ticks,
        device.held, provenance_of(options));
    bool has_begun = false;
    const activities::StageKeeper keeper{
        [&](const activities::TrainingRun& run) -> Result<void> {
            // A visit whose device or window did not open, or that began no stage, has not been.
            if (!std::exchange(has_begun, true))
                BURIN_TRY_DO(activities::begin_visit(study, options.participant, device.held, begun));
            return disk.begin(run);
        },
        [&](const activities::TrainingRun::Ticked& ticked) { disk.take(ticked); },
        [&](const std::vector<activities::RunEvent>& events) { return disk.take(events); },
        [&](const activities::EndedStage& ended) { return disk.end(ended); }, [&] { return disk.close(); }};
    const auto activity = std::make_shared<activities::StudyActivity>(
        study.protocol(), *group, worlds, places,
        activities::visit_settings(study.facts().protocol_digest, *group, places),
        activities::StudyDevice{wand, options.participant}, keeper,
        std::vector<std::pair<std::string, std::string>>{{activities::kProtocolTextFact, study.protocol_text()}});
    session::SculptOptions session = participant_session(live, activity);
    if (wand) session.points = devices::usual_points(*wand);
    const Result<void> done = run_recorded_session(session, "study run");
    std::printf("%zu stages ended; %zu of the day are left\n", activity->stages_ended(),
                places.size() - activity->stages_ended());
    if (const auto made = make_trials(options.study))
        std::printf("%s/trials.csv: %s\n", options.study.c_str(), made->count_text().c_str());
    return done;
}

}  // namespace burin::app
