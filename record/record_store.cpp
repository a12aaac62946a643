// SPDX-License-Identifier: MIT
#include "record/record_store.hpp"

#include "base/try.hpp"
#include "haptics/tick_record.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace burin::record {
namespace {

namespace fs = std::filesystem;

std::int64_t utc_ns() {
    timespec t{};
    clock_gettime(CLOCK_REALTIME, &t);
    return static_cast<std::int64_t>(t.tv_sec) * kNanosecondsPerSecond + t.tv_nsec;
}

std::vector<ColumnType> types_of(const std::vector<Column>& columns) {
    std::vector<ColumnType> types;
    for (const Column& column : columns) types.push_back(column.type);
    return types;
}

}  // namespace

Result<void> check_new_place(const std::string& path) {
    if (path.empty()) return {};
    struct stat there{};
    if (::lstat(path.c_str(), &there) == 0) return cannot_make(path, EEXIST, kRecordingKind);
    if (errno != ENOENT) return cannot_make(path, errno, kRecordingKind);
    const fs::path folder = fs::path(path).parent_path();
    if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0)
        return cannot_make(path, errno, kRecordingKind);
    return check_no_log_of(path);
}

RecordStore::RecordStore(std::string path, std::vector<RecordedHand> hands, WriterOptions options)
    : path_(std::move(path)), options_(std::move(options)) {
    for (RecordedHand& hand : hands) {
        Part part;
        part.shape = shape_of(hand.device, hand.probe);
        part.columns = columns_for(part.shape);
        part.columns.insert(part.columns.end(), hand.more_columns.begin(), hand.more_columns.end());
        part.block = Block(types_of(part.columns));
        part.period_ns = nanoseconds(1.0 / hand.device.rate_Hz);
        part.hand = std::move(hand);
        parts_.push_back(std::move(part));
    }
}

// ---- The file

Result<void> RecordStore::make() {
    Result<StoreFile> made = StoreFile::make(
        path_, kRecordingKind,
        [this](Database& database) {
            database_ = &database;
            return fill_tables();
        },
        options_.vfs);
    if (!made) return std::unexpected(made.error());
    linked();
    file_.emplace(std::move(*made));
    database_ = &file_->database();
    committed_ns_ = clock_.now_ns();
    return {};
}

Result<void> RecordStore::fill_tables() {
    BURIN_TRY_DO(database_->run(std::string(store_tables()) + chain_table()));
    Result<Statement> object = database_->prepare("INSERT OR REPLACE INTO object VALUES('', ?, ?)");
    if (!object) return fail(path_, "its tables cannot be made", "choose another disk");
    for (const auto& [key, value] : options_.facts) BURIN_TRY_DO(put_fact(key, value));
    for (const auto& [number, name] : options_.objects) {
        object->bind(1, number);
        object->bind(2, std::string_view(name));
        BURIN_TRY_DO(object->run());
    }
    BURIN_TRY_DO(fill_columns());
    for (std::size_t h = 0; h < parts_.size(); ++h)
        BURIN_TRY_DO(put_fact(period_fact(h), std::to_string(parts_[h].period_ns)));
    BURIN_TRY_DO(insert_clock());
    return add_link();
}

// Adds the link of the chain to what the open transaction has written.
Result<void> RecordStore::add_link() {
    std::vector<std::int64_t> ended;
    for (const StoreNote& note : notes_)
        if (note.kind == StoreNote::Kind::trial_end && note.trial) ended.push_back(*note.trial);
    return chain_.add(*database_, new_facts_, ended);
}

// Takes note that the transaction with the link is on the disk.
void RecordStore::linked() {
    chain_.added();
    new_facts_.clear();
}

Result<void> RecordStore::commit_with_link() {
    BURIN_TRY_DO(add_link());
    BURIN_TRY_DO(database_->run("COMMIT"));
    linked();
    return {};
}

Result<void> RecordStore::put_fact(const std::string& key, const std::string& value) {
    BURIN_TRY(fact, database_->prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)"));
    fact.bind(1, std::string_view(key));
    fact.bind(2, std::string_view(value));
    BURIN_TRY_DO(fact.run());
    if (std::ranges::find(new_facts_, key) == new_facts_.end()) new_facts_.push_back(key);
    return {};
}

Result<void> RecordStore::fill_columns() {
    Result<Statement> hand = database_->prepare("INSERT INTO hand VALUES(?, ?)");
    Result<Statement> column = database_->prepare("INSERT INTO column VALUES(?, ?, ?, ?, ?, ?)");
    if (!hand || !column) return fail(path_, "its tables cannot be made", "choose another disk");
    for (std::size_t h = 0; h < parts_.size(); ++h) {
        const Part& part = parts_[h];
        hand->bind(1, static_cast<std::int64_t>(h));
        hand->bind(2, std::string_view(part.hand.name));
        BURIN_TRY_DO(hand->run());
        for (std::size_t c = 0; c < part.columns.size(); ++c) {
            column->bind(1, static_cast<std::int64_t>(h));
            column->bind(2, static_cast<std::int64_t>(c));
            column->bind(3, std::string_view(part.columns[c].name));
            column->bind(4, std::string_view(part.columns[c].unit));
            column->bind(5, std::string_view(part.columns[c].frame));
            column->bind(6, name_of(part.columns[c].type));
            BURIN_TRY_DO(column->run());
        }
    }
    return {};
}

