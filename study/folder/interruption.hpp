// SPDX-License-Identifier: MIT
// Stages that were begun and never ended, such as by a power cut: until when each is known, and whether its participant
// may go on there by the protocol's resume_within_min. Reads the recordings; one thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/folder/study_folder.hpp"

namespace burin::study {

struct Interruption {
    std::string participant;
    StageVisit visit;
    std::uint64_t ticks_kept = 0;   // of the motion, as far as the recording can be read
    std::optional<Error> unreadable = {};  // why it cannot, where it should
    std::int64_t known_utc_ns = 0;  // of the last transaction of its recording, else of its beginning in the journal
    bool done_again = false;        // the stage was ended by a later run

    // "test (day 1, stage 3) of p01, known until TIME; 5000 ticks of its motion are kept; to be done again"
    [[nodiscard]] std::string text() const;
};

// In the order of participants and stages; those of withdrawn participants are left out.
[[nodiscard]] std::vector<Interruption> interruptions_of(const StudyFolder& study);

// A stage that a participant is still to do and that was interrupted longer ago than resume_within_min.
struct LateResumption {
    Interruption interruption;
    double minutes = 0.0;  // since it was known to go on

    [[nodiscard]] std::string text(const Protocol& protocol) const;  // for the journal and the report
};
// Returns nothing where this participant may go on by the protocol, whatever became of the others.
[[nodiscard]] std::optional<LateResumption> late_resumption(const StudyFolder& study, const Participant& person,
                                                            std::int64_t now_utc_ns);
// Fails where there is one, with the remedy.
[[nodiscard]] Result<void> check_resumption(const StudyFolder& study, const Participant& person,
                                            std::int64_t now_utc_ns);

// "2026-11-25T10:00:00.123Z" of nanoseconds since 1970, and back, also without a fraction; 0 for what is no such text.
[[nodiscard]] std::string utc_text(std::int64_t utc_ns);
[[nodiscard]] std::int64_t utc_of(const std::string& text);
[[nodiscard]] std::int64_t now_utc_ns();

// Whether a day may begin so many hours after the last stage of the day before.
enum class DayVerdict { in_time, too_early, too_late };
[[nodiscard]] DayVerdict day_verdict(const Protocol& protocol, std::size_t day, double hours_since);

}  // namespace burin::study
