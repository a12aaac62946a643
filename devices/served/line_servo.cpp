// SPDX-License-Identifier: MIT
#include "devices/served/line_servo.hpp"

#include "base/try.hpp"

#include <algorithm>

namespace burin::devices {

Result<std::unique_ptr<LineServo>> LineServo::open(std::unique_ptr<DeviceLine> line, std::unique_ptr<Clock> clock) {
    BURIN_TRY_DO(line->open());
    std::unique_ptr<LineServo> servo(new LineServo(std::move(line), std::move(clock)));
    servo->thread_ = std::thread([s = servo.get()] { s->run(); });
    return servo;
}

LineServo::~LineServo() {
    // relaxed: the flag says nothing of other memory.
    ends_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
}

std::vector<std::string> LineServo::take_messages() {
    std::vector<std::string> messages;
    for (LineNotice notice; notices_.pop(notice);) {
        if (notice == told_) continue;
        told_ = notice;
        if (std::string words = line_->words_for(notice); !words.empty()) messages.push_back(std::move(words));
    }
    return messages;
}

void LineServo::run() {
    static_cast<void>(ask_for_servo_priority());
    constexpr Nanoseconds kPeriod_ns = nanoseconds(kServedTurn_s);
    Nanoseconds due_ns = clock_->now_ns();
    while (!ends_.load(std::memory_order_relaxed)) {
        due_ns = std::max(due_ns + kPeriod_ns, clock_->now_ns() - 5 * kPeriod_ns);
        // One that cannot keep up leaves its core to others.
        clock_->sleep_until(std::max(due_ns, clock_->now_ns() + kPeriod_ns / 2));
        if (is_open_)
            turn();
        else
            open_again();
    }
    if (is_open_) {
        static_cast<void>(line_->turn(DeviceWrench{}, state_));
        line_->close();
    }
}

void LineServo::turn() noexcept {
    const Nanoseconds now_ns = clock_->now_ns();
    const bool may = held_ == DeviceFault::none && state_.fault == DeviceFault::none;
    state_.fault = DeviceFault::none;
    if (!line_->turn(may ? exchange_.wanted(now_ns) : DeviceWrench{}, state_)) return lose();
    if (!finite(state_.pose_device.position_m)) state_.fault = DeviceFault::other;
    publish(clock_->now_ns());
    take_notice();
}

void LineServo::publish(Nanoseconds now_ns) noexcept {
    state_.time_ns = now_ns;
    if (state_.fault != DeviceFault::none) {
        held_ = state_.fault;
        fault_ns_ = now_ns;
    } else if (held_ != DeviceFault::none && now_ns - fault_ns_ >= kServedErrorHolds_ns) {
        held_ = DeviceFault::none;
    }
    ServedState& told = exchange_.draft();
    told = state_;
    if (held_ != DeviceFault::none) told.fault = held_;
    exchange_.publish();
}

void LineServo::lose() noexcept {
    // What the device held is not to stay, where it still hears.
    static_cast<void>(line_->turn(DeviceWrench{}, state_));
    take_notice();
    line_->close();
    is_open_ = false;
    tried_ns_ = clock_->now_ns();
    state_.fault = DeviceFault::disconnected;
    publish(tried_ns_);
}

void LineServo::open_again() {
    const Nanoseconds now_ns = clock_->now_ns();
    publish(now_ns);
    if (now_ns - tried_ns_ < kLineAgain_ns) return;
    is_open_ = line_->open().has_value();
    tried_ns_ = clock_->now_ns();
    take_notice();
}

void LineServo::take_notice() noexcept {
    if (const LineNotice notice = line_->notice(); notice.what != 0) notices_.push(notice);
}

}  // namespace burin::devices
