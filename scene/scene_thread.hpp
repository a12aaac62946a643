// SPDX-License-Identifier: MIT
// Runs the service of a scene on a thread of its own, beside the haptic threads and the frame's, as often as the parts
// of the scene ask for it.
//
// Data flow: orders go in as functions, which know the part that they are for; they are carried out on this thread just
// before an update. After each update, and before it is among those that can be taken, `after_update` is called on this
// thread: there whoever knows the parts collects what the frame shall show, and hands it on under a lock of its own.
// The haptic threads take no part in it.
// Threads: order() and take_updates() are called by one thread, the frame's. Between start() and stop() nobody else may
// call the service or its parts, which must outlive the object.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/clock.hpp"
#include "scene/scene_order.hpp"
#include "scene/scene_service.hpp"

namespace burin::scene {

class SceneThread {
public:
    using Order = SceneOrder;

    struct Ended {
        Nanoseconds took_ns = 0;
        bool failed = false;
    };
    using AfterUpdate = std::function<void(const Ended&)>;

    // after_update is also called after an update that failed; it must not wait for the frame.
    SceneThread(SceneService& service, Clock& clock, AfterUpdate after_update);
    ~SceneThread() { stop(); }
    SceneThread(const SceneThread&) = delete;
    SceneThread& operator=(const SceneThread&) = delete;

    void start();
    // Waits for the last update, which carries out the orders that are left.
    void stop();
    void order(Order order);
    // Returns the inputs of all updates since the last call, for a recording.
    [[nodiscard]] std::vector<SceneUpdate> take_updates();
    // Returns why the scene stands still; nullopt while it goes on. Each part stays as it was before its update failed.
    [[nodiscard]] std::optional<Error> failure() const;

private:
    struct Woken {
        std::vector<Order> orders;
        bool stopping = false;  // the update that follows takes the last samples, and is the last one
    };
    void run();
    [[nodiscard]] Woken wait_for_orders(Nanoseconds until_ns);

    SceneService& service_;
    Clock& clock_;
    AfterUpdate after_update_;
    mutable std::mutex mutex_;  // guards the members below, but for thread_
    std::condition_variable woken_;
    std::vector<Order> orders_;
    std::vector<SceneUpdate> updates_;
    std::optional<Error> failure_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace burin::scene
