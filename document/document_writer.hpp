// SPDX-License-Identifier: MIT
// Saves the document of a session and keeps its journal on a thread of its own: neither a frame nor a tick waits for
// the disk.
//
// Data flow: what is to be saved, taken from the scene's parts between two updates -> a queue -> this thread, which
// compresses and writes (document_store.hpp) -> what became of it, taken by the frame. Changes go the same way, in the
// same order, into the journal (journal.hpp); a save takes their place there once it is on the disk.
// Pages of a save that failed are written with the next save to the same path, so that none is missing there.
// Changes that the journal's disk refuses are kept and tried again every few seconds; beyond kMostUnwritten_bytes they
// are given up, and wants_all() asks for all as it is then, which takes their place (begin_anew()).
// Failure: in the outcome, never thrown. Threads: save() and the rest on any, but the haptic one.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "document/document_store.hpp"
#include "document/journal.hpp"

namespace burin::document {

struct SaveRequest {
    std::string path;
    std::string name;  // what messages call it
    Content content;
    // The parts' pages are those that have changed since the request before, which was to the same path, or since it
    // was opened (have()). Else they are all.
    bool changed_alone = false;
    Place place = Place::nothing;    // of a new file
    std::size_t asked_by = 0;        // comes back with the outcome; whoever asks knows what it means
    std::uint64_t state = 0;         // of the work, likewise
    std::optional<Error> refused{};  // why nothing is written
};

struct SaveOutcome {
    std::string path, name;
    std::size_t asked_by = 0;
    std::uint64_t state = 0;
    Result<Saved> saved;
};

// News of the journal. failed: why what is noted is not on the disk; none: all of it is on the disk again.
struct JournalNews {
    std::optional<Error> failed;
};

class DocumentWriter {
public:
    // vfs: the name of one of SQLite's file systems, for tests; so are the other two.
    explicit DocumentWriter(std::string vfs = {}, std::chrono::milliseconds again_after = std::chrono::seconds(3),
                            std::size_t most_unwritten_bytes = std::size_t{256} << 20);
    ~DocumentWriter();  // saves what waits
    DocumentWriter(const DocumentWriter&) = delete;
    DocumentWriter& operator=(const DocumentWriter&) = delete;

    // Tells which document was opened: saves to this path go into it, as long as it is of this version.
    void have(std::string path, Version version);
    // Waits for no disk.
    void save(SaveRequest request);
    // Begins a journal at this path; beginning: all as it is now. replaces: an earlier journal that goes then.
    void keep_journal(std::string path, Content beginning, std::string replaces = {});
    // Notes a change of a part for the journal; nothing where there is none.
    void note(Change change);
    // Returns how many changes have been noted, and how many of these are on the disk. Any thread.
    [[nodiscard]] std::int64_t noted() const { return noted_.load(std::memory_order_relaxed); }
    // acquire: whoever sees the number sees a file that holds it.
    [[nodiscard]] std::int64_t safe_up_to() const { return safe_.load(std::memory_order_acquire); }
    // Returns what has become of the journal since the last call: each time that its disk begins to refuse, and when
    // all is there again.
    [[nodiscard]] std::vector<JournalNews> take_journal_news();
    // Returns, once, whether the journal needs all as it is now: begin_anew() gives it. All that was noted before is in
    // the content.
    [[nodiscard]] bool wants_all() { return wants_all_.exchange(false, std::memory_order_relaxed); }
    void begin_anew(Content now);
    // Ends the journal, once all is done: it goes, but where it holds what was saved nowhere else and is not discarded.
    // Returns its path then, else nothing.
    [[nodiscard]] std::string end_journal(bool discards);
    // Returns what has become of the requests since the last call, in their order.
    [[nodiscard]] std::vector<SaveOutcome> take_outcomes();
    // Returns whether a save is under way.
    [[nodiscard]] bool busy() const;
    // Returns when all that was asked for has been written or has failed.
    void finish();

private:
    struct JournalBeginning {
        std::string path;
        Content content;
        std::string replaces;
    };
    struct Anew {
        Content content;
    };
    struct JournalEnd {
        bool discards = false;
    };
    using Work = std::variant<SaveRequest, Change, JournalBeginning, Anew, JournalEnd>;
    void run();
    void put(Work work);
    void carry_out(SaveRequest& request);
    void carry_out(JournalBeginning& begin);
    void carry_out(Anew& anew);
    void carry_out(JournalEnd& end);
    void carry_out(std::vector<Change> changes);
    [[nodiscard]] Result<Saved> write(SaveRequest& request);
    [[nodiscard]] Result<Saved> write_elsewhere(SaveRequest& request);
    void keep_saved(Content saved, const std::string& path, const Version& version);
    void begin_journal(const Content& content);
    void add_unwritten();
    void try_journal_again();
    void journal_holds_all();
    void journal_fails(const Error& why);
    void give_up_unwritten();

    const std::string vfs_;
    // The thread's own while it writes; set by have() before the first save.
    std::string path_;                // of the document that there is
    std::optional<Version> version_;  // none: it has not been written yet
    Content owed_;
    std::optional<Journal> journal_;
    std::string journal_path_, replaces_;  // empty: no journal is kept; replaces_: one that goes with its beginning
    std::map<std::string, std::string> named_;  // facts of the journal alone
    std::vector<Change> unwritten_;             // that the journal's disk has refused
    std::size_t unwritten_bytes_ = 0;
    bool fails_ = false;       // the journal's disk refuses, and is tried again
    bool lacks_some_ = false;  // of what was noted something is neither in the journal nor unwritten_
    bool unsaved_ = false;     // something was noted since the last save
    int tries_ = 0;
    std::chrono::steady_clock::time_point next_try_;
    std::int64_t handled_ = 0;  // changes that have come to this thread
    std::atomic<std::int64_t> noted_{0}, safe_{0};
    std::atomic<bool> wants_all_{false};
    const std::chrono::milliseconds again_after_;
    const std::size_t most_unwritten_bytes_;
    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable wake_, done_;
    std::deque<Work> waiting_;
    std::vector<JournalNews> journal_news_;
    std::string journal_left_;  // at its end
    std::vector<SaveOutcome> outcomes_;
    bool writing_ = false, ending_ = false;
    std::thread thread_;
};

}  // namespace burin::document
