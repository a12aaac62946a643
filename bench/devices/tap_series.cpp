// SPDX-License-Identifier: MIT
#include "bench/devices/tap_series.hpp"

#include <utility>

namespace burin::bench {

std::vector<int> tap_order(std::mt19937_64& random, bool is_one_way) {
    std::vector<int> order;
    for (std::size_t look = 0; look < kMostTaps; look += kTapsToALook) {
        for (std::size_t i = 0; i < kTapsToALook; ++i) {
            const int way = i % 4 == 1 && !is_one_way ? -1 : 1;
            order.push_back(i % 2 == 0 ? 0 : way);
        }
        for (std::size_t left = kTapsToALook; left > 1; --left)
            std::swap(order[look + left - 1], order[look + random() % left]);
    }
    return order;
}

void TapPlaces::add(double time_s, const Vec3& place_m) {
    Sums* sums = nullptr;
    if (time_s < 0.02) sums = &before_;
    if (time_s >= 0.10 && time_s < 0.14) sums = &moved_;
    if (time_s >= 0.22 && time_s < kTapSlot_s) sums = &after_;
    if (sums == nullptr || !finite(place_m)) return;
    sums->time_s += time_s;
    sums->place_m += place_m;
    sums->count += 1.0;
}

bool TapPlaces::is_whole() const { return before_.count > 0.0 && moved_.count > 0.0 && after_.count > 0.0; }

Vec3 TapPlaces::moved_m() const {
    const auto mean = [](const Sums& sums) { return std::pair(sums.time_s / sums.count, sums.place_m / sums.count); };
    const auto [before_s, before_m] = mean(before_);
    const auto [moved_s, moved_m] = mean(moved_);
    const auto [after_s, after_m] = mean(after_);
    return moved_m - glm::mix(before_m, after_m, (moved_s - before_s) / (after_s - before_s));
}

TapSeries::TapSeries(const TapQuestion& question, std::mt19937_64& random) : question_(question), random_(random) {
    restart();
}

void TapSeries::restart() {
    order_ = tap_order(random_, question_.is_one_way);
    taps_.clear();
    has_begun_ = is_over_ = false;
    answer_ = {};
}

int TapSeries::tick(const TapTick& tick) {
    if (is_over_) return 0;
    if (!has_begun_) begin_tap(tick.time_s);
    if (tick.time_s - begun_s_ >= kTapSlot_s) {
        end_tap();
        if (is_over_) return 0;
        begin_tap(tick.time_s);
    }
    const double time_s = tick.time_s - begun_s_;
    places_.add(time_s, tick.place_m);
    if (time_s >= kTapForce_s) return 0;
    let_through_ += tick.let_through;
    force_ticks_ += 1.0;
    return order_[taps_.size()];
}

void TapSeries::begin_tap(double time_s) {
    has_begun_ = true;
    begun_s_ = time_s;
    places_ = {};
    let_through_ = force_ticks_ = 0.0;
}

bool TapSeries::is_undisturbed() const {
    constexpr double kMostOfIt = 0.8;
    return places_.is_whole() && let_through_ >= kMostOfIt * force_ticks_;
}

void TapSeries::end_tap() {
    if (!is_undisturbed()) return;
    taps_.push_back({order_[taps_.size()], places_.moved_m()});
    if (taps_.size() % kTapsToALook != 0) return;
    answer_ = judge_taps(taps_, question_);
    is_over_ = answer_.finding != TapFinding::unclear || taps_.size() == kMostTaps;
}

}  // namespace burin::bench
