// SPDX-License-Identifier: MIT
// A study on the disk:
//   protocol.toml    as it was at the start; study.json holds its digest, and a protocol edited later is refused
//   study.json       digests, seed, places of each stratum's list
//   allocation.sealed  the whole list, each place sealed by itself (study/assign/sealed_list.hpp)
//   allocation.key   opens it, unless it is kept elsewhere
//   journal.jsonl    what happened, only appended to (journal.hpp)
//   data/ID/*.json   one file for each stage that was measured, never written twice
//   data/ID/*.session  the motion of a stage, tick by tick (stage_recording.hpp); DAY-PLACE-runN as its .json
//   trials.csv       derived of these: made anew by run and report
//   wand.toml        the simulated wand with the points of the protocol, of the last visit with it
//   lock             held by the process that writes
// One process writes at a time; others read. One thread for each object.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "study/folder/held_device.hpp"
#include "study/folder/journal.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

// The names in a study's folder that are the study's own, beside those below data/.
inline constexpr std::array<std::string_view, 8> kFilesOfStudy{
    "wand.toml",      "protocol.toml", "study.json", "allocation.sealed",
    "allocation.key", "journal.jsonl", "trials.csv", "lock"};

// Of participants' codes.
inline constexpr std::string_view kLettersOfCodes = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";

enum class StageStatus { ended, aborted };

// A stage as a participant went through it. Aborted: begun and never ended.
struct StageVisit {
    std::size_t day = 1, place = 1;  // place in the day's list of stages; both from 1
    std::string stage{};
    StageStatus status = StageStatus::aborted;
    std::string result{};       // name_of(StageResult)
    std::string file{};         // within the folder; empty: none
    std::string file_digest{};  // SHA-256
    // The motion, likewise; named from the stage's beginning on, its digest known at its end.
    std::string recording{}, recording_digest{};
    HeldDevice held{};                     // what moved the wand
    std::size_t run = 1;                   // how often the stage was begun, this time included; as its files are named
    std::string begun_utc{}, ended_utc{};  // as the journal has them
    std::optional<double> clock_s{}, ended_clock_s{};  // of a simulated participant's clock
    std::map<std::string, std::size_t> failures{};     // of a trial's attempts, how many by the reason's name
};

// The reason of a trial that nobody came to begin.
inline constexpr const char* kNeverTouched = "start cap never touched";

// Where a stage's files are, within the folder and without their ends: "data/p01/day1-03-run1".
[[nodiscard]] std::string files_begin(const std::string& id, std::size_t day, std::size_t place, std::size_t run);

// What was done otherwise than the protocol has it, as the journal tells it.
struct ProtocolDeviation {
    std::string utc{}, text{};
};

struct Participant {
    std::string id, stratum, group;
    std::vector<std::string> codes;
    std::size_t position = 0;  // in the stratum's list, from 1
    bool withdrawn = false, erased = false, simulated = false;
    std::optional<HeldDevice> held{};  // of the last visit; none: there was none
    std::vector<StageVisit> visits{};
    std::vector<ProtocolDeviation> deviations{};
    bool has_words = false;  // the journal holds more of it than its code and group

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
    std::string protocol_digest, allocation_digest;
    std::uint64_t seed = 1;  // of simulated learners, and of the allocation where it was given
    bool seed_given = false;
    std::size_t participants = 0;
};

struct StudyMaking {
    std::optional<std::uint64_t> seed;  // nothing: the allocation is drawn from the system's randomness
    std::size_t participants = 10;      // places of each stratum's list
    std::filesystem::path key;          // where the key goes, a new file; empty: into the folder
};
// Makes a new folder; fails where anything has its name. Whole or not at all.
[[nodiscard]] Result<void> create_study(const std::filesystem::path& folder, const std::string& protocol_text,
                                        const StudyMaking& making);

// Within the study's folder.
struct StageFiles {
    std::size_t run = 1;
    std::string measured;
    std::string recording;  // empty: the motion is not recorded
};

inline constexpr std::uint64_t kMostRecordingBytes = std::uint64_t{2} << 30;  // 6 hours of a wand

enum class StudyAccess { read, write };

