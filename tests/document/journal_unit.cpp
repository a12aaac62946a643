// SPDX-License-Identifier: MIT
// A journal keeps what was not saved: after a kill (SIGKILL) all that it acknowledged is there. More runs:
// BURIN_KILL_RUNS (scripts/soak-document).
#include "document/journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

#include "base/clock.hpp"
#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "document/log_check.hpp"
#include "record/database.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> numbered(std::int64_t number, std::size_t size) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::byte>((static_cast<std::uint64_t>(number) * 2654435761u >> (i % 4 * 8)) + i / 7);
    return bytes;
}

Content beginning() {
    Content content{.facts = {{kJournalNameFact, "work.burin"}}};
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"tile", 0}, numbered(0, 5000)}};
    return content;
}

Change change(std::int64_t number) {
    return {.part = 0, .pages = {.part = "a thing", .whole = false, .pages = {{{"rays", 0}, numbered(number, 3000)}}}};
}

// Counts the changes that are there, all sound and in their order; -1: one is not.
std::int64_t sound_changes(const std::string& path) {
    Result<DocumentReader> reader = DocumentReader::open(path);
    if (!reader) return -1;
    for (std::int64_t number = 1; number <= reader->changes(); ++number) {
        const Result<scene::Pages> found = reader->change(reader->parts().at(0), number);
        if (!found || found->pages.at({"rays", 0}) != numbered(number, 3000)) return -1;
    }
    return reader->changes();
}

// What the child tells of itself, in memory that both share and that outlives it.
struct WriterProgress {
    std::atomic<std::int64_t> noted{0}, safe{0};
};

// Notes changes until it is killed.
[[noreturn]] void work_for_ever(const std::string& path, WriterProgress& progress) {
    DocumentWriter writer;
    writer.keep_journal(path, beginning());
    for (std::int64_t number = 1;; ++number) {
        writer.note(change(number));
        progress.noted = number;
        while (number - writer.safe_up_to() > 20) sched_yield();
        progress.safe = writer.safe_up_to();
    }
}

// Waits for a state. Who waits longer than any machine takes has waited for nothing.
bool comes(const std::function<bool()>& is_there) {
    constexpr Nanoseconds kLongest_ns = 30'000'000'000;
    MonotonicClock clock;
    for (const Nanoseconds end_ns = clock.now_ns() + kLongest_ns; !is_there(); sched_yield())
        if (clock.now_ns() > end_ns) return false;
    return true;
}

int journal_kill_runs() {
    const char* wanted = std::getenv("BURIN_KILL_RUNS");
    return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 8;
}

}  // namespace

TEST(Journal, LosesNothingThatWasAcknowledgedWhenItIsKilled) {
    auto* shared = mmap(nullptr, sizeof(WriterProgress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    std::mt19937 random(48);
    std::int64_t acknowledged_in_all = 0, unacknowledged_most = 0;
    Nanoseconds longest_ns = 0;
    MonotonicClock clock;
    for (int run = 0; run < journal_kill_runs(); ++run) {
        const Workplace at;
        const std::string path = at / "work-1.burin";
        auto* progress = new (shared) WriterProgress;
        const auto until = static_cast<std::int64_t>(random() % 200);
        const std::uint64_t spins = random() % 400'000;
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) work_for_ever(path, *progress);
        EXPECT_TRUE(comes([&] { return progress->noted >= until; }));
        for (std::uint64_t spin = 0; spin < spins; ++spin) std::atomic_signal_fence(std::memory_order_seq_cst);
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
        const std::int64_t noted = progress->noted, acknowledged = progress->safe;
        if (acknowledged == 0) continue;  // killed before anything was promised
        const Nanoseconds before_ns = clock.now_ns();
        const std::int64_t found = sound_changes(path);
        longest_ns = std::max(longest_ns, clock.now_ns() - before_ns);
        EXPECT_GE(found, acknowledged);
        EXPECT_LE(found, noted + 1);
        const auto left = left_journals((at / "").string());
        ASSERT_EQ(left.size(), 1u);
        EXPECT_EQ(left[0].name, "work.burin");
        acknowledged_in_all += acknowledged;
        unacknowledged_most = std::max(unacknowledged_most, noted - std::min(noted, found));
    }
    EXPECT_GT(acknowledged_in_all, 0) << "else nothing was tried";
    std::printf(
        "%d runs, %lld changes acknowledged, none lost; at most %lld unacknowledged lost; read again in %.0f ms "
        "at most\n",
        journal_kill_runs(), static_cast<long long>(acknowledged_in_all), static_cast<long long>(unacknowledged_most),
        1e-6 * static_cast<double>(longest_ns));
    munmap(shared, sizeof(WriterProgress));
}

TEST(Journal, GoesWithASaveAndIsThereForWhatFollows) {
    const Workplace at;
    const std::string path = at / "journals-1.burin", work = at / "work.burin";
    {
        DocumentWriter writer;
        writer.keep_journal(path, beginning());
        for (std::int64_t number = 1; number <= 3; ++number) writer.note(change(number));
        Content saved = beginning();
        saved.facts.clear();
        writer.save({.path = work, .name = "work.burin", .content = std::move(saved)});
        writer.finish();
        EXPECT_EQ(writer.safe_up_to(), 3);
        EXPECT_TRUE(writer.take_outcomes().at(0).saved);
        EXPECT_EQ(writer.end_journal(false), "") << "all is saved";
        EXPECT_FALSE(fs::exists(path));
    }
    DocumentWriter writer;
    writer.keep_journal(path, beginning());
    writer.note(change(1));
    Content saved = beginning();
    saved.facts.clear();
    writer.save({.path = work, .name = "work.burin", .content = std::move(saved), .place = Place::replaced});
    writer.note(change(2));
    EXPECT_EQ(writer.end_journal(false), path);
    const auto left = left_journals((at / "").string());
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].of, work);
    const Result<DocumentReader> reader = DocumentReader::open(work);
    ASSERT_TRUE(reader);
    EXPECT_EQ((Version{left[0].base_id, left[0].base_saves}), reader->version());
    Result<DocumentReader> journal = DocumentReader::open(path);
    ASSERT_TRUE(journal);
    ASSERT_EQ(journal->changes(), 1) << "the one before it is saved";
    EXPECT_EQ(journal->change(journal->parts()[0], 1)->pages.at({"rays", 0}), numbered(2, 3000));
}

