// SPDX-License-Identifier: MIT
#include "app/study/study_run_command.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <span>

#include "activities/train/live_visit.hpp"
#include "activities/train/scripted_visit.hpp"
#include "activities/train/simulated_study.hpp"
#include "app/cli/live_options.hpp"
#include "app/recordings/live_replay.hpp"
#include "app/study/study_command.hpp"
#include "app/study/study_pictures.hpp"
#include "app/study/study_trials.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::app {
namespace {

constexpr std::uint64_t kMostScriptBytes = std::uint64_t{16} << 20;

bool is_live(const StudyRunOptions& options) {
    return !options.simulated &&
           (options.session.record.input.empty() || activities::is_session_log(options.session.record.input));
}

// Program, version, compiler, command and settings of a run; no file's name, which may name somebody.
activities::Provenance provenance_of(const StudyRunOptions& options) {
    std::string settings = options.simulated ? formatted("simulated learners, effect %g SD", options.effect)
                           : options.session.record.input.empty() ? "a participant in a live session"
                           : activities::is_session_log(options.session.record.input)
                               ? "a participant in a live session, by a log"
                               : "a participant by a script";
    if (options.resume) settings += ", --resume";
    if (options.any_delay) settings += ", --any-delay";
    return {{"program", "burin"},
            {"version", BURIN_VERSION},
            {"compiler", __VERSION__},
            {"command", "study run"},
            {"settings", settings}};
}

// Those of the options given that are in the list, with commas between them.
std::string named_among(const std::vector<std::string>& given, std::span<const std::string> list) {
    std::string names;
    for (const std::string& name : given)
        if (name != "--input" && std::ranges::find(list, name) != list.end())
            names += (names.empty() ? "" : ", ") + name;
    return names;
}

// That no option was given that changes nothing.
Result<void> check_effect(const StudyRunOptions& options, const std::vector<std::string>& given) {
    static const std::array<std::string, 2> kOfLearners{"--effect", "--threads"};
    const std::string of_learners = options.simulated ? "" : named_among(given, kOfLearners);
    if (!of_learners.empty())
        return fail(of_learners, "no effect on a participant's visit: of simulated learners only",
                    "leave it out, or give --simulated without --participant");
    if (options.simulated && options.any_delay)
        return fail("--any-delay", "no effect on simulated learners, who come in time: of a participant's visit",
                    "leave it out, or take one person through with --participant ID");
    const std::string of_session = is_live(options) ? "" : named_among(given, options.live_names);
    if (of_session.empty()) return {};
    if (options.simulated)
        return fail(of_session, "no effect on simulated learners, who have no window and no device: of a live session",
                    "leave it out, or take one person through with --participant ID");
    return fail(of_session, "no effect on a script, which has no window and no device: of a live session",
                "leave it out, or give a session's log as --input (its first line begins with burin-input)");
}

Result<void> check_usage(const StudyRunOptions& options) {
    constexpr const char* kRun = "burin study run";
    if (options.simulated == !options.participant.empty())
        return fail(kRun, "takes simulated learners, or one participant, through a study",
                    "add --simulated, or --participant ID");
    if (options.pictures && options.without_motion)
        return fail(kRun, "--pictures are drawn from the motion that --without-motion leaves out",
                    "give one of the two");
    if (options.simulated && !options.session.record.input.empty())
        return fail(kRun, "simulated learners need no script", "give --participant ID with --input");
    return {};
}

Result<void> take_learners(study::StudyFolder& study, const StudyRunOptions& options) {
    std::printf("Simulated learners: no person and no device; hand and wand are simulated; effect %g SD.\n",
                options.effect);
    activities::SimulationOptions simulation;
    simulation.effect = options.effect;
    simulation.threads = options.threads;
    simulation.records = !options.without_motion;
    simulation.resumes_late = options.resume;
    simulation.provenance = provenance_of(options);
    simulation.tell = [](const std::string& line) {
        std::printf("%s\n", line.c_str());
        std::fflush(stdout);
    };
    const auto begun = std::chrono::steady_clock::now();
    BURIN_TRY(went, activities::run_simulated(study, simulation));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    BURIN_TRY(made, make_trials(options.study));
    std::printf("%zu stages, %.0f s of simulated time in %.1f s, %.0f times real time; %s/trials.csv: %s\n",
                went.stages, went.simulated_s, took.count(), went.simulated_s / took.count(), options.study.c_str(),
                made.count_text().c_str());
    return {};
}

// Prints a line of the operator's panel whenever another stage or phase begins.
class OperatorLog {
public:
    void at(double time_s, const activities::TrainingShown& shown, const activities::TrainingRun& run) {
        for (const activities::RunEvent& event : shown.events)
            std::printf("%9.3f s  %s: %s\n", time_s, event.name.c_str(), event.value.c_str());
        std::string now, away;
        for (const activities::PanelRow& row : run.rows())
            if (row.name == "stage" || row.name == "now")
                now += (now.empty() ? "" : "; ") + row.value;
            else if (row.name == "start cap")
                away = row.value;
        if (now == last_) return hint(time_s, away);
        last_ = now;
        since_s_ = time_s;
        hinted_ = false;
        std::printf("%9.3f s  %s\n", time_s, now.c_str());
    }

private:
    // Where a trial has waited long for its start cap.
    void hint(double time_s, const std::string& away) {
        constexpr double kLongWait_s = 10.0;
        if (away.empty() || hinted_ || time_s - since_s_ < kLongWait_s) return;
        hinted_ = true;
        std::printf(
            "%9.3f s  both points must be in the start cap, which lies outside the tube's first point: its "
            "middle is %s\n",
            time_s, away.c_str());
    }

