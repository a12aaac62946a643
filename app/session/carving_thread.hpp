// SPDX-License-Identifier: MIT
// The carving desk on a thread of its own, 100 updates a second, beside the haptic thread and the frame; 25 while the haptic loop rests.
// Orders go in and news come out under a lock that neither holds while carving; the haptic thread knows nothing of it.
// Threads: order() and take_news() from one thread, the frame's. The desk must outlive the object and be left alone meanwhile.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "app/session/carving_desk.hpp"
#include "base/clock.hpp"
#include "haptics/histogram.hpp"

namespace burin {

class CarvingThread {
public:
    static constexpr Nanoseconds kPeriod_ns = 10'000'000, kRest_ns = 40'000'000;

    // on_news is called on the carving thread when there is something to take; it must not wait.
    CarvingThread(CarvingDesk& desk, Clock& clock, std::function<void()> on_news);
    ~CarvingThread() { stop(); }
    CarvingThread(const CarvingThread&) = delete;
    CarvingThread& operator=(const CarvingThread&) = delete;

    void start();
    void stop();  // after the update that goes on; orders not yet carried out are
    void order(CarvingOrder order);
    struct Taken {
        std::optional<SurfaceNews> news;
        std::vector<UpdateSeen> updates;  // that told it, and those that had nothing to tell
    };
    [[nodiscard]] Taken take_news();
    // How long the updates took in which the surface changed. Any thread.
    [[nodiscard]] const Histogram& update_duration() const { return update_duration_; }
    // Why carving ended; nothing while all is well. What is carved is kept.
    [[nodiscard]] std::optional<Error> failure() const;

private:
    void run();
    [[nodiscard]] bool loop_rests(const UpdateSeen& before) const;
    [[nodiscard]] std::vector<CarvingOrder> wait_for_orders(Nanoseconds until_ns);

    CarvingDesk& desk_;
    Clock& clock_;
    std::function<void()> on_news_;
    Histogram update_duration_;
    mutable std::mutex mutex_;  // guards all that follows
    std::condition_variable woken_;
    std::vector<CarvingOrder> orders_;
    Taken done_;
    std::optional<Error> failure_;
    bool stopping_ = false;
    std::thread thread_;
};

// Adds later news to those not yet taken.
void merge(SurfaceNews& into, SurfaceNews later);
// The same where there may be none.
void add(std::optional<SurfaceNews>& to, std::optional<SurfaceNews> later);

}  // namespace burin
