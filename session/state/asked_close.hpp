// SPDX-License-Identifier: MIT
// What a session is told of its document from outside, and what it asks its user: whether the window may close over
// unsaved work, and under which name the work is to be saved.
//
//   writer, files -> DocumentNews -> command `document` ->  state  -> panel: title, line, question
//   quit, the window's cross      -> ask_or_quit()      ->  state  <- quit save|discard|stay, save, save-as
//
// All of it comes as commands, so that a recording replays it. Where nobody tells (a script, a log) nobody is asked.
// Pure functions on the session's state; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace burin::session {

struct SessionState;
struct SessionOrders;

enum class DocumentIs : std::uint8_t { saved, changed, saving, failed };  // failed: changed, the last save went wrong

// What is known of the document.
struct DocumentTold {
    DocumentIs is = DocumentIs::saved;
    std::string name = "work.burin";  // its file's; of work that has none, the one that it would be offered
    bool has_file = false;
    bool keeps = true;  // a journal keeps what is not saved
    // Strokes and edits that can be undone; the first so many are on the disk, in the journal.
    std::size_t strokes = 0, kept = 0;
    std::size_t saves = 0;  // that have ended, well or not
    bool operator==(const DocumentTold&) const = default;
};
[[nodiscard]] std::span<const std::string_view> document_states();  // in the order of DocumentIs
// Returns the name without its folders.
[[nodiscard]] std::string short_name(const DocumentTold& told);
// Says for a window's title and the panel what the document is: "saved", "changed", "saving...".
[[nodiscard]] std::string state_text(const DocumentTold& told);
// Says what of the unsaved work would come back after a crash: "kept: up to stroke 11 of 12". step: what undo takes
// back, "stroke".
[[nodiscard]] std::string kept_text(const DocumentTold& told, const std::string& step);

// How far the session's end is.
enum class Closing : std::uint8_t {
    no,
    asked,   // the user is asked what becomes of the work
    saving,  // it ends when the work is saved
};

// What is known of a file's name that the user has given. replaced: the file that has it may go.
enum class NameIs : std::uint8_t { given, free, taken, replaced };
[[nodiscard]] std::span<const std::string_view> name_states();  // in the order of NameIs
// The name under which the work is to be saved.
struct Naming {
    std::string name;
    NameIs is = NameIs::given;
    bool looks = false;  // whether there is a file of that name
    bool operator==(const Naming&) const = default;
};

// What a session's user is asked about the document.
struct AskedClose {
    std::optional<DocumentTold> told;  // none: nobody tells, and nobody is asked
    Closing closing = Closing::no;
    std::size_t saves_before = 0;  // ended, when closing began to wait for one
    std::optional<Naming> naming;  // lies before the question of closing
    double rests_s = 3600.0;       // since the tool worked: what it did then may not be known yet
};

// Ends the session; where there is unsaved work, asks first.
void ask_or_quit(SessionState& state);
// Saves the work and ends the session once it is saved.
void save_and_quit(SessionState& state, SessionOrders& orders);
// Goes on with the session.
void stay(SessionState& state);
// Takes what is told. A session that waits for its save ends with it, or stays where that failed.
void take_told(SessionState& state, const DocumentTold& told);
// Saves the work where it lies; work without a file is given a name first, where somebody can.
void save_or_name(SessionState& state, SessionOrders& orders);
// Opens the field for a name, or closes it.
void open_or_close_naming(SessionState& state);
// Saves under a name. Where a user is asked, its place is looked at first (given), and the answer comes with the same
// name: nothing is there (free), or another's file (taken), and then the user is asked whether it may be replaced.
void save_as(SessionState& state, SessionOrders& orders, const std::string& name, NameIs is);
// Orders a save; replaces: a file that lies there may go.
void order_save(SessionState& state, SessionOrders& orders, const std::string& name, bool replaces);

}  // namespace burin::session
