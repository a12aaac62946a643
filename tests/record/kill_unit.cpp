// SPDX-License-Identifier: MIT
// A recording that is killed in the middle (SIGKILL) keeps all that it has acknowledged, and loses at most the second
// that it has not. Told by counting ticks; no time is measured. More runs: BURIN_KILL_RUNS.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <random>

#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

constexpr std::uint64_t kBatch = 100;

// What the child tells of itself, in memory that both share and that outlives it.
struct ChildProgress {
    std::atomic<std::uint64_t> pushed{0}, acknowledged{0};
    std::atomic<bool> failed{false};
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// Records until it is killed.
[[noreturn]] void record_for_ever(const std::string& path, ChildProgress& progress) {
    test::Recording recording;
    if (!recording.begin(path)) progress.failed = true;
    while (!progress.failed) {
        for (std::uint64_t i = 0; i < kBatch; ++i) recording.ring.push(test::made_tick(++recording.last_tick, 2));
        progress.pushed = recording.last_tick;
        recording.writer->take_now();
        progress.acknowledged = recording.writer->acknowledged();
        if (recording.writer->failure()) progress.failed = true;
    }
    _exit(1);
}

int kill_runs() {
    const char* wanted = std::getenv("BURIN_KILL_RUNS");
    return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 8;
}

}  // namespace

TEST(Kill, LosesNothingThatWasAcknowledgedAndAtMostOneSecondOfTicks) {
    auto* shared = mmap(nullptr, sizeof(ChildProgress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    std::mt19937 random(20);
    std::uint64_t acknowledged_in_all = 0, unacknowledged_most = 0;
    for (int run = 0; run < kill_runs(); ++run) {
        const Workplace at;
        const std::string path = at / "a.session";
        auto* progress = new (shared) ChildProgress;
        // Somewhere in a block, in its compression, or in its transaction.
        const std::uint64_t until = random() % 6000, spins = random() % 400'000;
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) record_for_ever(path, *progress);
        while (progress->pushed < until && !progress->failed) sched_yield();
        if (run == 0 && progress->pushed > 0) {
            EXPECT_FALSE(RecordReader::open(path)) << "in use by another process";
        }
        for (std::uint64_t spin = 0; spin < spins; ++spin) std::atomic_signal_fence(std::memory_order_seq_cst);
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
        const std::uint64_t pushed = progress->pushed, acknowledged = progress->acknowledged;
        if (pushed == 0) continue;  // killed before the file was made, or while
        const auto found = test::sound_ticks(path);
        ASSERT_TRUE(found) << found.error().line();
        EXPECT_GE(*found, acknowledged);
        EXPECT_LE(*found, pushed + kBatch);
        // A block of a second has 1000 ticks; beside it the batch that was on its way.
        EXPECT_GE(*found + 1000 + 2 * kBatch, pushed);
        const auto reader = RecordReader::open(path);
        ASSERT_TRUE(reader);
        EXPECT_FALSE(reader->is_closed());
        acknowledged_in_all += acknowledged;
        unacknowledged_most = std::max(unacknowledged_most, pushed - std::min(pushed, *found));
    }
    EXPECT_GT(acknowledged_in_all, 0u) << "else nothing was tried";
    std::printf("%d runs, %llu ticks acknowledged, none lost; at most %llu unacknowledged ticks lost\n", kill_runs(),
                static_cast<unsigned long long>(acknowledged_in_all),
                static_cast<unsigned long long>(unacknowledged_most));
    munmap(shared, sizeof(ChildProgress));
}

}  // namespace burin::record
