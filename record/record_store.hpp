// SPDX-License-Identifier: MIT
// What the writer's thread works on: the file, the block that each hand's ticks go into, and what waits for the
// next transaction. One thread at a time; record_writer.hpp says what it promises.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "haptics/histogram.hpp"
#include "record/block.hpp"
#include "record/chain.hpp"
#include "record/record_writer.hpp"
#include "record/store_file.hpp"

namespace burin::record {

struct StoreNote {
    enum class Kind : std::uint8_t { line, event, trial_begin, trial_end };
    Kind kind = Kind::line;
    Nanoseconds time_ns = 0;
    std::string text{};   // the line, the event's or the trial's name, or how the trial ended
    std::string value{};  // of an event
    std::optional<std::int64_t> trial{};

    [[nodiscard]] std::size_t bytes() const { return sizeof(StoreNote) + text.size() + value.size(); }
};

class RecordStore {
public:
    RecordStore(std::string path, std::vector<RecordedHand> hands, WriterOptions options);
    RecordStore(const RecordStore&) = delete;
    RecordStore& operator=(const RecordStore&) = delete;

    // Makes file and tables. A failure leaves no file behind.
    [[nodiscard]] Result<void> make();
    void add(StoreNote note);
    // Takes what the rings hold, and seals the blocks that are full.
    void take_ticks();
    // Brings what waits to the disk, where a block is full, the time has come, or this is the last turn.
    void commit_what_is_due(bool last);
    // Notes how the recording ended, and makes the file one that travels alone.
    void end(std::uint64_t notes_lost, const std::vector<std::pair<std::string, std::string>>& facts);

    [[nodiscard]] std::uint64_t acknowledged(std::size_t hand) const { return parts_[hand].acknowledged; }
    [[nodiscard]] std::uint64_t transactions() const { return transactions_; }
    [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
    [[nodiscard]] const haptics::Histogram& transaction_duration() const { return transaction_duration_; }

private:
    struct Part {
        RecordedHand hand;
        RowShape shape;
        std::vector<Column> columns;
        Block block;  // being filled
        BlockHeader header{};
        std::uint64_t last_tick = 0;     // in the block or sealed
        std::uint64_t acknowledged = 0;  // on the disk
        std::uint64_t sealed_tick = 0;   // the last tick of the sealed blocks
        std::uint64_t lost = 0;          // taken from the ring and not kept
        Nanoseconds period_ns = 0;
        std::uint64_t never_run = 0;  // ticks that were due and that the loop skipped
    };

    [[nodiscard]] Result<void> fill_tables();
    [[nodiscard]] Result<void> fill_columns();
    [[nodiscard]] Result<void> put_fact(const std::string& key, const std::string& value);
    [[nodiscard]] Result<void> add_link();
    void linked();
    [[nodiscard]] Result<void> commit_with_link();
    void take(std::size_t index, const haptics::TickRecord& record);
    void seal(std::size_t index);
    [[nodiscard]] Result<void> commit();
    [[nodiscard]] Result<void> insert_all();
    [[nodiscard]] Result<void> insert_note(const StoreNote& note);
    [[nodiscard]] Result<void> insert_clock();
    [[nodiscard]] Result<void> check_place();
    [[nodiscard]] Result<void> write_facts_of_end(std::uint64_t notes_lost,
                                                  const std::vector<std::pair<std::string, std::string>>& facts);
    void give_up(Error why);
    void save_elsewhere(Error& why);
    [[nodiscard]] std::size_t waiting_bytes() const { return sealed_bytes_ + note_bytes_; }
    [[nodiscard]] std::string progress() const;

    std::string path_;
    WriterOptions options_;
    std::vector<Part> parts_;
    std::optional<StoreFile> file_;
    Database* database_ = nullptr;  // the file's
    std::deque<PackedBlock> sealed_;
    std::vector<StoreNote> notes_;
    ChainWriter chain_;
    std::vector<std::string> new_facts_;  // keys of those that no link covers yet
    std::size_t sealed_bytes_ = 0, note_bytes_ = 0;
    std::uint64_t transactions_ = 0;
    Nanoseconds committed_ns_ = 0;           // when the last transaction ended, or was tried
    std::optional<Nanoseconds> refused_ns_;  // since when the disk has refused
    std::optional<Error> failure_;
    haptics::Histogram transaction_duration_;
    MonotonicClock clock_;
};

}  // namespace burin::record
