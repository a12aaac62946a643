// SPDX-License-Identifier: MIT
#include "scene/scene_thread.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace burin::scene {

SceneThread::SceneThread(SceneService& service, Clock& clock, AfterUpdate after_update)
    : service_(service), clock_(clock), after_update_(std::move(after_update)) {}

void SceneThread::start() {
    service_.let_lag();
    thread_ = std::thread([this] { run(); });
}

void SceneThread::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void SceneThread::order(Order order) {
    {
        const std::lock_guard lock(mutex_);
        orders_.push_back(std::move(order));
    }
    woken_.notify_all();
}

std::vector<SceneUpdate> SceneThread::take_updates() {
    const std::lock_guard lock(mutex_);
    return std::exchange(updates_, {});
}

std::optional<Error> SceneThread::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

SceneThread::Woken SceneThread::wait_for_orders(Nanoseconds until_ns) {
    std::unique_lock lock(mutex_);
    const std::chrono::nanoseconds left(std::max<Nanoseconds>(until_ns - clock_.now_ns(), 0));
    woken_.wait_for(lock, left, [this] { return stopping_ || !orders_.empty(); });
    return {std::exchange(orders_, {}), stopping_};
}

void SceneThread::run() {
    Nanoseconds next_ns = clock_.now_ns();
    while (true) {
        const auto [orders, last] = wait_for_orders(next_ns);
        for (const Order& order : orders) order();
        const Nanoseconds began_ns = clock_.now_ns();
        const Result<void> updated = service_.update(began_ns);
        after_update_({clock_.now_ns() - began_ns, !updated});
        {
            const std::lock_guard lock(mutex_);
            if (updated) {
                updates_.push_back(service_.seen());
                updates_.back().orders = static_cast<std::size_t>(std::ranges::count_if(orders, &Order::counts));
            } else {
                failure_ = updated.error();
            }
        }
        if (last || !updated) return;
        next_ns = std::max(next_ns + service_.period_ns(), clock_.now_ns());
    }
}

}  // namespace burin::scene
