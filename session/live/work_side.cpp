// SPDX-License-Identifier: MIT
#include "session/live/work_side.hpp"

#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "session/work/journal_folder.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kEditsNoted_ns = 500'000'000;  // how often the journal has what was done to objects

}  // namespace

void FoundOut::settle(SessionSetup& options) const {
    options.carve.workpiece.units = unit;
    options.carve.workpiece.close_holes = options.carve.workpiece.close_holes || holes_closed;
    options.hands.tool = tool_options;
}

Result<void> WorkSide::open() {
    const std::string path = document_of(options_);
    if (path.empty() || options_.scene.given != nullptr) return {};
    BURIN_TRY(opened, open_document_and_journal(path, options_.work.journal, options_.carve.undo_memory_MiB << 20));
    opened_ = std::move(opened);
    if (!opened_.lost.empty()) log_.notify(opened_.lost, MessageKind::error);
    if (!opened_.recovered.empty()) log_.notify_of_event(opened_.recovered, MessageKind::warning);
    document_.came_from(opened_.origin);
    // A log's session leaves the file that it began with as it is; so does one that has more than what is in there.
    const bool has_all =
        opened_.workpiece.has_value() == has_workpiece(options_) && opened_.world.has_value() == has_world(options_);
    // A world of which something is lost is saved elsewhere, so that what may yet be saved of the file stays.
    const bool is_whole = !opened_.world || opened_.lost.empty();
    const bool is_own = opened_.version && options_.record.input.empty() && has_all && is_whole;
    const auto holder = is_own ? document_.hold(options_.work.journal, opened_.document) : std::nullopt;
    if (holder)
        log_.notify_of_event(opened_.document + " is open in another window, " + text_of(*holder) +
                                 ": it can be read here, and is saved under another name",
                             MessageKind::warning);
    else if (is_own)
        document_.opened(opened_.document, *opened_.version);
    return {};
}

void WorkSide::has_begun() {
    if (options_.scene.given == nullptr) {
        document_.began_with(has_workpiece(options_) ? options_.carve.workpiece.source : options_.scene.world);
        if (document_of(options_).empty()) opened_.kept = unsaved_work_in(options_.work.journal);
    }
    for (const std::string& line : opened_.kept) log_.notify_of_event(line);
}

void WorkSide::begin_history(SessionState& state) {
    state.edits = std::move(opened_.edits);
    state.history = std::move(opened_.order);
    if (scene_.carved() != nullptr) state.history.adopt(SessionState::kWorkpiecePart, scene_.carved()->undo_steps());
    if (scene_.world() != nullptr) state.history.adopt(state.objects_part(), state.edits.steps());
    const scene::ScenePart* const brought = scene_.brought();
    state.saves_brought = brought != nullptr && brought->is_kept();
    if (state.saves_brought) state.history.adopt(scene_.brought_part(), brought->undo_steps());
}

void WorkSide::begin_journal(const SessionState& state) {
    const bool keeps = !options_.work.journal.empty() && (state.saves || state.saves_brought);
    if (state.saves && options_.record.input.empty()) news_.begin(keeps, !opened_.recovered.empty());
    if (state.saves_brought) {
        opened_.journal = options_.work.goes_on_from;
        if (!opened_.journal.empty()) opened_.recovered = "what was not saved has come back from " + opened_.journal;
        if (options_.record.input.empty())
            for (const std::string& line : unsaved_work_in(options_.work.journal))
                if (!line.ends_with(" " + opened_.journal)) log_.notify_of_event(line);
    }
    const bool begins_at_once = scene_.carved() != nullptr || state.saves_brought || !opened_.journal.empty();
    if (keeps && begins_at_once) keep_journal(state.saves ? state.world.get() : nullptr, state);
    begins_journal_ = keeps && !begins_at_once;
}

void WorkSide::save(const AskedSave& wanted, const SessionState& state, const Give& give) {
    if (!files_.write()) return;
    news_.save_ordered();
    note_edits(wanted.world.get(), state, give);  // so that a save that fails leaves them in the journal
    // A journal that began after this, with what follows, would get what is saved now in place of that.
    if (std::exchange(begins_journal_, false)) keep_journal(wanted.world.get(), state);
    document::SaveRequest request = document_.request(wanted, files_, options_, beginning_());
    if (wanted.world && !request.refused)
        request.content.parts.push_back(saved_world_.save(*wanted.world, wanted.edits, !request.changed_alone));
    request.content.history = wanted.history;
    request.state = wanted.edits.state() << 32;
    give(scene_.saving(std::move(request), document_.writer()));
}

