// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/kept_run.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/measures/hand_measures.hpp"
#include "activities/rehab/progress/withdrawal.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 1;
constexpr std::uint64_t kMostBytes = 8 << 20;  // hours of events

std::string folder_name(unsigned participant) { return kParticipantFolders + formatted("%03u", participant); }

fs::path folder_of(const fs::path& folder, unsigned participant) { return folder / folder_name(participant); }

// Two or four digits, as a date and a time have them.
std::optional<unsigned> digits(std::string_view text, std::size_t from, std::size_t count) {
    if (text.size() < from + count) return std::nullopt;
    const std::string_view part = text.substr(from, count);
    if (!std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; })) return std::nullopt;
    unsigned value = 0;
    std::from_chars(part.data(), part.data() + part.size(), value);
    return value;
}

std::optional<std::chrono::sys_days> calendar_day(std::string_view date) {
    const auto year = digits(date, 0, 4), month = digits(date, 5, 2), day = digits(date, 8, 2);
    if (date.size() != 10 || date[4] != '-' || date[7] != '-' || !year || !month || !day) return std::nullopt;
    const std::chrono::year_month_day known{std::chrono::year(static_cast<int>(*year)), std::chrono::month(*month),
                                            std::chrono::day(*day)};
    return known.ok() ? std::optional(std::chrono::sys_days(known)) : std::nullopt;
}

bool is_time(std::string_view time) {
    const auto hour = digits(time, 0, 2), minute = digits(time, 3, 2), second = digits(time, 6, 2);
    return time.size() == 8 && time[2] == ':' && time[5] == ':' && hour && minute && second && *hour < 24 &&
           *minute < 60 && *second < 61;
}

const Json* text_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? &*found : nullptr;
}

// Checks that a report has all that the page reads of it; the rest may be anything.
bool is_report(const Json& report) {
    if (!report.is_object() || text_at(report, "exercise") == nullptr || text_at(report, "ended") == nullptr)
        return false;
    for (const char* key : {"score", "time_s"})
        if (const Json* const value = find_value(report, std::string("/") + key); !value || !value->is_number())
            return false;
    for (const char* key : {"settings", "counts"})
        if (const Json* const value = find_value(report, std::string("/") + key); !value || !value->is_object())
            return false;
    const double score = report.at("score").get<double>(), time_s = report.at("time_s").get<double>();
    if (!(score >= 0.0 && score <= 100.0) || !(time_s >= 0.0 && time_s < 1e6)) return false;
    const ExerciseKind* const kind = exercise_named(report.at("exercise").get<std::string>());
    const Json* const level = find_value(report, "/settings/level");
    if (kind == nullptr) return false;
    if (levels_of(kind->name) > 0) {
        if (level == nullptr || !level->is_number()) return false;
        const double number = level->get<double>();
        if (!(number >= 1.0 && number <= levels_of(kind->name)) || number != std::floor(number)) return false;
    }
    const Json* const fingers = find_value(report, "/fingers");
    return fingers != nullptr && fingers->is_array() && !fingers->empty() &&
           std::ranges::all_of(*fingers, [](const Json& finger) {
               const Json* const name = finger.is_object() ? text_at(finger, "finger") : nullptr;
               return name != nullptr &&
                      std::ranges::find(kFingerNames, name->get<std::string>()) != kFingerNames.end();
           });
}

}  // namespace

Result<void> check_date(const std::string& date) {
    if (calendar_day(date)) return {};
    return fail("date " + date, "is none", "write it as 2026-11-03");
}

int day_of(const std::string& date) {
    const auto day = calendar_day(date);
    BURIN_CHECK(day.has_value());
    return day ? static_cast<int>(day->time_since_epoch().count()) : 0;
}

std::unexpected<Error> written_by_newer(const std::string& name, const char* key, int version, int known) {
    return fail(name,
                formatted("was written by a newer version of this program: \"%s\" is %d, and this one reads %d", key,
                          version, known),
                "open the folder with that version; here it stays as it is");
}

Result<KeptRun> run_of_json(const Json& json, const std::string& name) {
    const auto other = [&](const char* what) {
        return fail(name, std::string("is no run of an exercise: ") + what, "take it out of the folder");
    };
    if (!json.is_object()) return other("it is no object");
    const auto participant = json.find("participant");
    if (participant == json.end() || !participant->is_number_unsigned() || *participant < 1u ||
        *participant > KeptRun::kMostParticipants)
        return other("its participant is none");
    const Json *const date = text_at(json, "date"), *const time = text_at(json, "time"),
                      *const hand = text_at(json, "hand");
    if (date == nullptr || time == nullptr || hand == nullptr) return other("date, time or hand are missing");
    KeptRun run{
        participant->get<unsigned>(), date->get<std::string>(), time->get<std::string>(), hand->get<std::string>(), {}};
    if (!calendar_day(run.date) || !is_time(run.time)) return other("its date or its time is none");
    const auto report = json.find("report");
    if (report == json.end() || !is_report(*report)) return other("its report is not whole");
    run.report = *report;
    return run;
}

