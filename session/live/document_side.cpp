// SPDX-License-Identifier: MIT
#include "session/live/document_side.hpp"

#include <filesystem>
#include <utility>

#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/sha256.hpp"
#include "base/try.hpp"
#include "session/work/journal_folder.hpp"

namespace burin::session {
namespace {

// The name of work that has none: that of its source.
std::string name_from(const SessionSetup& options) {
    const std::string& source = options.scene.no_workpiece ? options.scene.world : options.carve.workpiece.source;
    const std::string shape = source.substr(0, source.find(':'));
    const std::string stem = shape != source ? shape : std::filesystem::path(source).stem().string();
    return (stem.empty() ? "work" : stem) + std::string(document::kEnding);
}

}  // namespace

document::DocumentWriter& DocumentSide::writer() {
    if (!writer_) writer_ = std::make_unique<document::DocumentWriter>();
    return *writer_;
}

void DocumentSide::opened(const std::string& path, const document::Version& version) {
    path_ = name_ = path;
    state_ = FileState::written;
    writer().have(path, version);
}

std::optional<DocumentHolder> DocumentSide::hold(const std::string& folder, const std::string& path) {
    lock_folder_ = folder;
    std::optional<DocumentHolder> holder = lock_.take(folder, path);
    if (holder) name_ = path;
    return holder;
}

void DocumentSide::began_with(const std::string& source) {
    std::error_code ignored;
    if (document::is_document_name(source) || !std::filesystem::is_regular_file(source, ignored)) return;
    source_digest_ = std::async(std::launch::async, [source] {
        const Result<std::vector<std::byte>> bytes = read_file(source);
        if (!bytes) return std::string();
        return sha256({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    });
}

document::SaveRequest DocumentSide::request(const Asked& wanted, AskedFiles& files, const SessionSetup& options,
                                            document::Content content) {
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(path_, ignored);
    // Where nothing was written and something is now, that is another's.
    if (state_ == FileState::failed && is_there) path_.clear();
    const bool is_gone = state_ == FileState::written && !is_there;
    const bool is_again = wanted.text.empty() || wanted.text == asked_;
    const std::string usual = !name_.empty() ? name_ : name_from(options);
    const std::string name = is_again && !name_.empty() ? name_ : !wanted.text.empty() ? wanted.text : usual;
    document::SaveRequest request{.path = name, .name = name, .content = std::move(content), .asked_by = wanted.line};
    request.content.facts.insert(origin_.begin(), origin_.end());
    if (source_digest_.valid()) request.content.facts[document::kSourceDigestFact] = source_digest_.get();
    const Result<AskedFiles::DocumentPlace> place = files.place_document(name, path_, wanted.replaces);
    if (!place) {
        request.refused = place.error();
        return request;
    }
    const bool is_of_log = !options.record.input.empty();
    request.name = place->shown;
    request.changed_alone = place->is_current && !is_gone;  // else the whole, as a new file
    request.path = place->is_current ? path_ : place->path;
    // A user's file that is there is another's, unless it was opened or written here; then it is updated.
    request.place =
        place->replaces && (is_of_log || !place->is_current) ? document::Place::replaced : document::Place::nothing;
    if (!place->is_current) {
        if (state_ == FileState::written && is_there) earlier_ = Earlier{path_, name_, asked_};
        asked_ = wanted.text;
        name_ = is_of_log ? name : request.path;
    }
    if (!request.changed_alone) state_ = FileState::asked_for;
    path_ = request.path;
    return request;
}

std::string DocumentSide::name(const SessionSetup& options) const {
    return !name_.empty() ? name_ : name_from(options);
}

bool DocumentSide::has_file() const { return !path_.empty() && state_ != FileState::failed; }

Result<void> DocumentSide::keep_journal(const std::string& folder, const SessionSetup& options,
                                        const OpenedWork& opened, document::Content beginning) {
    const std::string name = !opened.name.empty() ? opened.name : name_from(options);
    if (name_.empty()) name_ = opened.name;
    BURIN_TRY(path, new_journal(folder, name));
    beginning.facts.insert(origin_.begin(), origin_.end());
    beginning.facts[document::kJournalNameFact] = name;
    beginning.facts[document::kOpenedByFact] = options.work.opened_by;
    if (!opened.recovered.empty()) beginning.facts[document::kUnsavedFact] = "1";
    if (!opened.document.empty() && opened.version) {
        beginning.facts[document::kJournalOfFact] = absolute_path(opened.document).string();
        beginning.facts[document::kBaseIdFact] = opened.version->id;
        beginning.facts[document::kBaseSavesFact] = std::to_string(opened.version->saves);
    }
    // A journal that could not be read to its end stays where it is.
    writer().keep_journal(std::move(path), std::move(beginning), opened.lost.empty() ? opened.journal : "");
    return {};
}

std::string DocumentSide::end_journal(bool discards) {
    return writer_ ? writer_->end_journal(discards) : std::string();
}

std::vector<document::SaveOutcome> DocumentSide::take_outcomes() {
    std::vector<document::SaveOutcome> outcomes;
    if (writer_) outcomes = writer_->take_outcomes();
    for (const document::SaveOutcome& ended : outcomes) {
        if (ended.path != path_) continue;
        if (ended.saved) static_cast<void>(lock_.take(lock_folder_, path_));
        const std::optional<Earlier> earlier = std::exchange(earlier_, std::nullopt);
        if (ended.saved) {
            state_ = FileState::written;
        } else if (earlier) {
            path_ = earlier->path;
            name_ = earlier->name;
            asked_ = earlier->asked;
            state_ = FileState::written;
        } else if (state_ == FileState::asked_for) {
            state_ = FileState::failed;
        }
    }
    return outcomes;
}

void DocumentSide::finish() {
    if (writer_) writer_->finish();
}

}  // namespace burin::session
