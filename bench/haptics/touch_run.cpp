// SPDX-License-Identifier: MIT
#include "bench/haptics/touch_run.hpp"

#include "haptics/channels.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace burin::bench {
namespace {

constexpr Nanoseconds kPeriod_ns = 1'000'000;

Vec3 in_steps(const Vec3& p, double step_m) {
    return step_m > 0.0 ? step_m * Vec3(std::round(p.x / step_m), std::round(p.y / step_m), std::round(p.z / step_m))
                        : p;
}

}  // namespace

const char* name_of(Pacing pacing) {
    static constexpr std::array kNames{"cold", "rehearsed", "back_to_back"};
    return kNames.at(static_cast<std::size_t>(pacing));
}

CacheEvictor::CacheEvictor() {
    constexpr std::size_t kLeast = 1u << 20, kMost = 8u << 20;  // the largest still leaves time within a period
    const long second_level = sysconf(_SC_LEVEL2_CACHE_SIZE);
    const std::size_t twice = second_level > 0 ? 2 * static_cast<std::size_t>(second_level) : 4 * kLeast;
    words_.resize(std::clamp(twice, kLeast, kMost) / sizeof(std::uint64_t), 1);
}

void CacheEvictor::evict() noexcept {
    constexpr std::size_t kLine = 64 / sizeof(std::uint64_t);
    std::uint64_t carried = words_[0];
    for (std::size_t i = 0; i < words_.size(); i += kLine) words_[i] = carried = 3 * carried + words_[i];
}

TouchRun::TouchRun(TickCosts& costs, Clock& clock, const haptics::TickParameters& parameters, PressedWalk path,
                   bool cuts)
    : costs_(costs),
      clock_(clock),
      parameters_(parameters),
      path_(std::move(path)),
      cuts_(cuts),
      loop_(device_, clock, *channels_) {}

// While the hand is taken elsewhere nothing holds the tool: its proxy goes with the hand.
void TouchRun::publish_parameters() {
    if (let_go_ == path_.lifted() && parameters_.sequence > 1) return;
    let_go_ = path_.lifted();
    ++parameters_.sequence;
    parameters_.enabled = !let_go_;
    channels_->parameters.draft() = parameters_;
    channels_->parameters.publish();
}

void TouchRun::take(std::uint64_t ticks, Pacing pacing, const Update& update) {
    Nanoseconds deadline_ns = 0;
    for (std::uint64_t i = 0; costs_.tick_us.size() < ticks; ++i) {
        if (i % kTicksAnUpdate == 0) update(clock_.now_ns());
        move_hand();
        // Whoever carves beside has to keep up with the hand also while it comes down.
        const bool waits = pacing != Pacing::back_to_back && (path_.pressed() || cuts_);
        if (!waits) {
            tick(0);
            deadline_ns = 0;
            continue;
        }
        if (deadline_ns == 0) deadline_ns = clock_.now_ns() + kPeriod_ns;
        if (pacing == Pacing::cold) evictor_.evict();
        // Excludes the time spent between ticks.
        while (deadline_ns < clock_.now_ns()) deadline_ns += kPeriod_ns;
        wait(deadline_ns, pacing);
        tick(clock_.now_ns() - deadline_ns);
        const Nanoseconds missed = (clock_.now_ns() - deadline_ns) / kPeriod_ns;
        if (path_.pressed()) costs_.skipped_deadlines += static_cast<std::uint64_t>(missed);
        deadline_ns += (missed + 1) * kPeriod_ns;
    }
}

void TouchRun::wait(Nanoseconds deadline_ns, Pacing pacing) {
    if (pacing == Pacing::cold) {
        clock_.sleep_until(deadline_ns);
        return;
    }
    clock_.sleep_until(deadline_ns - haptics::HapticLoop::kLead_ns);
    const Nanoseconds began_ns = clock_.now_ns();
    loop_.warm_up();
    costs_.warm_up_us.push_back(1e-3 * static_cast<double>(clock_.now_ns() - began_ns));
    clock_.spin_until(deadline_ns);
}

void TouchRun::move_hand() {
    path_.step();
    publish_parameters();
    const Vec3 read_m = in_steps(path_.hip_m(), parameters_.position_noise_m);
    device_.go_to(read_m, path_.orientation(), time_ns_ += kPeriod_ns, cuts_ && path_.pressed() ? 1u : 0u);
}

void TouchRun::tick(Nanoseconds lateness_ns) {
    const Nanoseconds began_ns = clock_.now_ns();
    const haptics::TickRecord record = loop_.step(lateness_ns);
    const Nanoseconds took_ns = clock_.now_ns() - began_ns;
    if (path_.pressed()) {
        count(record, 1e-3 * static_cast<double>(took_ns));
        costs_.lateness_us.push_back(1e-3 * static_cast<double>(lateness_ns));
    }
    for (haptics::TickRecord read; channels_->records.pop(read);) {
    }
    if (cuts_) return;
    for (haptics::TickRecord read; channels_->ticks.pop(read);) {
    }
}

void TouchRun::count(const haptics::TickRecord& record, double took_us) {
    const haptics::ContactWork& work = record.contact.work;
    costs_.tick_us.push_back(took_us);
    costs_.tests.push_back(work.triangles_tested);
    costs_.looks.push_back(work.triangles_seen);
    costs_.gathered.push_back(work.gathered + work.points);
    costs_.steps.push_back(work.steps);
    costs_.solves.push_back(work.plane_solves);
    costs_.cost_us.push_back(1e-3 * haptics::cost_ns(work));
    if (record.in_contact())
        ++costs_.in_contact;
    else
        without_contact_m_.push_back(record.contact.points[0].hip_object_m);
    if ((record.flags & haptics::kTickWorkLimited) != 0) ++costs_.work_limited;
    if ((record.flags & haptics::kTickPushedOut) != 0) ++costs_.pushed_out;
    const double held_m = record.deepest().penetration_m;
    if (held_m > kLeftBehind_m + parameters_.probe.points[record.contact.deepest].radius_m) ++costs_.left_behind;
    if (record.surface_sequence != surface_) ++costs_.surfaces_used;
    surface_ = record.surface_sequence;
}

}  // namespace burin::bench