TEST(Journal, WithoutAnythingUnsavedOrDiscardedIsRemoved) {
    const Workplace at;
    const std::string path = at / "journals-1.burin";
    DocumentWriter writer;
    writer.keep_journal(path, beginning());
    writer.finish();
    EXPECT_TRUE(fs::exists(path));
    EXPECT_EQ(writer.end_journal(false), "");
    EXPECT_FALSE(fs::exists(path));
    writer.keep_journal(path, beginning());
    writer.note(change(1));
    EXPECT_EQ(writer.end_journal(true), "");
    EXPECT_FALSE(fs::exists(path));
}

// SQLite reads a log up to the first fault: what follows would be gone without a word, and the journal with it.
TEST(Journal, WhoseLogIsDamagedIsKeptAndTold) {
    const Workplace at;
    const std::string path = at / "work-1.burin", folder = at / "left", copy = folder + "/work-1.burin";
    fs::create_directory(folder);
    DocumentWriter writer;
    writer.keep_journal(path, beginning());
    for (std::int64_t number = 1; number <= 3; ++number) {
        writer.note(change(number));
        writer.finish();
    }
    const std::string file = at.read("work-1.burin"), log = at.read("work-1.burin-wal");
    ASSERT_GT(log.size(), 20000u);
    const auto left_with = [&](const std::string& damaged) {
        at.write("left/work-1.burin", file);
        at.write("left/work-1.burin-wal", damaged);
        fs::remove(copy + "-shm");
        return is_log_damaged(copy);
    };
    EXPECT_FALSE(left_with(log));
    EXPECT_EQ(sound_changes(copy), 3);
    for (int part = 0; part < 40; ++part) {
        std::string damaged = log;
        damaged[damaged.size() * static_cast<std::size_t>(part) / 40 + 11] ^= 16;
        EXPECT_TRUE(left_with(damaged)) << part;
        const auto reader = DocumentReader::open(copy);
        const bool is_known = reader && reader->facts().contains(kJournalNameFact);  // else its beginning is lost
        const auto journals = left_journals(folder);
        ASSERT_EQ(journals.size(), 1u) << part;
        EXPECT_EQ(journals[0].unreadable.empty(), is_known) << part;
        EXPECT_TRUE(fs::exists(copy) && fs::exists(copy + "-wal")) << part;
    }
    // A transaction that a kill cut off had not been ended, so that nothing that was acknowledged is missing.
    EXPECT_FALSE(left_with(log.substr(0, log.size() - 100)));
    EXPECT_FALSE(left_with(log.substr(0, 32)));
    EXPECT_FALSE(left_with(""));
}

TEST(Journal, ThatCannotBeReadIsToldAndStays) {
    const Workplace at;
    at.write("work-1.burin", std::string(5000, 'x'));
    at.write("work-" + std::to_string(::getpid()) + ".burin", "");
    DocumentWriter living;
    living.keep_journal(at / "work-3.burin", beginning());
    living.finish();
    const auto left = left_journals((at / "").string());
    ASSERT_EQ(left.size(), 1u) << "the second is about to be written, and the third is a living session's";
    EXPECT_EQ(left[0].path, (at / "work-1.burin").string());
    EXPECT_TRUE(left[0].unreadable.contains("not an SQLite file")) << left[0].unreadable;
    EXPECT_EQ(at.read("work-1.burin").size(), 5000u);
}

