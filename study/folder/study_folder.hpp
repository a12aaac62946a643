// SPDX-License-Identifier: MIT
// A study on the disk:
//   protocol.toml    as it was at the start; study.json holds its digest, and a protocol edited later is refused
//   study.json       digest, seed, places of each stratum's list
//   allocation.csv   the whole list, for whoever keeps it sealed
//   journal.jsonl    what happened, only appended to (journal.hpp)
//   data/ID/*.json   one file for each stage that was recorded, never written twice
//   trials.csv       derived of these: made anew by run and report
//   lock             held by the process that writes
// One process writes at a time; others read. One thread for each object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "study/folder/journal.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

enum class StageStatus { ended, aborted };

// A stage as a participant went through it. Aborted: begun and never ended.
struct StageVisit {
    std::size_t day = 1, place = 1;  // place in the day's list of stages; both from 1
    std::string stage;
    StageStatus status = StageStatus::aborted;
    std::string result;       // name_of(StageResult)
    std::string file;         // within the folder; empty: none
    std::string file_digest;  // SHA-256
};

struct Participant {
    std::string id, stratum, group;
    std::vector<std::string> codes;
    std::size_t position = 0;  // in the stratum's list, from 1
    bool withdrawn = false, erased = false, simulated = false;
    std::vector<StageVisit> visits;

    [[nodiscard]] bool has_ended(std::size_t day, std::size_t place) const;
};
[[nodiscard]] std::vector<Participant> participants_of(const Journal& journal);

// The stages of a protocol in order, of all days.
struct StagePlace {
    std::size_t day = 1, place = 1;
    const Stage* stage = nullptr;
};
[[nodiscard]] std::vector<StagePlace> places_of(const Protocol& protocol);

struct StudyFacts {
    std::string protocol_digest;
    std::uint64_t seed = 1;
    std::size_t participants = 0;
};

// Makes a new folder; fails where anything has its name. Whole or not at all.
[[nodiscard]] Result<void> create_study(const std::filesystem::path& folder, const std::string& protocol_text,
                                        std::uint64_t seed, std::size_t participants);

enum class StudyAccess { read, write };

class StudyFolder {
public:
    // Fails where the protocol is not the one that the study began with, and, to write, where another process does.
    [[nodiscard]] static Result<StudyFolder> open(const std::filesystem::path& folder, StudyAccess access);
    ~StudyFolder();
    StudyFolder(StudyFolder&& other) noexcept;
    StudyFolder& operator=(StudyFolder&&) = delete;

    [[nodiscard]] const Protocol& protocol() const { return protocol_; }
    [[nodiscard]] const StudyFacts& facts() const { return facts_; }
    [[nodiscard]] const Journal& journal() const { return journal_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::vector<Participant> participants() const { return participants_of(journal_); }

    // Needs access to write. Gives the next place of the stratum's list; refuses an id that was used before.
    [[nodiscard]] Result<Participant> enrol(const std::string& id, const std::vector<std::string>& codes,
                                            bool simulated);
    // Excludes the participant; with erase its data files are deleted, and the journal keeps that it was here.
    [[nodiscard]] Result<void> withdraw(const std::string& id, bool erase);
    // A study has one effect of simulated learners: the first run's. Refuses another.
    [[nodiscard]] Result<void> begin_simulation(double effect);
    [[nodiscard]] std::optional<double> simulated_effect() const;  // nothing before the first run
    [[nodiscard]] Result<void> begin_stage(const std::string& id, const StagePlace& at);
    // Writes what was recorded (null: nothing) to a new file and syncs it before the journal names it.
    [[nodiscard]] Result<void> end_stage(const std::string& id, const StagePlace& at, const std::string& result,
                                         const Json& recorded);
    // Fails where the file is missing or not the one that the journal names.
    [[nodiscard]] Result<Json> recorded(const StageVisit& visit) const;

private:
    StudyFolder() = default;
    [[nodiscard]] Result<void> note(Json value);

    std::filesystem::path path_;
    Protocol protocol_;
    StudyFacts facts_;
    Journal journal_;
    int lock_ = -1;
};

}  // namespace burin::study
