// SPDX-License-Identifier: MIT
// Memory that an emulator and the emulated library share: who owns a device, and who may take a name; and the priority
// of servo threads.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "devices/drivers/library_beside.hpp"
#include "devices/presence/hd_shared.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {
namespace {

std::string own_memory() { return "emulated-test-" + std::to_string(::getpid()) + "-memory"; }

// A process that has ended.
std::uint32_t dead_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return static_cast<std::uint32_t>(child);
}

void beat(HdShared& shared) {
    MonotonicClock clock;
    shared.beat_ns = clock.now_ns();
    shared.magic = HdShared::kMagic;
}

}  // namespace

TEST(EmulatedMemory, OneOfThoseWhoAskAtOnceOwnsTheDevice) {
    constexpr int kRaces = 2000, kThreads = 4;
    std::atomic<std::uint32_t> owner = 0;
    std::atomic<int> taken = 0, ready = 0, race = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i)
        threads.emplace_back([&] {
            for (int own = 1; own <= kRaces; ++own) {
                ++ready;
                while (race.load() < own) std::this_thread::yield();
                taken += take_ownership(owner) ? 1 : 0;
            }
        });
    for (int turn = 1; turn <= kRaces; ++turn) {
        while (ready.load() < turn * kThreads) std::this_thread::yield();
        EXPECT_EQ(taken.load(), turn - 1) << "one of each race before";
        owner = 0;
        race = turn;
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(taken.load(), kRaces);
    EXPECT_EQ(owner.load(), static_cast<std::uint32_t>(::getpid()));
}

TEST(EmulatedMemory, OneThatHasDiedIsNoOwnerAndOneThatLivesIs) {
    std::atomic<std::uint32_t> owner = dead_process();
    EXPECT_TRUE(take_ownership(owner));
    EXPECT_FALSE(take_ownership(owner)) << "this process has it";
    owner = 1;  // the first process of the system
    EXPECT_FALSE(take_ownership(owner));
}

TEST(EmulatedMemory, AnEmulatorStartsAtOnceWhereOneOfItsNameWasKilled) {
    auto killed = HdSharedMemory::create(own_memory());
    ASSERT_TRUE(killed);
    beat(**killed);  // and never again: it was killed right after
    EXPECT_TRUE(HdSharedMemory::create(own_memory()));
}

TEST(EmulatedMemory, AnEmulatorIsRefusedWhereOneOfItsNameLives) {
    auto living = HdSharedMemory::create(own_memory());
    ASSERT_TRUE(living);
    beat(**living);
    std::atomic<bool> ends = false;
    std::thread beats([&] {
        MonotonicClock clock;
        while (!ends) {
            beat(**living);
            clock.sleep_until(clock.now_ns() + 1'000'000);
        }
    });
    EXPECT_FALSE(HdSharedMemory::create(own_memory()));
    ends = true;
    beats.join();
}

TEST(EmulatedLibrary, ThatIsMissingIsNoReasonToInstallAMakersLibrary) {
    const auto missing = library_chosen("device", false, "", "emulated", "libburin_emulated_nothing.so", "libHD.so");
    ASSERT_FALSE(missing);
    EXPECT_TRUE(missing.error().line().contains("libburin_emulated_nothing.so is not beside the program"));
    EXPECT_FALSE(missing.error().line().contains("install")) << missing.error().line();
    EXPECT_EQ(library_chosen("device", false, "", "0", "x", "libHD.so"), "libHD.so");
    EXPECT_EQ(library_chosen("device", true, "/a/l.so", "emulated", "x", "libHD.so"), "/a/l.so");
    const auto empty = library_chosen("device", true, "", "0", "x", "libHD.so");
    ASSERT_FALSE(empty);
    EXPECT_TRUE(empty.error().line().contains("names no library behind @")) << empty.error().line();
}

TEST(ServoPriority, IsRealTimeWhereTheSystemGrantsItAndAsBeforeWhereNot) {
    bool is_granted = false;
    int policy = -1;
    std::thread([&] {
        is_granted = ask_for_servo_priority();
        sched_param priority{};
        ::pthread_getschedparam(::pthread_self(), &policy, &priority);
    }).join();
    EXPECT_EQ(policy == SCHED_FIFO, is_granted);
}

}  // namespace burin::devices
