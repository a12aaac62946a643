// SPDX-License-Identifier: MIT
#include "session/drive/driver.hpp"

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

// ---- On the caller's thread

SteppedExecutor::SteppedExecutor(SimulatedClock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                                 sculpt::SculptService& service)
    : clock_(clock),
      loop_(loop),
      channels_(channels),
      service_(service),
      next_update_ns_(clock.now_ns() + sculpt::SculptThread::kPeriod_ns) {}

Result<void> SteppedExecutor::advance_to(Nanoseconds until_ns) {
    while (clock_.now_ns() + loop_.period_ns() <= until_ns) {
        clock_.sleep_until(clock_.now_ns() + loop_.period_ns());
        tick();
        if (clock_.now_ns() < next_update_ns_) continue;
        if (const auto updated = service_.update(clock_.now_ns()); !updated) return updated;
        next_update_ns_ += sculpt::SculptThread::kPeriod_ns;
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

void SteppedExecutor::order(sculpt::SculptOrder order) {
    service_.order(order);
    service_.finish_export();
}

Result<Executor::Taken> SteppedExecutor::take_surface_update() { return Taken{service_.take_surface_update(), {}}; }

// ---- On threads

ThreadedExecutor::ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                                   sculpt::SculptService& service, const haptics::LoopPace& pace,
                                   std::function<void()> on_update)
    : clock_(clock), channels_(channels), touch_(loop, pace), service_(service) {
    carving_.emplace(service, clock, std::move(on_update));
}

ThreadedExecutor::ThreadedExecutor(Clock& clock, haptics::HapticLoop& loop, haptics::HapticChannels& channels,
                                   sculpt::SculptService& service)
    : clock_(clock), channels_(channels), touch_(loop), service_(service) {}

haptics::RealtimeNotice ThreadedExecutor::start() {
    haptics::RealtimeNotice notice = touch_.start();
    if (carving_) carving_->start();
    return notice;
}

Result<void> ThreadedExecutor::advance_to(Nanoseconds until_ns) {
    clock_.sleep_until(until_ns);
    if (!carving_) return service_.update(clock_.now_ns());
    if (const auto failed = carving_->failure()) return std::unexpected(*failed);
    return {};
}

void ThreadedExecutor::order(sculpt::SculptOrder order) {
    if (carving_) {
        carving_->order(std::move(order));
    } else {
        service_.order(order);
    }
}

Result<Executor::Taken> ThreadedExecutor::take_surface_update() {
    return carving_ ? carving_->take_surface_update() : Taken{service_.take_surface_update(), {}};
}

void ThreadedExecutor::stop() {
    touch_.stop();
    if (carving_) carving_->stop();
}

}  // namespace burin::session
