// SPDX-License-Identifier: MIT
// The files that a session is asked for: meshes, documents and pictures, where they go, and what became of them. Counts
// what is missing of what a log asked for, so that a script fails where it did not get all.
// Thread: the frame's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/image.hpp"
#include "document/document_writer.hpp"
#include "scene/surface_update.hpp"
#include "session/notices/message_log.hpp"
#include "session/record/log_outputs.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::session {

struct SessionSetup;  // session/options/session_setup.hpp

class AskedFiles {
public:
    // The log of messages must outlive it.
    AskedFiles(const SessionSetup& options, MessageLog& log);

    // Notes the line of the input that a step has come to.
    void note_line(std::size_t line) { last_line_ = line; }
    // Returns what is told before a message of something that a line of the input asked for and did not get; counts it.
    [[nodiscard]] std::string failed_on(std::size_t line);
    // Tells that what the session should leave is lost: a recording that ended, the rest of a log. It then fails at its
    // end.
    void notify_of_loss(const std::string& message);
    // Returns whether all that was asked for was done, once the session is over.
    [[nodiscard]] Result<void> outcome() const;

    // Returns whether files are written at all.
    [[nodiscard]] bool write() const { return outputs_.write(); }
    // Says where a mesh goes; one that is refused is ordered as well, since a recording counts the orders.
    void place(workpiece::ExportSurface& wanted);
    void tell(const scene::ExportOutcome& ended);

    struct DocumentPlace {
        std::string path, shown;
        bool is_current = false;  // it is the document that the session has
        bool replaces = false;    // a file that is there may go
    };
    // Says where a document of this name goes; current: the path of the one that there is, empty for none. replaces: a
    // user's file that is there may go.
    [[nodiscard]] Result<DocumentPlace> place_document(const std::string& name, const std::string& current,
                                                       bool replaces = false);
    // Returns whether a user's file has this name, that is not the document itself.
    [[nodiscard]] bool is_taken(const std::string& name, const std::string& current) const;
    void tell(const document::SaveOutcome& ended);

    // Pictures of the next frame, by their names.
    void ask_for_pictures(std::vector<Asked> wanted);
    void ask_for_picture(const std::string& name) { pictures_.push_back({name}); }
    [[nodiscard]] bool wants_pictures() const { return !pictures_.empty(); }
    // Returns those that were asked for since the last call.
    [[nodiscard]] std::vector<Asked> take_pictures() { return std::exchange(pictures_, {}); }
    // Writes a picture to the place of its name, and tells of it.
    void keep_picture(const Asked& wanted, const Result<Image>& image);

private:
    MessageLog& log_;
    SessionOutputs outputs_;
    std::string log_name_;         // of the input; empty: a user's
    std::string opened_;           // the document that a user's session began with, read to its end; empty: none
    std::vector<Asked> pictures_;  // not drawn yet
    std::size_t last_line_ = 0;    // of the log, that was seen by a step
    std::size_t failures_ = 0;     // of what a log asked for, and of the recording
};

}  // namespace burin::session
