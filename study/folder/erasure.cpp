// SPDX-License-Identifier: MIT
// Withdrawal from a study, and what of a participant is erased then (docs/study.md, "The folder").
#include <algorithm>
#include <span>
#include <system_error>

#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/try.hpp"
#include "study/assign/allocation.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::study {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostReportBytes = std::uint64_t{256} << 20;

// Whether a file holds a participant's code as a word of its own.
bool tells_of(const fs::path& file, const std::string& id) {
    const auto bytes = read_file(file, kMostReportBytes);
    if (!bytes) return true;  // nobody knows
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const auto in_code = [&](std::size_t at) {
        return at < text.size() && kLettersOfCodes.find(text[at]) != std::string_view::npos;
    };
    for (std::size_t at = text.find(id); at != std::string_view::npos; at = text.find(id, at + 1))
        if (!in_code(at - 1) && !in_code(at + id.size())) return true;
    return false;
}

// Whether any file below a report does.
bool tells_below(const fs::path& report, const std::string& id) {
    std::error_code error;
    const auto tells = [&](const fs::path& file) { return fs::is_regular_file(file, error) && tells_of(file, id); };
    if (!fs::is_directory(report, error)) return tells(report);
    const auto files = entries_below(report);
    return !files || std::ranges::any_of(*files, tells);  // nobody knows what a folder that cannot be read holds
}

// Reports in which a participant occurs, and the pictures, any of which may be drawn of its motion.
std::vector<fs::path> derived_of(const fs::path& study, const std::string& id) {
    std::error_code error;
    std::vector<fs::path> derived;
    for (const fs::path& report : entries_of(study / "reports").value_or(std::vector<fs::path>()))
        if (tells_below(report, id)) derived.push_back(report);
    if (fs::exists(study / "pictures", error)) derived.push_back(study / "pictures");
    return derived;
}

}  // namespace

// How many places of each stratum's list are taken, in the order of combinations(). What was erased is counted as it
// was told when it was.
std::vector<std::size_t> StudyFolder::places_taken() const {
    const auto all = combinations(protocol_.strata);
    std::vector<std::size_t> taken(all.size(), 0);
    for (const JournalEntry& entry : journal_.entries) {
        const auto told = entry.value.find("places_taken");
        if (told == entry.value.end() || !told->is_array()) continue;
        for (std::size_t s = 0; s < std::min(taken.size(), told->size()); ++s)
            if ((*told)[s].is_number_unsigned()) taken[s] = std::max(taken[s], (*told)[s].get<std::size_t>());
    }
    for (const Participant& p : participants())
        for (std::size_t s = 0; s < all.size(); ++s)
            if (p.stratum == stratum_label(all[s])) taken[s] = std::max(taken[s], p.position);
    return taken;
}

Result<std::vector<std::string>> StudyFolder::withdraw(const std::string& id, bool erase) {
    const std::vector<Participant> all = participants();
    const auto found = std::ranges::find(all, id, &Participant::id);
    if (found == all.end()) return fail(id, "is not in this study", "burin study status lists who is");
    std::error_code error;
    const bool is_left = found->has_words || fs::exists(path_ / "data" / id, error);
    if (found->withdrawn && (!erase || (found->erased && !is_left)))
        return fail(id, "has withdrawn already", erase ? "nothing is left to erase" : "add --erase to erase its data");
    if (erase && fs::is_symlink(path_ / "data" / id, error))
        return fail((path_ / "data" / id).string(), "is a link, so that the data themselves would stay",
                    "put the folder in the link's place, or erase it by hand where it is");
    // Told before it is done: what a power cut leaves is erased when it is asked for again.
    if (!found->erased) {
        Json entry{{"event", "withdrawn"}, {"participant", id}, {"erase", erase}};
        if (erase) entry["places_taken"] = places_taken();
        BURIN_TRY_DO(note(std::move(entry)));
    }
    return erase ? this->erase(id) : Result<std::vector<std::string>>();
}

Result<std::vector<std::string>> StudyFolder::erase(const std::string& id) {
    const auto failed = [](const fs::path& file, const std::error_code& error) {
        return fail(file.string(), "cannot be erased: " + error.message(), "delete it by hand");
    };
    std::error_code error;
    fs::remove_all(path_ / "data" / id, error);
    if (error) return failed(path_ / "data" / id, error);
    fs::remove(path_ / "trials.csv", error);
    if (error) return failed(path_ / "trials.csv", error);
    std::vector<std::string> deleted;
    for (const fs::path& derived : derived_of(path_, id)) {
        fs::remove_all(derived, error);
        if (error) return failed(derived, error);
        deleted.push_back(derived.lexically_relative(path_).string());
    }
    BURIN_TRY_DO(erase_words(id));
    return deleted;
}

// The journal is written anew, whole or not at all; its chain and its last digest stay.
Result<void> StudyFolder::erase_words(const std::string& id) {
    BURIN_TRY(text, read_text_file(path_ / "journal.jsonl", kMostJournalBytes));
    const std::string kept = without_words(text, id);
    const std::span<const char> bytes(kept.data(), kept.size());
    BURIN_TRY_DO(write_file_atomically(path_ / "journal.jsonl", std::as_bytes(bytes)));
    journal_ = parse_journal(kept);
    return {};
}

}  // namespace burin::study
