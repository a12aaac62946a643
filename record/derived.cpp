// SPDX-License-Identifier: MIT
#include "record/derived.hpp"

#include "base/try.hpp"

#include <utility>

namespace burin::record {
namespace {

constexpr std::uint32_t kDerivedRows = 1000;  // of a block

constexpr const char* kObjectTable =
    "CREATE TABLE IF NOT EXISTS object(part TEXT NOT NULL, number INTEGER NOT NULL, name TEXT NOT NULL, "
    "PRIMARY KEY(part, number)) WITHOUT ROWID";

std::unexpected<Error> no_spool() {
    return fail("temporary file", "cannot be written", "free some space where TMPDIR is, /tmp by default");
}

std::vector<ColumnType> types_in(const std::vector<Column>& columns) {
    std::vector<ColumnType> types;
    for (const Column& column : columns) types.push_back(column.type);
    return types;
}

}  // namespace

DerivedWriter::DerivedWriter(DerivedTable table) : table_(std::move(table)), block_(types_in(table_.columns)) {}

Result<DerivedWriter> DerivedWriter::create(DerivedTable table) {
    DerivedWriter writer(std::move(table));
    writer.spool_.reset(std::tmpfile());
    if (!writer.spool_) return no_spool();
    return writer;
}

Result<void> DerivedWriter::add(std::int64_t tick, Nanoseconds time_ns, std::span<const Word> row) {
    if (block_.rows() == 0) header_ = {table_.hand, tick, 0, time_ns};
    block_.add(row);
    ++rows_;
    return block_.rows() < kDerivedRows ? Result<void>() : seal();
}

Result<void> DerivedWriter::seal() {
    if (block_.rows() == 0) return {};
    const Result<PackedBlock> packed = pack(block_, header_);
    block_.clear();
    if (!packed) return std::unexpected(packed.error());
    if (std::fwrite(packed->data.data(), 1, packed->data.size(), spool_.get()) != packed->data.size())
        return no_spool();
    waiting_.push_back({packed->header, packed->crc, packed->data.size()});
    return {};
}

Result<void> DerivedWriter::finish(const std::string& path) {
    BURIN_TRY_DO(seal());
    if (std::fflush(spool_.get()) != 0) return no_spool();
    std::rewind(spool_.get());
    BURIN_TRY(database, Database::open(path, Database::Use::write));
    // A killed recording is added to while it is read, by readers who do not tell what they read (private_index.hpp):
    // its log is brought into the file once nobody has it open any more.
    BURIN_TRY_DO(database.run("PRAGMA wal_autocheckpoint = 0; PRAGMA synchronous = FULL"));
    BURIN_TRY_DO(database.run("BEGIN IMMEDIATE"));
    if (const auto done = insert_all(database); !done) {
        if (database.in_transaction()) static_cast<void>(database.run("ROLLBACK"));
        return done;
    }
    if (const auto done = database.run("COMMIT"); !done) {
        if (database.in_transaction()) static_cast<void>(database.run("ROLLBACK"));
        return done;
    }
    return database.close();
}

Result<void> DerivedWriter::insert_all(Database& database) {
    BURIN_TRY_DO(database.run(kObjectTable));
    {
        BURIN_TRY(find, database.prepare("SELECT count(*) FROM derived WHERE name = ? AND program = ?"));
        find.bind(1, std::string_view(table_.name));
        find.bind(2, std::string_view(table_.program));
        BURIN_TRY(row, find.step());
        if (row && find.integer(0) > 0)
            return fail("derived table " + table_.name, "exists, and is not written over",
                        "read the one that is there");
    }
    Result<Statement> insert = database.prepare(
        "INSERT INTO derived(name, program, columns, hand, tick0, rows, t0_ns, crc, data) VALUES(?, ?, ?, ?, ?, ?, ?, "
        "?, ?)");
    Result<Statement> object = database.prepare("INSERT OR REPLACE INTO object VALUES(?, ?, ?)");
    Result<Statement> fact = database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)");
    for (const auto* statement : {&insert, &object, &fact})
        if (!*statement) return std::unexpected(statement->error());
    const std::string columns = text_of(table_.columns), key = "derived " + table_.name;
    std::vector<std::byte> data;
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
        const Waiting& waiting = waiting_[i];
        data.resize(waiting.bytes);
        if (std::fread(data.data(), 1, data.size(), spool_.get()) != data.size()) return no_spool();
        insert->bind(1, std::string_view(table_.name));
        insert->bind(2, std::string_view(table_.program));
        insert->bind(3, i == 0 ? std::string_view(columns) : std::string_view(""));
        insert->bind(4, std::int64_t{waiting.header.hand});
        insert->bind(5, waiting.header.tick0);
        insert->bind(6, std::int64_t{waiting.header.rows});
        insert->bind(7, waiting.header.t0_ns);
        insert->bind(8, std::int64_t{waiting.crc});
        insert->bind(9, std::span<const std::byte>(data));
        BURIN_TRY_DO(insert->run());
    }
    for (const RecordedObject& each : table_.objects) {
        object->bind(1, std::string_view(table_.name));
        object->bind(2, each.number);
        object->bind(3, std::string_view(each.name));
        BURIN_TRY_DO(object->run());
    }
    fact->bind(1, std::string_view(key));
    fact->bind(2, std::string_view(table_.settings));
    return fact->run();
}

}  // namespace burin::record
