// SPDX-License-Identifier: MIT
// Reads rings of tick records that nothing else reads: of a session that is streamed and not recorded. It waits for
// nothing but the time, so that a ring is emptied long before it is full. Threads: made, stopped and destroyed on one;
// `sink` is called on its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "haptics/tick_record.hpp"

#include "base/ring.hpp"

namespace burin::session {

class TickPump {
public:
    using Sink = std::function<void(std::size_t part, const haptics::TickRecord&)>;
    // The rings must outlive it; from now on it is their only reader.
    TickPump(std::vector<Ring<haptics::TickRecord>*> rings, Sink sink)
        : rings_(std::move(rings)), sink_(std::move(sink)), thread_([this] { run(); }) {}
    ~TickPump() { stop(); }
    TickPump(const TickPump&) = delete;
    TickPump& operator=(const TickPump&) = delete;

    // Takes what the rings hold now, and ends.
    void stop() {
        if (!thread_.joinable()) return;
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

private:
    void run() {
        constexpr auto kPumpEvery = std::chrono::milliseconds(5);
        for (bool last = false; !last;) {
            {
                std::unique_lock lock(mutex_);
                wake_.wait_for(lock, kPumpEvery, [this] { return ends_; });
                last = ends_;
            }
            for (std::size_t part = 0; part < rings_.size(); ++part) take(part);
        }
    }
    void take(std::size_t part) {
        for (std::size_t left = rings_[part]->waiting(); left > 0; --left) {
            sink_(part, *rings_[part]->oldest());
            rings_[part]->drop();
        }
    }

    std::vector<Ring<haptics::TickRecord>*> rings_;
    Sink sink_;
    std::mutex mutex_;  // guards ends_
    std::condition_variable wake_;
    bool ends_ = false;
    std::thread thread_;  // last: it uses all others
};

}  // namespace burin::session
