// SPDX-License-Identifier: MIT
// Runs the sculpt service on a thread of its own, beside the haptic thread and the frame's: 100 updates a second, and
// 25 while the haptic loop rests. Orders go in and surface updates come out under a lock that neither side holds while
// it works; the haptic thread takes no part in it.
// Threads: order() and take_surface_update() are called by one thread, the frame's. Between start() and stop() nobody
// else may call the service, which must outlive the object.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "base/clock.hpp"
#include "haptics/histogram.hpp"
#include "sculpt/sculpt_service.hpp"

namespace burin::sculpt {

class SculptThread {
public:
    static constexpr Nanoseconds kPeriod_ns = 10'000'000, kRest_ns = 40'000'000;

    // on_update is called on the carving thread when there is something to take; it must not block.
    SculptThread(SculptService& service, Clock& clock, std::function<void()> on_update);
    ~SculptThread() { stop(); }
    SculptThread(const SculptThread&) = delete;
    SculptThread& operator=(const SculptThread&) = delete;

    void start();
    // Waits for the last update, which carries out the orders that are left.
    void stop();
    void order(SculptOrder order);
    struct Taken {
        std::optional<SurfaceUpdate> surface;
        std::vector<UpdateSeen> updates;  // all since the last call, also those that changed nothing
    };
    [[nodiscard]] Taken take_surface_update();
    // Returns the durations of the updates that changed the surface. Any thread.
    [[nodiscard]] const haptics::Histogram& update_duration() const { return update_duration_; }
    // Returns why carving ended; nullopt while it goes on. The solid stays as it was before the update that failed.
    [[nodiscard]] std::optional<Error> failure() const;

private:
    void run();
    [[nodiscard]] bool loop_rests(const UpdateSeen& before) const;
    struct Woken {
        std::vector<SculptOrder> orders;
        bool stopping = false;  // the update that follows takes the last samples, and is the last one
    };
    [[nodiscard]] Woken wait_for_orders(Nanoseconds until_ns);

    SculptService& service_;
    Clock& clock_;
    std::function<void()> on_update_;
    haptics::Histogram update_duration_;
    mutable std::mutex mutex_;  // guards the members below, but for thread_
    std::condition_variable woken_;
    std::vector<SculptOrder> orders_;
    Taken done_;
    std::optional<Error> failure_;
    bool stopping_ = false;
    std::thread thread_;
};

// Merges a later surface update into one that nobody has taken yet.
void merge(SurfaceUpdate& into, SurfaceUpdate later);
// Merges a later surface update, if there is one, into one that may not exist yet.
void add(std::optional<SurfaceUpdate>& to, std::optional<SurfaceUpdate> later);

}  // namespace burin::sculpt
