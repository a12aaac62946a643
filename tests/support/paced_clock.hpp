// SPDX-License-Identifier: MIT
// A clock for threads that run side by side at whatever pace a machine has: its time goes on only when all who wait for
// it are asleep, and then to the earliest time that one of them waits for. So each has done its work before the time of
// the next comes, on a busy machine and under a sanitizer as on a quick one, and nobody is ever late.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <set>

#include "base/clock.hpp"

namespace burin {

// Any thread.
class PacedClock final : public Clock {
public:
    // sleepers: the number of threads that wait for its time.
    explicit PacedClock(std::size_t sleepers) : sleepers_(sleepers) {}

    [[nodiscard]] Nanoseconds now_ns() noexcept override { return now_ns_.load(std::memory_order_acquire); }
    void sleep_until(Nanoseconds deadline_ns) noexcept override {
        std::unique_lock lock(mutex_);
        if (is_real_) return sleep_in_real_time(lock, deadline_ns);
        const auto mine = waited_for_ns_.insert(deadline_ns);
        // One that is awake again but has not said so yet still stands there, with a time that is past.
        if (waited_for_ns_.size() >= sleepers_) go_on_to(*waited_for_ns_.begin());
        gone_on_.wait(lock, [&] { return is_real_ || now_ns() >= deadline_ns; });
        waited_for_ns_.erase(mine);
    }
    // From now on time passes for each sleeper as it does outside: threads are about to end, and one no longer sleeps.
    void go_on_in_real_time() noexcept {
        const std::lock_guard lock(mutex_);
        is_real_ = true;
        gone_on_.notify_all();
    }

private:
    void go_on_to(Nanoseconds time_ns) noexcept {
        if (time_ns > now_ns()) now_ns_.store(time_ns, std::memory_order_release);
        gone_on_.notify_all();
    }
    void sleep_in_real_time(std::unique_lock<std::mutex>& lock, Nanoseconds deadline_ns) noexcept {
        lock.unlock();
        MonotonicClock outside;
        outside.sleep_until(outside.now_ns() + std::max<Nanoseconds>(deadline_ns - now_ns(), 0));
        lock.lock();
        go_on_to(deadline_ns);
    }

    const std::size_t sleepers_;
    std::atomic<Nanoseconds> now_ns_{0};  // written with the mutex held
    std::mutex mutex_;                    // guards what follows
    std::condition_variable gone_on_;
    std::multiset<Nanoseconds> waited_for_ns_;
    bool is_real_ = false;
};

}  // namespace burin
