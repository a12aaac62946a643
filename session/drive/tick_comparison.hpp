// SPDX-License-Identifier: MIT
// Compares the ticks of a replayed session with those in its session file: every column, bit for bit. One thread.
#pragma once

#include "record/compare.hpp"
#include "record/motion.hpp"
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

    [[nodiscard]] std::optional<Known> known(std::uint64_t tick) override;
    [[nodiscard]] Result<void> take(const haptics::TickRecord& again) override;

    // What was compared so far, up to the first difference.
    [[nodiscard]] const record::Comparison& found() const { return found_; }
    // Ticks that were computed again and are not in the file: lost, or not acknowledged before a kill.
    [[nodiscard]] std::uint64_t unrecorded() const { return unrecorded_; }
    // Ticks of the file that were computed again, whether or not they were in the range.
    [[nodiscard]] std::uint64_t repeated() const { return repeated_; }

private:
    TickComparison(record::RecordReader& reader, const record::TickRange& range, const record::RowShape& shape,
                   record::MotionColumns motion, std::size_t tick_column)
        : reader_(&reader),
          range_(range),
          shape_(shape),
          motion_(std::move(motion)),
          walk_(reader, 0),
          tick_column_(tick_column) {
        found_.columns = reader.table(0).columns.size();
    }
    // Goes to the row of a tick; false where there is none.
    [[nodiscard]] Result<bool> go_to(std::uint64_t tick);

    record::RecordReader* reader_;
    record::TickRange range_;
    record::RowShape shape_;
    record::MotionColumns motion_;
    record::RowWalk walk_;
    std::size_t tick_column_;
    bool begun_ = false, over_ = false;
    std::optional<Error> damaged_;  // a block that cannot be read: there is no row to look at from then on
    std::uint64_t unrecorded_ = 0, repeated_ = 0;
    record::Comparison found_;
    AtDifference then_ = AtDifference::ends;
};

}  // namespace burin::session
