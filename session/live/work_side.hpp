// SPDX-License-Identifier: MIT
// The work of a session: what it was opened from, its document, its journal, and how far it has come since it was
// saved. What the scene's parts have of it is written by way of the scene's thread (scene_side.hpp). Thread: the
// frame's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "session/live/asked_files.hpp"
#include "session/live/document_news.hpp"
#include "session/live/document_side.hpp"
#include "session/live/scene_side.hpp"
#include "session/notices/message_log.hpp"
#include "session/work/saved_world.hpp"

namespace burin::session {

// What a session found out in place of what its options leave open.
struct FoundOut {
    std::string name, size;             // of what is worked on: its file's or its shape's; "60 x 40 x 8 mm, 128 cells"
    LengthUnit unit = LengthUnit::m;    // of the workpiece's file
    bool holes_closed = false;          // of the workpiece's mesh
    toolbox::ToolOptions tool_options;  // as the session began

    // Writes it into options that leave it open.
    void settle(SessionSetup& options) const;
};

class WorkSide {
public:
    using Give = SceneSide::Give;
    // Returns what a document begins with, but for the pages of the scene: facts and commands.
    using Beginning = std::function<document::Content()>;

    // All must outlive it.
    WorkSide(const SessionSetup& options, SceneSide& scene, AskedFiles& files, MessageLog& log, Beginning beginning)
        : options_(options), scene_(scene), files_(files), log_(log), beginning_(std::move(beginning)) {}

    // Opens the document that the options name, if they name one. What of it the session is made of is taken out.
    [[nodiscard]] Result<void> open();
    [[nodiscard]] OpenedWork& opened() { return opened_; }
    // Takes what the work begins with, once it is there, and tells what a journal has kept of it.
    void has_begun();
    void world_has_begun(const WorldObjects& now, bool is_saved) { saved_world_.begin(now, opened_.edits, is_saved); }
    // Has the state go on with the steps of the work that was opened, and of what the scene has.
    void begin_history(SessionState& state);
    // Begins the journal, unless who looks at a world alone needs none before the first edit.
    void begin_journal(const SessionState& state);

    // ---- In a step
    void save(const AskedSave& wanted, const SessionState& state, const Give& give);
    void look_at_name(const std::string& name) { news_.name_looked_at(name, document_.is_taken(name, files_)); }
    // Tells what became of saves.
    void take_outcomes();
    // Keeps up with what was done to objects, with the journal, and with what the user is told of both.
    void go_on(const SessionState& state, Nanoseconds time_ns, const Give& give);
    // Hears that the part that an activity has brought has other steps.
    void brought_has_changed() { brought_due_->store(true, std::memory_order_relaxed); }
    // Tells the state of the work, once the carved surface has changed.
    void tell(const SessionState& state);
    // Ends document and journal.
    void finish(const SessionState& state);

    [[nodiscard]] std::vector<CommandInput> take_told(bool works);
    // Returns whether there will be something to tell soon.
    [[nodiscard]] bool waits_for_the_disk() const { return news_.waits(document_.safe_up_to()); }

private:
    [[nodiscard]] bool keeps_brought(const SessionState& state) const;
    void note_edits(const WorldObjects* world, const SessionState& state, const Give& give);
    void keep_journal(const WorldObjects* world, const SessionState& state);
    void watch_journal(const SessionState& state, const Give& give);

    const SessionSetup& options_;
    SceneSide& scene_;
    AskedFiles& files_;
    MessageLog& log_;
    Beginning beginning_;
    OpenedWork opened_;  // without its solid, once that is carved
    DocumentSide document_;
    DocumentNews news_;
    SavedWorld saved_world_;
    Nanoseconds edits_noted_ns_ = 0;  // in the journal
    std::int64_t brought_place_ = 0;  // of the brought part in a document
    // It has something that the journal has not; the scene's thread says when no more.
    std::shared_ptr<std::atomic<bool>> brought_due_ = std::make_shared<std::atomic<bool>>(false);
    bool begins_journal_ = false;  // with the first edit
};

}  // namespace burin::session
