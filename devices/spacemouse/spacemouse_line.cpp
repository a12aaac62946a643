// SPDX-License-Identifier: MIT
#include "devices/spacemouse/spacemouse_line.hpp"

#include "base/try.hpp"

#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>

namespace burin::devices {
namespace {

constexpr int kLook_ms = 50;
constexpr std::size_t kMostKept = 64;  // messages and presses that nobody has taken

}  // namespace

Result<std::unique_ptr<SpaceMouseLine>> SpaceMouseLine::open(const std::string& where, const std::string& place,
                                                             OnState on_state, const HidrawPlaces& places) {
    BURIN_TRY(port, open_spacemouse_port(where, place, places));
    std::unique_ptr<SpaceMouseLine> line(
        new SpaceMouseLine(where, place, std::move(on_state), places, std::move(port)));
    line->thread_ = std::thread([l = line.get()] { l->run(); });
    return line;
}

SpaceMouseLine::~SpaceMouseLine() {
    stop_.give();
    if (thread_.joinable()) thread_.join();
}

std::vector<std::string> SpaceMouseLine::take_messages() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(messages_, {});
}

std::vector<std::uint32_t> SpaceMouseLine::take_presses() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(presses_, {});
}

void SpaceMouseLine::say(const std::string& what) {
    const std::scoped_lock lock(mutex_);
    if (messages_.size() < kMostKept) messages_.push_back(where_ + ": " + what);
}

void SpaceMouseLine::run() {
    while (true) {
        publish(clock_.now_ns());
        const auto woken = stop_.wait_for(port_ ? port_->file.get() : -1, kLook_ms);
        if (woken == StopSign::Woken::by_sign) return;
        const Nanoseconds now_ns = clock_.now_ns();
        if (!port_)
            look_again(now_ns);
        else if (woken == StopSign::Woken::by_file)
            read_reports(now_ns);
        rest_if_stale(now_ns);
    }
}

void SpaceMouseLine::look_again(Nanoseconds now_ns) {
    if (now_ns - tried_ns_ < kSpaceMouseAgain_ns) return;
    auto port = open_spacemouse_port(where_, place_, places_);
    tried_ns_ = clock_.now_ns();
    if (!port) return;
    port_ = std::move(*port);
    now_.is_there = true;
    say("is there again: " + std::string(port_->product.name));
}

void SpaceMouseLine::read_reports(Nanoseconds now_ns) {
    // As many as a device sends in a second: then the state is told and the stop looked for.
    constexpr int kMostAtOnce = 128;
    for (int i = 0; i < kMostAtOnce; ++i) {
        std::array<std::byte, kMostHidReport + 1> report;
        const ssize_t count = ::read(port_->file.get(), report.data(), report.size());
        if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
        if (count <= 0) return lose(now_ns);
        take(std::span(report).first(static_cast<std::size_t>(count)), now_ns);
    }
}

void SpaceMouseLine::take(std::span<const std::byte> bytes, Nanoseconds now_ns) {
    const auto report = spacemouse_report(bytes, port_->product.keys, port_->product.axes);
    if (!report) {
        refused_.fetch_add(1, std::memory_order_relaxed);
        if (complained_ns_ && now_ns - *complained_ns_ < kSpaceMouseAgain_ns) return;
        complained_ns_ = now_ns;
        return say("report " + std::to_string(std::to_integer<int>(bytes[0])) + " came with " +
                   std::to_string(bytes.size()) + " bytes, which it never has: it is left out");
    }
    if (report->push) now_.push = *report->push;
    if (report->turn) now_.turn = *report->turn;
    if (report->push || report->turn) moved_ns_ = now_ns;
    if (!report->buttons) return;
    const std::uint32_t pressed = *report->buttons & ~now_.buttons;
    now_.buttons = *report->buttons;
    const std::scoped_lock lock(mutex_);
    for (std::uint32_t left = pressed; left != 0 && presses_.size() < kMostKept; left &= left - 1)
        presses_.push_back(static_cast<std::uint32_t>(std::countr_zero(left)));
}

void SpaceMouseLine::rest_if_stale(Nanoseconds now_ns) {
    const bool moves = now_.push != Vec3(0.0) || now_.turn != Vec3(0.0);
    if (!moves || now_ns - moved_ns_ < kSpaceMouseStale_ns) return;
    now_.push = now_.turn = Vec3(0.0);
    say("was pushed and then silent: what it moves stands still");
}

void SpaceMouseLine::lose(Nanoseconds now_ns) {
    port_.reset();
    now_ = {};
    tried_ns_ = now_ns;
    say("was unplugged or switched off: what it moves stands still, and it is looked for each second");
}

void SpaceMouseLine::publish(Nanoseconds now_ns) {
    now_.time_ns = now_ns;
    state_.draft() = now_;
    state_.publish();
    if (on_state_) on_state_(now_);
}

}  // namespace burin::devices