// ---- Ticks and notes

void RecordStore::add(StoreNote note) {
    if (failure_) return;
    note_bytes_ += note.bytes();
    notes_.push_back(std::move(note));
}

void RecordStore::take_ticks() {
    for (std::size_t h = 0; h < parts_.size(); ++h) {
        Ring<haptics::TickRecord>& ring = *parts_[h].hand.ring;
        // Only what is there now: a ring that is filled as fast as it is emptied would hold the thread for ever.
        for (std::size_t left = ring.waiting(); left > 0; --left) {
            take(h, *ring.oldest());
            ring.drop();
        }
    }
}

void RecordStore::take(std::size_t index, const haptics::TickRecord& record) {
    Part& part = parts_[index];
    if (options_.on_record) options_.on_record(index, record);
    if (failure_) {
        ++part.lost;
        return;
    }
    const bool full = part.block.rows() >= kMostBlockRows ||
                      (part.block.rows() > 0 &&
                       (record.time_ns - part.header.t0_ns >= options_.block_ns || record.time_ns < part.header.t0_ns));
    if (full) seal(index);
    if (part.block.rows() == 0)
        part.header = {static_cast<std::uint32_t>(index), static_cast<std::int64_t>(record.tick), 0, record.time_ns};
    std::vector<Word> row = row_of(record, part.shape);
    if (part.hand.more_values) part.hand.more_values(record, row);
    row.resize(part.columns.size());
    part.block.add(row);
    part.last_tick = record.tick;
    part.never_run += haptics::skipped_deadlines(record.lateness_ns, part.period_ns);
}

void RecordStore::seal(std::size_t index) {
    Part& part = parts_[index];
    if (part.block.rows() == 0) return;
    Result<PackedBlock> packed = pack(part.block, part.header);
    part.block.clear();
    if (!packed) return give_up(packed.error());
    part.sealed_tick = part.last_tick;
    sealed_bytes_ += packed->data.size();
    sealed_.push_back(std::move(*packed));
}

// ---- Transactions

void RecordStore::commit_what_is_due(bool last) {
    const Nanoseconds now_ns = clock_.now_ns();
    const bool time_has_come = now_ns - committed_ns_ >= options_.block_ns;
    // A disk that has just refused gets a rest before the next try; the last turn tries until patience ends.
    if (failure_ || (!last && !time_has_come && (sealed_.empty() || refused_ns_))) return;
    for (std::size_t h = 0; h < parts_.size(); ++h)
        if (last || time_has_come) seal(h);
    if (sealed_.empty() && notes_.empty()) {
        committed_ns_ = now_ns;
        return;
    }
    for (;;) {
        const Result<void> done = commit();
        committed_ns_ = clock_.now_ns();
        if (done) {
            refused_ns_.reset();
            return;
        }
        if (failure_) return;
        if (!refused_ns_) refused_ns_ = committed_ns_;
        if (committed_ns_ - *refused_ns_ >= options_.patience_ns || waiting_bytes() > kMostWaitingBytes)
            return give_up(done.error());
        if (!last) return;
        clock_.sleep_until(committed_ns_ + std::min(options_.patience_ns, options_.block_ns) / 4);
    }
}

Result<void> RecordStore::commit() {
    BURIN_TRY_DO(check_place());
    const Nanoseconds begun_ns = clock_.now_ns();
    Result<void> done = insert_all();
    transaction_duration_.add(clock_.now_ns() - begun_ns);
    if (!done) {
        // Some failures roll back by themselves; a rollback that fails leaves the next BEGIN to say so.
        if (database_->in_transaction()) static_cast<void>(database_->run("ROLLBACK"));
        return done;
    }
    for (Part& part : parts_) part.acknowledged = part.sealed_tick;
    sealed_.clear();
    notes_.clear();
    sealed_bytes_ = note_bytes_ = 0;
    ++transactions_;
    return {};
}

Result<void> RecordStore::insert_all() {
    BURIN_TRY_DO(database_->run("BEGIN IMMEDIATE"));
    BURIN_TRY(insert,
              database_->prepare("INSERT INTO block(hand, tick0, rows, t0_ns, crc, data) VALUES(?, ?, ?, ?, ?, ?)"));
    for (const PackedBlock& block : sealed_) {
        insert.bind(1, std::int64_t{block.header.hand});
        insert.bind(2, block.header.tick0);
        insert.bind(3, std::int64_t{block.header.rows});
        insert.bind(4, block.header.t0_ns);
        insert.bind(5, std::int64_t{block.crc});
        insert.bind(6, std::span<const std::byte>(block.data));
        BURIN_TRY_DO(insert.run());
    }
    for (const StoreNote& note : notes_) BURIN_TRY_DO(insert_note(note));
    BURIN_TRY_DO(insert_clock());
    return commit_with_link();
}

