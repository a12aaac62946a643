// SPDX-License-Identifier: MIT
#include "compute/vulkan/vulkan_engine.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "shaders/cut_rays.comp.spv.hpp"
#include "shaders/export_rays.comp.spv.hpp"
#include "shaders/patch_rays.comp.spv.hpp"

namespace burin::compute {
namespace {

using shared::Capsule;
using shared::ChangedRay;
using shared::CutCounters;
using shared::CutParameters;
using shared::CutTask;
using shared::DexelEnd;
using shared::PatchRay;
using shared::PendingRay;

// Limits of the work of one pass. A software driver stops the loops of a group of up to 16 invocations after 65535
// iterations in total. Half of these are for testing capsules (16 x 2048), half for cutting.
constexpr std::uint32_t kLooks = 2048;
constexpr std::uint32_t kCutTurns = 32000;
// Upper bound of the iterations in capsule_span and capsule_normal: about 5 x 28 halvings.
constexpr std::uint32_t kSearchTurns = 140;
// Most ends of a ray for which one cut, at three iterations an end, and the export fit into kCutTurns.
constexpr std::uint32_t kLongestRay = 7500;
constexpr std::uint32_t kMostCuts = 64;

// Returns how many capsules a ray may take in one pass when no ray has more than `longest` ends; each capsule may add
// two.
std::uint32_t cuts_a_pass(std::uint32_t longest) {
    std::uint32_t cuts = kMostCuts;
    const auto turns = [&] { return cuts * (kSearchTurns + 3 * (longest + 2 * cuts)) + longest + 2 * cuts; };
    while (cuts > 1 && turns() > kCutTurns) --cuts;
    return cuts;
}

template <typename T>
void copy_to(const SharedBuffer& buffer, std::span<const T> values) {
    std::ranges::copy(values, buffer.to_device<T>().begin());
}

std::uint32_t groups_of(std::uint32_t rays) { return (rays + shared::kCutGroup - 1) / shared::kCutGroup; }

}  // namespace

void keep_each_once(std::vector<std::uint32_t>& ray_codes) {
    std::ranges::sort(ray_codes);
    const auto repeated = std::ranges::unique(ray_codes);
    ray_codes.erase(repeated.begin(), repeated.end());
}

Error with_the_other_engine(Error failure) {
    constexpr const char* kOther = "use --engine cpu";
    if (!failure.remedy.contains("--engine cpu"))
        failure.remedy = failure.remedy.empty() ? kOther : failure.remedy + ", or " + kOther;
    return failure;
}

Result<std::unique_ptr<VulkanEngine>> VulkanEngine::create(Solid&& solid, const gpu::Device& device, WorkerPool& pool,
                                                           const VulkanEngineOptions& options) {
    const gpu::Capabilities& can = device.capabilities();
    if (!can.shader_int64 || !can.shader_float64 || !can.buffer_address) {
        return fail("Vulkan engine",
                    device.info().name + " has no " +
                        (!can.shader_int64     ? "64-bit integers in shaders"
                         : !can.shader_float64 ? "doubles in shaders"
                                               : "addresses of buffers"),
                    "use --engine cpu");
    }
    std::unique_ptr<VulkanEngine> engine(new VulkanEngine(std::move(solid), device, pool, options));
    const auto compile = [&](gpu::ComputePipeline& to, std::span<const std::uint32_t> spirv, std::uint32_t buffers,
                             const char* name) -> Result<void> {
        BURIN_TRY(made, gpu::ComputePipeline::create(engine->device_, {.spirv = spirv,
                                                                       .storage_buffers = buffers,
                                                                       .push_constant_bytes = sizeof(CutParameters),
                                                                       .name = name}));
        to = std::move(made);
        return {};
    };
    auto made = compile(engine->cut_rays_, k_cut_rays_comp, 10, "cut");
    if (made) made = compile(engine->patch_rays_, k_patch_rays_comp, 4, "patch");
    if (made) made = compile(engine->export_rays_, k_export_rays_comp, 5, "read back");
    if (made) made = engine->synchronize();
    if (!made) {
        solid = engine->give_solid();
        return std::unexpected(with_the_other_engine(made.error()));
    }
    return engine;
}

VulkanEngine::VulkanEngine(Solid solid, const gpu::Device& device, WorkerPool& pool, const VulkanEngineOptions& options)
    : solid_(std::move(solid)), device_(device), pool_(pool), options_(options) {}

// Sends the rays that were assigned since the device was last used, as they are now.
Result<void> VulkanEngine::send_assigned() {
    if (assigned_.empty()) return {};
    keep_each_once(assigned_);
    RayBatch batch;
    for (const std::uint32_t code : std::exchange(assigned_, {})) {
        const RayPlace place = place_of(code);
        batch.add(code, solid_.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v));
    }
    const auto patched = patch(batch);
    if (!patched) synchronized_ = false;
    return patched;
}

