// SPDX-License-Identifier: MIT
// Writes a session file: every tick of every hand, and what the session notes beside them.
//
// Data flow:
//   haptic thread -> ring of tick records of each hand -> the writer's thread, the ring's only reader
//     -> rows (columns.hpp) -> a block a second (block.hpp)   |
//   any thread -> queue of lines, events, trials              |-> one transaction -> the disk -> acknowledged
//   both clocks, once a transaction                           |
// Whoever else wants the records (figures, plots, monitors) gets them from the writer, by `on_record`.
//
// Ownership: one SQLite connection, which alone writes and checkpoints; it holds the file's lock until the end, so
// that no other program reads or writes the file meanwhile. Each transaction adds a link to the chain of digests
// (chain.hpp), so that what is changed later shows. WAL with synchronous FULL: what is acknowledged survives a
// kill and a power cut. close() brings everything into the one file, which then travels alone.
// Failures: create() never touches an existing file. While the disk refuses (full, locked, unplugged) the writer keeps
// what it has, tries again, and gives up after `patience_ns` or beyond kMostWaitingBytes: failure() then says why,
// later ticks are counted as lost, and what was acknowledged stays. A file that is taken away is noticed before the
// next transaction; where it was deleted, its contents are saved under a new name, which the failure tells.
// Threads: create(), close() and the destructor on one thread; note_...(), acknowledged() and failure() on any, but
// the haptic one; take_now() on the thread that makes the ticks, in simulated time.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/ring.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/histogram.hpp"
#include "record/columns.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::record {

// Ticks that a ring holds while a transaction takes long: 16 s at 1 kHz.
inline constexpr std::size_t kRingTicks = 1u << 14;

// Bytes that may wait for a disk that refuses: minutes of one hand.
inline constexpr std::size_t kMostWaitingBytes = std::size_t{64} << 20;

// Checks, as far as that shows beforehand, whether a recording can be made there: nothing has the name yet, and the
// folder takes files. Writes nothing. Empty: nothing is asked for.
[[nodiscard]] Result<void> check_new_place(const std::string& path);

// The fact that says how far apart a hand's ticks are due, in nanoseconds.
[[nodiscard]] inline std::string period_fact(std::size_t hand) {
    return "tick period ns, hand " + std::to_string(hand);
}

struct RecordedHand {
    std::string name;  // of the device and, of several parts, the part; unique
    devices::DeviceDescription device;
    haptics::Probe probe;  // the one with the most points that the hand will have
    Ring<haptics::TickRecord>* ring = nullptr;
    // Columns after those of columns_for(), and the values that a tick has in them, which are appended to its row;
    // called on the writer's thread for every tick in order. Null: there are none.
    std::vector<Column> more_columns = {};
    std::function<void(const haptics::TickRecord&, std::vector<Word>& row)> more_values = {};
};

using OnRecord = std::function<void(std::size_t hand, const haptics::TickRecord&)>;

struct WriterOptions {
    // Facts about the session, for table meta: program, version, compiler, digests, settings.
    std::vector<std::pair<std::string, std::string>> facts;
    Nanoseconds block_ns = kNanosecondsPerSecond;  // of ticks in a block, and longest time until a transaction
    Nanoseconds patience_ns = 10 * kNanosecondsPerSecond;
    // What can be touched, by the numbers in a column of objects (more_columns): for table object.
    std::vector<std::pair<std::int64_t, std::string>> objects = {};
    OnRecord on_record;  // called on the writer's thread, for every tick in order; null: nobody
    std::string vfs;     // one of SQLite's file systems, for tests; empty: the usual one
};

class RecordWriter {
public:
    // Makes the file and starts the thread. The rings must outlive the writer; from now on it is their only reader.
    [[nodiscard]] static Result<std::unique_ptr<RecordWriter>> create(const std::string& path,
                                                                      std::vector<RecordedHand> hands,
                                                                      WriterOptions options);
    ~RecordWriter();  // closes; a failure is lost
    RecordWriter(const RecordWriter&) = delete;
    RecordWriter& operator=(const RecordWriter&) = delete;

    // Notes go into the next transaction, in their order. They wait for no disk; where too many wait they are counted
    // as lost.
    void note_line(Nanoseconds time_ns, std::string text);
    void note_event(Nanoseconds time_ns, std::string name, std::string value, std::optional<std::int64_t> trial = {});
    // A trial is kept from its beginning on, as "open"; its end says how it ended ("done", "aborted").
    [[nodiscard]] std::int64_t begin_trial(Nanoseconds time_ns, std::string name);
    void end_trial(std::int64_t trial, Nanoseconds time_ns, std::string state);

    // Writes a fact at the end, which is not known before.
    void note_fact(std::string key, std::string value);

    // Returns when the writer has taken all that the rings hold now. For simulated time, whose ticks no clock holds
    // back: a ring would overflow.
    void take_now();
    // Returns the last tick of a hand that is on the disk; 0: none. All before it are there as well, but those lost.
    [[nodiscard]] std::uint64_t acknowledged(std::size_t hand = 0) const;
    // Returns how many transactions have been acknowledged.
    [[nodiscard]] std::uint64_t transactions() const;
    // Returns how long transactions took, those included that the disk refused. Any thread; lives as the writer does.
    [[nodiscard]] const haptics::Histogram& transaction_duration() const;
    // Returns why nothing is recorded any more.
    [[nodiscard]] std::optional<Error> failure() const;
    // Takes the rest of the rings and notes, brings all to the disk, and ends. Afterwards nobody writes to the file.
    // Fails with what failure() says; a second call returns the same.
    [[nodiscard]] Result<void> close();

private:
    struct Store;  // the thread's own: connection, blocks, what waits
    struct Note;   // a line, an event, a trial's beginning or end
    RecordWriter();

    void run();
    void add_note(Note note);

    std::unique_ptr<Store> store_;
    std::unique_ptr<std::atomic<std::uint64_t>[]> acknowledged_;
    std::atomic<std::uint64_t> transactions_{0};
    std::size_t hands_ = 0;
    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable wake_, taken_;
    std::vector<Note> notes_;
    std::size_t note_bytes_ = 0;
    std::uint64_t notes_lost_ = 0;
    std::vector<std::pair<std::string, std::string>> facts_of_end_;
    std::int64_t trials_ = 0;
    std::uint64_t asked_ = 0, answered_ = 0;  // turns of the thread that take_now() has asked for, and that were made
    bool ending_ = false;
    std::optional<Error> failure_;
    std::thread thread_;
};

}  // namespace burin::record