Result<void> RecordStore::insert_note(const StoreNote& note) {
    using Kind = StoreNote::Kind;
    const char* sql =
        note.kind == Kind::line          ? "INSERT INTO line(time_ns, text) VALUES(?1, ?2)"
        : note.kind == Kind::event       ? "INSERT INTO event(time_ns, name, trial, value) VALUES(?1, ?2, ?3, ?4)"
        : note.kind == Kind::trial_begin ? "INSERT INTO trial(id, name, begun_ns, state) VALUES(?3, ?2, ?1, 'open')"
                                         : "UPDATE trial SET ended_ns = ?1, state = ?2 WHERE id = ?3";
    BURIN_TRY(statement, database_->prepare(sql));
    statement.bind(1, note.time_ns);
    statement.bind(2, std::string_view(note.text));
    if (note.kind != Kind::line && note.trial) statement.bind(3, *note.trial);
    if (note.kind == Kind::event) statement.bind(4, std::string_view(note.value));
    return statement.run();
}

Result<void> RecordStore::insert_clock() {
    BURIN_TRY(statement, database_->prepare("INSERT INTO clock(mono_ns, utc_ns) VALUES(?, ?)"));
    statement.bind(1, std::int64_t{clock_.now_ns()});
    statement.bind(2, utc_ns());
    return statement.run();
}

// ---- What can go wrong, and the end

Result<void> RecordStore::check_place() {
    if (file_->is_in_place()) return {};
    Error why{"the file was taken away while it was recorded", path_, "leave the file where it is until the end"};
    if (file_->is_deleted()) save_elsewhere(why);
    give_up(std::move(why));
    return std::unexpected(*failure_);
}

// A deleted file still exists for those who hold it open.
void RecordStore::save_elsewhere(Error& why) {
    const std::string saved = path_ + ".saved";
    std::error_code ignored;
    if (fs::exists(saved, ignored)) return;
    Result<Statement> copy = database_->prepare("VACUUM INTO ?");
    if (!copy) return;
    copy->bind(1, std::string_view(saved));
    if (copy->run()) why.remedy = "what had been acknowledged is in " + saved;
}

std::string RecordStore::progress() const {
    std::string text;
    for (const Part& part : parts_) {
        if (!text.empty()) text += ", ";
        text += part.hand.name + " up to tick " + std::to_string(part.acknowledged);
    }
    return text;
}

void RecordStore::give_up(Error why) {
    why.what += "; kept: " + progress();
    failure_ = std::move(why);
    for (const PackedBlock& block : sealed_) parts_[block.header.hand].lost += block.header.rows;
    for (Part& part : parts_) {
        part.lost += part.block.rows();
        part.block.clear();
    }
    sealed_.clear();
    notes_.clear();
    sealed_bytes_ = note_bytes_ = 0;
}

Result<void> RecordStore::write_facts_of_end(std::uint64_t notes_lost,
                                             const std::vector<std::pair<std::string, std::string>>& facts) {
    BURIN_TRY_DO(database_->run("BEGIN IMMEDIATE"));
    for (std::size_t h = 0; h < parts_.size(); ++h) {
        const std::string of_hand = ", hand " + std::to_string(h),
                          lost = std::to_string(parts_[h].lost + parts_[h].hand.ring->refused());
        BURIN_TRY_DO(put_fact("ticks lost" + of_hand, lost));
        BURIN_TRY_DO(put_fact("ticks never run" + of_hand, std::to_string(parts_[h].never_run)));
    }
    for (const auto& [key, value] : facts) BURIN_TRY_DO(put_fact(key, value));
    BURIN_TRY_DO(put_fact("notes lost", std::to_string(notes_lost)));
    BURIN_TRY_DO(put_fact("end", failure_ ? failure_->line() : "regular"));
    return commit_with_link();
}

void RecordStore::end(std::uint64_t notes_lost, const std::vector<std::pair<std::string, std::string>>& facts) {
    Result<void> ended;
    if (!failure_) {
        ended = write_facts_of_end(notes_lost, facts);
    } else {
        static_cast<void>(write_facts_of_end(notes_lost, facts));  // where the disk takes it again
        if (database_->in_transaction()) static_cast<void>(database_->run("ROLLBACK"));
    }
    const Result<void> closed = file_->close();
    if (ended) ended = closed;
    if (!ended && !failure_) give_up(ended.error());
    file_.reset();
    database_ = nullptr;
}

}  // namespace burin::record