TEST(Journal, ThatWasTakenAwayIsToldAtTheEnd) {
    const Workplace at;
    DocumentWriter writer;
    writer.keep_journal(at / "work-1.burin", beginning());
    writer.note(change(1));
    writer.finish();
    fs::remove(at / "work-1.burin");
    EXPECT_EQ(writer.end_journal(false), "");
    const auto news = writer.take_journal_news();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_TRUE(news[0].failed && news[0].failed->line().contains("is not there any more")) << news[0].failed->line();
}

// Without its log a file says nothing of its newest changes: somebody may yet find it.
TEST(Journal, WhoseLogIsNotBesideItIsKept) {
    const Workplace at;
    const std::string path = at / "work-1.burin";
    Content unsaved = beginning();
    unsaved.facts[kUnsavedFact] = "1";
    {
        DocumentWriter writer;
        writer.keep_journal(path, unsaved);
        EXPECT_EQ(writer.end_journal(false), path);
    }
    const std::string all_saved = "DELETE FROM meta WHERE key = '" + std::string(kUnsavedFact) + "'; ";
    for (const bool had_log : {true, false}) {
        auto database = record::Database::open(path, record::Database::Use::write);
        ASSERT_TRUE(database);
        ASSERT_TRUE(
            database->run(all_saved + (had_log ? "PRAGMA journal_mode = WAL" : "PRAGMA journal_mode = DELETE")));
        ASSERT_TRUE(database->close());
        ASSERT_FALSE(fs::exists(path + "-wal"));
        static_cast<void>(left_journals((at / "").string()));
        EXPECT_EQ(fs::exists(path), had_log) << "one at rest, of which all is saved, goes";
    }
}

// The one that it goes on from is the only copy until then.
TEST(Journal, TakesThePlaceOfTheOneBeforeOnceItIsThere) {
    const Workplace at;
    const std::string before = at / "before-1.burin", later = at / "later/work-1.burin";
    for (const char* const ending : {"", "-wal", "-shm"}) at.write("before-1.burin" + std::string(ending), "mine");
    DocumentWriter writer({}, std::chrono::milliseconds(1));
    Content unsaved = beginning();
    unsaved.facts[kUnsavedFact] = "1";
    writer.keep_journal(later, unsaved, before);
    for (int round = 0; round < 2; ++round) {  // the first try, and that of all that is asked for later
        writer.finish();
        for (const char* const ending : {"", "-wal", "-shm"})
            EXPECT_EQ(at.read("before-1.burin" + std::string(ending)), "mine") << ending << " in round " << round;
        ASSERT_TRUE(comes([&] { return writer.wants_all(); }));
        if (round == 1) fs::create_directory(at / "later");
        writer.begin_anew(unsaved);
    }
    writer.finish();
    for (const char* const ending : {"", "-wal", "-shm"}) EXPECT_FALSE(fs::exists(before + ending)) << ending;
    EXPECT_EQ(writer.end_journal(false), later) << "it has what nobody has saved";
}

// ---- A disk that refuses

namespace {

class JournalOnABadDisk : public testing::Test {
protected:
    void SetUp() override { disk.reset(); }
    void TearDown() override { disk.reset(); }
    // Waits for what the writer finds by itself; some news that is a failure where it finds nothing.
    static std::vector<JournalNews> next_news(DocumentWriter& writer) {
        std::vector<JournalNews> news;
        if (!comes([&] { return !(news = writer.take_journal_news()).empty(); })) news.resize(1);
        return news;
    }
    void fill_up_before_a_change(DocumentWriter& writer) {
        writer.keep_journal(path, beginning());
        writer.finish();
        disk.is_full = true;
        writer.note(change(1));
        writer.finish();
        EXPECT_TRUE(next_news(writer)[0].failed);
    }
    [[nodiscard]] bool tries_again(int count) const {
        return comes([this, wanted = disk.writes + count] { return disk.writes >= wanted; });
    }
    static Content now(std::int64_t number) {
        Content content = beginning();
        content.parts[0].pages = {{{"tile", 0}, numbered(number, 5000)}};
        return content;
    }
    static constexpr auto kAgain = std::chrono::milliseconds(1);
    record::test::FailingDisk& disk = record::test::failing_disk();
    Workplace at;
    const std::string path = at / "work-1.burin", work = at / "work.burin";
};

}  // namespace

