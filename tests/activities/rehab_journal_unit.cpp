// SPDX-License-Identifier: MIT
// Runs that are kept while they are under way: what is taken up of a program that was killed, and never twice.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "activities/rehab/progress/run_journal.hpp"
#include "activities/rehab/progress/withdrawal.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

Json report_after(unsigned squeezes, const std::string& ended = "broken off") {
    return {{"exercise", "ball"},
            {"settings", {{"colour", "red"}, {"level", 1.0}}},
            {"ended", ended},
            {"broken_off_because", Json()},
            {"score", 20.0 * squeezes},
            {"time_s", 3.5 * squeezes},
            {"counts", {{"repetitions", squeezes}}},
            {"notes", Json::array()},
            {"fingers", Json::array({{{"finger", "thumb"}, {"peak_force_N", 1.0 + squeezes}}})},
            {"events", Json::array({"all of them, which a line leaves out"})}};
}

Json event_of(unsigned squeeze) {
    return {{"what", "counted"}, {"time_s", 3.5 * squeeze}, {"force_N", 2.0 + 0.25 * squeeze}};
}

// A disk that takes no more than so many bytes of a file; as one does that is full, it takes what it can of a write.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        signal_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit before_{};
    void (*signal_)(int) = nullptr;
};

class RunJournals : public testing::Test {
protected:
    void SetUp() override {
        fs::remove_all(folder);
        for (const unsigned participant : {7u, 8u}) ASSERT_TRUE(prepare_results(folder, participant));
    }
    void TearDown() override { fs::remove_all(folder); }

    [[nodiscard]] std::unique_ptr<RunJournal> begun(unsigned participant) const {
        auto journal = RunJournal::begin(folder, {participant, "2026-11-03", "10:15:00", "glove:4", report_after(0)});
        EXPECT_TRUE(journal) << journal.error().line();
        return journal ? std::move(*journal) : nullptr;
    }
    // Leaves the journal of a run of so many squeezes whose program has died.
    void leave(unsigned squeezes) const {
        const auto journal = begun(7);
        for (unsigned i = 1; i <= squeezes; ++i) ASSERT_TRUE(journal->add(report_after(i), Json::array({event_of(i)})));
    }
    [[nodiscard]] std::string text() const {
        std::ifstream in(journal, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(const std::string& text) const { std::ofstream(journal, std::ios::binary) << text; }
    // Returns the only run that the folder holds.
    [[nodiscard]] KeptRun only_run() const {
        const auto kept = read_runs(folder);
        EXPECT_TRUE(kept && kept->errors.empty() && kept->runs.size() == 1);
        return kept && kept->runs.size() == 1 ? kept->runs.front() : KeptRun{};
    }
    const fs::path folder = fs::temp_directory_path() / ("burin-journals-" + std::to_string(::getpid()));
    const fs::path own = folder / "participant-007", journal = own / "2026-11-03T10-15-00-ball.journal",
                   file = own / "2026-11-03T10-15-00-ball.json";
};

}  // namespace

TEST_F(RunJournals, OfDeadProgramsBecomeRunsAsFarAsTheyCameAndOnce) {
    leave(3);
    ASSERT_TRUE(fs::exists(journal));
    const LeftRuns left = take_up_left_runs(folder);
    ASSERT_TRUE(left.errors.empty());
    ASSERT_EQ(left.kept.size(), 1u);
    EXPECT_EQ(left.kept.front(), file);
    EXPECT_FALSE(fs::exists(journal));
    const KeptRun run = only_run();
    EXPECT_EQ(run.participant, 7u);
    EXPECT_EQ(run.date + " " + run.time + " " + run.hand, "2026-11-03 10:15:00 glove:4");
    EXPECT_EQ(run.report.at("ended"), "broken off");
    EXPECT_EQ(run.report.at("broken_off_because"), "the program ended before the run did");
    EXPECT_EQ(run.report.at("score"), 60.0);
    EXPECT_EQ(run.report.at("counts").at("repetitions"), 3);
    EXPECT_EQ(run.report.at("events"), Json::array({event_of(1), event_of(2), event_of(3)}));
    EXPECT_TRUE(take_up_left_runs(folder).kept.empty());
    EXPECT_EQ(only_run().report, run.report);
}

// What was begun and nothing more is a visit as well.
TEST_F(RunJournals, AreThereFromTheBeginningOfARun) {
    leave(0);
    EXPECT_EQ(take_up_left_runs(folder).kept.size(), 1u);
    EXPECT_EQ(only_run().report.at("time_s"), 0.0);
    EXPECT_EQ(only_run().report.at("events"), Json::array());
}

TEST_F(RunJournals, OfARunThatWaitedForItsStartLeaveNothing) {
    for (const char* start : {"asked", "pressed"}) {
        Json report = report_after(0);
        report["settings"]["start"] = start;
        ASSERT_TRUE(RunJournal::begin(folder, {7, "2026-11-03", "10:15:00", "glove:4", report}));
        ASSERT_TRUE(fs::exists(journal));
        EXPECT_TRUE(take_up_left_runs(folder).kept.empty());
        EXPECT_FALSE(fs::exists(journal) || fs::exists(file)) << start;
        report["broken_off_because"] = "it was stopped";
        ASSERT_TRUE(RunJournal::begin(folder, {7, "2026-11-03", "10:15:00", "glove:4", report}));
        EXPECT_EQ(take_up_left_runs(folder).kept.size(), 1u) << "somebody has stopped it";
        fs::remove(file);
    }
}

TEST_F(RunJournals, AndTheirRunsAreTheirOwnersAlone) {
    const auto of_others = fs::perms::group_all | fs::perms::others_all;
    const auto journal_of_run = begun(7);
    EXPECT_EQ(fs::status(journal).permissions() & of_others, fs::perms::none);
    const auto path = journal_of_run->keep(report_after(1, "done"));
    ASSERT_TRUE(path);
    EXPECT_EQ(fs::status(*path).permissions() & of_others, fs::perms::none);
    EXPECT_EQ(fs::status(own).permissions() & of_others, fs::perms::none);
}

TEST_F(RunJournals, OfWhoHasWithdrawnAreTakenUpNoMoreAndErasedWithTheRest) {
    leave(2);
    ASSERT_TRUE(withdraw(folder, 7, "2026-11-04", false));
    EXPECT_TRUE(take_up_left_runs(folder).kept.empty());
    EXPECT_TRUE(fs::exists(journal)) << "it stays, as the runs do";
    ASSERT_TRUE(withdraw(folder, 7, "2026-11-04", true));
    EXPECT_FALSE(fs::exists(own)) << "with the journal and the note of who had the lock";
    for (const auto& file : fs::recursive_directory_iterator(folder))
        EXPECT_FALSE(file.path().string().contains("participant-007")) << file.path();
}

TEST_F(RunJournals, KeepTheirParticipantFromBeingErasedWhileTheRunGoesOn) {
    auto running = begun(7);
    const auto refused = withdraw(folder, 7, "2026-11-04", true);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().starts_with("participant 7: has a run under way: process "))
        << refused.error().line();
    EXPECT_TRUE(read_withdrawals(folder).value().empty()) << "and nothing is told of it";
    ASSERT_TRUE(running->keep(report_after(1, "done")));
    running.reset();
    EXPECT_TRUE(withdraw(folder, 7, "2026-11-04", true));
}

