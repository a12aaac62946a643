// SPDX-License-Identifier: MIT
// Cuts that the device keeps to itself until somebody reads the solid back.
#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute {

using shared::ChangedRay;
using shared::CutCounters;
using shared::CutParameters;
using shared::CutTask;
using shared::DexelEnd;

Result<void> VulkanEngine::defer(std::span<const BallSweep> sweeps) {
    BURIN_CHECK(under_way() == 0);
    deferred_tasks_.clear();
    next_task_ = 0;
    pending_ = 0;
    deferred_stats_ = {};
    BURIN_TRY(capsules, capsules_in_units(solid_, sweeps));
    CutTasks tasks = cut_tasks(solid_.lattice, capsules, options_.tasks_a_pass);
    if (tasks.tasks.empty()) return {};
    BURIN_TRY_DO(synchronize());
    BURIN_TRY_DO(check_longest());
    BURIN_TRY_DO(reserve(capsules, tasks));
    deferred_tasks_ = std::move(tasks.tasks);
    ++counts_.cuts;
    return {};
}

// Sends as many tasks as one pass takes, and returns how many work groups they are.
std::uint32_t VulkanEngine::send_tasks() {
    std::vector<CutTask> tasks;
    std::uint32_t groups = 0;
    const std::size_t first = next_task_;
    while (next_task_ < deferred_tasks_.size() && groups < options_.tasks_a_pass)
        groups += groups_of(deferred_tasks_[next_task_++]);
    append_pass(std::span(deferred_tasks_).subspan(first, next_task_ - first), tasks);
    copy_to<CutTask>(tasks_, tasks);
    tasks_sent_ = static_cast<std::uint32_t>(tasks.size());
    return groups;
}

// Reserves the buffers of a cut, for the case that every ray visited in a pass changes or is left pending.
Result<void> VulkanEngine::reserve(std::span<const shared::Capsule> capsules, const CutTasks& tasks) {
    std::uint64_t groups = 0;
    for (const CutTask& task : tasks.tasks) groups += groups_of(task);
    const std::uint64_t rays =
        std::min<std::uint64_t>(groups, options_.tasks_a_pass + std::uint64_t{kMostTaskGroups}) * shared::kCutGroup;
    const std::pair<SharedBuffer*, std::size_t> sizes[] = {
        {&capsules_, capsules.size_bytes()},
        {&tasks_, tasks.tasks.size() * sizeof(CutTask)},
        {&order_, tasks.order.size() * sizeof(std::uint32_t)},
        {&counters_, sizeof(CutCounters)},
        {&deferred_changed_, rays * sizeof(ChangedRay)},
        {&exported_, std::max<std::size_t>(rays * options_.export_per_ray, 1) * sizeof(DexelEnd)},
        {&pending_buffer_, rays * sizeof(shared::PendingRay)},
        {&continued_, rays * sizeof(shared::PendingRay)},
    };
    for (const auto& [buffer, size] : sizes) {
        BURIN_TRY_DO(buffer->reserve(device_, size));
    }
    copy_to(capsules_, capsules);
    copy_to<std::uint32_t>(order_, tasks.order);
    capsule_bytes_ = capsules.size_bytes();
    order_bytes_ = tasks.order.size() * sizeof(std::uint32_t);
    return {};
}

void VulkanEngine::record_cut(gpu::Commands& commands, CutParameters parameters, std::uint32_t groups) {
    passed_rays_ = parameters.pending > 0 ? parameters.pending : groups * shared::kCutGroup;
    parameters.end_task = tasks_sent_;
    std::swap(pending_buffer_, continued_);
    capsules_.send(commands, capsule_bytes_);
    tasks_.send(commands, tasks_sent_ * sizeof(CutTask));
    order_.send(commands, order_bytes_);
    send_counters(commands);
    commands.dispatch(cut_rays_,
                      {device_solid_.rays(), stale_.buffer(), capsules_.buffer(), tasks_.buffer(), order_.buffer(),
                       counters_.buffer(), deferred_changed_.buffer(), exported_.buffer(), continued_.buffer(),
                       pending_buffer_.buffer()},
                      gpu::bytes_of(parameters), {groups_of(passed_rays_), 1, 1});
}