Result<KeptRun> read_run(const fs::path& path) {
    BURIN_TRY(text, read_text_file(path, kMostBytes));
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded())
        return fail(path.string(), "is cut or damaged: it is not whole JSON", "mend it, or take it out of the folder");
    const auto version = json.is_object() ? json.find("run") : json.end();
    if (version != json.end() && version->is_number_integer() && *version > kVersion)
        return written_by_newer(path.string(), "run", version->get<int>(), kVersion);
    if (json.is_object() && (version == json.end() || !version->is_number_integer() || *version != kVersion))
        return fail(path.string(), "is no run of an exercise: it has no number \"run\" that is 1",
                    "take it out of the folder");
    Result<KeptRun> run = run_of_json(json, path.string());
    if (run && path.parent_path().filename().string() != folder_name(run->participant))
        return fail(path.string(), "is no run of an exercise: it is of a participant whose folder is another",
                    "take it out of the folder");
    return run;
}

fs::path participant_folder(const fs::path& folder, unsigned participant) { return folder_of(folder, participant); }

std::string run_name(const KeptRun& run) {
    std::string moment = run.date + "T" + run.time;
    std::ranges::replace(moment, ':', '-');
    return moment + "-" + run.report.at("exercise").get<std::string>();
}

fs::path free_run_file(const fs::path& folder, const KeptRun& run) {
    const std::string name = run_name(run);
    const fs::path own = folder_of(folder, run.participant);
    fs::path path = own / (name + ".json");
    std::error_code ignored;
    const auto is_taken = [&] {
        return fs::exists(path, ignored) || fs::exists(fs::path(path).replace_extension(".journal"), ignored);
    };
    for (int n = 2; is_taken(); ++n) path = own / formatted("%s-%d.json", name.c_str(), n);
    return path;
}

Result<void> write_run(const fs::path& file, const KeptRun& run) {
    const std::string text = json_text({{"run", kVersion},
                                        {"participant", run.participant},
                                        {"date", run.date},
                                        {"time", run.time},
                                        {"hand", run.hand},
                                        {"report", run.report}});
    return write_private(file, text);
}

Result<void> prepare_results(const fs::path& folder, unsigned participant) {
    const fs::path own = folder_of(folder, participant);
    std::error_code error;
    const fs::path above = fs::absolute(folder, error).parent_path();
    if (!fs::is_directory(folder, error) && !fs::is_directory(above, error))
        return fail(folder.string(), "would stand in " + above.string() + ", which is no folder",
                    "make that first, or see whether the name is right");
    const bool is_new = !fs::exists(folder, error);
    fs::create_directories(own, error);
    if (error) return fail(own.string(), "cannot be made: " + error.message(), "name a folder that you may write to");
    // A folder that there was stays as its owner wants it; the participant's is made for the results in any case.
    if (is_new) BURIN_TRY_DO(make_private(folder));
    BURIN_TRY_DO(make_private(own));
    return check_writable(own / "a-run.json");
}

Result<fs::path> keep_run(const fs::path& folder, const KeptRun& run) {
    fs::path path = free_run_file(folder, run);
    BURIN_TRY_DO(write_run(path, run));
    return path;
}

Result<KeptRuns> read_runs(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return fail(folder.string(), "is no folder of results", "name the folder that --results was given");
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && at != end; at.increment(error)) {
        if (at.depth() >= 1) at.disable_recursion_pending();
        if (at.depth() == 1 && at->path().extension() == ".json" &&
            at->path().parent_path().filename().string().starts_with(kParticipantFolders))
            files.push_back(at->path());
    }
    if (error) return fail(folder.string(), "cannot be read: " + error.message(), "see to its permissions");
    // Runs of one second have the same name with a number behind it, which rises with each.
    std::ranges::sort(files, {}, [](const fs::path& file) {
        const std::string name = file.stem().string();
        return std::tuple(file.parent_path(), name.size(), name);
    });
    KeptRuns kept;
    for (const fs::path& file : files) {
        Result<KeptRun> run = read_run(file);
        const auto is_same = [&](const KeptRun& other) {
            return run && other.participant == run->participant && other.date == run->date && other.time == run->time &&
                   other.report == run->report;
        };
        if (!run)
            kept.errors.push_back(run.error());
        else if (std::ranges::any_of(kept.runs, is_same))
            kept.errors.push_back({"is a copy of another run", file.string(), "take it out of the folder"});
        else
            kept.runs.push_back(std::move(*run));
    }
    std::ranges::stable_sort(kept.runs, {},
                             [](const KeptRun& run) { return std::tuple(run.participant, run.date, run.time); });
    return kept;
}

}  // namespace burin::activities
