// SPDX-License-Identifier: MIT
#include "devices/trackers/tracker_inbox.hpp"

#include <algorithm>
#include <utility>

namespace burin::devices {

void TrackerInbox::push(TrackerSample sample) {
    const std::lock_guard lock(mutex_);
    if (!queue_.push(std::move(sample))) ++refused_;
}

void TrackerInbox::refuse(const std::string& why, Nanoseconds now_ns) {
    const std::lock_guard lock(mutex_);
    ++refused_;
    std::erase_if(reasons_, [&](const Reason& told) { return now_ns - told.told_ns >= kNanosecondsPerSecond; });
    const bool is_told = std::ranges::find(reasons_, why, &Reason::why) != reasons_.end();
    if (is_told || reasons_.size() >= kMostReasons) return;
    reasons_.push_back({why, now_ns});
    note(why);
}

void TrackerInbox::say(std::string message) {
    const std::lock_guard lock(mutex_);
    note(std::move(message));
}

void TrackerInbox::note(std::string message) {
    if (messages_.size() < kMostMessages) messages_.push_back(std::move(message));
}

std::vector<TrackerSample> TrackerInbox::take() {
    const std::lock_guard lock(mutex_);
    return queue_.take();
}

std::vector<std::string> TrackerInbox::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

std::uint64_t TrackerInbox::refused() const {
    const std::lock_guard lock(mutex_);
    return refused_;
}

}  // namespace burin::devices
