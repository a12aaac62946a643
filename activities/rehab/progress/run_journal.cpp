// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/run_journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <utility>

#include "activities/rehab/exercise/exercise.hpp"
#include "activities/rehab/progress/withdrawal.hpp"
#include "base/append_file.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

constexpr int kJournalVersion = 1;
constexpr const char* kProgramEnded = "the program ended before the run did";
constexpr const char* kJournalExtension = ".journal";
constexpr std::uint64_t kMostJournalBytes = 256 << 20;  // a thousand squeezes are some ten

std::string line_of_run(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json without_events(Json report) {
    report.erase("events");
    return report;
}

// Takes a participant's folder for this process; returns who has it where that is another.
std::optional<session::DocumentHolder> take_folder(session::DocumentLock& lock, const fs::path& own) {
    return lock.take(own.string(), own.string());
}

// A run that waited for its start has no events, and no reason that the person is to know.
bool has_begun(const KeptRun& run) {
    const Json *const events = find_value(run.report, "/events"),
                      *const why = find_value(run.report, "/broken_off_because"),
                      *const start = find_value(run.report, "/settings/start");
    const bool waits = start != nullptr && (*start == kStarts[static_cast<std::size_t>(kStartsAsked)] ||
                                            *start == kStarts[static_cast<std::size_t>(kStartsPressed)]);
    const bool is_told = why != nullptr && why->is_string() && *why != kProgramEnded;
    return !waits || is_told || events == nullptr || !events->empty();
}

fs::path made_of(const fs::path& journal) { return fs::path(journal).replace_extension(".json"); }

// Makes a kept run of a journal; nothing where that has been done.
Result<std::optional<fs::path>> take_up(const fs::path& journal) {
    const fs::path file = made_of(journal);
    std::error_code ignored;
    std::optional<fs::path> made;
    if (!fs::exists(file, ignored)) {
        BURIN_TRY(text, read_text_file(journal, kMostJournalBytes));
        BURIN_TRY(run, run_in_journal(text, journal.string()));
        if (has_begun(run)) {
            BURIN_TRY_DO(write_run(file, run));
            made = file;
        }
    }
    if (::unlink(journal.c_str()) != 0)
        return fail(journal.string(), std::string("cannot be removed: ") + std::strerror(errno),
                    "see to its folder's permissions; its run is kept, and is not kept again");
    return made;
}

// Takes up all journals of a participant whose lock is held, and removes what a write that was cut off has left.
void take_up_of(const fs::path& own, LeftRuns& left) {
    std::vector<fs::path> journals, remnants;
    std::error_code error;
    for (fs::directory_iterator at(own, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() == kJournalExtension) journals.push_back(at->path());
        if (at->path().extension() == ".part" && at->path().filename().string().starts_with("."))
            remnants.push_back(at->path());
    }
    if (error) left.errors.push_back({"cannot be read: " + error.message(), own.string(), "see to its permissions"});
    for (const fs::path& remnant : remnants) fs::remove(remnant, error);
    std::ranges::sort(journals);
    for (const fs::path& journal : journals) {
        const Result<std::optional<fs::path>> made = take_up(journal);
        if (!made)
            left.errors.push_back(made.error());
        else if (*made)
            left.kept.push_back(**made);
    }
}

// Takes up what participants have left who have no run now and take part. except: one whose lock this process has.
void take_up_others(const fs::path& folder, const fs::path& except, LeftRuns& left) {
    const Result<Withdrawals> withdrawn = read_withdrawals(folder);
    if (!withdrawn) {
        left.errors.push_back(withdrawn.error());
        return;
    }
    std::vector<fs::path> gone;
    for (const Withdrawal& one : *withdrawn) gone.push_back(participant_folder(folder, one.participant));
    std::vector<fs::path> participants;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (at->path().filename().string().starts_with(kParticipantFolders) && at->is_directory(error) &&
            at->path().filename() != except.filename() && std::ranges::find(gone, at->path()) == gone.end())
            participants.push_back(at->path());
    std::ranges::sort(participants);
    for (const fs::path& own : participants) {
        const bool any = std::ranges::any_of(fs::directory_iterator(own, error), [](const fs::directory_entry& entry) {
            return entry.path().extension() == kJournalExtension;
        });
        if (!any) continue;  // nothing is to be locked, and so nothing is written
        session::DocumentLock lock;
        if (!take_folder(lock, own)) take_up_of(own, left);
    }
}

}  // namespace

Result<session::DocumentLock> take_participant(const fs::path& folder, unsigned participant) {
    session::DocumentLock lock;
    const auto holder = take_folder(lock, participant_folder(folder, participant));
    if (!holder) return lock;
    return fail(formatted("participant %u", participant), "has a run under way: " + text_of(*holder),
                "end that one first, or give another person's number");
}

// Syncs the journal's file in a thread of its own, once for however many lines have come meanwhile.
class RunJournal::Syncer {
public:
    explicit Syncer(int file) : file_(file), thread_([this](const std::stop_token& stop) { sync(stop); }) {}
    ~Syncer() {
        thread_.request_stop();
        thread_.join();
        ::close(file_);
    }
    Syncer(const Syncer&) = delete;
    Syncer& operator=(const Syncer&) = delete;

    [[nodiscard]] int file() const { return file_; }
    // Has what is written now brought to the disk; returns the errno of an earlier try, once.
    [[nodiscard]] int ask() {
        const std::scoped_lock lock(mutex_);
        asked_ = true;
        wake_.notify_one();
        return std::exchange(error_, 0);
    }

private:
    void sync(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, stop, [this] { return asked_; })) {
            asked_ = false;
            lock.unlock();
            const int error = ::fdatasync(file_) != 0 ? errno : 0;
            lock.lock();
            if (error != 0) error_ = error;
        }
    }

    int file_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    bool asked_ = false;
    int error_ = 0;
    std::jthread thread_;  // last: it begins when all else is there
};