TEST_F(RunJournals, GiveWayToTheWholeRunAndAreNoSecondOne) {
    leave(2);
    const std::string remnant = text();
    {
        const auto next = begun(7);  // takes up what was left, and has a name beside it
        EXPECT_EQ(next->left().kept.size(), 1u);
        EXPECT_EQ(next->name(), "2026-11-03T10-15-00-ball-2");
        const auto path = next->keep(report_after(5, "done"));
        ASSERT_TRUE(path) << path.error().line();
        EXPECT_EQ(path->filename(), "2026-11-03T10-15-00-ball-2.json");
    }
    ASSERT_EQ(read_runs(folder)->runs.size(), 2u);
    write(remnant);  // as if it had been killed between the file and the journal's end
    const LeftRuns again = take_up_left_runs(folder);
    EXPECT_TRUE(again.kept.empty());
    EXPECT_TRUE(again.errors.empty());
    EXPECT_FALSE(fs::exists(journal));
    EXPECT_EQ(read_runs(folder)->runs.size(), 2u);
}

TEST_F(RunJournals, WithATornLineTellAllThatCameBeforeIt) {
    leave(3);
    const std::string whole = text();
    const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
    for (const std::size_t kept : {last, last + 1, (last + whole.size()) / 2, whole.size() - 1}) {
        fs::remove(file);
        write(whole.substr(0, kept));
        ASSERT_EQ(take_up_left_runs(folder).kept.size(), 1u) << kept;
        EXPECT_EQ(only_run().report.at("score"), 40.0) << kept;
        EXPECT_EQ(only_run().report.at("events"), Json::array({event_of(1), event_of(2)}));
        EXPECT_EQ(only_run().report.at("notes").size(), kept == last ? 0u : 1u) << kept;
    }
}

