// SPDX-License-Identifier: MIT
#include "document/journal.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/places.hpp"
#include "base/try.hpp"
#include "document/document_reader.hpp"
#include "document/document_rows.hpp"
#include "document/leftovers.hpp"
#include "document/log_check.hpp"
#include "record/store_reading.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;
using record::Database, record::StoreFile;

// Runs a transaction whole or not at all.
template <typename Write>
Result<void> in_transaction(Database& database, Write write) {
    BURIN_TRY_DO(database.run("BEGIN IMMEDIATE"));
    Result<void> done = write();
    if (done) done = database.run("COMMIT");
    if (!done && database.in_transaction()) static_cast<void>(database.run("ROLLBACK"));
    return done;
}

// Puts one change, with its steps, within a transaction.
Result<void> put_change(Database& database, const Change& change, std::int64_t number) {
    Saved ignored;
    for (const auto& [name, bytes] : change.pages.pages)
        BURIN_TRY_DO(put_page(database, Table::change, change.part, {name.kind, number}, bytes, ignored));
    if (change.pages.steps) BURIN_TRY_DO(put_steps(database, change.part, *change.pages.steps, ignored));
    if (!change.history) return {};
    return put_page(database, Table::change, kHistoryPart, {kOrderPage, number}, change.history->bytes(), ignored);
}

}  // namespace

Result<Journal> Journal::begin(const std::string& path, const Content& beginning, const std::string& vfs) {
    Saved ignored;
    Result<StoreFile> file = StoreFile::make(
        path, kDocumentKind,
        [&](Database& database) -> Result<void> {
            BURIN_TRY_DO(database.run(document_tables()));
            return put_content(database, beginning, ignored);
        },
        vfs);
    if (!file) return std::unexpected(file.error());
    Journal journal(path, std::move(*file));
    journal.needed_ = beginning.facts.contains(kUnsavedFact);
    journal.note_first_steps(beginning);
    return journal;
}

Result<void> Journal::add(const std::vector<Change>& changes) {
    Database& database = file_.database();
    std::int64_t number = changes_;
    const Result<void> done = in_transaction(database, [&]() -> Result<void> {
        for (const Change& change : changes) BURIN_TRY_DO(put_change(database, change, ++number));
        return {};
    });
    if (!done) return done;
    changes_ = number;
    needed_ = true;
    return {};
}

// Leaves out steps of the saved content that are older than those which the journal has. What was undone since is new
// in the content, however old it is.
Result<void> Journal::take_over(Content saved) {
    for (std::size_t part = 0; part < saved.parts.size() && part < first_steps_.size(); ++part) {
        auto& steps = saved.parts[part].steps;
        if (steps) steps->first = std::min(std::max(steps->first, first_steps_[part]), steps->done + 1);
    }
    return replace_changes(saved, false);
}

Result<void> Journal::begin_anew(const Content& now, bool is_needed) {
    const Result<void> done = replace_changes(now, is_needed);
    if (done) note_first_steps(now);
    return done;
}

Result<void> Journal::replace_changes(const Content& content, bool is_needed) {
    Database& database = file_.database();
    const Result<void> done = in_transaction(database, [&]() -> Result<void> {
        if (const auto gone =
                database.run("DELETE FROM change; DELETE FROM meta WHERE key = '" + std::string(kUnsavedFact) + "'");
            !gone)
            return gone;
        Saved ignored;
        const Result<void> put = put_content(database, content, ignored);
        return put && is_needed ? put_fact(database, kUnsavedFact, "1") : put;
    });
    if (!done) return done;
    needed_ = is_needed;
    changes_ = 0;
    return {};
}

void Journal::note_first_steps(const Content& beginning) {
    first_steps_.clear();
    for (const scene::Pages& part : beginning.parts)
        first_steps_.push_back(part.steps ? part.steps->first : std::numeric_limits<std::int64_t>::min());
}

void Journal::end() {
    static_cast<void>(file_.close());
    if (!needed_) record::remove_with_log(path_);
}

namespace {

bool is_in_use(const Error& error) { return error.what == record::kInUse; }

}  // namespace

std::vector<LeftJournal> left_journals(const std::string& folder) {
    std::vector<LeftJournal> left;
    std::vector<std::string> paths;
    for (const fs::path& file : entries_of(folder).value_or(std::vector<fs::path>()))
        if (is_document_name(file.string())) paths.push_back(file.string());
    for (const std::string& path : paths) {
        if (remove_hollow_journal(path)) continue;
        const Result<DocumentReader> reader = DocumentReader::open(path);
        if (!reader) {
            // That of a living session is locked, or still empty.
            std::error_code ignored;
            if (!is_in_use(reader.error()) && fs::file_size(path, ignored) > 0)
                left.push_back({.path = path, .unreadable = reader.error().what});
            continue;
        }
        if (!reader->facts().contains(kJournalNameFact)) {  // it has been put there, or its beginning is lost
            if (is_log_damaged(path)) left.push_back({.path = path, .unreadable = "has a damaged log"});
            continue;
        }
        const bool is_saved = reader->changes() == 0 && !reader->facts().contains(kUnsavedFact);
        if (is_saved && !is_log_damaged(path) && !record::lacks_its_log(path)) {
            record::remove_with_log(path);
            continue;
        }
        left.push_back({.path = path,
                        .of = reader->fact(kJournalOfFact),
                        .name = reader->fact(kJournalNameFact),
                        .base_id = reader->fact(kBaseIdFact),
                        .base_saves = reader->number(kBaseSavesFact),
                        .opened_by = reader->fact(kOpenedByFact)});
    }
    return left;
}

}  // namespace burin::document
