// SPDX-License-Identifier: MIT
// Updates of the Vulkan engine: which of them the device carries out, and when.
#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "compute/tools/apply.hpp"
#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute {

using shared::ChangedRay;
using shared::CutCounters;
using shared::CutParameters;
using shared::DexelEnd;

bool VulkanEngine::Update::is_for_device() const { return !sweeps.empty() && std::ranges::all_of(sweeps, is_ball_cut); }

Result<Ticket> VulkanEngine::begin(std::span<const ToolSweep> sweeps) {
    for (const ToolSweep& sweep : sweeps) BURIN_TRY_DO(check_tool(solid_, sweep));
    waiting_.push_back({std::vector(sweeps.begin(), sweeps.end()), {}});
    ++begun_;
    if (!flight_) start(Wait::yes);
    return begun_;
}

Result<Ticket> VulkanEngine::begin(RayBatch rays) {
    waiting_.push_back({{}, std::move(rays)});
    return ++begun_;
}

Result<std::optional<Delta>> VulkanEngine::take(Wait wait) {
    if (failure_) return std::unexpected(forgotten(*std::exchange(failure_, std::nullopt)));
    if (flight_) {
        if (const auto advanced = advance(wait); !advanced) return std::unexpected(forgotten(advanced.error()));
        if (!flight_->is_done()) return std::nullopt;
        Delta delta = land();
        start(wait);
        return delta;
    }
    if (waiting_.empty()) return std::nullopt;
    Result<Delta> delta = carry_out_on_host();
    if (!delta) return std::unexpected(forgotten(delta.error()));
    start(wait);
    return std::move(*delta);
}

// Lets the device carry out the updates that come next, as one or the first alone, as far as they are for it.
void VulkanEngine::start(Wait alone) {
    if (failure_ || waiting_.empty() || !waiting_.front().is_for_device()) return;
    std::vector<ToolSweep> sweeps;
    std::size_t updates = 0;
    do {
        std::ranges::move(waiting_.front().sweeps, std::back_inserter(sweeps));
        waiting_.pop_front();
        ++updates;
    } while (alone != Wait::yes && !waiting_.empty() && waiting_.front().is_for_device());
    auto started = prepare(sweeps);
    if (started) {
        flight_->updates = updates;
        started = advance(Wait::no);
    }
    if (!started) failure_ = started.error();
}

// ---- On the device

Result<void> VulkanEngine::prepare(std::span<const ToolSweep> sweeps) {
    std::vector<BallSweep> balls;
    for (const ToolSweep& sweep : sweeps) balls.push_back(ball_sweep(sweep));
    BURIN_TRY_DO(read_back());
    flight_.emplace();
    changed_rays_.clear();
    new_ends_.clear();
    BURIN_TRY(capsules, capsules_in_units(solid_, balls));
    flight_->tasks = cut_tasks(solid_.lattice, capsules);
    if (flight_->tasks.tasks.empty()) return {};
    flight_->capsules = std::move(capsules);
    ++counts_.cuts;
    BURIN_TRY_DO(synchronize());
    return reserve(flight_->capsules, flight_->tasks, changed_);
}

// Submits what is left of the flight, as far as that needs no waiting, or all of it.
Result<void> VulkanEngine::advance(Wait wait) {
    while (!flight_->is_done()) {
        if (!flight_->submission) {
            BURIN_TRY_DO(submit_pass());
        } else if (wait != Wait::yes && !flight_->submission->done_within(wait == Wait::no ? 0 : kBriefly_ns)) {
            return {};
        } else {
            BURIN_TRY_DO(end_submission());
        }
    }
    return {};
}