// Before the scene's thread starts, or where there is no workpiece.
void WorkSide::keep_journal(const WorldObjects* world, const SessionState& state) {
    document::Content beginning = beginning_();
    if (scene_.workpiece() != nullptr) scene_.workpiece()->copy(beginning.parts.emplace_back());
    if (world != nullptr) beginning.parts.push_back(saved_world_.all(*world, state.edits));
    brought_place_ = static_cast<std::int64_t>(beginning.parts.size());
    if (state.saves_brought) static_cast<void>(scene_.brought()->note(beginning.parts.emplace_back()));
    beginning.history = state.history;
    if (const auto kept = document_.keep_journal(options_.work.journal, options_, opened_, std::move(beginning));
        !kept) {
        news_.journal_keeps(false);
        return log_.notify(kept.error().line());
    }
    if (scene_.carved() != nullptr)
        scene_.carved()->keep_journal([&writer = document_.writer()](scene::Pages change) {
            writer.note({.part = 0, .pages = std::move(change)});
        });
}

bool WorkSide::keeps_brought(const SessionState& state) const {
    return state.saves_brought && !options_.work.journal.empty();
}

// Notes for the journal what was done to objects. By way of the scene's thread, as saves go: one that was asked for
// before would take the place of what was noted since.
void WorkSide::note_edits(const WorldObjects* world, const SessionState& state, const Give& give) {
    if (world == nullptr || !state.saves || options_.work.journal.empty()) return;
    std::optional<scene::Pages> change = saved_world_.take_change(*world, state.edits);
    if (!change) return;
    if (std::exchange(begins_journal_, false)) keep_journal(world, state);
    give(scene_.noting({.part = state.objects_part(), .pages = std::move(*change), .history = state.history},
                       document_.writer()));
}

void WorkSide::go_on(const SessionState& state, Nanoseconds time_ns, const Give& give) {
    if (time_ns - edits_noted_ns_ >= kEditsNoted_ns) {
        edits_noted_ns_ = time_ns;
        note_edits(state.world.get(), state, give);
        if (keeps_brought(state) && brought_due_->load(std::memory_order_relaxed))
            give(scene_.noting_brought(brought_place_, state.history, document_.writer(), brought_due_));
    }
    if (state.world) tell(state);
    watch_journal(state, give);
}

// What was done to objects and is not noted yet will be the next change.
void WorkSide::tell(const SessionState& state) {
    if (!news_.tells()) return;
    std::int64_t not_noted = scene_.to_be_noted();  // before those that are: one more is told of later, none too early
    if (state.world && saved_world_.has_change(*state.world)) ++not_noted;
    // The number of the state in which the workpiece and the objects are.
    const std::uint64_t work_state = scene_.strokes().state + (state.edits.state() << 32);
    news_.work_is(work_state, scene_.strokes().undoable + state.edits.undoable(), document_.noted() + not_noted);
}

void WorkSide::take_outcomes() {
    for (const document::SaveOutcome& ended : document_.take_outcomes()) {
        files_.tell(ended);
        news_.save_ended(ended);
    }
}

void WorkSide::watch_journal(const SessionState& state, const Give& give) {
    if (options_.work.journal.empty()) return;
    for (const document::JournalNews& news : document_.writer().take_journal_news()) {
        news_.journal_keeps(!news.failed);
        if (news.failed)
            log_.notify_of_event("strokes are not kept until they are saved: " + news.failed->line() +
                                     "; it is tried again every few seconds",
                                 MessageKind::error);
        else
            log_.notify_of_event("strokes are kept again, with all that was done meanwhile", MessageKind::info);
    }
    if (!document_.writer().wants_all()) return;
    document::Content now = beginning_();
    if (state.world && state.saves) now.parts.push_back(saved_world_.all(*state.world, state.edits));
    now.history = state.history;
    give(scene_.journalling(std::move(now), document_.writer()));
}

std::vector<CommandInput> WorkSide::take_told(bool works) {
    return news_.take(document_.name(options_), document_.has_file(), document_.safe_up_to(), works);
}

void WorkSide::finish(const SessionState& state) {
    note_edits(state.world.get(), state, [](const SceneSide::Order& order) { order(); });
    document_.finish();
    for (const document::SaveOutcome& ended : document_.take_outcomes()) files_.tell(ended);
    // Who ends an exercise that was not killed is done with its body; what came back from a journal stays until it is
    // saved.
    const bool is_done_with = !state.saves && options_.work.goes_on_from.empty();
    if (const std::string kept = document_.end_journal(state.discards || is_done_with); !kept.empty())
        log_.notify("what was not saved is kept: " + options_.work.opened_by + " " + kept);
    if (!options_.work.journal.empty())
        for (const document::JournalNews& news : document_.writer().take_journal_news())
            if (news.failed) log_.notify_of_event(news.failed->line(), MessageKind::error);
}

}  // namespace burin::session