    std::string last_;
    double since_s_ = 0.0;
    bool hinted_ = false;
};

Result<void> take_participant(study::StudyFolder& study, const StudyRunOptions& options) {
    BURIN_TRY(text, read_text_file(options.session.record.input, kMostScriptBytes));
    BURIN_TRY(script, activities::parse_visit_script(text, options.session.record.input));
    std::printf("%s by a script, in simulated time: hand and wand are simulated.\n", options.participant.c_str());
    activities::VisitOptions visit;
    visit.records = !options.without_motion;
    visit.provenance = provenance_of(options);
    visit.leave = {.resumes_late = options.resume, .any_delay = options.any_delay};
    OperatorLog log;
    visit.on_frame = [&](double time_s, const activities::TrainingShown& shown,
                         const activities::TrainingRun& run) -> Result<void> {
        log.at(time_s, shown, run);
        return {};
    };
    visit.tell = [](double time_s, const std::string& line) { std::printf("%9.3f s  %s\n", time_s, line.c_str()); };
    BURIN_TRY(went, activities::run_scripted_visit(study, options.participant, script, visit));
    std::printf("%zu stages ended in %.1f s of simulated time, %llu ticks; %zu of the day are left%s\n", went.stages,
                went.simulated_s, static_cast<unsigned long long>(went.ticks), went.left,
                went.interrupted ? "; the script ended within a stage, which is to be done again" : "");
    // Before the first trial there is no table.
    if (const auto made = make_trials(options.study))
        std::printf("%s/trials.csv: %s\n", options.study.c_str(), made->count_text().c_str());
    if (went.without_effect == 0) return {};
    std::fflush(stdout);
    return fail(options.session.record.input,
                formatted("%zu of its words had no effect, as told above", went.without_effect),
                "correct the script; the visit's stages are kept");
}

// Opens the window, or plays the log.
Result<void> take_live_participant(study::StudyFolder& study, const StudyRunOptions& options) {
    BURIN_TRY(visit, activities::LiveVisit::prepare(
                         study, {.participant = options.participant,
                                 .session = options.session,
                                 .leave = {.resumes_late = options.resume, .any_delay = options.any_delay},
                                 .records_motion = !options.without_motion,
                                 .provenance = provenance_of(options)}));
    const Result<void> done = run_recorded_session(visit->session(), "study run");
    std::printf("%zu stages ended; %zu of the day are left\n", visit->stages_ended(), visit->stages_left());
    if (const auto made = make_trials(options.study))
        std::printf("%s/trials.csv: %s\n", options.study.c_str(), made->count_text().c_str());
    return done;
}

}  // namespace

Result<void> study_run(const StudyRunOptions& options, const std::vector<std::string>& given) {
    BURIN_TRY_DO(check_usage(options));
    BURIN_TRY_DO(check_effect(options, given));
    BURIN_TRY_DO(activities::check_visit_input(options.session.record.input));
    BURIN_TRY(study, study::StudyFolder::open(options.study, study::StudyAccess::write));
    warn_of_journal(study);
    study.use_key(options.key);
    const auto went = options.simulated  ? take_learners(study, options)
                      : is_live(options) ? take_live_participant(study, options)
                                         : take_participant(study, options);
    if (!went) return went;
    return options.pictures ? draw_stages(study) : Result<void>();
}

namespace {

CommandAction add_study_run(Command command) {
    const auto options = std::make_shared<StudyRunOptions>();
    command.option("STUDY", options->study, kStudyHelp).required();
    command.flag("--simulated", options->simulated,
                 "Simulated learners with a simulated wand fill all places; no window");
    command.option("--participant", options->participant,
                   "Takes one participant, who is enrolled, through the next day's stages");
    options->live_names =
        add_live_options(command, options->session,
                         "A written log of a session's input, in its user's place, in a live session; or a "
                         "script of a visit, in simulated time (docs/study.md)",
                         ". In a study \"simulated\" is not the Omni but the wand, simulated, with the "
                         "protocol's two points");
    command.option("--key", options->key, "The allocation's key, where it is not in the folder");
    command.option("--threads", options->threads, "People at a time; 0: one for each core; the result is the same")
        .within(0, 1024);
    command.flag("--without-motion", options->without_motion,
                 "Keep what is measured, but not the motion; replay needs that");
    command.flag(
        "--resume", options->resume,
        "Begin an interrupted stage anew though the protocol's time for it is over; journal and report name it");
    command.flag("--any-delay", options->any_delay,
                 "Begin the day though it comes too early or too late by the protocol; journal and report name it");
    command.flag("--pictures", options->pictures,
                 "Draw what each group saw in each stage, into the folder's pictures/");
    command.option("--effect", options->effect, "Of simulated learners: how much less the first group wanders, in SD")
        .within(-10.0, 10.0)
        .show_default();
    return action([options, command] { return study_run(*options, command.given()); });
}

}  // namespace

CommandRow study_run_row() {
    return {"run", "Takes the participants through the protocol, from where the journal ends", add_study_run};
}

}  // namespace burin::app