TEST_F(RunJournals, OnADiskThatIsFullKeepWhatWasWrittenAndGoOnWhereThereIsRoomAgain) {
    {
        const auto run = begun(7);
        ASSERT_TRUE(run->add(report_after(1), Json::array({event_of(1)})));
        {
            const FullDisk full(fs::file_size(journal) + 40);
            const auto refused = run->add(report_after(2), Json::array({event_of(2)}));
            ASSERT_FALSE(refused);
            EXPECT_TRUE(refused.error().line().contains(journal.string())) << refused.error().line();
            EXPECT_TRUE(refused.error().line().contains("make room")) << refused.error().line();
        }
        EXPECT_FALSE(text().ends_with('\n')) << "a part of the line is there";
        ASSERT_TRUE(run->add(report_after(3), Json::array({event_of(2), event_of(3)})));
    }
    ASSERT_EQ(take_up_left_runs(folder).kept.size(), 1u);
    EXPECT_EQ(only_run().report.at("score"), 60.0);
    EXPECT_EQ(only_run().report.at("events"), Json::array({event_of(1), event_of(2), event_of(3)}));
    fs::remove(file);
    const FullDisk full(10);
    const auto refused = RunJournal::begin(folder, {7, "2026-11-03", "10:15:00", "glove:4", report_after(0)});
    ASSERT_FALSE(refused);
    EXPECT_FALSE(fs::exists(journal));
}

TEST_F(RunJournals, ThatCannotBecomeFilesStayForTheNextTime) {
    leave(2);
    const std::string whole = text();
    {
        const FullDisk full(10);
        const LeftRuns left = take_up_left_runs(folder);
        EXPECT_TRUE(left.kept.empty());
        ASSERT_EQ(left.errors.size(), 1u);
        EXPECT_TRUE(left.errors.front().line().contains(file.string())) << left.errors.front().line();
    }
    EXPECT_EQ(text(), whole);
    EXPECT_EQ(take_up_left_runs(folder).kept.size(), 1u);
    EXPECT_EQ(only_run().report.at("score"), 40.0);
}

TEST_F(RunJournals, OfAParticipantAreOneAtATimeAndNobodyElseTakesThemUp) {
    const auto run = begun(7);
    const auto second = RunJournal::begin(folder, {7, "2026-11-03", "10:16:00", "glove:5", report_after(0)});
    ASSERT_FALSE(second);
    EXPECT_TRUE(second.error().line().contains("participant 7")) << second.error().line();
    EXPECT_TRUE(second.error().line().contains("process " + std::to_string(::getpid()))) << second.error().line();
    EXPECT_TRUE(second.error().line().contains("end that one first")) << second.error().line();
    const auto other = begun(8);
    EXPECT_TRUE(other->left().kept.empty());
    EXPECT_TRUE(other->left().errors.empty());
    EXPECT_TRUE(take_up_left_runs(folder).kept.empty());
    EXPECT_TRUE(fs::exists(journal));
}

TEST_F(RunJournals, OfANewerVersionAreToldAndStay) {
    leave(1);
    std::string newer = text();
    newer.replace(newer.find("\"run_journal\":1"), 15, "\"run_journal\":2");
    write(newer);
    const LeftRuns left = take_up_left_runs(folder);
    ASSERT_EQ(left.errors.size(), 1u);
    EXPECT_TRUE(left.errors.front().line().contains("newer version")) << left.errors.front().line();
    EXPECT_EQ(text(), newer);
    fs::remove(journal);
    leave(1);
    ASSERT_EQ(take_up_left_runs(folder).kept.size(), 1u);
    std::ifstream in(file, std::ios::binary);
    std::string run{std::istreambuf_iterator<char>(in), {}};
    run.replace(run.find("\"run\": 1"), 8, "\"run\": 2");
    std::ofstream(file, std::ios::binary) << run;
    const auto kept = read_runs(folder);
    ASSERT_TRUE(kept);
    ASSERT_EQ(kept->errors.size(), 1u);
    EXPECT_TRUE(kept->errors.front().line().contains("newer version")) << kept->errors.front().line();
    EXPECT_TRUE(kept->errors.front().line().contains("open the folder with that version"));
}

TEST_F(RunJournals, GiveWayToARecordingThatHasComeFartherAndToNoOther) {
    leave(2);
    ASSERT_EQ(take_up_left_runs(folder).kept.size(), 1u);
    KeptRun again{7, "2026-11-03", "10:15:00", "glove:4", report_after(4)};
    const auto farther = keep_again(folder, again, "2026-11-03T10-15-00-ball");
    ASSERT_TRUE(farther) << farther.error().line();
    EXPECT_TRUE(farther->is_new);
    EXPECT_EQ(farther->file, file);
    EXPECT_EQ(only_run().report.at("score"), 80.0);
    again.report = report_after(3);
    EXPECT_FALSE(keep_again(folder, again, "2026-11-03T10-15-00-ball")->is_new);
    EXPECT_EQ(only_run().report.at("score"), 80.0);
}

}  // namespace burin::activities