// Sends the ends of the batch in several pieces, so that no buffer grows beyond what a device may bind.
Result<void> VulkanEngine::patch(const RayBatch& rays) {
    const std::size_t limit = static_cast<std::size_t>(device_.capabilities().max_storage_buffer_bytes);
    const std::size_t most_rays = std::min<std::size_t>(std::size_t{options_.tasks_a_pass} * shared::kCutGroup,
                                                        limit / sizeof(PatchRay)),
                      most_ends = limit / sizeof(DexelEnd);
    for (std::size_t next = 0; next < rays.rays.size();) {
        std::vector<PatchRay> patches;
        std::vector<DexelEnd> ends;
        while (next < rays.rays.size() && patches.size() < most_rays) {
            const RayBatch::Ray& ray = rays.rays[next];
            if (!ends.empty() && ends.size() + ray.count > most_ends) break;
            patches.push_back({ray.code, static_cast<std::uint32_t>(ends.size()), ray.count});
            const auto of_ray = rays.ends_of(ray);
            ends.insert(ends.end(), of_ray.begin(), of_ray.end());
            ++next;
        }
        auto reserved = patches_.reserve(device_, patches.size() * sizeof(PatchRay));
        if (reserved) reserved = patch_ends_.reserve(device_, std::max<std::size_t>(ends.size(), 1) * sizeof(DexelEnd));
        if (reserved) reserved = counters_.reserve(device_, sizeof(CutCounters));
        if (!reserved) return reserved;
        copy_to<PatchRay>(patches_, patches);
        copy_to<DexelEnd>(patch_ends_, ends);
        for (bool done = false; !done;) {  // repeated when the store had to grow
            BURIN_TRY(commands, gpu::Commands::begin(device_));
            CutParameters parameters = this->parameters();
            parameters.pending = static_cast<std::uint32_t>(patches.size());
            patches_.send(commands, patches.size() * sizeof(PatchRay));
            patch_ends_.send(commands, ends.size() * sizeof(DexelEnd));
            send_counters(commands);
            commands.dispatch(patch_rays_,
                              {device_solid_.rays(), patches_.buffer(), patch_ends_.buffer(), counters_.buffer()},
                              gpu::bytes_of(parameters), {groups_of(parameters.pending), 1, 1});
            BURIN_TRY(counters, counted(std::move(commands)));
            longest_ = std::max(longest_, counters.longest);
            done = counters.room_wanted == 0;
            BURIN_TRY_DO(make_room_for(counters));
        }
    }
    return {};
}

Result<void> VulkanEngine::synchronize() {
    if (synchronized_) return send_assigned();
    assigned_.clear();
    const std::size_t rays = solid_.rays_held();
    BURIN_TRY_DO(stale_.reserve(device_, rays * sizeof(std::uint32_t)));
    // The first cuts of a fine solid need more free ends than those of a coarse one: one for every eighth ray.
    const std::size_t spare = options_.spare_ends > 0 ? std::max(options_.spare_ends, rays / 8) : 0;
    BURIN_TRY_DO(device_solid_.upload(device_, solid_, {0, spare}));
    used_ = device_solid_.packed_size();
    longest_ = device_solid_.longest_ray();
    synchronized_ = true;
    return {};
}

// Sends as many tasks as one pass takes, and returns their number.
std::uint32_t VulkanEngine::send_tasks(std::span<const CutTask> tasks) {
    const auto some = tasks.first(std::min<std::size_t>(options_.tasks_a_pass, tasks.size()));
    copy_to<CutTask>(tasks_, some);
    task_bytes_ = some.size_bytes();
    return static_cast<std::uint32_t>(some.size());
}

