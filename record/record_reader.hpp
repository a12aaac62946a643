// SPDX-License-Identifier: MIT
// Reads a session file, block by block, whatever is in it.
//
// The file is never changed, but where a program was killed: SQLite brings the log of a recording (FILE-wal) in when it
// can, and takes a derived table that was half there (FILE-journal) back.
// Bad input: not SQLite, another program's, a newer version, a truncated or damaged file, tables that are views, huge
// claims, columns that are missing or unknown: an Error, with the remedy. A block is checked when it is read, so the
// others are there although one is damaged. Memory: the list of blocks (32 bytes each, at most kMostBlocks) and one
// block (at most kMostBlockBytes and its compressed data). A statement that takes too long is interrupted.
// Threads: one at a time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "record/block.hpp"
#include "record/chain.hpp"
#include "record/database.hpp"

namespace burin::record {

inline constexpr std::size_t kMostBlocks = 4'000'000;  // a month of one hand
inline constexpr std::size_t kMostHands = 64;
inline constexpr std::size_t kMostDerived = 1000, kMostObjects = 100'000;

struct BlockPlace {
    std::int64_t id = 0;  // in table block
    BlockHeader header;
};

// An object that can be touched, by the number that a column "object..." holds.
struct RecordedObject {
    std::int64_t number = 0;
    std::string name;

    bool operator==(const RecordedObject&) const = default;
};

// The ticks of a hand, or a table that was derived from them (derived.hpp).
struct HandRecord {
    std::uint32_t number = 0;
    std::string name;     // of the device; of a derived table: of what it was computed with
    std::string program;  // that computed a derived table; empty: recorded
    std::vector<Column> columns;
    std::vector<RecordedObject> objects;
    std::vector<BlockPlace> blocks;  // in the order of their ticks

    [[nodiscard]] bool is_derived() const { return !program.empty(); }

    [[nodiscard]] std::uint64_t rows() const;  // as the blocks say
    [[nodiscard]] std::vector<ColumnType> types() const;
};

struct TrialRecord {
    std::int64_t id = 0;
    std::string name, state;
    std::int64_t begun_ns = 0, ended_ns = 0;  // ended 0: still open when the recording ended
};

struct EventRecord {
    std::int64_t time_ns = 0;
    std::string name, value;
};

struct ClockPair {
    std::int64_t mono_ns = 0, utc_ns = 0;
};

class RecordReader {
public:
    [[nodiscard]] static Result<RecordReader> open(const std::string& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::map<std::string, std::string>& facts() const { return facts_; }
    // Returns what a recording says of itself under this key; empty where it says nothing.
    [[nodiscard]] std::string fact(const std::string& key) const {
        const auto at = facts_.find(key);
        return at == facts_.end() ? std::string() : at->second;
    }
    [[nodiscard]] const std::vector<HandRecord>& hands() const { return hands_; }
    // Tables that were computed from the ticks later.
    [[nodiscard]] const std::vector<HandRecord>& derived() const { return derived_; }
    // All of them: first the hands, then what is derived. `table` is below tables().
    [[nodiscard]] std::size_t tables() const { return hands_.size() + derived_.size(); }
    [[nodiscard]] const HandRecord& table(std::size_t table) const {
        return table < hands_.size() ? hands_[table] : derived_[table - hands_.size()];
    }
    // Whether the recording was closed; else it was killed, or is still going on in a copy.
    [[nodiscard]] bool is_closed() const { return facts_.contains("end"); }

    // Reads, checks and unpacks a block of a table.
    [[nodiscard]] Result<Block> block(std::size_t table, std::size_t number);
    // Names a block in messages: "FILE: block 3 of omni, from tick 3001".
    [[nodiscard]] std::string name_of_block(std::size_t table, std::size_t number) const;

    [[nodiscard]] Result<std::vector<TrialRecord>> trials();
    [[nodiscard]] Result<std::vector<EventRecord>> events();
    [[nodiscard]] Result<std::vector<ClockPair>> clocks();
    [[nodiscard]] Result<std::uint64_t> lines();  // how many there are
    // Calls for each line in order, one in memory at a time.
    [[nodiscard]] Result<void> each_line(const std::function<void(std::int64_t time_ns, const std::string&)>& take);
    // Compares the file with its chain of digests (chain.hpp). Reads the whole file.
    [[nodiscard]] Result<ChainExamination> examine_chain();
    // Returns the digest of the last transaction as the file states it; empty: it has none.
    [[nodiscard]] Result<std::string> last_digest();
    // Has SQLite check its own structure: empty, or what is wrong. Reads the whole file.
    [[nodiscard]] Result<std::string> structure_fault();

private:
    [[nodiscard]] Result<void> check_marks();
    [[nodiscard]] Result<void> check_tables();
    [[nodiscard]] Result<void> read_facts();
    [[nodiscard]] Result<void> read_hands();
    [[nodiscard]] Result<void> read_columns(HandRecord& hand);
    [[nodiscard]] Result<void> read_places();
    [[nodiscard]] Result<void> read_derived();
    [[nodiscard]] Result<void> read_objects();

    std::string path_;
    std::optional<Database> database_;
    std::map<std::string, std::string> facts_;
    std::vector<HandRecord> hands_, derived_;
};

}  // namespace burin::record
