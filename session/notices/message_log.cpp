// SPDX-License-Identifier: MIT
#include "session/notices/message_log.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace burin::session {
namespace {

// Returns when a message goes away by itself; none: it stays.
std::optional<Nanoseconds> gone_ns(const Message& message) {
    if (message.kind == MessageKind::error) return std::nullopt;
    return message.time_ns + (message.kind == MessageKind::info ? MessageLog::kInfo_ns : MessageLog::kWarning_ns);
}

}  // namespace

void MessageLog::print(const std::string& message, const Beside& beside) const {
    if (prints_) std::fprintf(stderr, "burin: %s%s%s\n", beside.before.c_str(), message.c_str(), beside.after.c_str());
}

void MessageLog::notify(const std::string& message, MessageKind kind, const Beside& beside) {
    keep(message, kind);
    print(message, beside);
}

void MessageLog::notify_of_event(const std::string& message, MessageKind kind, const Beside& beside) {
    ++changes_;
    print(message, beside);
    heard_.push_back({message, kind});
}

std::vector<std::string> MessageLog::take_events() {
    std::vector<std::string> taken;
    for (Heard& event : std::exchange(heard_, {})) {
        if (hears_outside_ && !follows_recording_) keep(event.message, event.kind);
        taken.push_back(std::move(event.message));
    }
    return taken;
}

// A recording does not keep the kind of what came from outside.
void MessageLog::replay_events(std::span<const std::string> recorded) {
    follows_recording_ = true;
    for (const std::string& message : recorded) keep(message, MessageKind::info);
}

void MessageLog::dismiss() {
    ++changes_;
    for (Message& message : all_) message.dismissed = true;
}

bool MessageLog::is_shown(const Message& message) const {
    const auto gone = gone_ns(message);
    return !message.dismissed && (!gone || now_ns_ < *gone);
}

std::optional<Nanoseconds> MessageLog::next_change_ns() const {
    std::optional<Nanoseconds> next;
    for (const Message& message : all_)
        if (const auto gone = gone_ns(message); gone && is_shown(message)) next = std::min(next.value_or(*gone), *gone);
    return next;
}

void MessageLog::keep(const std::string& message, MessageKind kind) {
    ++changes_;
    const auto same = std::ranges::find_if(
        all_, [&](const Message& old) { return old.text == message && old.kind == kind && is_shown(old); });
    Message kept{message, kind, now_ns_};
    if (same != all_.end()) {
        kept.count = same->count + 1;
        all_.erase(same);
    }
    all_.push_back(std::move(kept));
    if (all_.size() > kKept) all_.erase(all_.begin());
}

}  // namespace burin::session