// Submits one pass: over the rays of the next tasks, or over those that the last one left pending.
Result<void> VulkanEngine::submit_pass() {
    BURIN_TRY_DO(check_longest());
    BURIN_TRY(commands, gpu::Commands::begin(device_));
    CutParameters parameters = this->parameters();
    parameters.pending = flight_->pending;
    std::uint32_t tasks = 0;
    if (flight_->pending == 0) {
        flight_->next_task += tasks = send_tasks(std::span(flight_->tasks.tasks).subspan(flight_->next_task));
    }
    // The buffer may be larger from an earlier cut, but what the host did not expect it would not look for.
    const std::uint64_t rays = flight_->pending > 0 ? flight_->pending : std::uint64_t{tasks} * shared::kCutGroup;
    const std::uint64_t space = exported_.size_bytes() / sizeof(DexelEnd);
    const std::uint64_t expected = std::max<std::uint64_t>(rays * options_.export_per_ray, 1);
    parameters.export_size = static_cast<std::uint32_t>(flight_->pending > 0 ? space : std::min(space, expected));
    record_cut(commands, parameters, tasks, changed_);
    commands.barrier();
    counters_.fetch(commands, sizeof(CutCounters));
    BURIN_TRY(submission, std::move(commands).submit());
    ++counts_.submissions;
    flight_->submission.emplace(std::move(submission));
    return {};
}

Result<void> VulkanEngine::end_submission() {
    BURIN_TRY_DO(flight_->submission->wait());
    flight_->submission.reset();
    const CutCounters counters = counters_.from_device<CutCounters>()[0];
    device_.core()->count_written_home(counters.changed * sizeof(ChangedRay) + counters.exported * sizeof(DexelEnd));
    flight_->stats.rays_touched += counters.touched;
    collect(counters);
    flight_->pending = counters.pending;
    return make_room_for(counters);
}

// Puts what the flight has changed into the host's solid.
Delta VulkanEngine::land() {
    Delta delta{taken_ += flight_->updates, flight_->stats, {}};
    delta.stats.rays_changed = changed_rays_.size();
    apply_changes(delta.changes);
    flight_.reset();
    return delta;
}

// Forgets all updates that were not taken.
Error VulkanEngine::forgotten(const Error& why) {
    flight_.reset();
    waiting_.clear();
    taken_ = begun_;
    synchronized_ = false;
    return with_the_other_engine(why);
}

// ---- On the host

Result<Delta> VulkanEngine::carry_out_on_host() {
    const Update update = std::move(waiting_.front());
    waiting_.pop_front();
    BURIN_TRY_DO(read_back());
    Delta delta{++taken_, {}, {}};
    if (update.sweeps.empty()) {
        delta.stats = {update.rays.rays.size(), assign_rays(update.rays, delta.changes)};
    } else {
        BURIN_TRY(stats, carry_out(update.sweeps, delta.changes));
        delta.stats = stats;
    }
    return delta;
}

Result<CarveStats> VulkanEngine::carry_out(std::span<const ToolSweep> sweeps, Changes& changes) {
    CarveStats stats;
    for (std::size_t i = 0; i < sweeps.size();) {
        std::size_t end = i;
        while (end < sweeps.size() && is_ball_cut(sweeps[end])) ++end;
        const auto done = end > i ? cut_now(sweeps.subspan(i, end - i), changes)
                                  : apply_on_host(solid_, sweeps[i], pool_,
                                                  [&](const RayBatch& rays) { return assign_rays(rays, changes); });
        if (!done) return done;
        stats += *done;
        i = std::max(end, i + 1);
    }
    return stats;
}

// Cuts with balls between what the host does, and waits for the device.
Result<CarveStats> VulkanEngine::cut_now(std::span<const ToolSweep> balls, Changes& changes) {
    BURIN_TRY_DO(prepare(balls));
    BURIN_TRY_DO(advance(Wait::yes));
    Delta delta = land();
    changes.append(delta.changes);
    return delta.stats;
}

std::uint64_t VulkanEngine::assign_rays(const RayBatch& rays, Changes& changes) {
    std::uint64_t changed = 0;
    for (const RayBatch::Ray& ray : rays.rays) {
        const RayPlace place = place_of(ray.code);
        if (!assign_ray(solid_.sets[static_cast<std::size_t>(place.axis)], place, rays.ends_of(ray), changes)) continue;
        ++changed;
        assigned_.push_back(ray.code);
    }
    // Undo, smoothing and most tools assign, often many times before the next cut.
    if (assigned_.size() > solid_.rays_held()) keep_each_once(assigned_);
    return changed;
}

}  // namespace burin::compute
