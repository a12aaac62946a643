// SPDX-License-Identifier: MIT
// Asking the system for what a 1 kHz loop wants: a real-time priority, a timer without slack, and memory that stays in place;
// and a thread that has them. All are asked for, none is needed: without the right to them the loop runs all the same, late
// ticks are flagged and counted, and the notice says what was refused and how to allow it.
// Memory: what the process holds is brought in and locked; what it takes later is locked as it is first touched, but only where
// there is no limit, since beyond a limit taking memory itself would fail. The thread's stack is touched before the first tick.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "haptics/haptic_loop.hpp"

namespace burin {

struct RealtimeNotice {
    bool priority = false;       // SCHED_FIFO granted
    bool memory_locked = false;  // no page of the process will be swapped out, nor of what it takes later
    std::string text;            // one line a refusal; empty when all was granted. For the log and the status panel.
};

// For the calling thread (priority) and the whole process (memory). Allocates: call it before the loop, not in it.
[[nodiscard]] RealtimeNotice ask_for_realtime();

// Runs a loop on a thread of its own until stop() or destruction. The loop must outlive it, and nobody else may step
// the loop meanwhile.
class HapticThread {
public:
    // Where nobody feels when a tick begins, a thread without a lead takes a tenth of a core less, and one that rests next to nothing.
    explicit HapticThread(HapticLoop& loop, const LoopPace& pace = {.lead_ns = HapticLoop::kLead_ns})
        : loop_(loop), pace_(pace) {}
    ~HapticThread() { stop(); }
    HapticThread(const HapticThread&) = delete;
    HapticThread& operator=(const HapticThread&) = delete;

    // Returns when the thread has its priority and is about to tick. Once.
    [[nodiscard]] RealtimeNotice start();
    // Waits for the running tick and for the zero force after it.
    void stop();

private:
    HapticLoop& loop_;
    LoopPace pace_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace burin
