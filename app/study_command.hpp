// SPDX-License-Identifier: MIT
// burin study: the figures of a study.
//   burin study analyse --data FILE.csv [--published FILE.csv] [--json OUT] [--out FOLDER]
//   burin study power --effect D [--participants N | --target P] [--json OUT]
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line.hpp"
#include "base/error.hpp"

namespace burin::app {

class StudyCommand {
public:
    // Adds the command and its options; the command line must outlive the object.
    explicit StudyCommand(Command app);
    ~StudyCommand();
    StudyCommand(const StudyCommand&) = delete;
    StudyCommand& operator=(const StudyCommand&) = delete;

    [[nodiscard]] bool parsed() const;
    [[nodiscard]] Result<void> run() const;

private:
    struct Options;
    std::unique_ptr<Options> options_;
    Command command_;
    Command analyse_;
};

// ---- burin study analyse (study_analyse_command.cpp)

struct StudyAnalyseOptions {
    std::string data;       // CSV
    std::string published;  // CSV; empty: only studies that Burin knows
    std::string json;       // a file; empty: none
    std::string out;        // a folder that does not exist yet; empty: none
    std::uint64_t seed = 1;
};
// Lists every fault of the inputs and fails, or analyses. The folder is written whole or not at all.
[[nodiscard]] Result<void> study_analyse(const StudyAnalyseOptions& options);

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

}  // namespace burin::app
