// SPDX-License-Identifier: MIT
#include "session/live/document_side.hpp"

#include <filesystem>

#include "base/file_io.hpp"
#include "base/sha256.hpp"
#include "session/document/journal_folder.hpp"

namespace burin::session {
namespace {

// The name of work that has none: that of its source.
std::string name_from(const SculptOptions& options) {
    const std::string& source = options.workpiece.source;
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
    writer().have(path, version);
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

document::SaveRequest DocumentSide::request(const Asked& wanted, AskedFiles& files, const SculptOptions& options,
                                            document::Content content) {
    const std::string name = !wanted.text.empty() ? wanted.text : !name_.empty() ? name_ : name_from(options);
    document::SaveRequest request{.path = name, .name = name, .content = std::move(content), .asked_by = wanted.line};
    request.content.facts.insert(origin_.begin(), origin_.end());
    if (source_digest_.valid()) request.content.facts[document::kSourceDigestFact] = source_digest_.get();
    const Result<AskedFiles::DocumentPlace> place = files.place_document(name, path_);
    if (!place) {
        request.refused = place.error();
        return request;
    }
    request.name = place->shown;
    request.changed_alone = place->is_current;
    request.path = place->is_current ? path_ : place->path;
    request.place = place->replaces ? document::Place::replaced : document::Place::nothing;
    path_ = request.path;
    if (!request.changed_alone) name_ = name;
    return request;
}

Result<void> DocumentSide::keep_journal(const std::string& folder, const SculptOptions& options,
                                        const OpenedWork& opened, document::Content beginning) {
    const std::string name = !opened.name.empty() ? opened.name : name_from(options);
    if (name_.empty()) name_ = opened.name;
    Result<std::string> path = new_journal(folder, name);
    if (!path) return std::unexpected(path.error());
    beginning.facts.insert(origin_.begin(), origin_.end());
    beginning.facts[document::kJournalNameFact] = name;
    if (!opened.recovered.empty()) beginning.facts[document::kUnsavedFact] = "1";
    if (!opened.document.empty() && opened.version) {
        beginning.facts[document::kJournalOfFact] = std::filesystem::absolute(opened.document).string();
        beginning.facts[document::kBaseIdFact] = opened.version->id;
        beginning.facts[document::kBaseSavesFact] = std::to_string(opened.version->saves);
    }
    // A journal that could not be read to its end stays where it is.
    writer().keep_journal(std::move(*path), std::move(beginning), opened.lost.empty() ? opened.journal : "");
    return {};
}

std::string DocumentSide::end_journal(bool discards) {
    return writer_ ? writer_->end_journal(discards) : std::string();
}

std::vector<document::SaveOutcome> DocumentSide::take_outcomes() {
    return writer_ ? writer_->take_outcomes() : std::vector<document::SaveOutcome>{};
}

void DocumentSide::finish() {
    if (writer_) writer_->finish();
}

}  // namespace burin::session
