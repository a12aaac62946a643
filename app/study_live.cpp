// SPDX-License-Identifier: MIT
#include "app/study_live.hpp"
#include "app/live_replay.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "activities/train/recorded_visit.hpp"
#include "activities/train/stage_on_disk.hpp"
#include "activities/train/study_activity.hpp"
#include "app/output_files.hpp"
#include "app/study_trials.hpp"
#include "base/places.hpp"
#include "base/text.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/drive/session.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_recording.hpp"
#include "study/folder/interruption.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

constexpr double kSamePoint_m = 1e-6;

// The wand with its points where the protocol has them.
Result<std::string> write_wand(const study::Protocol& protocol, const fs::path& study) {
    std::string text = "name = \"simulated wand\"\n";
    text += formatted("\n[calibration]\ntolerance = %.9g\n", protocol.calibration_tolerance_m);
    for (const devices::WandPoint& point : study::study_wand(protocol).points)
        text += formatted("\n[[point]]\nname = \"%s\"\noffset = [%.9g, %.9g, %.9g]\n", point.name.c_str(),
                          point.offset_m.x, point.offset_m.y, point.offset_m.z);
    const std::string file = (study / "wand.toml").string();
    if (const auto ok = write_text(file, text); !ok) return std::unexpected(ok.error());
    return file;
}

// The wand that the device is, where it is one; its points must be where the protocol has them.
Result<std::optional<devices::WandDescription>> wand_of(const std::string& device, const study::Protocol& protocol) {
    const Result<devices::DeviceNature> nature = devices::nature_of_device(device, &session::session_recordings());
    if (!nature) return std::unexpected(nature.error());
    const std::optional<devices::WandDescription>& wand = nature->handle;
    if (!wand) return std::nullopt;
    const auto points = devices::points_named(*wand, devices::usual_points(*wand));
    if (!points) return std::unexpected(points.error());
    const std::vector<devices::WandPoint> wanted = study::study_wand(protocol).points;
    if (points->size() != wanted.size())
        return fail(
            device,
            formatted("touches with %zu points, and the protocol's wand with %zu", points->size(), wanted.size()),
            "describe the points as the protocol's point_offset_m has them");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Vec3& at_m = points->at(i).offset_m;
        if (glm::distance(at_m, wanted[i].offset_m) > kSamePoint_m)
            return fail(device,
                        formatted("has its point %s %.1f mm above the handle's middle, and the protocol %.1f mm",
                                  wanted[i].name.c_str(), 1e3 * at_m.y, 1e3 * wanted[i].offset_m.y),
                        "describe the points as the protocol's point_offset_m has them");
    }
    return *wand;
}

// Checks where a visit's session is recorded: beside the study, whose files a withdrawal erases, and so that it can be
// done again.
Result<void> check_record(const std::string& record, const fs::path& study) {
    if (record.empty()) return {};
    if (const auto ok = check_working_folder(record); !ok) return ok;
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
    if (const auto ok = check_record(options.live.record, study.path()); !ok) return ok;
    const auto plan =
        activities::plan_visit(study, options.participant,
                               {.resumes_late = options.resume, .any_delay = options.any_delay}, study::now_utc_ns());
    if (!plan) return std::unexpected(plan.error());
    const std::vector<study::StagePlace>& places = plan->places;
    const auto people = study.participants();
    const auto person = std::ranges::find(people, options.participant, &study::Participant::id);
    const auto group = std::ranges::find(study.protocol().groups, person->group, &study::Group::code);
    if (group == study.protocol().groups.end())
        return fail(options.participant, "is in a group that the protocol has not", "restore the journal from a copy");
    const auto worlds = activities::felt_worlds(study.protocol());
    if (!worlds) return std::unexpected(worlds.error());
    session::LiveOptions live = options.live;
    if (!live.hands.empty())
        return fail("--device", "gives several hands, and a participant's visit has one", "name one device");
    if (live.device == devices::kDefaultHapticDevice || live.device == devices::kSimulatedWand) {
        const auto described = write_wand(study.protocol(), study.path());
        if (!described) return std::unexpected(described.error());
        live.device = std::string(devices::kSimulatedWand) + ":" + *described;
    }
    const auto wand = wand_of(live.device, study.protocol());
    if (!wand) return std::unexpected(wand.error());
    const std::string device = *wand ? "simulated wand" : live.device;
    if (const auto ok = activities::begin_visit(study, options.participant, device, *plan); !ok) return ok;
    activities::StageOnDisk disk(study, options.participant, *group,
                                 options.without_motion ? activities::StageOnDisk::Motion::none
                                                        : activities::StageOnDisk::Motion::session_ticks);
    const activities::StageKeeper keeper{
        [&](const activities::TrainingRun& run) { return disk.begin(run); },
        [&](const activities::TrainingRun::Ticked& ticked) { disk.take(ticked); },
        [&](const std::vector<activities::RunEvent>& events) { return disk.take(events); },
        [&](const activities::EndedStage& ended) { return disk.end(ended); }, [&] { return disk.close(); }};
    const auto activity = std::make_shared<activities::StudyActivity>(
        study.protocol(), *group, *worlds, places,
        activities::visit_settings(study.facts().protocol_digest, *group, places),
        activities::StudyDevice{*wand, options.participant}, keeper,
        std::vector<std::pair<std::string, std::string>>{{activities::kProtocolTextFact, study.protocol_text()}});
    session::SculptOptions session = participant_session(live, activity);
    if (*wand) session.points = devices::usual_points(**wand);
    const Result<void> done = run_recorded_session(session, "study run");
    std::printf("%zu stages ended; %zu of the day are left\n", activity->stages_ended(),
                places.size() - activity->stages_ended());
    if (const auto made = make_trials(options.study))
        std::printf("%s/trials.csv: %zu trials\n", options.study.c_str(), made->trials);
    return done;
}

}  // namespace burin::app
