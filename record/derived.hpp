// SPDX-License-Identifier: MIT
// Adds a table that was computed from the ticks to the session file itself: all of it or nothing.
//
// Rows wait, packed as blocks, in a temporary file until the end, so that the recording can be read meanwhile; one
// transaction then brings them in. What was recorded is not touched. A table is named by what it was computed with and
// by the program; one that exists is never replaced.
// One thread. Memory: one block, and 40 bytes for each. Failures name the file and the remedy.
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "record/record_reader.hpp"

namespace burin::record {

struct DerivedTable {
    std::string name, program;
    std::uint32_t hand = 0;  // whose ticks it was computed from
    std::vector<Column> columns;
    std::vector<RecordedObject> objects;
    std::string settings;  // kept in table meta under "derived NAME", for whoever wants to know how it was computed
};

class DerivedWriter {
public:
    [[nodiscard]] static Result<DerivedWriter> create(DerivedTable table);

    // Appends a row, one word a column.
    [[nodiscard]] Result<void> add(std::int64_t tick, Nanoseconds time_ns, std::span<const Word> row);
    // Brings all rows into the session file. Fails where it has the table already, and changes nothing then.
    [[nodiscard]] Result<void> finish(const std::string& path);
    [[nodiscard]] std::uint64_t rows() const { return rows_; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    struct Waiting {
        BlockHeader header;
        std::uint32_t crc = 0;
        std::size_t bytes = 0;
    };
    explicit DerivedWriter(DerivedTable table);
    [[nodiscard]] Result<void> seal();
    [[nodiscard]] Result<void> insert_all(Database& database);

    DerivedTable table_;
    std::unique_ptr<std::FILE, Close> spool_;
    std::vector<Waiting> waiting_;
    Block block_;
    BlockHeader header_;
    std::uint64_t rows_ = 0;
};

}  // namespace burin::record