void VulkanEngine::record_pass(gpu::Commands& commands) {
    CutParameters parameters = this->parameters();
    parameters.pending = pending_;
    parameters.deferred = 1;
    record_cut(commands, parameters, pending_ == 0 ? send_tasks() : 0);
    commands.barrier();
    counters_.fetch(commands, sizeof(CutCounters));
    ++counts_.submissions;
}

Result<void> VulkanEngine::end_pass() {
    const CutCounters counters = counters_.from_device<CutCounters>()[0];
    deferred_stats_.rays_touched += counters.touched;
    deferred_stats_.rays_changed += counters.changed;
    stale_count_ = counters.stale;
    longest_ = std::max(longest_, counters.longest);
    pending_ = counters.pending;
    auto done = make_room_for(counters);
    if (done && pending_ > 0) done = check_longest();
    if (!done) {
        synchronized_ = false;
        stale_count_ = pending_ = 0;
        deferred_tasks_.clear();
        next_task_ = 0;
    }
    return done;
}

// All is fetched before anything is assigned: a device that fails in between leaves the host's solid as it was.
Result<void> VulkanEngine::read_back() {
    const std::uint32_t rays = std::exchange(stale_count_, 0);
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes;
    const auto most = static_cast<std::uint32_t>(std::min<std::uint64_t>(limit / sizeof(ChangedRay), 1 << 20));
    changed_rays_.clear();
    new_ends_.clear();
    for (std::uint32_t first = 0, some = 0; first < rays; first += some) {
        some = std::min(most, rays - first);
        const auto fetched = fetch_stale(first, some);
        if (!fetched) {
            synchronized_ = false;
            return std::unexpected(fetched.error());
        }
        some = fetched->changed;
        collect(*fetched);
    }
    Changes changes;
    for (const ChangedRay& ray : changed_rays_) {
        const RayPlace place = place_of(ray.ray);
        // Returns false, which does not matter here, if the ray has its former ends again.
        (void)assign_ray(solid_.sets[static_cast<std::size_t>(place.axis)], place,
                         std::span(new_ends_).subspan(ray.first, ray.count), changes);
    }
    gather(changes);
    return {};
}

// Fetches some of the stale rays into changed_ and exported_. `changed` of what it returns says how many: fewer than
// requested where their ends do not fit into one buffer.
Result<CutCounters> VulkanEngine::fetch_stale(std::uint32_t first, std::uint32_t rays) {
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes / sizeof(DexelEnd);
    std::uint64_t ends = std::min<std::uint64_t>(std::uint64_t{2} * rays, limit);
    for (;;) {
        auto kept = changed_.reserve(device_, rays * sizeof(ChangedRay));
        if (kept) kept = exported_.reserve(device_, ends * sizeof(DexelEnd));
        if (kept) kept = counters_.reserve(device_, sizeof(CutCounters));
        if (!kept) return std::unexpected(kept.error());
        BURIN_TRY(commands, gpu::Commands::begin(device_));
        CutParameters parameters = this->parameters();
        parameters.pending = rays;
        parameters.first_stale = first;
        parameters.export_size = static_cast<std::uint32_t>(ends);
        send_counters(commands);
        commands.dispatch(
            export_rays_,
            {device_solid_.rays(), stale_.buffer(), counters_.buffer(), changed_.buffer(), exported_.buffer()},
            gpu::bytes_of(parameters), {groups_of(rays), 1, 1});
        commands.barrier();
        changed_.fetch(commands, rays * sizeof(ChangedRay));
        exported_.fetch(commands, ends * sizeof(DexelEnd));
        auto counters = counted(std::move(commands));
        if (!counters) return std::unexpected(counters.error());
        counters->changed = rays;
        if (counters->exported <= ends) return counters;
        ends = std::min<std::uint64_t>(counters->exported, limit);
        if (counters->exported > limit) rays = std::max(1u, rays / 2);
    }
}

}  // namespace burin::compute
