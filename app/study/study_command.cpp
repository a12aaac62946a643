// SPDX-License-Identifier: MIT
#include "app/study/study_command.hpp"

#include "app/cli/live_options.hpp"

namespace burin::app {

struct StudyCommand::Options {
    StudyAnalyseOptions analyse;
    StudyPowerOptions power;
    StudyInitOptions init;
    StudyEnrolOptions enrol;
    StudyRunOptions run;
    StudyReplayOptions replay;
    StudyWithdrawOptions withdraw;
    std::string checked, status, reported;
};

StudyCommand::StudyCommand(Command app)
    : options_(std::make_unique<Options>()), command_(app.subcommand("study", "A study, from protocol to report")) {
    command_.require_subcommand();
    add_folder();
    add_figures();
}

void StudyCommand::add_folder() {
    constexpr const char* kStudy = "The study's folder";
    StudyInitOptions& i = options_->init;
    init_ = command_.subcommand("init", "Makes a study's folder of a protocol: frozen, with its allocation");
    init_.option("PLACES", i.places, "PROTOCOL STUDY: a TOML file (docs/study.md) or kinesthetic-path; a new folder")
        .required();
    init_.option("--protocol", i.protocol, "The protocol, where only STUDY is named before");
    init_.option("--participants", i.participants, "Places of each stratum's list")
        .within(std::uint64_t{1}, std::uint64_t{10'000})
        .show_default();
    init_.option("--seed", i.seed, "Of the allocation and of simulated learners; with people leave it out");
    init_.option("--key", i.key, "A new file for the key of the sealed allocation, to be kept by who does not enrol");
    check_ = command_.subcommand("check", "Every fault of a protocol, or of a study's folder");
    check_.option("PLACE", options_->checked, "A protocol (.toml) or a study's folder").required();
    StudyEnrolOptions& e = options_->enrol;
    enrol_ = command_.subcommand("enrol", "Gives a participant the next place of the allocation");
    enrol_.option("STUDY", e.study, kStudy).required();
    enrol_.option("ID", e.id, "A code such as p07, never a name").required();
    enrol_.option("--key", e.key, "The allocation's key, where it is not in the folder");
    enrol_.option("--codes", e.codes, "One code of each stratum, in the protocol's order");
    StudyRunOptions& r = options_->run;
    run_ = command_.subcommand("run", "Takes the participants through the protocol, from where the journal ends");
    run_.option("STUDY", r.study, kStudy).required();
    run_.flag("--simulated", r.simulated, "Simulated learners with a simulated wand fill all places; no window");
    run_.option("--participant", r.participant,
                "Takes one participant, who is enrolled, through the next day's stages");
    r.live_names = add_live_options(run_, r.live,
                                    "A written log of a session's input, in its user's place, in a live session; or a "
                                    "script of a visit, in simulated time (docs/study.md)",
                                    ". In a study \"simulated\" is not the Omni but the wand, simulated, with the "
                                    "protocol's two points");
    run_.option("--key", r.key, "The allocation's key, where it is not in the folder");
    run_.option("--threads", r.threads, "People at a time; 0: one for each core; the result is the same")
        .within(0, 1024);
    run_.flag("--without-motion", r.without_motion, "Keep what is measured, but not the motion; replay needs that");
    run_.flag("--resume", r.resume,
              "Begin an interrupted stage anew though the protocol's time for it is over; journal and report name it");
    run_.flag("--any-delay", r.any_delay,
              "Begin the day though it comes too early or too late by the protocol; journal and report name it");
    run_.flag("--pictures", r.pictures, "Draw what each group saw in each stage, into the folder's pictures/");
    run_.option("--effect", r.effect, "Of simulated learners: how much less the first group wanders, in SD")
        .within(-10.0, 10.0)
        .show_default();
    StudyReplayOptions& again = options_->replay;
    replay_ = command_.subcommand("replay", "Recorded motion through the haptic tick again, compared to the bit");
    replay_.option("STUDY", again.study, kStudy).required();
    replay_.option("--participant", again.participant, "Of this participant only");
    replay_.option("--threads", again.threads, "Recordings at a time; 0: one for each core").within(0, 1024);
    status_ = command_.subcommand("status", "Who is in the study and how far; aborted stages; damage");
    status_.option("STUDY", options_->status, kStudy).required();
    StudyWithdrawOptions& w = options_->withdraw;
    withdraw_ = command_.subcommand("withdraw", "Excludes a participant");
    withdraw_.option("STUDY", w.study, kStudy).required();
    withdraw_.option("ID", w.id, "The participant's code").required();
    withdraw_.flag("--erase", w.erase,
                   "Delete the participant's data too, and all that journal and reports tell but for code and group");
    report_ = command_.subcommand("report", "A new folder in reports/ with report.html, results.json and tables");
    report_.option("STUDY", options_->reported, kStudy).required();
}

void StudyCommand::add_figures() {
    StudyAnalyseOptions& a = options_->analyse;
    analyse_ = command_.subcommand("analyse", "Correlations, comparisons and effect sizes of a table of trials");
    analyse_.option("STUDY", a.study, "The study's folder, instead of --data");
    analyse_.option("--data", a.data, "CSV with participant, group, trial, deviation, time_s; see docs/formats.md");
    analyse_.option("--day", a.chosen.day, "With STUDY: trials of this day alone, such as a later one's (retention)");
    analyse_.option("--stage", a.chosen.stage, "With STUDY: trials of this stage alone, such as another path's");
    analyse_.option("--published", a.published, "CSV of figures that were published of these data, to be checked");
    analyse_.option("--json", a.json, "A file for every figure; - for standard output");
    analyse_.option("--out", a.out, "A new folder for report.html, results.json and tables as CSV");
    analyse_.option("--seed", a.seed, "Of random permutations, where there are too many to count all").show_default();

    StudyPowerOptions& p = options_->power;
    power_ = command_.subcommand("power", "How many participants a study needs, by simulation");
    power_.option("--effect", p.effect, "Difference of the groups in standard deviations of a participant's value")
        .within(-100.0, 100.0)
        .required();
    power_.option("--participants", p.participants, "Of both groups together: print their power")
        .within(std::uint64_t{2}, std::uint64_t{4000});
    power_.option("--target", p.target, "Print the fewest participants that reach this power (0.8)")
        .within(0.01, 0.9999);
    power_.option("--alpha", p.alpha, "Significance level").within(1e-6, 0.5).show_default();
    power_.option("--studies", p.studies, "How many are simulated (10000; 1000 without an effect)")
        .within(std::uint64_t{100}, std::uint64_t{10'000'000});
    power_.option("--seed", p.seed, "Of the simulation").show_default();
    power_.option("--threads", p.threads, "How many threads work; 0: one per core; the result is the same")
        .within(0, 1024);
    power_.option("--json", p.json, "A file for the result; - for standard output");
}

StudyCommand::~StudyCommand() = default;

bool StudyCommand::parsed() const { return command_.parsed(); }

Result<void> StudyCommand::run() const {
    const Options& o = *options_;
    if (init_.parsed()) return study_init(o.init);
    if (check_.parsed()) return study_check(o.checked);
    if (enrol_.parsed()) return study_enrol(o.enrol);
    if (run_.parsed()) return study_run(o.run, run_.given());
    if (replay_.parsed()) return study_replay(o.replay);
    if (status_.parsed()) return study_status(o.status);
    if (withdraw_.parsed()) return study_withdraw(o.withdraw);
    if (report_.parsed()) return study_report(o.reported);
    return analyse_.parsed() ? study_analyse(o.analyse) : study_power(o.power);
}

}  // namespace burin::app
