// SPDX-License-Identifier: MIT
// The journal of a session: what has changed since the work was saved, change by change, on the disk within a moment.
//
// A journal is a document of its own, with all pages as they were when it began and a table of what changed since. So
// work without a name is kept as well, and whatever becomes of the document that the work came from, the journal opens
// by itself: burin sculpt JOURNAL.burin.
// The file is open, and locked, as long as the session lives: one that can be read belongs to a session that is dead.
// Thread: one, the writer's (document/document_writer.hpp). Failures are Errors that name the file and the remedy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/document_file.hpp"

namespace burin::document {

// A change: what pages of one part hold after it. Its steps, where it names them, are all that there are then, with the
// pages of those that are new; history: the order of all parts' steps then, where the change says it.
struct Change {
    std::int64_t part = 0;
    scene::Pages pages = {};
    std::optional<History> history = {};
};

class Journal {
public:
    // Makes the file; beginning: all as it is now. vfs: the name of one of SQLite's file systems, for tests.
    [[nodiscard]] static Result<Journal> begin(const std::string& path, const Content& beginning,
                                               const std::string& vfs = {});

    // Adds changes in one transaction; when it returns they are on the disk.
    [[nodiscard]] Result<void> add(const std::vector<Change>& changes);
    // Takes over what was saved elsewhere: its pages take the place of the changes so far.
    [[nodiscard]] Result<void> take_over(Content saved);
    // Takes all as it is now in the place of what it holds. is_needed: something of that was not saved elsewhere.
    [[nodiscard]] Result<void> begin_anew(const Content& now, bool is_needed);
    // Returns how many changes follow its pages.
    [[nodiscard]] std::int64_t changes() const { return changes_; }
    // Returns whether its path still leads to it.
    [[nodiscard]] bool is_in_place() const { return file_.is_in_place(); }
    // Returns whether it holds something that was not saved elsewhere.
    [[nodiscard]] bool is_needed() const { return needed_; }
    // Marks its changes as not wanted: end() then removes the file.
    void discard() { needed_ = false; }
    // Closes the file so that it can be read; removes it unless it is needed.
    void end();

private:
    Journal(std::string path, record::StoreFile file) : path_(std::move(path)), file_(std::move(file)) {}

    [[nodiscard]] Result<void> replace_changes(const Content& content, bool is_needed);
    void note_first_steps(const Content& beginning);

    std::string path_;
    record::StoreFile file_;
    std::int64_t changes_ = 0;
    bool needed_ = false;
    std::vector<std::int64_t> first_steps_;  // by part: what came before them is not in the journal
};

// A journal that a dead session has left.
struct LeftJournal {
    std::string path;
    std::string of = {};       // the document's path; empty: the work had no name
    std::string name = {};     // what the work was called
    std::string base_id = {};  // the document that it goes on from, and its count of saves
    std::int64_t base_saves = 0;
    std::string opened_by = {};   // the command that opens it, before its path; empty: that of a document
    std::string unreadable = {};  // why it cannot be read; empty: it can, else nothing but its path is known
};
// Returns those in a folder that hold unsaved work, or may; removes the others that nobody has open.
[[nodiscard]] std::vector<LeftJournal> left_journals(const std::string& folder);

// Facts of a journal.
inline constexpr const char *kJournalOfFact = "journal of", *kJournalNameFact = "journal name",
                            *kBaseIdFact = "journal base", *kBaseSavesFact = "journal base saves",
                            *kUnsavedFact = "unsaved", *kOpenedByFact = "journal opened by";

}  // namespace burin::document
