// SPDX-License-Identifier: MIT
// The document of a live session: which file it is, what is saved into it, and what became of that.
//
// Data flow: a command -> request(), which finds the place -> the scene's thread takes the pages of all parts between
// two updates -> the writer's thread -> take_outcomes() -> messages.
// Thread: the frame's.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "document/document_writer.hpp"
#include "session/live/asked_files.hpp"
#include "session/work/document_lock.hpp"
#include "session/work/opened_work.hpp"

namespace burin::session {

class DocumentSide {
public:
    // Takes the document that was opened: a save without a name goes there, where the session may write to it.
    void opened(const std::string& path, const document::Version& version);
    // Takes a document for this session, as far as its user's other sessions are concerned. Returns who has it already:
    // then it is only read, and a save wants another name.
    [[nodiscard]] std::optional<DocumentHolder> hold(const std::string& folder, const std::string& path);
    // Takes the facts of a document that say from where the work came.
    void came_from(std::map<std::string, std::string> origin) { origin_ = std::move(origin); }
    // Works out the SHA-256 of the file that the work began with, beside the session, for the facts; a shape has none,
    // and a document tells its origin.
    void began_with(const std::string& source);

    // Returns the name of the document's file, or of work that has none the one that it would get.
    [[nodiscard]] std::string name(const SessionSetup& options) const;
    [[nodiscard]] bool has_file() const;  // or is about to have it
    // Returns whether another file has this name, which the document is to get.
    [[nodiscard]] bool is_taken(const std::string& name, const AskedFiles& files) const {
        return files.is_taken(name, path_);
    }

    // Keeps a journal of the work in the folder. beginning: all as it is now. The work is what was opened, if it was.
    [[nodiscard]] Result<void> keep_journal(const std::string& folder, const SessionSetup& options,
                                            const OpenedWork& opened, document::Content beginning);
    // Ends the journal. Returns its path where it holds what was not saved; discards: that is not wanted.
    [[nodiscard]] std::string end_journal(bool discards);
    // Returns what to save, but for the pages of the scene, to the place that was asked for: a name, or empty for the
    // document's own.
    [[nodiscard]] document::SaveRequest request(const Asked& wanted, AskedFiles& files, const SessionSetup& options,
                                                document::Content content);
    [[nodiscard]] std::vector<document::SaveOutcome> take_outcomes();
    // Waits until all is written.
    void finish();
    [[nodiscard]] document::DocumentWriter& writer();
    // See DocumentWriter; 0 before its first use.
    [[nodiscard]] std::int64_t safe_up_to() const { return writer_ ? writer_->safe_up_to() : 0; }
    [[nodiscard]] std::int64_t noted() const { return writer_ ? writer_->noted() : 0; }

private:
    // What is known of the document at its place. failed: nothing has been written there.
    enum class FileState : std::uint8_t { asked_for, written, failed };

    std::unique_ptr<document::DocumentWriter> writer_;  // since the first use
    std::string path_, name_;                           // of the document; empty: it has none yet
    std::string asked_;                                 // the name that led to that place; empty: none was given
    FileState state_ = FileState::asked_for;
    // The document that there was when a save elsewhere was asked for, which stays the session's should that fail.
    struct Earlier {
        std::string path, name, asked;
    };
    std::optional<Earlier> earlier_;
    std::map<std::string, std::string> origin_;  // facts
    std::shared_future<std::string> source_digest_;
    DocumentLock lock_;
    std::string lock_folder_;  // empty: nobody is told who has the document
};

}  // namespace burin::session
