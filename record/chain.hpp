// SPDX-License-Identifier: MIT
// The chain of digests in a session file: what was taken out, put in or changed afterwards shows, and where.
//
// A link a transaction, in table chain. Its digest is the SHA-256 of the digest before and of every row that the
// transaction wrote: blocks of ticks, lines, events, trials, times of the clocks. The first link covers the names as
// well: facts, hands, columns, objects; the last one the facts of the end. Rows are written out as their values with
// types and lengths, so that no two contents are hashed alike. Tables that were derived later (derived.hpp) are not
// covered: they can be computed again.
//
// Limits: whoever writes the file can write a new chain. Against that, and against transactions cut off the end
// together with their links, stands only the last digest, kept elsewhere; `burin session info` prints it, and a study's
// journal holds the SHA-256 of its files.
//
// Cost: a hash of some 100 kB a second of one hand, on the writer's thread. One thread at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "record/database.hpp"

namespace burin::record {

// The table, as one of store_tables().
[[nodiscard]] const char* chain_table();

struct ChainLink {
    std::int64_t id = 0;  // from 1
    // The last row of each table that this link or one before it covers.
    std::int64_t block = 0, line = 0, event = 0, trial = 0, clock = 0;
    std::string ended;   // numbers of the trials that ended in it, a line each
    std::string facts;   // keys of the facts that it covers, a line each
    std::string digest;  // 64 hexadecimal digits
};

// Adds links, each within the transaction whose rows it covers.
class ChainWriter {
public:
    // Adds the link that covers what was written since the one before, these facts and the ends of these trials. Call
    // added() once the transaction is on the disk: until then the same link is added again.
    [[nodiscard]] Result<void> add(Database& database, const std::vector<std::string>& facts,
                                   const std::vector<std::int64_t>& ended_trials);
    void added() { last_ = next_; }

private:
    ChainLink last_, next_;
};

struct ChainExamination {
    bool is_there = false;  // false: the file was written by a version without it
    std::int64_t links = 0;
    std::string last_digest;
    std::vector<std::string> faults;  // in words, each with the place
};
// Reads and hashes the whole file.
[[nodiscard]] Result<ChainExamination> examine_chain(Database& database);

// Returns the digest of the last link without checking anything; empty: there is none.
[[nodiscard]] Result<std::string> last_digest(Database& database);

}  // namespace burin::record