class StudyFolder {
public:
    // Fails where the protocol is not the one that the study began with, and, to write, where another process does.
    [[nodiscard]] static Result<StudyFolder> open(const std::filesystem::path& folder, StudyAccess access);
    ~StudyFolder();
    StudyFolder(StudyFolder&& other) noexcept;
    StudyFolder& operator=(StudyFolder&&) = delete;

    [[nodiscard]] const Protocol& protocol() const { return protocol_; }
    // The text of protocol.toml.
    [[nodiscard]] const std::string& protocol_text() const { return protocol_text_; }
    [[nodiscard]] const StudyFacts& facts() const { return facts_; }
    [[nodiscard]] const Journal& journal() const { return journal_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::vector<Participant> participants() const { return participants_of(journal_); }

    // Where the allocation's key is, if it is not in the folder.
    void use_key(const std::filesystem::path& file) { key_ = file; }
    // That the sealed list is the one that the journal names, and, where the key is there, that it opens and that
    // everybody is in the group of their place.
    [[nodiscard]] Result<void> check_allocation() const;

    // Needs access to write. Opens the next place of the stratum's list; refuses an id that was used before.
    [[nodiscard]] Result<Participant> enrol(const std::string& id, const std::vector<std::string>& codes,
                                            bool simulated);
    // Excludes the participant. With erase its data, the journal's words about it and the reports and pictures that
    // tell of it are deleted; the journal keeps its code, its group and that it has withdrawn. Returns what was deleted
    // of reports and pictures, within the folder.
    [[nodiscard]] Result<std::vector<std::string>> withdraw(const std::string& id, bool erase);
    // A study has one effect of simulated learners: the first run's. Refuses another.
    [[nodiscard]] Result<void> begin_simulation(double effect);
    [[nodiscard]] std::optional<double> simulated_effect() const;  // nothing before the first run
    // What an operator wrote about a participant; it must name nobody.
    [[nodiscard]] Result<void> note_of(const std::string& id, const std::string& text);
    // What is done otherwise than the protocol has it; reports name it.
    [[nodiscard]] Result<void> note_deviation(const std::string& id, const std::string& text);
    // A participant comes for some stages, with this device: before the first of them.
    [[nodiscard]] Result<void> begin_visit(const std::string& id, const HeldDevice& held);
    // Names the files of the stage, of which there are none yet. `has_motion`: its motion will be recorded. `clock_s`:
    // of a simulated participant's clock.
    [[nodiscard]] Result<StageFiles> begin_stage(const std::string& id, const StagePlace& at, bool has_motion,
                                                 std::optional<double> clock_s = {});
    // Writes what was measured (null: nothing) to a new file and syncs it before the journal names it, and takes the
    // digest of the recording, which must be closed. `failures`: an object of why attempts failed, each with how often;
    // null: none.
    [[nodiscard]] Result<void> end_stage(const std::string& id, const StagePlace& at, const std::string& result,
                                         const Json& recorded, const StageFiles& files, const Json& failures = {},
                                         std::optional<double> clock_s = {});
    // Fails where the file is missing or not the one that the journal names.
    [[nodiscard]] Result<Json> recorded(const StageVisit& visit) const;
    // Likewise of the motion, which is not read.
    [[nodiscard]] Result<void> check_recording(const StageVisit& visit) const;

private:
    StudyFolder() = default;
    [[nodiscard]] Result<void> note(Json value);
    [[nodiscard]] std::vector<std::size_t> places_taken() const;
    [[nodiscard]] std::size_t run_after(const std::string& id, const StagePlace& at) const;
    [[nodiscard]] Result<std::vector<std::string>> erase(const std::string& id);
    [[nodiscard]] Result<void> erase_words(const std::string& id);
    [[nodiscard]] Result<std::string> sealed_list() const;
    [[nodiscard]] std::filesystem::path key_file() const { return key_.empty() ? path_ / kKeyFile : key_; }

    static constexpr const char* kKeyFile = "allocation.key";
    std::filesystem::path path_, key_;
    Protocol protocol_;
    std::string protocol_text_;
    StudyFacts facts_;
    Journal journal_;
    std::string sealed_;  // the sealed list, once somebody was enrolled
    int lock_ = -1;
};

}  // namespace burin::study