TEST_F(JournalOnABadDisk, IsTriedAgainUntilItHasAll) {
    DocumentWriter writer(disk.kName, kAgain);
    writer.keep_journal(path, beginning());
    writer.note(change(1));
    writer.finish();
    EXPECT_EQ(writer.safe_up_to(), 1);
    disk.is_full = true;
    for (std::int64_t number = 2; number <= 5; ++number) writer.note(change(number));
    writer.finish();
    const auto failed = next_news(writer);
    ASSERT_EQ(failed.size(), 1u);
    EXPECT_TRUE(failed[0].failed && failed[0].failed->line().contains("the disk is full"));
    ASSERT_TRUE(tries_again(3));
    EXPECT_TRUE(writer.take_journal_news().empty()) << "it is told once";
    EXPECT_EQ(writer.safe_up_to(), 1);
    disk.is_full = false;
    const auto back = next_news(writer);
    ASSERT_EQ(back.size(), 1u);
    EXPECT_FALSE(back[0].failed);
    EXPECT_EQ(writer.safe_up_to(), 5);
    writer.note(change(6));
    EXPECT_EQ(writer.end_journal(false), path);
    EXPECT_TRUE(writer.take_journal_news().empty());
    EXPECT_EQ(sound_changes(path), 6);
}

TEST_F(JournalOnABadDisk, BeginsAnewWithAllWhereTooMuchWouldHaveToBeKept) {
    DocumentWriter writer(disk.kName, kAgain, 20'000);
    writer.keep_journal(path, beginning());
    writer.note(change(1));
    writer.finish();
    disk.is_full = true;
    for (std::int64_t number = 2; number <= 20; ++number) {
        writer.note(change(number));
        writer.finish();
    }
    EXPECT_TRUE(next_news(writer)[0].failed);
    ASSERT_TRUE(comes([&] { return writer.wants_all(); }));
    writer.begin_anew(now(20));
    writer.finish();
    EXPECT_TRUE(writer.take_journal_news().empty()) << "the disk is still full";
    EXPECT_EQ(writer.safe_up_to(), 1);
    disk.is_full = false;
    ASSERT_TRUE(comes([&] { return writer.wants_all(); }));
    writer.begin_anew(now(20));
    EXPECT_FALSE(next_news(writer)[0].failed);
    EXPECT_EQ(writer.safe_up_to(), 20);
    writer.note(change(1));
    EXPECT_EQ(writer.end_journal(false), path);
    EXPECT_EQ(sound_changes(path), 1);
    Result<DocumentReader> reader = DocumentReader::open(path);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->pages(reader->parts().at(0))->pages.at({"tile", 0}), numbered(20, 5000));
    EXPECT_EQ(left_journals((at / "").string()).size(), 1u);
}

TEST_F(JournalOnABadDisk, IsWrittenAtTheEndWhereThereIsRoomByThen) {
    DocumentWriter writer(disk.kName, std::chrono::hours(1));
    fill_up_before_a_change(writer);
    disk.is_full = false;
    EXPECT_EQ(writer.end_journal(false), path);
    EXPECT_EQ(sound_changes(path), 1);
}

TEST_F(JournalOnABadDisk, SaysAtTheEndThatTheNewestStrokesAreNowhere) {
    DocumentWriter writer(disk.kName, std::chrono::hours(1));
    fill_up_before_a_change(writer);
    EXPECT_EQ(writer.end_journal(false), "");
    const auto lost = next_news(writer);
    ASSERT_TRUE(lost[0].failed);
    EXPECT_TRUE(lost[0].failed->line().contains("in no file")) << lost[0].failed->line();
}

// Its folder comes later, as a disk that is plugged in.
TEST_F(JournalOnABadDisk, ThatCouldNotBeginBeginsWhenItCanAndKnowsWhatWasSaved) {
    const std::string later = at / "later/work-1.burin";
    DocumentWriter writer(disk.kName, kAgain);
    writer.keep_journal(later, beginning());
    writer.note(change(1));
    writer.save({.path = work, .name = "work.burin", .content = beginning()});
    writer.finish();
    EXPECT_TRUE(next_news(writer)[0].failed);
    EXPECT_EQ(writer.safe_up_to(), 1) << "in the document";
    EXPECT_TRUE(writer.take_outcomes().at(0).saved);
    writer.note(change(2));
    writer.finish();
    EXPECT_EQ(writer.safe_up_to(), 1);
    fs::create_directory(at / "later");
    ASSERT_TRUE(comes([&] { return writer.wants_all(); }));
    writer.begin_anew(now(2));
    EXPECT_FALSE(next_news(writer)[0].failed);
    EXPECT_EQ(writer.safe_up_to(), 2);
    EXPECT_EQ(writer.end_journal(false), later);
    const auto left = left_journals((at / "later").string());
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].of, work);
    const Result<DocumentReader> reader = DocumentReader::open(work);
    ASSERT_TRUE(reader);
    EXPECT_EQ((Version{left[0].base_id, left[0].base_saves}), reader->version());
}

}  // namespace burin::document
