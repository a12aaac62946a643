// SPDX-License-Identifier: MIT
#include "compute/vulkan/vulkan_engine.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "shaders/cut_covered.comp.spv.hpp"
#include "shaders/cut_rays.comp.spv.hpp"
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

// Most capsules that an invocation tests in one pass (cuts_a_pass in flight.cpp).
constexpr std::uint32_t kLooks = 2048;

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
    auto made = compile(engine->cut_rays_, k_cut_rays_comp, 9, "cut");
    if (made) made = compile(engine->cut_covered_, k_cut_covered_comp, 9, "cut what is covered");
    if (made) made = compile(engine->patch_rays_, k_patch_rays_comp, 4, "patch");
    if (made) made = engine->synchronize();
    if (!made) {
        solid = engine->give_solid();
        return std::unexpected(with_the_other_engine(made.error()));
    }
    auto covered =
        CoveredRays::create(engine->device_, {.roundings = options.roundings, .spans_a_ray = options.spans_a_ray});
    engine->smooths_ = covered && SmoothPasses::suits(device);
    if (covered)
        engine->covered_.emplace(std::move(*covered));
    else
        engine->no_cover_ = covered.error();
    return engine;
}

VulkanEngine::VulkanEngine(Solid solid, const gpu::Device& device, WorkerPool& pool, const VulkanEngineOptions& options)
    : solid_(std::move(solid)), device_(device), pool_(pool), options_(options) {}

void VulkanEngine::make_cells() {
    // Without covered_ the device rounds otherwise than the processor, or nobody knows how it does.
    if (maker_ || !covered_ || !CellMaker::suits(device_)) return;
    auto made = CellMaker::create(device_, options_.cells);
    if (made)
        maker_ = std::move(*made);
    else
        leave_cells_to_host(made.error());
}

// Returns the rays that were assigned since the device was last used, as they are now.
RayBatch VulkanEngine::take_assigned() {
    keep_each_once(assigned_);
    RayBatch batch;
    for (const std::uint32_t code : std::exchange(assigned_, {})) {
        const RayPlace place = place_of(code);
        batch.add(code, solid_.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v));
    }
    return batch;
}

// Sends the rays that were assigned, and waits.
Result<void> VulkanEngine::send_assigned() {
    if (assigned_.empty()) return {};
    const auto patched = patch(take_assigned());
    if (!patched) synchronized_ = false;
    return patched;
}

// Sends the ends of the batch in several pieces, so that no buffer grows beyond what a device may bind.
Result<void> VulkanEngine::patch(const RayBatch& rays) {
    for (std::size_t next = 0; next < rays.rays.size();) {
        std::vector<PatchRay> patches;
        std::vector<DexelEnd> ends;
        while (next < rays.rays.size() && patches.size() < most_patches()) {
            const RayBatch::Ray& ray = rays.rays[next];
            if (!ends.empty() && ends.size() + ray.count > most_patch_ends()) break;
            patches.push_back({ray.code, static_cast<std::uint32_t>(ends.size()), ray.count});
            const auto of_ray = rays.ends_of(ray);
            ends.insert(ends.end(), of_ray.begin(), of_ray.end());
            ++next;
        }
        BURIN_TRY_DO(reserve_patches(patches.size(), ends.size()));
        for (bool done = false; !done;) {  // repeated when the store had to grow
            BURIN_TRY(commands, gpu::Commands::begin(device_));
            send_counters(commands);
            record_patches(commands, patches, ends);
            BURIN_TRY(counters, counted(std::move(commands)));
            longest_ = std::max(longest_, counters.longest);
            done = counters.room_wanted == 0;
            BURIN_TRY_DO(make_room_for(counters));
        }
    }
    return {};
}

std::size_t VulkanEngine::most_patches() const {
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes;
    return std::min<std::size_t>(std::size_t{options_.tasks_a_pass} * shared::kCutGroup, limit / sizeof(PatchRay));
}

std::size_t VulkanEngine::most_patch_ends() const {
    return device_.capabilities().max_storage_buffer_bytes / sizeof(DexelEnd);
}

Result<void> VulkanEngine::reserve_patches(std::size_t rays, std::size_t ends) {
    BURIN_TRY_DO(patches_.reserve(device_, rays * sizeof(PatchRay)));
    BURIN_TRY_DO(patch_ends_.reserve(device_, std::max<std::size_t>(ends, 1) * sizeof(DexelEnd)));
    return counters_.reserve(device_, sizeof(CutCounters));
}

void VulkanEngine::record_patches(gpu::Commands& commands, std::span<const PatchRay> rays,
                                  std::span<const DexelEnd> ends) {
    copy_to<PatchRay>(patches_, rays);
    copy_to<DexelEnd>(patch_ends_, ends);
    patches_.send(commands, rays.size_bytes());
    patch_ends_.send(commands, ends.size_bytes());
    commands.barrier();
    CutParameters parameters = this->parameters();
    parameters.pending = static_cast<std::uint32_t>(rays.size());
    commands.dispatch(patch_rays_, {device_solid_.rays(), patches_.buffer(), patch_ends_.buffer(), counters_.buffer()},
                      gpu::bytes_of(parameters), {groups_of(parameters.pending), 1, 1});
    commands.barrier();
}

Result<void> VulkanEngine::synchronize() {
    if (synchronized_) return send_assigned();
    assigned_.clear();
    // The first cuts of a fine solid need more free ends than those of a coarse one: one for every eighth ray.
    const std::size_t spare = options_.spare_ends > 0 ? std::max(options_.spare_ends, solid_.rays_held() / 8) : 0;
    BURIN_TRY_DO(device_solid_.upload(device_, solid_, {0, spare}));
    used_ = device_solid_.packed_size();
    longest_ = device_solid_.longest_ray();
    synchronized_ = true;
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
    CutCounters counters{};
    counters.used = used_;
    counters_.to_device<CutCounters>()[0] = counters;
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
        const auto reserved =
            exported_.reserve(device_, std::min<std::uint64_t>(counters.exported, kMostExported) * sizeof(DexelEnd));
        if (!reserved) return reserved;
    }
    if (counters.room_wanted == 0) return {};
    ++counts_.store_rebuilds;
    // Reserves more than was requested: rays that got their space may request more. With less, fewer rays are finished
    // in each pass.
    const std::size_t asked = counters.room_wanted;
    const DeviceSolid::Spare spare{asked, std::max<std::size_t>(used_ / 4, 2 * asked + 4096)};
    BURIN_TRY_DO(device_solid_.make_space(device_, used_, spare));
    used_ = device_solid_.packed_size();
    longest_ = std::max(longest_, device_solid_.longest_ray());
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
