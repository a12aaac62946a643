// SPDX-License-Identifier: MIT
#include "document/document_writer.hpp"

#include <filesystem>
#include <set>
#include <utility>

namespace burin::document {
namespace {

// Tries until all of the work is asked for once more: copying it takes the scene's thread some time.
constexpr int kTriesForAll = 3;

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

DocumentWriter::DocumentWriter(std::string vfs, std::chrono::milliseconds again_after, std::size_t most_unwritten_bytes)
    : vfs_(std::move(vfs)), again_after_(again_after), most_unwritten_bytes_(most_unwritten_bytes) {
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

void DocumentWriter::begin_anew(Content now) { put(Anew{std::move(now)}); }

std::vector<JournalNews> DocumentWriter::take_journal_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(journal_news_, {});
}

std::string DocumentWriter::end_journal(bool discards) {
    put(JournalEnd{discards});
    finish();
    const std::lock_guard lock(mutex_);
    return std::exchange(journal_left_, {});
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
    const auto has_work = [this] { return ending_ || !waiting_.empty(); };
    for (;;) {
        if (fails_)
            wake_.wait_until(lock, next_try_, has_work);
        else
            wake_.wait(lock, has_work);
        if (waiting_.empty() && ending_) return;
        std::vector<Change> changes;  // all that wait next to each other go into one transaction
        while (!waiting_.empty() && std::holds_alternative<Change>(waiting_.front())) {
            changes.push_back(std::get<Change>(std::move(waiting_.front())));
            waiting_.pop_front();
        }
        std::optional<Work> work;
        if (changes.empty() && !waiting_.empty()) {
            work = std::move(waiting_.front());
            waiting_.pop_front();
        }
        writing_ = true;
        lock.unlock();
        if (fails_ && std::chrono::steady_clock::now() >= next_try_) try_journal_again();
        if (!changes.empty()) carry_out(std::move(changes));
        if (work && std::holds_alternative<SaveRequest>(*work)) carry_out(std::get<SaveRequest>(*work));
        if (work && std::holds_alternative<JournalBeginning>(*work)) carry_out(std::get<JournalBeginning>(*work));
        if (work && std::holds_alternative<Anew>(*work)) carry_out(std::get<Anew>(*work));
        if (work && std::holds_alternative<JournalEnd>(*work)) carry_out(std::get<JournalEnd>(*work));
        lock.lock();
        writing_ = false;
        done_.notify_all();
    }
}

void DocumentWriter::carry_out(SaveRequest& request) {
    Result<Saved> saved = write(request);
    if (saved) keep_saved(std::move(request.content), request.path, saved->version);
    const std::lock_guard lock(mutex_);
    outcomes_.push_back(
        {std::move(request.path), std::move(request.name), request.asked_by, request.state, std::move(saved)});
}

// ---- The journal

// From now on the journal goes on from what was saved.
void DocumentWriter::keep_saved(Content saved, const std::string& path, const Version& version) {
    unsaved_ = false;
    // release: the document holds these changes before anybody reads the number.
    safe_.store(handled_, std::memory_order_release);
    named_[kJournalOfFact] = path;
    named_[kJournalNameFact] = std::filesystem::path(path).filename().string();
    named_[kBaseIdFact] = version.id;
    named_[kBaseSavesFact] = std::to_string(version.saves);
    if (!journal_ || lacks_some_) return;
    for (const auto& [key, value] : named_) saved.facts[key] = value;
    saved.facts.erase(kUnsavedFact);
    const auto taken = journal_->take_over(std::move(saved));
    if (taken) return journal_holds_all();
    give_up_unwritten();  // it leads on from an earlier state
    journal_fails(taken.error());
}

void DocumentWriter::carry_out(JournalBeginning& begin) {
    journal_path_ = begin.path;
    replaces_ = begin.replaces;
    // One that begins after a save goes on from that.
    for (const auto& [key, value] : named_) begin.content.facts[key] = value;
    for (const char* const fact : {kJournalNameFact, kJournalOfFact, kBaseIdFact, kBaseSavesFact})
        if (const auto at = begin.content.facts.find(fact); at != begin.content.facts.end()) named_.insert(*at);
    unsaved_ = begin.content.facts.contains(kUnsavedFact);
    begin_journal(begin.content);
}

void DocumentWriter::carry_out(Anew& anew) {
    if (journal_path_.empty()) return;
    for (const auto& [key, value] : named_) anew.content.facts[key] = value;
    if (unsaved_) anew.content.facts[kUnsavedFact] = "1";
    begin_journal(anew.content);
}

void DocumentWriter::begin_journal(const Content& content) {
    if (journal_) {
        if (const auto begun = journal_->begin_anew(content, unsaved_); !begun) return journal_fails(begun.error());
        return journal_holds_all();
    }
    Result<Journal> journal = Journal::begin(journal_path_, content, vfs_);
    if (!journal) {
        give_up_unwritten();
        return journal_fails(journal.error());
    }
    journal_.emplace(std::move(*journal));
    if (!replaces_.empty()) record::remove_with_log(replaces_);
    journal_holds_all();
}

void DocumentWriter::carry_out(std::vector<Change> changes) {
    handled_ += static_cast<std::int64_t>(changes.size());
    unsaved_ = true;
    if (journal_path_.empty() || lacks_some_) return;
    for (Change& change : changes) {
        for (const auto& [name, bytes] : change.pages.pages) unwritten_bytes_ += bytes.size();
        unwritten_.push_back(std::move(change));
    }
    if (!fails_) return add_unwritten();
    if (unwritten_bytes_ > most_unwritten_bytes_) give_up_unwritten();
}

void DocumentWriter::add_unwritten() {
    if (const auto added = journal_->add(unwritten_); !added) return journal_fails(added.error());
    journal_holds_all();
}

void DocumentWriter::try_journal_again() {
    ++tries_;
    next_try_ = std::chrono::steady_clock::now() + again_after_;
    if (!lacks_some_) return add_unwritten();
    if (tries_ % kTriesForAll == 0) wants_all_ = true;
}

void DocumentWriter::journal_holds_all() {
    unwritten_.clear();
    unwritten_bytes_ = 0;
    lacks_some_ = false;
    // release: the file holds these changes before anybody reads the number.
    safe_.store(handled_, std::memory_order_release);
    if (!std::exchange(fails_, false)) return;
    const std::lock_guard lock(mutex_);
    journal_news_.push_back({});
}

// Keeps what could not be written, for the next try; the file stays as it is.
void DocumentWriter::journal_fails(const Error& why) {
    next_try_ = std::chrono::steady_clock::now() + again_after_;
    if (std::exchange(fails_, true)) return;
    tries_ = 0;
    const std::lock_guard lock(mutex_);
    journal_news_.push_back({why});
}

// From now on the journal needs all as it is then.
void DocumentWriter::give_up_unwritten() {
    unwritten_.clear();
    unwritten_bytes_ = 0;
    lacks_some_ = true;
}

void DocumentWriter::carry_out(JournalEnd& end) {
    if (fails_ && !lacks_some_) add_unwritten();  // there may be room by now
    std::string left;
    bool taken_away = false;
    if (journal_) {
        if (end.discards) journal_->discard();
        const bool is_there = journal_->is_in_place();
        if (journal_->is_needed() && is_there) left = journal_path_;
        if (journal_->is_needed() && !is_there) taken_away = true;
        journal_->end();
        journal_.reset();
    }
    const bool loses = (fails_ || taken_away) && unsaved_ && !end.discards;
    const std::string path = std::exchange(journal_path_, {});
    fails_ = false;
    give_up_unwritten();
    const std::lock_guard lock(mutex_);
    journal_left_ = std::move(left);
    if (loses)
        journal_news_.push_back({taken_away ? Error{.what = "is not there any more: what was not saved is in no file",
                                                    .where = path,
                                                    .remedy = "save before the end"}
                                            : Error{.what = "the newest strokes are in no file",
                                                    .where = path,
                                                    .remedy = "free some space first, and save before the end"}});
}

// The document that there is stays the one that saves go to, until another is whole.
Result<Saved> DocumentWriter::write_elsewhere(SaveRequest& request) {
    Result<Saved> saved = write_document(request.path, request.content, request.place, vfs_);
    if (saved) {
        path_ = request.path;
        version_ = saved->version;
        owed_ = {};
    } else {
        owed_ = std::move(request.content);
    }
    return saved;
}

Result<Saved> DocumentWriter::write(SaveRequest& request) {
    if (request.refused) return std::unexpected(*request.refused);
    if (request.changed_alone) {
        request.content = merged(std::exchange(owed_, {}), std::move(request.content));
        if (request.path != path_) {  // whoever asked did not know yet that the save before had failed
            owed_ = std::move(request.content);
            return fail(request.path, "was not written by the save before", "save once more");
        }
    } else {
        std::error_code ignored;
        // Where the whole content goes to the document's own file, and that still exists, the file is updated.
        if (request.path == path_ && !std::filesystem::exists(path_, ignored)) version_.reset();
        if (request.path != path_ && version_) return write_elsewhere(request);
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
