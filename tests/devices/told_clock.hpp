// SPDX-License-Identifier: MIT
// A clock that stands until somebody moves it: a test, or a thread that sleeps by it and finds itself awake at its
// deadline. So what a device does in a quarter of a second is seen turn by turn, however busy the machine is.
#pragma once

#include <atomic>

#include "base/clock.hpp"

namespace burin::devices {

// Any thread.
class ToldClock final : public Clock {
public:
    // Begins at a second, since 0 stands for never in many places.
    explicit ToldClock(Nanoseconds begins_ns = kNanosecondsPerSecond) : now_ns_(begins_ns) {}

    [[nodiscard]] Nanoseconds now_ns() noexcept override { return now_ns_.load(); }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        Nanoseconds now_ns = now_ns_.load();
        while (now_ns < deadline_ns && !now_ns_.compare_exchange_weak(now_ns, deadline_ns)) {
        }
    }
    void move_on(Nanoseconds by_ns) { now_ns_ += by_ns; }

private:
    std::atomic<Nanoseconds> now_ns_;
};

// Told time in which a thread takes as many turns as a test says, each of which it begins by a sleep. Between them the
// thread rests: two that turn as fast as they can would leave the test no core.
class TurnsClock final : public Clock {
public:
    [[nodiscard]] Nanoseconds now_ns() noexcept override { return told_.now_ns(); }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        for (int left = turns_left_.load(); left == 0; left = turns_left_.load()) turns_left_.wait(0);
        if (turns_left_.load() > 0) {
            --turns_left_;
            turns_left_.notify_all();
        }
        told_.sleep_until(deadline_ns);
    }
    // Lets the thread take so many turns, and waits until it has begun the last of them.
    void take_turns(int count) {
        let(count);
        for (int left = turns_left_.load(); left > 0; left = turns_left_.load()) turns_left_.wait(left);
    }
    // Lets it take all that it wants: it is about to end.
    void let_go() { let(-1); }

private:
    void let(int count) {
        turns_left_ = count;
        turns_left_.notify_all();
    }
    ToldClock told_;
    std::atomic<int> turns_left_ = 0;
};

}  // namespace burin::devices
