// SPDX-License-Identifier: MIT
#include "app/session/carving_thread.hpp"

#include <algorithm>
#include <chrono>

#include "haptics/haptic_loop.hpp"

namespace burin {

CarvingThread::CarvingThread(CarvingDesk& desk, Clock& clock, std::function<void()> on_news)
    : desk_(desk), clock_(clock), on_news_(std::move(on_news)) {}

void CarvingThread::start() {
    thread_ = std::thread([this] { run(); });
}

void CarvingThread::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void CarvingThread::order(CarvingOrder order) {
    {
        const std::lock_guard lock(mutex_);
        orders_.push_back(std::move(order));
    }
    woken_.notify_all();
}

CarvingThread::Taken CarvingThread::take_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(done_, {});
}

std::optional<Error> CarvingThread::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

std::vector<CarvingOrder> CarvingThread::wait_for_orders(Nanoseconds until_ns) {
    std::unique_lock lock(mutex_);
    const std::chrono::nanoseconds left(std::max<Nanoseconds>(until_ns - clock_.now_ns(), 0));
    woken_.wait_for(lock, left, [this] { return stopping_ || !orders_.empty(); });
    return std::exchange(orders_, {});
}

// Then the hand is where it was, and ticks come a tenth as often.
bool CarvingThread::loop_rests(const UpdateSeen& before) const {
    const UpdateSeen& now = desk_.seen();
    const auto most = static_cast<std::uint64_t>(2 * (now.time_ns - before.time_ns) / HapticLoop::kRest_ns);
    return now.last_tick - before.last_tick <= std::max<std::uint64_t>(most, 1);
}

void CarvingThread::run() {
    Nanoseconds next_ns = clock_.now_ns(), period_ns = kPeriod_ns;
    while (true) {
        next_ns = std::max(next_ns + period_ns, clock_.now_ns());
        const std::vector<CarvingOrder> orders = wait_for_orders(next_ns);
        for (const CarvingOrder& order : orders) desk_.order(order);
        const UpdateSeen before = desk_.seen();
        const Nanoseconds began_ns = clock_.now_ns();
        const auto updated = desk_.update(began_ns);
        const Nanoseconds took_ns = clock_.now_ns() - began_ns;
        std::optional<SurfaceNews> news = desk_.take_news();
        if (news && !news->tiles.empty()) update_duration_.add(took_ns);
        const bool told = news.has_value();
        bool end = false;
        {
            const std::lock_guard lock(mutex_);
            add(done_.news, std::move(news));
            if (updated) {
                done_.updates.push_back(desk_.seen());
                done_.updates.back().orders = orders.size();
            }
            if (!updated) failure_ = updated.error();
            end = stopping_ || failure_.has_value();
        }
        period_ns = !told && orders.empty() && loop_rests(before) ? kRest_ns : kPeriod_ns;
        if (told || !updated) on_news_();
        if (end) return;
    }
}

void add(std::optional<SurfaceNews>& to, std::optional<SurfaceNews> later) {
    if (to && later) {
        merge(*to, std::move(*later));
    } else if (later) {
        to = std::move(later);
    }
}

void merge(SurfaceNews& into, SurfaceNews later) {
    for (TileNews& tile : later.tiles) {
        const auto known = std::ranges::find(into.tiles, tile.tile, &TileNews::tile);
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
    into.export_progress = later.export_progress;
    std::ranges::move(later.messages, std::back_inserter(into.messages));
}

}  // namespace burin
