// SPDX-License-Identifier: MIT
#include "record/record_reader.hpp"
#include "base/try.hpp"
#include "record/row_walk.hpp"
#include "record/store_file.hpp"
#include "record/store_reading.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

namespace burin::record {
namespace {

// SQLite's steps for a statement: the list of kMostBlocks blocks takes some 20 a block.
constexpr std::int64_t kMostSteps = 200'000'000;
constexpr const char* kRemedy = "name a file that --record has written";

bool fits_u32(std::int64_t value) { return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max(); }

}  // namespace

std::uint64_t HandRecord::rows() const {
    std::uint64_t sum = 0;
    for (const BlockPlace& place : blocks) sum += place.header.rows;
    return sum;
}

std::vector<ColumnType> HandRecord::types() const {
    std::vector<ColumnType> types;
    for (const Column& column : columns) types.push_back(column.type);
    return types;
}

std::size_t find_column(const HandRecord& table, std::string_view name, ColumnType type) {
    const auto at =
        std::ranges::find_if(table.columns, [&](const Column& c) { return c.name == name && c.type == type; });
    return static_cast<std::size_t>(at - table.columns.begin());
}

Result<RecordReader> RecordReader::open(const std::string& path) {
    BURIN_TRY_DO(check_regular(path, "is empty: its recording ended before it began, or it is none", kRemedy));
    take_back_what_was_interrupted(path);
    RecordReader reader;
    reader.path_ = path;
    BURIN_TRY(opened, Database::open(path, Database::Use::read));
    reader.database_.emplace(std::move(opened));
    reader.database_->limit_steps(kMostSteps);
    for (const auto step :
         {&RecordReader::check_marks, &RecordReader::check_tables, &RecordReader::read_facts, &RecordReader::read_hands,
          &RecordReader::read_places, &RecordReader::read_derived, &RecordReader::read_objects})
        BURIN_TRY_DO((reader.*step)());
    return reader;
}

Result<void> RecordReader::check_marks() {
    BURIN_TRY_DO(database_->run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0"));
    return burin::record::check_marks(*database_, path_, kRecordingKind);
}

Result<void> RecordReader::check_tables() {
    return burin::record::check_tables(
        *database_, path_, {"meta", "hand", "column", "block", "line", "trial", "event", "clock", "derived"}, kRemedy);
}

Result<void> RecordReader::read_facts() {
    BURIN_TRY(facts, burin::record::read_facts(*database_));
    facts_ = std::move(facts);
    return {};
}

Result<void> RecordReader::read_hands() {
    BURIN_TRY(read, database_->prepare("SELECT hand, name FROM hand ORDER BY hand"));
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) {
        HandRecord hand;
        hand.number = static_cast<std::uint32_t>(read.integer(0));
        hand.name = read.text(1);
        if (!fits_u32(read.integer(0)) || hands_.size() >= kMostHands || hand.name.size() > 1000)
            return fail(path_, "has hands that no recording has", kRemedy);
        hands_.push_back(std::move(hand));
    }
    if (!row) return std::unexpected(row.error());
    for (HandRecord& hand : hands_) BURIN_TRY_DO(read_columns(hand));
    return {};
}

Result<void> RecordReader::read_columns(HandRecord& hand) {
    BURIN_TRY(read, database_->prepare(
                        "SELECT position, name, unit, frame, type FROM column WHERE hand = ? ORDER BY position"));
    read.bind(1, std::int64_t{hand.number});
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) {
        const auto type = column_type_named(read.text(4));
        Column column{read.text(1), read.text(2), read.text(3), type.value_or(ColumnType::f64)};
        if (read.integer(0) != static_cast<std::int64_t>(hand.columns.size()) || hand.columns.size() >= kMostColumns)
            return fail(path_, "column " + std::to_string(hand.columns.size()) + " of " + hand.name + " is missing",
                        kRemedy);
        if (!type || column.name.empty() || column.name.size() + column.unit.size() + column.frame.size() > 1000)
            return fail(path_,
                        "column " + std::to_string(hand.columns.size()) + " of " + hand.name +
                            " has a type or a name that this program does not know",
                        kRemedy);
        hand.columns.push_back(std::move(column));
    }
    if (!row) return std::unexpected(row.error());
    if (hand.columns.empty()) return fail(path_, "has no columns for " + hand.name, kRemedy);
    return {};
}

Result<void> RecordReader::read_places() {
    BURIN_TRY(read, database_->prepare("SELECT id, hand, tick0, rows, t0_ns FROM block ORDER BY id LIMIT " +
                                       std::to_string(kMostBlocks + 1)));
    std::size_t blocks = 0;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) {
        if (++blocks > kMostBlocks) return fail(path_, "has more blocks than a month of ticks", kRemedy);
        const std::int64_t number = read.integer(1), rows = read.integer(3);
        const auto hand = std::ranges::find_if(hands_, [&](const HandRecord& h) { return h.number == number; });
        if (hand == hands_.end())
            return fail(path_, "has a block of hand " + std::to_string(number) + ", which it does not name", kRemedy);
        // A number of rows that no block has stays there as one that is refused when the block is read.
        const auto kept_rows = rows < 0 || rows > kMostBlockRows ? 0 : static_cast<std::uint32_t>(rows);
        hand->blocks.push_back({read.integer(0), {hand->number, read.integer(2), kept_rows, read.integer(4)}});
    }
    if (!row) return std::unexpected(row.error());
    return {};
}

