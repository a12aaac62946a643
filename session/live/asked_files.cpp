// SPDX-License-Identifier: MIT
#include "session/live/asked_files.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "picture/png.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/input_files.hpp"
#include "session/work/opened_work.hpp"

namespace burin::session {
namespace {

// Says on the terminal where a file lies, if the message does not, and that another one was there.
std::string where_it_lies(const std::string& message, const std::string& path, bool replaced) {
    const std::string place = message.ends_with(" " + path) ? "" : path;
    const std::string instead = replaced ? "in place of the file that was there" : "";
    if (place.empty() && instead.empty()) return {};
    return " (" + place + (place.empty() || instead.empty() ? "" : ", ") + instead + ")";
}

}  // namespace

AskedFiles::AskedFiles(const SessionSetup& options, MessageLog& log)
    : log_(log), outputs_(options, inputs_of(options).list()), log_name_(options.record.input) {
    if (log_name_.empty()) opened_ = document_of(options);
}

void AskedFiles::place(workpiece::ExportSurface& wanted) {
    const auto placed = outputs_.new_place_of(wanted.path, OutputKind::mesh);
    if (!placed) {
        wanted.refused = placed.error();
        return;
    }
    wanted.name = outputs_.shown(wanted.path, *placed);
    wanted.path = placed->string();
}

void AskedFiles::tell(const scene::ExportOutcome& ended) {
    if (ended.written) {
        log_.notify(ended.message, MessageKind::info, {{}, where_it_lies(ended.message, ended.path, ended.replaced)});
    } else if (outputs_.refuse_meshes()) {
        log_.notify(ended.message);
    } else {
        log_.notify(ended.message, MessageKind::error, {failed_on(ended.asked_by), {}});
    }
}

Result<AskedFiles::DocumentPlace> AskedFiles::place_document(const std::string& asked, const std::string& current,
                                                             bool replaces) {
    const bool of_log = outputs_.are_of_log();
    // A name that a user has typed may lead anywhere; when the recording of that is done again it stays in the folder.
    const bool leads_out = of_log && !check_output_name(asked, OutputKind::document);
    const std::string name = leads_out ? std::filesystem::path(asked).filename().string() : asked;
    // A user's own document is an input as well, and yet what is saved goes there.
    if (!of_log && !outputs_.refuse_meshes() && is_same_file(name, current))
        return DocumentPlace{current, outputs_.shown(name, current), true, true};
    // The document that was opened is an input, and may be replaced by what came of it, if that is the answer.
    if (replaces && !outputs_.refuse_meshes() && is_same_file(name, opened_))
        return DocumentPlace{opened_, outputs_.shown(name, opened_), false, true};
    Result<std::filesystem::path> place = outputs_.place_of(name, OutputKind::document);
    if (!place) return std::unexpected(place.error());
    const bool is_current = is_same_file(*place, current);
    if (!is_current && !replaces) place = outputs_.new_place_of(name, OutputKind::document);
    if (!place) return std::unexpected(place.error());
    return DocumentPlace{place->string(), outputs_.shown(name, *place), is_current, of_log || replaces};
}

bool AskedFiles::is_taken(const std::string& name, const std::string& current) const {
    if (outputs_.are_of_log() || is_same_file(name, current)) return false;
    if (is_same_file(name, opened_)) return true;
    const Result<std::filesystem::path> place = outputs_.place_of(name, OutputKind::document);
    std::error_code ignored;
    return place && std::filesystem::exists(*place, ignored);
}

void AskedFiles::tell(const document::SaveOutcome& ended) {
    if (ended.saved) {
        const std::string message = "saved " + ended.name;
        const bool is_new = ended.saved->version.saves == 1;  // else it was the document itself
        log_.notify_of_event(message, MessageKind::info,
                             {{}, where_it_lies(message, ended.path, is_new && ended.saved->replaced)});
    } else if (outputs_.refuse_meshes()) {
        log_.notify_of_event(ended.saved.error().line());
    } else {
        log_.notify_of_event(ended.saved.error().line(), MessageKind::error, {failed_on(ended.asked_by), {}});
    }
}

void AskedFiles::keep_picture(const Asked& wanted, const Result<Image>& image) {
    const auto place = image ? outputs_.new_place_of(wanted.text, OutputKind::picture) : std::unexpected(image.error());
    std::error_code ignored;
    const bool was_there = place && std::filesystem::exists(*place, ignored);
    const auto written = place ? picture::write_png(*place, *image) : std::unexpected(place.error());
    if (written) {
        const std::string message = "wrote " + outputs_.shown(wanted.text, *place);
        log_.notify_of_event(message, MessageKind::info, {{}, where_it_lies(message, place->string(), was_there)});
    } else {
        log_.notify_of_event(written.error().line(), MessageKind::error, {failed_on(wanted.line), {}});
    }
}

std::string AskedFiles::failed_on(std::size_t line) {
    if (log_name_.empty()) return {};
    ++failures_;
    return line == 0 ? log_name_ + ": " : log_name_ + ":" + std::to_string(line) + ": ";
}

void AskedFiles::notify_of_loss(const std::string& message) {
    const std::string where = failed_on(last_line_);
    if (where.empty()) ++failures_;
    log_.notify(message, MessageKind::error, {where, {}});
}

Result<void> AskedFiles::outcome() const {
    if (failures_ == 0) return {};
    return fail(log_name_.empty() ? "the session" : log_name_,
                failures_ == 1 ? "one thing that was asked for is missing"
                               : std::to_string(failures_) + " things that were asked for are missing",
                "see above what, and why");
}

void AskedFiles::ask_for_pictures(std::vector<Asked> wanted) {
    if (outputs_.write()) std::ranges::move(wanted, std::back_inserter(pictures_));
}

}  // namespace burin::session
