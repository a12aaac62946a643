// SPDX-License-Identifier: MIT
// Tells a session what becomes of its document, as commands (session/state/asked_close.hpp): whether it is saved, how
// much of it a journal keeps, whether a file has a name that the user has given. So a recording holds what was known
// when, and its replay asks and ends as the session did.
// Thread: the frame's.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "document/document_writer.hpp"
#include "session/input/input_event.hpp"
#include "session/state/asked_close.hpp"

namespace burin::session {

class DocumentNews {
public:
    // Begins to tell. keeps: there is a journal; unsaved: of what the session begins with some is saved nowhere.
    void begin(bool keeps, bool unsaved);
    [[nodiscard]] bool tells() const { return tells_; }

    void save_ordered() { ++ordered_; }
    void save_ended(const document::SaveOutcome& ended);
    // Takes which state the work is in (compute::History::state), how many strokes can be undone there, and how many
    // changes the journal had been given by then.
    void work_is(std::uint64_t state, std::size_t strokes, std::int64_t noted);
    void journal_keeps(bool keeps) { keeps_ = keeps; }
    void name_looked_at(const std::string& name, bool taken);

    // Returns whether something is under way that will be told soon.
    [[nodiscard]] bool waits(std::int64_t safe) const {
        return tells_ && (ordered_ > ended_ || (keeps_ && kept_of(safe) < strokes_));
    }
    // Returns what is new since the last call. name: of the document's file, or the one that it would be offered; safe:
    // how many of the journal's changes are on the disk; works: the tool works now, so that its stroke is not whole.
    [[nodiscard]] std::vector<CommandInput> take(const std::string& name, bool has_file, std::int64_t safe, bool works);

private:
    [[nodiscard]] std::size_t kept_of(std::int64_t safe) const;
    struct Noted {
        std::int64_t changes = 0;
        std::size_t strokes = 0;
    };
    bool tells_ = false, keeps_ = false, failed_ = false;
    std::size_t ordered_ = 0, ended_ = 0;  // saves
    std::uint64_t state_ = 0;
    std::optional<std::uint64_t> saved_state_ = 0;  // none: it is in no file as it was at first
    std::size_t strokes_ = 0;
    std::deque<Noted> noted_;  // the newest last; those whose changes are safe but the last of them have gone
    std::optional<DocumentTold> told_;
    std::vector<CommandInput> replies_;
};

}  // namespace burin::session