RunJournal::RunJournal(fs::path journal, KeptRun run, session::DocumentLock lock, LeftRuns left)
    : journal_(std::move(journal)), run_(std::move(run)), lock_(std::move(lock)), left_(std::move(left)) {}

RunJournal::~RunJournal() = default;

Result<std::unique_ptr<RunJournal>> RunJournal::begin(const fs::path& folder, KeptRun run) {
    const fs::path own = participant_folder(folder, run.participant);
    BURIN_TRY(lock, take_participant(folder, run.participant));
    LeftRuns left;
    take_up_of(own, left);
    take_up_others(folder, own, left);
    fs::path journal = free_run_file(folder, run).replace_extension(kJournalExtension);
    const Json first{{"run_journal", kJournalVersion},
                     {"participant", run.participant},
                     {"date", run.date},
                     {"time", run.time},
                     {"hand", run.hand},
                     {"report", without_events(run.report)},
                     {"events", Json::array()}};
    const std::string text = line_of_run(first);
    BURIN_TRY_DO(write_private(journal, text));
    const int file = ::open(journal.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0)
        return fail(journal.string(), std::string("cannot be opened: ") + std::strerror(errno),
                    "see to its folder's permissions");
    std::unique_ptr<RunJournal> made(
        new RunJournal(std::move(journal), std::move(run), std::move(lock), std::move(left)));
    made->syncer_ = std::make_unique<Syncer>(file);
    return made;
}

Result<void> RunJournal::add(const Json& report, const Json& new_events) {
    const auto failed = [&](int error) {
        return fail(journal_.string(), std::string("cannot be written: ") + std::strerror(error),
                    "make room on the disk; the run goes on, and what was written before is kept");
    };
    const std::string line =
        (ends_within_line_ ? "\n" : "") + line_of_run({{"report", without_events(report)}, {"events", new_events}});
    const Appended appended = append_whole(syncer_->file(), line);
    if (appended.error != 0) {
        ends_within_line_ = ends_within_line_ || appended.has_begun;
        return failed(appended.error);
    }
    ends_within_line_ = false;
    if (const int error = syncer_->ask(); error != 0) return failed(error);
    return {};
}

Result<fs::path> RunJournal::keep(const Json& report) {
    run_.report = report;
    fs::path file = made_of(journal_);
    BURIN_TRY_DO(write_run(file, run_));
    discard();
    return file;
}

void RunJournal::discard() { ::unlink(journal_.c_str()); }

LeftRuns take_up_left_runs(const fs::path& folder) {
    LeftRuns left;
    take_up_others(folder, {}, left);
    return left;
}

Result<KeptAgain> keep_again(const fs::path& folder, const KeptRun& run, const std::string& name) {
    const fs::path own = participant_folder(folder, run.participant);
    BURIN_TRY(lock, take_participant(folder, run.participant));
    LeftRuns left;
    take_up_of(own, left);
    const fs::path file = own / ((name.empty() ? run_name(run) : name) + ".json");
    KeptRun again = run;
    std::error_code ignored;
    if (fs::exists(file, ignored)) {
        BURIN_TRY(kept, read_run(file));
        if (kept.report.at("time_s").get<double>() >= run.report.at("time_s").get<double>())
            return KeptAgain{file, false};
        for (const char* told : {"language", "comment"})  // no recording has them
            if (kept.report.contains(told) && !again.report.contains(told)) again.report[told] = kept.report.at(told);
    }
    BURIN_TRY_DO(write_run(file, again));
    return KeptAgain{file, true};
}

Result<KeptRun> run_in_journal(std::string_view text, const std::string& name) {
    const auto damaged = [&](const std::string& what) {
        return fail(name, "is no journal of a run: " + what, "take it out of the folder");
    };
    Json whole, events = Json::array();
    std::size_t torn = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        Json told = Json::parse(line, nullptr, false);
        const bool is_whole = end != std::string_view::npos && told.is_object() && told.contains("report") &&
                              told.at("report").is_object() && told.contains("events") && told.at("events").is_array();
        const auto version = told.is_object() ? told.find("run_journal") : told.end();
        if (whole.is_null()) {
            if (!told.is_object() || version == told.end() || !version->is_number_integer())
                return damaged("its first line is none of one");
            if (*version > kJournalVersion) return written_by_newer(name, "run_journal", version->get<int>(), 1);
            if (!is_whole) return damaged("its first line is not whole");
            whole = std::move(told);
        } else if (!is_whole) {
            ++torn;
        } else {
            whole["report"] = std::move(told["report"]);
            for (Json& event : told["events"]) events.push_back(std::move(event));
        }
    }
    if (whole.is_null()) return damaged("it is empty");
    Json report = std::move(whole["report"]);
    if (report.contains("ended") && report["ended"] == text_of(ExerciseEnd::not_yet)) {
        Json& why = report["broken_off_because"];
        if (!why.is_string()) why = kProgramEnded;
    }
    if (torn > 0 && report["notes"].is_array())
        report["notes"].push_back(
            formatted("%zu %s of its journal could not be read", torn, torn == 1 ? "line" : "lines"));
    report["events"] = std::move(events);
    whole["report"] = std::move(report);
    whole.erase("run_journal");
    whole.erase("events");
    return run_of_json(whole, name);
}

}  // namespace burin::activities
