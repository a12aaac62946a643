// SPDX-License-Identifier: MIT
#include "record/record_writer.hpp"

#include <ctime>

#include "base/try.hpp"
#include "record/record_store.hpp"

namespace burin::record {
namespace {

// How long ticks may lie in a ring before the thread looks.
constexpr auto kLookEvery = std::chrono::milliseconds(20);

}  // namespace

struct RecordWriter::Note : StoreNote {};

struct RecordWriter::Store : RecordStore {
    using RecordStore::RecordStore;
};

RecordWriter::RecordWriter() = default;

Result<std::unique_ptr<RecordWriter>> RecordWriter::create(const std::string& path, std::vector<RecordedHand> hands,
                                                           WriterOptions options) {
    std::unique_ptr<RecordWriter> writer(new RecordWriter);
    writer->hands_ = hands.size();
    writer->acknowledged_ = std::make_unique<std::atomic<std::uint64_t>[]>(hands.size());
    writer->store_ = std::make_unique<Store>(path, std::move(hands), std::move(options));
    BURIN_TRY_DO(writer->store_->make());
    writer->thread_ = std::thread([w = writer.get()] { w->run(); });
    return writer;
}

RecordWriter::~RecordWriter() {
    if (thread_.joinable()) static_cast<void>(close());
}

void RecordWriter::add_note(Note note) {
    const std::lock_guard lock(mutex_);
    const std::size_t bytes = note.bytes();
    if (note_bytes_ + bytes > kMostWaitingBytes) {
        ++notes_lost_;
        return;
    }
    note_bytes_ += bytes;
    notes_.push_back(std::move(note));
}

void RecordWriter::note_line(Nanoseconds time_ns, std::string text) {
    add_note({{.kind = StoreNote::Kind::line, .time_ns = time_ns, .text = std::move(text)}});
}

void RecordWriter::note_event(Nanoseconds time_ns, std::string name, std::string value,
                              std::optional<std::int64_t> trial) {
    add_note({{.kind = StoreNote::Kind::event,
               .time_ns = time_ns,
               .text = std::move(name),
               .value = std::move(value),
               .trial = trial}});
}

std::int64_t RecordWriter::begin_trial(Nanoseconds time_ns, std::string name) {
    std::int64_t trial = 0;
    {
        const std::lock_guard lock(mutex_);
        trial = ++trials_;
    }
    add_note({{.kind = StoreNote::Kind::trial_begin, .time_ns = time_ns, .text = std::move(name), .trial = trial}});
    return trial;
}

void RecordWriter::end_trial(std::int64_t trial, Nanoseconds time_ns, std::string state) {
    add_note({{.kind = StoreNote::Kind::trial_end, .time_ns = time_ns, .text = std::move(state), .trial = trial}});
}

void RecordWriter::note_fact(std::string key, std::string value) {
    const std::lock_guard lock(mutex_);
    facts_of_end_.emplace_back(std::move(key), std::move(value));
}

void RecordWriter::take_now() {
    std::unique_lock lock(mutex_);
    if (ending_) return;
    const std::uint64_t mine = ++asked_;
    wake_.notify_one();
    taken_.wait(lock, [&] { return answered_ >= mine || ending_; });
}

std::uint64_t RecordWriter::acknowledged(std::size_t hand) const {
    // acquire: whoever sees the number sees a file that holds it.
    return hand < hands_ ? acknowledged_[hand].load(std::memory_order_acquire) : 0;
}

std::uint64_t RecordWriter::transactions() const { return transactions_.load(std::memory_order_acquire); }

const haptics::Histogram& RecordWriter::transaction_duration() const { return store_->transaction_duration(); }

std::optional<Error> RecordWriter::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

Result<void> RecordWriter::close() {
    if (thread_.joinable()) {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        wake_.notify_one();
        taken_.notify_all();
        thread_.join();
    }
    const std::optional<Error> failed = failure();
    if (failed) return std::unexpected(*failed);
    return {};
}

void RecordWriter::run() {
    for (bool last = false; !last;) {
        std::vector<Note> notes;
        std::vector<std::pair<std::string, std::string>> facts;
        std::uint64_t turn = 0, notes_lost = 0;
        {
            std::unique_lock lock(mutex_);
            wake_.wait_for(lock, kLookEvery, [&] { return ending_ || asked_ > answered_; });
            last = ending_;
            turn = asked_;
            notes.swap(notes_);
            note_bytes_ = 0;
            notes_lost = notes_lost_;
            if (last) facts.swap(facts_of_end_);
        }
        for (Note& note : notes) store_->add(std::move(note));
        store_->take_ticks();
        store_->commit_what_is_due(last);
        if (last) store_->end(notes_lost, facts);
        // release: the file holds these ticks before anybody reads the number.
        for (std::size_t i = 0; i < hands_; ++i)
            acknowledged_[i].store(store_->acknowledged(i), std::memory_order_release);
        transactions_.store(store_->transactions(), std::memory_order_release);
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = store_->failure();
        answered_ = turn;
        taken_.notify_all();
    }
}

}  // namespace burin::record