// A table's name and the program that made it are in its blocks; the first one lists the columns.
Result<void> RecordReader::read_derived() {
    BURIN_TRY(read, database_->prepare("SELECT id, name, program, columns, hand, tick0, rows, t0_ns FROM derived ORDER "
                                       "BY name, program, id LIMIT " +
                                       std::to_string(kMostBlocks + 1)));
    std::size_t blocks = 0;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) {
        const std::string name = read.text(1), program = read.text(2);
        if (derived_.empty() || derived_.back().name != name || derived_.back().program != program) {
            Result<std::vector<Column>> columns = columns_in(read.text(3));
            if (!columns || name.size() + program.size() > 1000 || program.empty() || derived_.size() >= kMostDerived)
                return fail(path_, "has a derived table that this program does not know", kRemedy);
            derived_.push_back({0, name, program, std::move(*columns), {}, {}});
        }
        const std::int64_t number = read.integer(4), rows = read.integer(6);
        if (!fits_u32(number) || ++blocks > kMostBlocks)
            return fail(path_, "has a derived table of no hand, or a month of ticks", kRemedy);
        HandRecord& table = derived_.back();
        table.number = static_cast<std::uint32_t>(number);
        const auto kept_rows = rows < 0 || rows > kMostBlockRows ? 0 : static_cast<std::uint32_t>(rows);
        table.blocks.push_back({read.integer(0), {table.number, read.integer(5), kept_rows, read.integer(7)}});
    }
    if (!row) return std::unexpected(row.error());
    return {};
}

// Recordings from before there were names of objects have no table of them.
Result<void> RecordReader::read_objects() {
    BURIN_TRY(there, database_->has_table("object"));
    if (!there) return {};
    BURIN_TRY(read, database_->prepare("SELECT part, number, name FROM object WHERE length(part) + length(name) <= " +
                                       std::to_string(kMostTextBytes) + " ORDER BY part, number LIMIT " +
                                       std::to_string(kMostObjects)));
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) {
        const std::string part = read.text(0);
        const RecordedObject object{read.integer(1), read.text(2)};
        for (HandRecord& hand : hands_)
            if (part.empty()) hand.objects.push_back(object);
        for (HandRecord& table : derived_)
            if (table.name == part) table.objects.push_back(object);
    }
    if (!row) return std::unexpected(row.error());
    return {};
}

std::string RecordReader::name_of_block(std::size_t table, std::size_t number) const {
    const HandRecord& of = this->table(table);
    return path_ + ": block " + std::to_string(number + 1) + " of " + of.name + ", from tick " +
           std::to_string(of.blocks[number].header.tick0);
}

Result<Block> RecordReader::block(std::size_t table, std::size_t number) {
    const HandRecord& of = this->table(table);
    const std::string where = name_of_block(table, number);
    Result<Statement> read = database_->prepare(of.is_derived() ? "SELECT crc, data FROM derived WHERE id = ?"
                                                                : "SELECT crc, data FROM block WHERE id = ?");
    if (!read) return std::unexpected(read.error());
    read->bind(1, of.blocks[number].id);
    const Result<bool> row = read->step();
    if (!row) return std::unexpected(Error{row.error().what, where, row.error().remedy});
    if (!*row) return fail(where, "is gone", "read the file when no other program writes it");
    if (!fits_u32(read->integer(0))) return fail(where, "its check sum is wrong", "the other blocks can still be read");
    const std::span<const std::byte> data = read->blob(1);
    const PackedBlock packed{of.blocks[number].header, static_cast<std::uint32_t>(read->integer(0)),
                             std::vector<std::byte>(data.begin(), data.end())};
    return unpack(packed, of.types(), where);
}

Result<std::vector<TrialRecord>> RecordReader::trials() {
    BURIN_TRY(read,
              database_->prepare("SELECT id, name, state, begun_ns, ended_ns FROM trial ORDER BY id LIMIT 100000"));
    std::vector<TrialRecord> trials;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step())
        trials.push_back({read.integer(0), read.text(1), read.text(2), read.integer(3), read.integer(4)});
    if (!row) return std::unexpected(row.error());
    return trials;
}

Result<std::vector<EventRecord>> RecordReader::events() {
    BURIN_TRY(read, database_->prepare("SELECT time_ns, name, value FROM event ORDER BY id LIMIT 100000"));
    std::vector<EventRecord> events;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) events.push_back({read.integer(0), read.text(1), read.text(2)});
    if (!row) return std::unexpected(row.error());
    return events;
}

Result<std::vector<ClockPair>> RecordReader::clocks() {
    BURIN_TRY(read,
              database_->prepare("SELECT mono_ns, utc_ns FROM clock ORDER BY id LIMIT " + std::to_string(kMostBlocks)));
    std::vector<ClockPair> clocks;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) clocks.push_back({read.integer(0), read.integer(1)});
    if (!row) return std::unexpected(row.error());
    return clocks;
}

Result<std::uint64_t> RecordReader::lines() {
    BURIN_TRY(count, database_->integer("SELECT count(*) FROM line"));
    return static_cast<std::uint64_t>(count);
}

Result<void> RecordReader::each_line(const std::function<void(std::int64_t, const std::string&)>& take) {
    BURIN_TRY(read, database_->prepare("SELECT time_ns, text FROM line ORDER BY id"));
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) take(read.integer(0), read.text(1));
    if (!row) return std::unexpected(row.error());
    return {};
}

Result<ChainExamination> RecordReader::examine_chain() { return record::examine_chain(*database_); }

Result<std::string> RecordReader::last_digest() { return record::last_digest(*database_); }

Result<std::string> RecordReader::structure_fault() {
    BURIN_TRY(found, database_->text("PRAGMA quick_check(1)"));
    return found == "ok" ? std::string() : found;
}

}  // namespace burin::record
