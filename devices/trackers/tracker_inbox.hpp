// SPDX-License-Identifier: MIT
// Where a tracker's threads leave what they have heard, until the frame takes it: samples, messages for the user, and
// the number of what was dropped. Any thread; each function holds a lock for a moment.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "devices/trackers/tracker.hpp"

namespace burin::devices {

class TrackerInbox {
public:
    // Messages that nobody has taken, at most; beyond that new ones are left out.
    static constexpr std::size_t kMostMessages = 64;

    void push(TrackerSample sample);
    // Different reasons that are told within a second.
    static constexpr std::size_t kMostReasons = 4;
    // Counts something that was dropped. Says why: each reason at most once a second, and only so many, since a sender
    // of nonsense sends much of it.
    void refuse(const std::string& why, Nanoseconds now_ns);
    void say(std::string message);

    [[nodiscard]] std::vector<TrackerSample> take();
    [[nodiscard]] std::vector<std::string> take_messages();
    [[nodiscard]] std::uint64_t refused() const;

private:
    void note(std::string message);

    mutable std::mutex mutex_;  // guards what follows
    TrackerQueue queue_;
    std::vector<std::string> messages_;
    std::uint64_t refused_ = 0;
    struct Reason {
        std::string why;
        Nanoseconds told_ns = 0;
    };
    std::vector<Reason> reasons_;  // told within the last second
};

}  // namespace burin::devices
