// SPDX-License-Identifier: MIT
// burin study: a study from its protocol to its report (docs/study.md), and the figures of one.
//   burin study init PROTOCOL STUDY --participants N [--seed S] [--key FILE]
//   burin study check FILE.toml | STUDY
//   burin study enrol STUDY ID [--codes CODE...] [--key FILE]
//   burin study run STUDY --simulated [--effect D] [--threads N] [--without-motion | --pictures]
//   burin study run STUDY --participant ID --input SCRIPT [--resume] [--any-delay] [--without-motion | --pictures]
//   burin study run STUDY --participant ID [--input LOG] [live options] [--resume] [--any-delay]
//                   [--without-motion | --pictures]
//   burin study replay STUDY
//   burin study status STUDY
//   burin study withdraw STUDY ID [--erase]
//   burin study report STUDY
//   burin study analyse STUDY [--day N] [--stage NAME] [--json OUT] [--out FOLDER]
//   burin study analyse --data FILE.csv [--published FILE.csv] [--json OUT] [--out FOLDER]
//   burin study power --effect D [--participants N | --target P] [--json OUT]
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "study/report/html_report.hpp"
#include "study/report/study_trials.hpp"

namespace burin::app {

[[nodiscard]] CommandRow study_row();

inline constexpr const char* kStudyHelp = "The study's folder";

// ---- burin study analyse (study_analyse_command.cpp)

struct StudyAnalyseOptions {
    std::string data;           // CSV; empty: of the study
    std::string study;          // a study's folder; empty: data is given
    study::TrialChoice chosen;  // with a study
    std::string published;      // CSV; empty: only studies that Burin knows
    std::string json;           // a file; empty: none
    std::string out;            // a folder that does not exist yet; empty: none
    std::uint64_t seed = 1;
    std::vector<std::string> groups;  // of a study, in its protocol's order; empty: in the order of the rows
    std::vector<std::string> notes;   // whole sentences that stand beside the figures in every form
    std::vector<std::string> facts;   // whole sentences about the study for the report
    std::string title;                // of the study; empty: the file's name
    std::vector<study::ReportSection> sections;
};
// Lists every fault of the inputs and fails, or analyses. The folder is written whole or not at all.
[[nodiscard]] Result<void> study_analyse(const StudyAnalyseOptions& options);
[[nodiscard]] CommandRow study_analyse_row();

// ---- burin study power (study_power_command.cpp)

struct StudyPowerOptions {
    double effect = 0.0;                   // in standard deviations
    std::optional<unsigned> participants;  // of both groups together
    std::optional<double> target;          // the power that is asked for
    double alpha = 0.05;
    std::optional<unsigned> studies;  // simulated
    std::uint64_t seed = 1;
    unsigned threads = 0;  // 0: one per core
    std::string json;      // a file; empty: none
};
[[nodiscard]] Result<void> study_power(const StudyPowerOptions& options);
[[nodiscard]] CommandRow study_power_row();

// ---- the folder of a study (study_NAME_command.cpp each)

struct StudyInitOptions {
    std::vector<std::string> places;  // PROTOCOL STUDY, or STUDY with `protocol`
    std::string protocol;
    unsigned participants = 10;    // places in each stratum's list
    std::optional<unsigned> seed;  // nothing: drawn
    std::string key;               // a new file; empty: into the folder
};
// Lists every fault of the protocol and fails, or makes the folder.
[[nodiscard]] Result<void> study_init(const StudyInitOptions& options);
[[nodiscard]] CommandRow study_init_row();

// A protocol, or a study's folder with its protocol, journal and data; lists every fault.
[[nodiscard]] Result<void> study_check(const std::string& place);
[[nodiscard]] CommandRow study_check_row();

struct StudyEnrolOptions {
    std::string study, id, key;
    std::vector<std::string> codes;
};
[[nodiscard]] Result<void> study_enrol(const StudyEnrolOptions& options);
[[nodiscard]] CommandRow study_enrol_row();

[[nodiscard]] CommandRow study_run_row();

// Every recorded motion through the haptic tick again; fails where one does not give what was stored.
struct StudyReplayOptions {
    std::string study;
    std::string participant;  // empty: all
    unsigned threads = 0;     // 0: one for each core
    bool quiet = false;       // prints faults alone
};
[[nodiscard]] Result<void> study_replay(const StudyReplayOptions& options);
[[nodiscard]] CommandRow study_replay_row();

[[nodiscard]] Result<void> study_status(const std::string& study);
[[nodiscard]] CommandRow study_status_row();

struct StudyWithdrawOptions {
    std::string study, id;
    bool erase = false;
};
[[nodiscard]] Result<void> study_withdraw(const StudyWithdrawOptions& options);
[[nodiscard]] CommandRow study_withdraw_row();

// Makes trials.csv anew and writes a new folder in reports/.
[[nodiscard]] Result<void> study_report(const std::string& study);
[[nodiscard]] CommandRow study_report_row();

}  // namespace burin::app
