// SPDX-License-Identifier: MIT
#include "session/live/document_news.hpp"

#include <algorithm>
#include <utility>

#include "session/state/command_table.hpp"

namespace burin::session {
namespace {

// A name of a file that is no text, or too long for an input, is shown as far as it can be.
std::string as_text(std::string name) {
    const auto is_told = [&name] { return is_sensible(CommandInput{"document", {name}}); };
    if (is_told()) return name;
    for (char& c : name)
        if (static_cast<unsigned char>(c) >= 0x80) c = '?';
    if (name.size() > kMostTextBytes) name.erase(0, name.size() - kMostTextBytes);
    return name;
}

}  // namespace

void DocumentNews::begin(bool keeps, bool unsaved) {
    tells_ = true;
    keeps_ = keeps;
    if (unsaved) saved_state_.reset();
}

void DocumentNews::save_ended(const document::SaveOutcome& ended) {
    ++ended_;
    failed_ = !ended.saved;
    if (ended.saved) saved_state_ = ended.state;
}

void DocumentNews::work_is(std::uint64_t state, std::size_t strokes, std::int64_t noted) {
    // A stroke's last changes may be noted after it has been seen.
    if (state == state_ && strokes == strokes_ && (noted_.empty() || noted_.back().changes == noted)) return;
    state_ = state;
    strokes_ = strokes;
    noted_.push_back({noted, strokes});
}

void DocumentNews::name_looked_at(const std::string& name, bool taken) {
    replies_.push_back(as_input(SaveAs{name, taken ? NameIs::taken : NameIs::free}));
}

std::size_t DocumentNews::kept_of(std::int64_t safe) const {
    std::size_t kept = 0;
    for (const Noted& one : noted_)
        if (one.changes <= safe) kept = one.strokes;
    return std::min(kept, strokes_);
}

std::vector<CommandInput> DocumentNews::take(const std::string& name, bool has_file, std::int64_t safe, bool works) {
    if (!tells_) return {};
    while (noted_.size() > 1 && noted_[1].changes <= safe) noted_.pop_front();
    DocumentTold told{.name = as_text(name), .has_file = has_file, .keeps = keeps_, .saves = ended_};
    told.is = ordered_ > ended_        ? DocumentIs::saving
              : saved_state_ == state_ ? DocumentIs::saved
              : failed_                ? DocumentIs::failed
                                       : DocumentIs::changed;
    if (keeps_) {
        told.strokes = strokes_;
        told.kept = kept_of(safe);
        if (works && told.strokes > 0) told.kept = std::min(told.kept, told.strokes - 1);
    }
    std::vector<CommandInput> commands = std::exchange(replies_, {});
    if (told_ != told) commands.push_back(as_input(TellDocument{told}));
    told_ = std::move(told);
    return commands;
}

}  // namespace burin::session
