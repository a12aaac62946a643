// SPDX-License-Identifier: MIT
// Real-time scheduling for a 1 kHz loop: priority, a timer without slack, locked memory, and a thread that has them.
// All are requested, none is required: without permission the loop runs all the same, late ticks are flagged and
// counted, and the notice says what was refused and how to allow it.
// Memory: the pages that the process holds are loaded and locked; later ones are locked as they are first touched, but
// only where there is no limit, since beyond a limit allocation itself would fail. The thread's stack is touched before
// the first tick.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "haptics/haptic_loop.hpp"

namespace burin::haptics {

struct RealtimeNotice {
    bool priority = false;  // SCHED_FIFO granted
    // No page of the process will be swapped out, nor any that it allocates later.
    bool memory_locked = false;
    // One line per refusal; empty when all was granted. For the log and the status panel.
    std::string text;
};

// Requests priority for the calling thread and locked memory for the whole process. Allocates: call it before the loop,
// not in it.
[[nodiscard]] RealtimeNotice ask_for_realtime();

// Runs a loop on a thread of its own until stop() or destruction. The loop must outlive it, and nobody else may step
// the loop meanwhile.
class HapticThread {
public:
    // Where nobody feels when a tick begins, a thread without a lead takes a tenth of a core less, and one that idles
    // takes next to nothing.
    explicit HapticThread(HapticLoop& loop, const LoopPace& pace = {.lead_ns = HapticLoop::kLead_ns})
        : loop_(loop), pace_(pace) {}
    ~HapticThread() { stop(); }
    HapticThread(const HapticThread&) = delete;
    HapticThread& operator=(const HapticThread&) = delete;

    // Starts the thread; returns when it has its priority and is about to tick. Call it once.
    [[nodiscard]] RealtimeNotice start();
    // Waits for the running tick and for the zero force that follows it.
    void stop();

private:
    HapticLoop& loop_;
    LoopPace pace_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace burin::haptics
