// SPDX-License-Identifier: MIT
#include "compute/vulkan_engine.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "shaders/cut_rays.comp.spv.hpp"

namespace burin {
namespace {

using shared::Capsule;
using shared::ChangedRay;
using shared::CutCounters;
using shared::CutParameters;
using shared::CutTask;
using shared::DexelEnd;
using shared::PendingRay;

// A software driver lets the loops of a group of up to 16 invocations turn 65535 times together. Half of that is for
// looking at capsules (16 x 2048), half for cutting.
constexpr std::uint32_t kLooks = 2048;
constexpr std::uint32_t kCutTurns = 32000;
constexpr std::uint32_t kSearchTurns = 140;  // at most, in capsule_span and capsule_normal: about 5 x 28 halvings
constexpr std::uint32_t kLongestRay = 7500;  // ends: one cut, at three turns an end, and the export fit into kCutTurns
constexpr std::uint32_t kMostCuts = 64;

// How many capsules a ray may take in one pass when no ray has more than `longest` ends; each capsule may add two.
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

}  // namespace

Result<std::unique_ptr<CarvingEngine>> make_vulkan_engine(Solid solid, gpu::Device& device) {
    auto engine = VulkanEngine::create(std::move(solid), device);
    if (!engine) return std::unexpected(engine.error());
    return std::unique_ptr<CarvingEngine>(std::move(*engine));
}

Result<std::unique_ptr<VulkanEngine>> VulkanEngine::create(Solid solid, const gpu::Device& device,
                                                           const VulkanEngineOptions& options) {
    const gpu::Capabilities& can = device.capabilities();
    if (!can.shader_int64 || !can.shader_float64) {
        return fail(
            "Vulkan engine",
            device.info().name + " has no " + (can.shader_int64 ? "doubles" : "64-bit integers") + " in shaders",
            "use --engine cpu");
    }
    std::unique_ptr<VulkanEngine> engine(new VulkanEngine(std::move(solid), device, options));
    auto pipeline = gpu::ComputePipeline::create(
        engine->device_,
        {.spirv = k_cut_rays_comp, .storage_buffers = 10, .push_constant_bytes = sizeof(CutParameters), .name = "cut"});
    if (!pipeline) return std::unexpected(pipeline.error());
    engine->cut_rays_ = std::move(*pipeline);
    if (const auto sent = engine->synchronize(); !sent) return std::unexpected(sent.error());
    return engine;
}

VulkanEngine::VulkanEngine(Solid solid, const gpu::Device& device, const VulkanEngineOptions& options)
    : solid_(std::move(solid)), device_(device), options_(options) {}

Result<CarveStats> VulkanEngine::assign(const RayBatch& rays) {
    CarveStats stats;
    for (const RayBatch::Ray& ray : rays.rays) {
        const RayPlace place = place_of(ray.code);
        ++stats.rays_touched;
        if (assign_ray(solid_.sets[static_cast<std::size_t>(place.axis)], place, rays.ends_of(ray), changes_)) {
            ++stats.rays_changed;
        }
    }
    if (stats.rays_changed > 0) synchronized_ = false;
    return stats;
}

Result<CarveStats> VulkanEngine::carve(std::span<const BallSweep> sweeps) {
    const auto capsules = capsules_in_units(solid_, sweeps);
    if (!capsules) return std::unexpected(capsules.error());
    const CutTasks tasks = cut_tasks(solid_.lattice, *capsules);
    if (tasks.tasks.empty()) return CarveStats{};
    if (!synchronized_) {
        if (const auto sent = synchronize(); !sent) return std::unexpected(sent.error());
    }
    const auto stats = cut_on_device(*capsules, tasks);
    if (!stats) {
        synchronized_ = false;
        return stats;
    }
    apply_changes();
    ++counts_.cuts;
    return stats;
}

Result<void> VulkanEngine::synchronize() {
    if (const auto sent = device_solid_.upload(device_, solid_, {0, options_.spare_ends}); !sent) return sent;
    used_ = device_solid_.packed_size();
    longest_ = device_solid_.longest_ray();
    synchronized_ = true;
    return {};
}

Result<CarveStats> VulkanEngine::cut_on_device(std::span<const Capsule> capsules, const CutTasks& tasks) {
    changed_rays_.clear();
    new_ends_.clear();
    if (const auto reserved = reserve(capsules, tasks); !reserved) return std::unexpected(reserved.error());
    copy_to(capsules_, capsules);
    copy_to<std::uint32_t>(order_, tasks.order);
    capsule_bytes_ = capsules.size_bytes();
    order_bytes_ = tasks.order.size() * sizeof(std::uint32_t);
    CarveStats stats;
    for (std::size_t from = 0; from < tasks.tasks.size(); from += options_.tasks_a_pass) {
        const auto some = std::span(tasks.tasks)
                              .subspan(from, std::min<std::size_t>(options_.tasks_a_pass, tasks.tasks.size() - from));
        copy_to<CutTask>(tasks_, some);
        task_bytes_ = some.size_bytes();
        std::uint32_t pending = 0;
        do {
            const auto counters = pass(static_cast<std::uint32_t>(some.size()), pending);
            if (!counters) return std::unexpected(counters.error());
            stats.rays_touched += counters->touched;
            collect(*counters);
            if (const auto made = make_room_for(*counters); !made) return std::unexpected(made.error());
            pending = counters->pending;
        } while (pending > 0);
    }
    stats.rays_changed = changed_rays_.size();
    return stats;
}

// Every ray visited in a pass may change or have to wait.
Result<void> VulkanEngine::reserve(std::span<const Capsule> capsules, const CutTasks& tasks) {
    const std::size_t task_count = std::min<std::size_t>(tasks.tasks.size(), options_.tasks_a_pass);
    const std::size_t rays = task_count * shared::kCutGroup;
    const std::pair<SharedBuffer*, std::size_t> sizes[] = {
        {&capsules_, capsules.size_bytes()},
        {&tasks_, task_count * sizeof(CutTask)},
        {&order_, tasks.order.size() * sizeof(std::uint32_t)},
        {&counters_, sizeof(CutCounters)},
        {&changed_, rays * sizeof(ChangedRay)},
        {&exported_, std::max<std::size_t>(rays * options_.export_per_ray, 1) * sizeof(DexelEnd)},
        {&pending_, rays * sizeof(PendingRay)},
        {&continued_, rays * sizeof(PendingRay)},
    };
    for (const auto& [buffer, size] : sizes) {
        if (const auto reserved = buffer->reserve(device_, size); !reserved) return reserved;
    }
    return {};
}

// One submission: the tasks' rays, or the rays that an earlier pass left pending.
Result<CutCounters> VulkanEngine::pass(std::uint32_t task_count, std::uint32_t pending) {
    if (longest_ > kLongestRay) {
        return fail(
            "Vulkan engine",
            "a ray has " + std::to_string(longest_) + " interval ends, more than " + std::to_string(kLongestRay),
            "use --engine cpu");
    }
    auto commands = gpu::Commands::begin(device_);
    if (!commands) return std::unexpected(commands.error());
    counters_.to_device<CutCounters>()[0] = {used_, 0, 0, 0, 0, 0, 0};
    CutParameters parameters{};
    for (int axis = 0; axis < 3; ++axis) {
        parameters.rays_u[axis] = solid_.lattice.rays_u(axis);
        parameters.rays_v[axis] = solid_.lattice.rays_v(axis);
        parameters.first_ray[axis] = device_solid_.first_ray()[static_cast<std::size_t>(axis)];
    }
    parameters.store_size = device_solid_.store_size();
    const std::uint32_t rays = pending > 0 ? pending : task_count * shared::kCutGroup;
    // The buffer may be larger from an earlier cut; what a shader may use is also what has to be carried back.
    const std::uint64_t space = exported_.size_bytes() / sizeof(DexelEnd);
    const std::uint64_t expected = std::max<std::uint64_t>(std::uint64_t{rays} * options_.export_per_ray, 1);
    parameters.export_size = static_cast<std::uint32_t>(pending > 0 ? space : std::min(space, expected));
    parameters.cuts = cuts_a_pass(longest_);
    parameters.looks = kLooks;
    parameters.pending = pending;
    std::swap(pending_, continued_);
    capsules_.send(*commands, capsule_bytes_);
    tasks_.send(*commands, task_bytes_);
    order_.send(*commands, order_bytes_);
    counters_.send(*commands, sizeof(CutCounters));
    commands->barrier();
    commands->dispatch(
        cut_rays_,
        {device_solid_.rays(), device_solid_.store(), capsules_.buffer(), tasks_.buffer(), order_.buffer(),
         counters_.buffer(), changed_.buffer(), exported_.buffer(), continued_.buffer(), pending_.buffer()},
        gpu::bytes_of(parameters), {(rays + shared::kCutGroup - 1) / shared::kCutGroup, 1, 1});
    commands->barrier();
    counters_.fetch(*commands, sizeof(CutCounters));
    changed_.fetch(*commands, rays * sizeof(ChangedRay));
    exported_.fetch(*commands, parameters.export_size * sizeof(DexelEnd));
    auto submission = std::move(*commands).submit();
    if (!submission) return std::unexpected(submission.error());
    ++counts_.submissions;
    if (const auto done = submission->wait(); !done) return std::unexpected(done.error());
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
        const auto reserved = exported_.reserve(device_, counters.exported * sizeof(DexelEnd));
        if (!reserved) return reserved;
    }
    if (counters.room_wanted == 0) return {};
    ++counts_.store_rebuilds;
    // More than was asked for: rays that got theirs may ask again. With less, fewer rays get on in each pass.
    const std::size_t asked = counters.room_wanted;
    const DeviceSolid::Spare spare{asked, std::max<std::size_t>(used_ / 4, 2 * asked + 4096)};
    if (const auto made = device_solid_.make_space(device_, spare); !made) return made;
    used_ = device_solid_.packed_size();
    longest_ = device_solid_.longest_ray();
    return {};
}

void VulkanEngine::apply_changes() {
    for (const ChangedRay& change : changed_rays_) {
        const RayPlace place = place_of(change.ray);
        DexelSet& set = solid_.sets[static_cast<std::size_t>(place.axis)];
        changes_.record(place, change.changed_lo, change.changed_hi, set.ends(place.u, place.v));
        set.replace(place.u, place.v, std::span(new_ends_).subspan(change.first, change.count));
    }
}

}  // namespace burin
