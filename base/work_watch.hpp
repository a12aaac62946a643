// SPDX-License-Identifier: MIT
// Progress of long work for another thread, which may also stop it: the name of the present step, and the share
// of the whole that is done. Work asks go_on() often; functions that work for long take a pointer, null where nobody
// looks on.
// Threads: one begins steps, that and its helpers call go_on(), any other looks and stops. Never the haptic thread.
#pragma once

#include <algorithm>
#include <atomic>

namespace burin {

class WorkWatch {
public:
    // Begins a step, which is this part of the whole. The name is text that stays.
    void begin(const char* step, double from, double to) {
        from_.store(from, std::memory_order_relaxed);
        to_.store(to, std::memory_order_relaxed);
        done_.store(from, std::memory_order_relaxed);
        step_.store(step, std::memory_order_relaxed);
    }
    // Notes how much of the step is done, 0 to 1; returns whether the work is still wanted.
    [[nodiscard]] bool go_on(double of_step) {
        const double from = from_.load(std::memory_order_relaxed), to = to_.load(std::memory_order_relaxed);
        done_.store(from + (to - from) * std::clamp(of_step, 0.0, 1.0), std::memory_order_relaxed);
        return is_wanted();
    }
    [[nodiscard]] bool is_wanted() const { return !stopped_.load(std::memory_order_relaxed); }

    struct Seen {
        const char* step = "";
        double done = 0.0;  // of the whole, 0 to 1
    };
    [[nodiscard]] Seen look() const {
        return {step_.load(std::memory_order_relaxed), done_.load(std::memory_order_relaxed)};
    }
    void stop() { stopped_.store(true, std::memory_order_relaxed); }

private:
    // Relaxed: each is a figure of its own that is shown, and nothing else is read on its account.
    std::atomic<const char*> step_{""};
    std::atomic<double> from_{0.0}, to_{1.0}, done_{0.0};
    std::atomic<bool> stopped_{false};
};

// The same for work that may have no watch.
inline void begin_step(WorkWatch* watch, const char* step, double from, double to) {
    if (watch != nullptr) watch->begin(step, from, to);
}
[[nodiscard]] inline bool go_on(WorkWatch* watch, double of_step) { return watch == nullptr || watch->go_on(of_step); }

}  // namespace burin
