// SPDX-License-Identifier: MIT
#include "sculpt/sculpt_thread.hpp"

#include <algorithm>
#include <chrono>

#include "haptics/haptic_loop.hpp"

namespace burin::sculpt {

SculptThread::SculptThread(SculptService& service, Clock& clock, std::function<void()> on_update)
    : service_(service), clock_(clock), on_update_(std::move(on_update)) {}

void SculptThread::start() {
    thread_ = std::thread([this] { run(); });
}

void SculptThread::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void SculptThread::order(SculptOrder order) {
    {
        const std::lock_guard lock(mutex_);
        orders_.push_back(std::move(order));
    }
    woken_.notify_all();
}

SculptThread::Taken SculptThread::take_surface_update() {
    const std::lock_guard lock(mutex_);
    return std::exchange(done_, {});
}

std::optional<Error> SculptThread::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

SculptThread::Woken SculptThread::wait_for_orders(Nanoseconds until_ns) {
    std::unique_lock lock(mutex_);
    const std::chrono::nanoseconds left(std::max<Nanoseconds>(until_ns - clock_.now_ns(), 0));
    woken_.wait_for(lock, left, [this] { return stopping_ || !orders_.empty(); });
    return {std::exchange(orders_, {}), stopping_};
}

// Returns whether every hand's haptic loop rests, which it does while the hand stands still: ticks then come a tenth as
// often.
bool SculptThread::loop_rests(const UpdateSeen& before) const {
    const UpdateSeen& now = service_.seen();
    const auto most = static_cast<std::uint64_t>(2 * (now.time_ns - before.time_ns) / haptics::HapticLoop::kRest_ns);
    bool rests = now.last_tick - before.last_tick <= std::max<std::uint64_t>(most, 1);
    for (std::size_t i = 0; i < now.other_ticks.size(); ++i)
        rests = rests && now.other_ticks[i] - before.other_ticks[i] <= std::max<std::uint64_t>(most, 1);
    return rests;
}

void SculptThread::run() {
    Nanoseconds next_ns = clock_.now_ns(), period_ns = kPeriod_ns;
    while (true) {
        next_ns = std::max(next_ns + period_ns, clock_.now_ns());
        const auto [orders, last] = wait_for_orders(next_ns);
        for (const SculptOrder& order : orders) service_.order(order);
        const UpdateSeen before = service_.seen();
        const Nanoseconds began_ns = clock_.now_ns();
        const auto updated = last ? service_.finish(began_ns) : service_.update(began_ns);
        const Nanoseconds took_ns = clock_.now_ns() - began_ns;
        std::optional<SurfaceUpdate> surface = service_.take_surface_update();
        if (surface && !surface->tiles.empty()) update_duration_.add(took_ns);
        const bool changed = surface.has_value();
        {
            const std::lock_guard lock(mutex_);
            add(done_.surface, std::move(surface));
            if (updated) {
                done_.updates.push_back(service_.seen());
                done_.updates.back().orders = orders.size();
            }
            if (!updated) failure_ = updated.error();
        }
        period_ns = !changed && orders.empty() && loop_rests(before) ? kRest_ns : kPeriod_ns;
        if (changed || !updated) on_update_();
        if (last || !updated) return;
    }
}

void add(std::optional<SurfaceUpdate>& to, std::optional<SurfaceUpdate> later) {
    if (to && later) {
        merge(*to, std::move(*later));
    } else if (later) {
        to = std::move(later);
    }
}

void merge(SurfaceUpdate& into, SurfaceUpdate later) {
    for (TileUpdate& tile : later.tiles) {
        const auto known = std::ranges::find(into.tiles, tile.tile, &TileUpdate::tile);
        if (known == into.tiles.end()) {
            into.tiles.push_back(std::move(tile));
        } else {
            *known = std::move(tile);
        }
    }
    into.inner_boxes_object = std::move(later.inner_boxes_object);
    into.cut_ns = std::max(into.cut_ns, later.cut_ns);
    into.undoable = later.undoable;
    into.redoable = later.redoable;
    into.exporting = later.exporting;
    std::ranges::move(later.messages, std::back_inserter(into.messages));
}

}  // namespace burin::sculpt
