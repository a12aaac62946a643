// SPDX-License-Identifier: MIT
// What a session begins with that was saved before, and what it leaves: a document's solid, objects, tool, settings and
// view.
// Frames: object, metres; the view is world_from_object. Any thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/engine/history.hpp"
#include "document/document_reader.hpp"
#include "scene/world_file.hpp"
#include "session/options/session_setup.hpp"
#include "session/state/session_state.hpp"
#include "workpiece/loaded_workpiece.hpp"
#include "workpiece/workpiece_options.hpp"

namespace burin::session {

struct OpenedWork {
    std::optional<workpiece::LoadedWorkpiece> workpiece = {};               // none: a document of a world without one
    std::optional<scene::World> world = {};                                 // of a document
    std::vector<std::shared_ptr<const scene::CornerColours>> colours = {};  // of the files of its objects
    std::string lost = {};  // what of a document was damaged, in words; empty: nothing
    // What was done to a document's work, where that was asked for: strokes, edits of objects, and their order.
    std::optional<compute::History> history = {};
    WorldHistory edits = {};
    document::History order = {};
    std::optional<Similarity> view = {};             // of a document
    std::string document = {};                       // where a save goes; empty: the work has no file yet
    std::optional<document::Version> version = {};   // of that document
    std::string journal = {};                        // that a dead session left and this is; empty: it is none
    std::string recovered = {};                      // what was not saved and is here, in words; empty: nothing
    std::vector<std::string> kept = {};              // says which other unsaved work of it there is, a line each
    std::string name = {};                           // of work from a journal; empty: that of its source
    std::map<std::string, std::string> origin = {};  // the facts of a document that say from where it came
};

// Returns whether the source of a workpiece is a document.
[[nodiscard]] bool is_document(const workpiece::WorkpieceOptions& options);

// Returns the document that the options are of, in workpiece or world; empty: of none.
[[nodiscard]] std::string document_of(const SessionSetup& options);
// Has the options be of all that their document holds, a workpiece, a world or both, whichever of them they name. Fails
// where it cannot be read.
[[nodiscard]] Result<void> settle_document(SessionSetup& options);

// Opens a document with all that it holds. It needs no file but itself. undo_bytes: the memory for what led to its
// solid; 0: that is not wanted.
[[nodiscard]] Result<OpenedWork> open_document(const std::string& path, std::size_t undo_bytes = 0);
// Opens the workpiece of a document, which must hold one.
[[nodiscard]] Result<OpenedWork> open_workpiece_of(const std::string& document, std::size_t undo_bytes = 0);

// Takes over from the document, which is the options' workpiece, what it says of tool, material and mirror, where the
// options leave it open. Changes nothing where the workpiece is no document.
[[nodiscard]] Result<void> take_settings_of_document(SessionSetup& options);

// Returns the commands that bring tool, material and mirror of a session back.
[[nodiscard]] std::vector<std::string> saved_commands(const SessionState& state);
// Returns the facts that a document needs besides them.
// Empty bounds: there is no workpiece.
[[nodiscard]] std::map<std::string, std::string> saved_facts(const SessionSetup& options, const SessionState& state,
                                                             const Box& workpiece_object);

}  // namespace burin::session
