// SPDX-License-Identifier: MIT
// Puts a session without windows to sleep until something happens: the counterpart of window::wake() where there is no
// window library.
// wake(): any thread. wait(): one thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace burin::session {

class SessionWaker {
public:
    void wake() {
        {
            const std::lock_guard lock(mutex_);
            woken_ = true;
        }
        woken_up_.notify_one();
    }
    // Returns after wake(), also if that came before, or when the time is over; true if it was woken.
    bool wait(double timeout_s) {
        std::unique_lock lock(mutex_);
        woken_up_.wait_for(lock, std::chrono::duration<double>(timeout_s), [&] { return woken_; });
        return std::exchange(woken_, false);
    }

private:
    std::mutex mutex_;
    std::condition_variable woken_up_;
    bool woken_ = false;
};

}  // namespace burin::session