// Reserves the buffers of a cut, for the case that every ray visited in a pass changes or is left pending.
Result<void> VulkanEngine::reserve(std::span<const Capsule> capsules, const CutTasks& tasks, SharedBuffer& changed) {
    const std::size_t task_count = std::min<std::size_t>(tasks.tasks.size(), options_.tasks_a_pass);
    const std::size_t rays = task_count * shared::kCutGroup;
    const std::pair<SharedBuffer*, std::size_t> sizes[] = {
        {&capsules_, capsules.size_bytes()},
        {&tasks_, task_count * sizeof(CutTask)},
        {&order_, tasks.order.size() * sizeof(std::uint32_t)},
        {&counters_, sizeof(CutCounters)},
        {&changed, rays * sizeof(ChangedRay)},
        {&exported_, std::max<std::size_t>(rays * options_.export_per_ray, 1) * sizeof(DexelEnd)},
        {&pending_buffer_, rays * sizeof(PendingRay)},
        {&continued_, rays * sizeof(PendingRay)},
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

Result<void> VulkanEngine::check_longest() const {
    if (longest_ <= kLongestRay) return {};
    return fail("Vulkan engine",
                "a ray has " + std::to_string(longest_) + " interval ends, more than " + std::to_string(kLongestRay),
                "use --engine cpu");
}

CutParameters VulkanEngine::parameters() const {
    CutParameters parameters{};
    parameters.store_address = device_solid_.store().address();
    for (int axis = 0; axis < 3; ++axis) {
        parameters.rays_u[axis] = solid_.lattice.rays_u(axis);
        parameters.rays_v[axis] = solid_.lattice.rays_v(axis);
        parameters.first_ray[axis] = device_solid_.first_ray()[static_cast<std::size_t>(axis)];
    }
    parameters.store_size = device_solid_.store_size();
    parameters.cuts = cuts_a_pass(longest_);
    parameters.looks = kLooks;
    return parameters;
}

void VulkanEngine::send_counters(gpu::Commands& commands) {
    counters_.to_device<CutCounters>()[0] = {used_, 0, 0, 0, 0, 0, 0, stale_count_};
    counters_.send(commands, sizeof(CutCounters));
    commands.barrier();
}

// Submits the commands, waits for them and returns the counters.
Result<CutCounters> VulkanEngine::counted(gpu::Commands commands) {
    commands.barrier();
    counters_.fetch(commands, sizeof(CutCounters));
    BURIN_TRY(submission, std::move(commands).submit());
    ++counts_.submissions;
    BURIN_TRY_DO(submission.wait());
    return counters_.from_device<CutCounters>()[0];
}

void VulkanEngine::record_cut(gpu::Commands& commands, CutParameters parameters, std::uint32_t task_count,
                              const SharedBuffer& changed) {
    passed_rays_ = parameters.pending > 0 ? parameters.pending : task_count * shared::kCutGroup;
    std::swap(pending_buffer_, continued_);
    capsules_.send(commands, capsule_bytes_);
    tasks_.send(commands, task_bytes_);
    order_.send(commands, order_bytes_);
    send_counters(commands);
    commands.dispatch(
        cut_rays_,
        {device_solid_.rays(), stale_.buffer(), capsules_.buffer(), tasks_.buffer(), order_.buffer(),
         counters_.buffer(), changed.buffer(), exported_.buffer(), continued_.buffer(), pending_buffer_.buffer()},
        gpu::bytes_of(parameters), {groups_of(passed_rays_), 1, 1});
}

void VulkanEngine::collect(const CutCounters& counters) {
    const auto base = static_cast<std::uint32_t>(new_ends_.size());
    const auto ends = exported_.from_device<DexelEnd>();
    const auto count = std::min<std::size_t>(counters.exported, ends.size());
    new_ends_.insert(new_ends_.end(), ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
    for (const ChangedRay& ray : changed_.from_device<ChangedRay>().first(counters.changed)) {
        changed_rays_.push_back(ray);
        changed_rays_.back().first += base;
        longest_ = std::max(longest_, ray.count);
    }
    longest_ = std::max(longest_, counters.longest);
}

Result<void> VulkanEngine::make_room_for(const CutCounters& counters) {
    used_ = std::min(counters.used, device_solid_.store_size());
    if (counters.exported > exported_.size_bytes() / sizeof(DexelEnd)) {
        const auto reserved = exported_.reserve(device_, counters.exported * sizeof(DexelEnd));
        if (!reserved) return reserved;
    }
    if (counters.room_wanted == 0) return {};
    ++counts_.store_rebuilds;
    // Reserves more than was requested: rays that got their space may request more. With less, fewer rays are finished
    // in each pass.
    const std::size_t asked = counters.room_wanted;
    const DeviceSolid::Spare spare{asked, std::max<std::size_t>(used_ / 4, 2 * asked + 4096)};
    BURIN_TRY_DO(device_solid_.make_space(device_, spare));
    used_ = device_solid_.packed_size();
    longest_ = device_solid_.longest_ray();
    return {};
}

void VulkanEngine::apply_changes(Changes& changes) {
    for (const ChangedRay& change : changed_rays_) {
        const RayPlace place = place_of(change.ray);
        DexelSet& set = solid_.sets[static_cast<std::size_t>(place.axis)];
        changes.record(place, change.changed_lo, change.changed_hi, set.ends(place.u, place.v));
        set.replace(place.u, place.v, std::span(new_ends_).subspan(change.first, change.count));
    }
}

}  // namespace burin::compute
