// SPDX-License-Identifier: MIT
// Compares the ticks of a replayed session with those in its session file: every column, bit for bit. One thread.
#pragma once

#include <span>
#include <vector>

#include "record/compare.hpp"
#include "record/motion.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/drive/tick_witness.hpp"

namespace burin::session {

class TickComparison final : public TickWitness {
public:
    // What follows on the first difference: the replay ends there, or goes on.
    enum class AtDifference { ends, goes_on };
    // Fails on a file without ticks, or whose columns are not those of this program's recordings. The reader must
    // outlive it.
    [[nodiscard]] static Result<TickComparison> create(record::RecordReader& reader, const record::TickRange& range,
                                                       AtDifference then = AtDifference::ends);

    [[nodiscard]] std::optional<Known> known(std::size_t part, std::uint64_t tick) override;
    [[nodiscard]] Result<void> take(std::size_t part, const haptics::TickRecord& again) override;

    // What was compared so far, up to the first difference: ticks and columns of all parts.
    [[nodiscard]] const record::Comparison& found() const { return found_; }
    // Ticks that were computed again and are not in the file: lost, or not acknowledged before a kill.
    [[nodiscard]] std::uint64_t unrecorded() const { return unrecorded_; }
    // Ticks of the file that were computed again, whether or not they were in the range.
    [[nodiscard]] std::uint64_t repeated() const { return repeated_; }

private:
    // The table of a part of the hands.
    struct Part {
        record::RowShape shape;
        record::MotionColumns motion;
        record::RowWalk walk;
        std::size_t tick_column = 0;
        bool begun = false, over = false;
        std::optional<Error> damaged = {};  // a block that cannot be read: no row is looked at from then on
    };
    TickComparison(record::RecordReader& reader, const record::TickRange& range, AtDifference then)
        : reader_(&reader), range_(range), then_(then) {}
    [[nodiscard]] Result<void> add_part(std::size_t table);
    // Goes to the row of a tick; false where there is none.
    [[nodiscard]] static Result<bool> go_to(Part& part, std::uint64_t tick);

    record::RecordReader* reader_;
    record::TickRange range_;
    std::vector<Part> parts_;
    std::uint64_t unrecorded_ = 0, repeated_ = 0;
    record::Comparison found_;
    AtDifference then_;
};

// Compares the trials of a session that was done again with the rows that the recording has of them. Fails with the
// first that differs: by name, beginning, end, or how it ended. whole: its log and its rows go to the same end; else
// what both have is compared.
[[nodiscard]] Result<void> compare_trials(record::RecordReader& reader, std::span<const TrialMark> again, bool whole);

// Likewise of its events, where the recording has kept them (kEventsFact).
[[nodiscard]] Result<void> compare_events(record::RecordReader& reader, std::span<const EventMark> again, bool whole);

// Fails where something in the file was changed, put in or taken out since it was recorded, which a replay need not
// come across: by the first place that its chain of digests names (record/chain.hpp).
[[nodiscard]] Result<void> check_unchanged(record::RecordReader& reader);

}  // namespace burin::session
