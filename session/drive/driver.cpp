// SPDX-License-Identifier: MIT
#include "session/drive/driver.hpp"

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "session/drive/executors.hpp"

#include <utility>

namespace burin::session {

Result<void> drive(Executor& executor, FrameSource& frames) {
    Result<void> outcome;
    while (outcome) {
        const std::optional<Nanoseconds> due_ns = frames.next();
        if (!due_ns) break;
        outcome = executor.advance_to(*due_ns);
        if (outcome) outcome = frames.make(executor);
    }
    executor.stop();
    return outcome;
}

std::vector<haptics::ToolState> newest_tools(const std::vector<haptics::HapticChannels*>& parts) {
    std::vector<haptics::ToolState> tools;
    for (haptics::HapticChannels* const part : parts) tools.push_back(part->tool.newest());
    return tools;
}

// ---- On the caller's thread

SteppedExecutor::SteppedExecutor(SimulatedClock& clock, haptics::HapticLoop& loop,
                                 std::vector<haptics::HapticChannels*> parts, scene::SceneService& service,
                                 AfterUpdate after_update)
    : clock_(clock),
      loop_(loop),
      parts_(std::move(parts)),
      service_(service),
      after_update_(std::move(after_update)),
      next_update_ns_(clock.now_ns() + scene::SceneService::kHandsMove_ns) {}

Result<void> SteppedExecutor::advance_to(Nanoseconds until_ns) {
    while (clock_.now_ns() + loop_.period_ns() <= until_ns) {
        clock_.sleep_until(clock_.now_ns() + loop_.period_ns());
        tick();
        if (clock_.now_ns() < next_update_ns_) continue;
        BURIN_TRY_DO(service_.update(clock_.now_ns()));
        updates_.push_back(service_.seen());
        updates_.back().orders = std::exchange(orders_, 0);
        ++made_;
        collect();
        next_update_ns_ += scene::SceneService::kHandsMove_ns;
    }
    return {};
}

void SteppedExecutor::tick() {
    if (tick_durations_ns_ == nullptr) {
        loop_.step();
        return;
    }
    const Nanoseconds before_ns = stopwatch_.now_ns();
    loop_.step();
    tick_durations_ns_->push_back(static_cast<std::uint32_t>(stopwatch_.now_ns() - before_ns));
}

void SteppedExecutor::collect() {
    if (after_update_) after_update_({});
}

void SteppedExecutor::order(Order order) {
    if (order.counts()) ++orders_;
    order();
    service_.finish();
}

Result<Executor::Taken> SteppedExecutor::take_updates() {
    if (collects_orders_) collect();
    return Taken{std::exchange(updates_, {}), collects_orders_ ? kAllCollected : made_};
}

// ---- On threads

ThreadedExecutor::ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                                   scene::SceneService& service, const haptics::LoopPace& pace,
                                   AfterUpdate after_update)
    : clock_(clock), parts_(std::move(parts)), touch_(loop, pace), service_(service) {
    scene_.emplace(service, clock, std::move(after_update));
}

ThreadedExecutor::ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, std::vector<haptics::HapticChannels*> parts,
                                   scene::SceneService& service)
    : clock_(clock), parts_(std::move(parts)), touch_(loop), service_(service) {}

haptics::RealtimeNotice ThreadedExecutor::start() {
    haptics::RealtimeNotice notice = touch_.start();
    if (scene_) scene_->start();
    return notice;
}

Result<void> ThreadedExecutor::advance_to(Nanoseconds until_ns) {
    clock_.sleep_until(until_ns);
    if (!scene_) return service_.update(clock_.now_ns());
    if (const auto failed = scene_->failure()) return std::unexpected(*failed);
    return {};
}

void ThreadedExecutor::order(Order order) {
    if (scene_) {
        scene_->order(std::move(order));
    } else {
        order();
    }
}

Result<Executor::Taken> ThreadedExecutor::take_updates() {
    if (!scene_) return Taken{};
    Taken taken{scene_->take_updates()};
    updates_ += taken.updates.size();
    taken.collected = updates_;
    return taken;
}

void ThreadedExecutor::stop() {
    touch_.stop();
    if (scene_) scene_->stop();
}

}  // namespace burin::session
