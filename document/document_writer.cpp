// SPDX-License-Identifier: MIT
#include "document/document_writer.hpp"

#include <filesystem>
#include <set>
#include <utility>

namespace burin::document {
namespace {

// Puts what a part has later over what it had; steps that are not there any more fall away.
void put_over(scene::Pages& later, scene::Pages& earlier) {
    later.pages.merge(std::move(earlier.pages));  // which keeps its own
    if (!later.steps || !earlier.steps) return;
    // A step that is new later has all of its pages there.
    std::set<std::int64_t> renewed;
    for (const auto& [name, bytes] : later.steps->pages) renewed.insert(name.number);
    std::erase_if(earlier.steps->pages, [&](const auto& page) {
        const std::int64_t number = page.first.number;
        return renewed.contains(number) || number < later.steps->first || number > later.steps->last;
    });
    later.steps->pages.merge(std::move(earlier.steps->pages));
}

// Puts later pages, facts and commands over earlier ones.
Content merged(Content earlier, Content later) {
    for (std::size_t part = 0; part < later.parts.size() && part < earlier.parts.size(); ++part)
        put_over(later.parts[part], earlier.parts[part]);
    later.facts.merge(std::move(earlier.facts));
    return later;
}

}  // namespace

DocumentWriter::DocumentWriter(std::string vfs) : vfs_(std::move(vfs)) {
    thread_ = std::thread([this] { run(); });
}

DocumentWriter::~DocumentWriter() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void DocumentWriter::have(std::string path, Version version) {
    const std::lock_guard lock(mutex_);
    BURIN_CHECK(waiting_.empty() && !writing_);
    path_ = std::move(path);
    version_ = std::move(version);
}

void DocumentWriter::put(Work work) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(work));
    }
    wake_.notify_one();
}

void DocumentWriter::save(SaveRequest request) { put(std::move(request)); }

void DocumentWriter::keep_journal(std::string path, Content beginning, std::string replaces) {
    put(JournalBeginning{std::move(path), std::move(beginning), std::move(replaces)});
}

void DocumentWriter::note(Change change) {
    noted_.fetch_add(1, std::memory_order_relaxed);
    put(std::move(change));
}

std::optional<Error> DocumentWriter::take_journal_failure() {
    const std::lock_guard lock(mutex_);
    return std::exchange(journal_failure_, std::nullopt);
}

std::string DocumentWriter::end_journal(bool discards) {
    finish();
    if (!journal_) return {};
    if (discards) journal_->discard();
    const bool stays = journal_->is_needed();
    journal_->end();
    journal_.reset();
    return stays ? journal_path_ : std::string();
}

std::vector<SaveOutcome> DocumentWriter::take_outcomes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(outcomes_, {});
}

bool DocumentWriter::busy() const {
    const std::lock_guard lock(mutex_);
    return writing_ || !waiting_.empty();
}

void DocumentWriter::finish() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return waiting_.empty() && !writing_; });
}

void DocumentWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        std::vector<Change> changes;  // all that wait next to each other go into one transaction
        while (!waiting_.empty() && std::holds_alternative<Change>(waiting_.front())) {
            changes.push_back(std::get<Change>(std::move(waiting_.front())));
            waiting_.pop_front();
        }
        std::optional<Work> work;
        if (changes.empty()) {
            work = std::move(waiting_.front());
            waiting_.pop_front();
        }
        writing_ = true;
        lock.unlock();
        if (!changes.empty()) add_to_journal(std::move(changes));
        if (work && std::holds_alternative<SaveRequest>(*work)) carry_out(std::get<SaveRequest>(*work));
        if (work && std::holds_alternative<JournalBeginning>(*work)) carry_out(std::get<JournalBeginning>(*work));
        lock.lock();
        writing_ = false;
        done_.notify_all();
    }
}

void DocumentWriter::carry_out(SaveRequest& request) {
    Result<Saved> saved = write(request);
    if (saved && journal_) {
        // From now on the journal goes on from what was saved.
        request.content.facts[kJournalOfFact] = request.path;
        request.content.facts[kBaseIdFact] = saved->version.id;
        request.content.facts[kBaseSavesFact] = std::to_string(saved->version.saves);
        if (const auto taken = journal_->take_over(std::move(request.content)); !taken) fail_journal(taken.error());
    }
    const std::lock_guard lock(mutex_);
    outcomes_.push_back(
        {std::move(request.path), std::move(request.name), request.asked_by, request.state, std::move(saved)});
}

void DocumentWriter::carry_out(JournalBeginning& begin) {
    Result<Journal> journal = Journal::begin(begin.path, begin.content, vfs_);
    if (!journal) return fail_journal(journal.error());
    journal_.emplace(std::move(*journal));
    journal_path_ = begin.path;
    std::error_code ignored;
    if (!begin.replaces.empty())
        for (const char* ending : {"", "-wal", "-shm", "-journal"})
            std::filesystem::remove(begin.replaces + ending, ignored);
}

void DocumentWriter::add_to_journal(std::vector<Change> changes) {
    if (!journal_) return;
    if (const auto added = journal_->add(changes); !added) return fail_journal(added.error());
    // release: the file holds these changes before anybody reads the number.
    safe_.fetch_add(static_cast<std::int64_t>(changes.size()), std::memory_order_release);
}

// Ends the journal after a failure: its changes stay in its file, and later changes are in no journal.
void DocumentWriter::fail_journal(const Error& why) {
    if (journal_) journal_->end();
    journal_.reset();
    const std::lock_guard lock(mutex_);
    journal_failure_ = why;
}

Result<Saved> DocumentWriter::write(SaveRequest& request) {
    if (request.refused) return std::unexpected(*request.refused);
    if (request.changed_alone) {
        request.content = merged(std::exchange(owed_, {}), std::move(request.content));
    } else {
        std::error_code ignored;
        // Where the whole content goes to the document's own file, and that still exists, the file is updated.
        if (request.path != path_ || !std::filesystem::exists(path_, ignored)) version_.reset();
        path_ = request.path;
        owed_ = {};
    }
    const Result<Saved> saved = version_ ? update_document(path_, request.content, *version_, vfs_)
                                         : write_document(path_, request.content, request.place, vfs_);
    if (saved)
        version_ = saved->version;
    else
        owed_ = std::move(request.content);  // the journal keeps the changes as well, until they are saved
    return saved;
}

}  // namespace burin::document
