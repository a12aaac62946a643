// SPDX-License-Identifier: MIT
#include "compute/vulkan/smooth_passes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "shaders/smooth_begin.comp.spv.hpp"
#include "shaders/smooth_edges.comp.spv.hpp"
#include "shaders/smooth_ends.comp.spv.hpp"
#include "shaders/smooth_gather.comp.spv.hpp"
#include "shaders/smooth_merge.comp.spv.hpp"
#include "shaders/smooth_order.comp.spv.hpp"
#include "shaders/smooth_rays.comp.spv.hpp"
#include "shaders/smooth_rows.comp.spv.hpp"
#include "shaders/smooth_sides.comp.spv.hpp"
#include "shaders/smooth_signs.comp.spv.hpp"
#include "shaders/smooth_sort.comp.spv.hpp"
#include "shaders/smooth_store.comp.spv.hpp"
#include "shaders/smooth_surface.comp.spv.hpp"

namespace burin::compute {
namespace {

using shared::SmoothBoxes;
using shared::SmoothCounters;
using shared::SmoothParameters;
using shared::SmoothTask;

constexpr std::size_t kMostBalls = 4096;  // of a sweep
constexpr std::uint64_t kMostBoxes = std::uint64_t{1} << 24;
// A dispatch of as many work groups as every device takes covers them.
constexpr std::uint64_t kMostNodes = 65535 * std::uint64_t{shared::kSmoothGroup};
constexpr std::uint32_t kSmoothBuffers = 15;

std::uint32_t groups_over(std::uint64_t invocations) {
    return static_cast<std::uint32_t>((invocations + shared::kSmoothGroup - 1) / shared::kSmoothGroup);
}

// Counts the rays of all axes between two nodes.
std::uint64_t rays_between(const int* lo, const int* hi) {
    std::uint64_t rays = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        rays += static_cast<std::uint64_t>(hi[u] - lo[u] + 1) * static_cast<std::uint64_t>(hi[v] - lo[v] + 1);
    }
    return rays;
}

// Counts the nodes of a ball, and one more on each side.
std::uint64_t nodes_of(const SmoothTask& task) {
    std::uint64_t nodes = 1;
    for (int axis = 0; axis < 3; ++axis) nodes *= static_cast<std::uint64_t>(task.hi[axis] - task.lo[axis] + 3);
    return nodes;
}

std::uint64_t rows_of(const SmoothTask& task) {
    return static_cast<std::uint64_t>(task.boxes[1]) * static_cast<std::uint64_t>(task.boxes[2]);
}
std::uint64_t boxes_of(const SmoothTask& task) { return rows_of(task) * static_cast<std::uint64_t>(task.boxes[0] + 1); }
// Counts the places that the rows and boxes of all levels take behind the counts.
std::uint64_t places_of(const SmoothTask& task) {
    const SmoothBoxes last = shared::boxes_of_level(task, task.levels - 1, 0);
    return last.firsts + static_cast<std::uint64_t>(last.y) * static_cast<std::uint64_t>(last.z) *
                             static_cast<std::uint64_t>(last.x + 1);
}

// Returns a ball as the device takes it.
SmoothTask smooth_task(const Lattice& lattice, const SmoothRegion& region, std::uint8_t material) {
    SmoothTask task{};
    task.radius = region.path.radius;
    task.most_width2 = region.path.most_width2;
    task.reach = region.reach();
    task.material = material;
    task.levels = 1;
    for (double box = 1.0; region.most_width >= shared::kBoxesAWidth * 2.0 * box; box *= 2.0) ++task.levels;
    const Vec3 end = region.path.start + region.path.along, lo = glm::min(region.path.start, end) - task.reach,
               hi = glm::max(region.path.start, end) + task.reach;
    const int widest = 1 << (task.levels - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double cells = lattice.cells[a];
        task.start[axis] = region.path.start[axis];
        task.along[axis] = region.path.along[axis];
        task.lo[axis] = region.lo[a];
        task.hi[axis] = region.hi[a];
        task.ray_lo[axis] = static_cast<int>(std::clamp(std::ceil(lo[axis]), 0.0, cells));
        task.ray_hi[axis] = static_cast<int>(std::clamp(std::floor(hi[axis]), 0.0, cells));
        // A cell more on each side, since the mean of points may be rounded out of their box.
        const int from = static_cast<int>(std::clamp(std::floor(lo[axis]) - 1.0, 0.0, cells));
        const int to = static_cast<int>(std::clamp(std::floor(hi[axis]) + 1.0, 0.0, cells + 1.0));
        task.box_lo[axis] = from / widest * widest;
        task.boxes[axis] = (to - task.box_lo[axis] + widest) / widest * widest;
    }
    return task;
}

struct Program {
    std::span<const std::uint32_t> spirv;
    const char* name;
};

// A list that the kernels share, in the order of SmoothPasses::List.
struct SharedList {
    std::size_t element_bytes;
    const char* name;
};
constexpr std::array<SharedList, 9> kSharedLists{{{sizeof(shared::SmoothPoint), "points to smooth"},
                                                  {sizeof(shared::SmoothPoint), "sorted points"},
                                                  {sizeof(std::uint32_t), "order of points"},
                                                  {sizeof(std::uint32_t), "boxes of points"},
                                                  {sizeof(shared::SmoothNode), "nodes to smooth"},
                                                  {sizeof(std::uint32_t), "waves of nodes"},
                                                  {sizeof(shared::SmoothEnd), "ends to smooth"},
                                                  {sizeof(shared::SmoothRay), "smoothed rays"},
                                                  {sizeof(shared::DexelEnd), "smoothed ends"}}};

}  // namespace

std::optional<std::vector<SmoothStep>> smooth_steps(const Lattice& lattice, const ToolSweep& sweep) {
    const SmoothBalls balls(sweep);
    if (balls.size() > kMostBalls) return {};
    std::vector<SmoothStep> steps;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const SmoothBall ball = balls[i];
        const SmoothRegion region = smooth_region(lattice, ball);
        if (region.is_empty()) continue;
        const SmoothTask task = smooth_task(lattice, region, ball.material);
        if (task.levels > shared::kMostLevels || boxes_of(task) > kMostBoxes || nodes_of(task) > kMostNodes) return {};
        steps.push_back({task, i, static_cast<std::uint32_t>(rays_between(task.lo, task.hi))});
    }
    return steps;
}

bool SmoothPasses::suits(const gpu::Device& device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device.core()->physical, &properties);
    return properties.limits.maxPerStageDescriptorStorageBuffers >= kSmoothBuffers;
}

Result<SmoothPasses> SmoothPasses::create(const gpu::Device& device, std::uint32_t percent) {
    SmoothPasses passes(device);
    passes.percent_ = percent;
    const std::array<Program, kKernels> programs{{{k_smooth_begin_comp, "begin smoothing"},
                                                  {k_smooth_gather_comp, "gather points"},
                                                  {k_smooth_rows_comp, "place boxes"},
                                                  {k_smooth_order_comp, "fill boxes"},
                                                  {k_smooth_sort_comp, "sort points"},
                                                  {k_smooth_merge_comp, "merge points"},
                                                  {k_smooth_signs_comp, "sides of nodes"},
                                                  {k_smooth_surface_comp, "nodes at the surface"},
                                                  {k_smooth_sides_comp, "move nodes"},
                                                  {k_smooth_edges_comp, "ends to smooth"},
                                                  {k_smooth_ends_comp, "smooth ends"},
                                                  {k_smooth_rays_comp, "smoothed rays"},
                                                  {k_smooth_store_comp, "store smoothed rays"}}};
    for (std::size_t i = 0; i < programs.size(); ++i) {
        BURIN_TRY(made, gpu::ComputePipeline::create(passes.device_, {.spirv = programs.at(i).spirv,
                                                                      .storage_buffers = kSmoothBuffers,
                                                                      .push_constant_bytes = sizeof(SmoothParameters),
                                                                      .name = programs.at(i).name}));
        passes.kernels_.at(i) = std::move(made);
    }
    BURIN_TRY_DO(passes.counters_.reserve(passes.device_, sizeof(SmoothCounters)));
    return passes;
}

Result<void> SmoothPasses::prepare(std::span<const SmoothStep> steps) {
    Lengths lengths{};
    const auto want = [&](List list, std::uint64_t length) {
        lengths.at(list) = std::max({lengths.at(list), length, std::uint64_t{1}});
    };
    std::uint64_t box_counts = box_counts_, row_counts = row_counts_, behind = 0;
    for (const SmoothStep& step : steps) {
        const std::uint64_t near = rays_between(step.task.ray_lo, step.task.ray_hi) * percent_ / 100,
                            own = std::uint64_t{step.rays} * percent_ / 100;
        box_counts = std::max(box_counts, boxes_of(step.task));
        row_counts = std::max(row_counts, rows_of(step.task));
        behind = std::max(behind, places_of(step.task));
        want(points, near);
        want(sorted, near + near / 2);
        want(nodes, nodes_of(step.task));
        want(waves, own);
        want(moved, own);
        want(changing, step.rays);
        want(fresh, 4 * own);
    }
    if (box_counts > box_counts_ || row_counts > row_counts_) must_clear_ = true;
    box_counts_ = box_counts;
    row_counts_ = row_counts;
    want(boxes, box_counts_ + row_counts_ + behind);
    return grow(lengths);
}

// Grows the lists to these lengths at least.
Result<void> SmoothPasses::grow(const Lengths& lengths) {
    static_assert(kSharedLists.size() == kLists);
    const std::uint64_t limit = device_.capabilities().max_storage_buffer_bytes;
    for (std::size_t i = 0; i < kLists; ++i) {
        const std::size_t of = i == places ? static_cast<std::size_t>(sorted) : i;  // one for each sorted point
        const std::uint64_t size_bytes = lengths.at(of) * kSharedLists.at(i).element_bytes;
        if (size_bytes <= lists_.at(i).size_bytes()) continue;
        const std::uint64_t wished = std::max(size_bytes, std::min(size_bytes + size_bytes / 2, limit));
        BURIN_TRY(made, gpu::Buffer::create(device_, gpu::BufferUse::device_storage, wished / 4 * 4,
                                            kSharedLists.at(i).name));
        lists_.at(i) = std::move(made);
        if (i == boxes) must_clear_ = true;
    }
    return {};
}

std::uint32_t SmoothPasses::length(List list) const {
    return static_cast<std::uint32_t>(lists_.at(list).size_bytes() / kSharedLists.at(list).element_bytes);
}

Result<void> SmoothPasses::send(gpu::Commands& commands, std::span<const SmoothTask> tasks) {
    if (tasks.empty()) return {};
    BURIN_TRY_DO(tasks_.reserve(device_, tasks.size_bytes()));
    copy_to(tasks_, tasks);
    tasks_.send(commands, tasks.size_bytes());
    if (std::exchange(must_clear_, false)) {
        commands.fill(lists_.at(boxes), 0, (box_counts_ + row_counts_) * sizeof(std::uint32_t), 0);
        commands.fill(counters_.buffer(), 0, sizeof(SmoothCounters), 0);
    }
    return {};
}

void SmoothPasses::record(gpu::Commands& commands, const SmoothStep& step, SmoothParameters parameters,
                          const Engine& engine) {
    const SmoothTask& task = step.task;
    parameters.points = length(points);
    parameters.sorted = std::min(length(sorted), length(places));
    parameters.boxes = static_cast<std::uint32_t>(box_counts_);
    parameters.rows = static_cast<std::uint32_t>(row_counts_);
    parameters.waves = length(waves);
    parameters.ends = length(moved);
    parameters.rays = length(changing);
    parameters.fresh = length(fresh);
    const std::array<gpu::BufferRange, kSmoothBuffers> buffers{
        engine.rays,    engine.counters,  tasks_.buffer(), counters_.buffer(), lists_[points],
        lists_[sorted], lists_[boxes],    lists_[places],  lists_[nodes],      lists_[waves],
        lists_[moved],  lists_[changing], lists_[fresh],   engine.changed,     engine.exported};
    const auto run = [&](Kernel kernel, std::uint64_t invocations) {
        commands.dispatch(kernels_.at(kernel), buffers, gpu::bytes_of(parameters), {groups_over(invocations), 1, 1});
    };
    const auto run_over = [&](Kernel kernel, std::size_t groups_bytes) {
        commands.dispatch_indirect(kernels_.at(kernel), buffers, gpu::bytes_of(parameters), counters_.buffer(),
                                   groups_bytes);
        commands.barrier();
    };
    commands.barrier();
    run(begin, 1);
    commands.barrier();
    run(gather, rays_between(task.ray_lo, task.ray_hi));
    run(signs, static_cast<std::uint64_t>(task.hi[0] - task.lo[0] + 3) *
                   static_cast<std::uint64_t>(task.hi[1] - task.lo[1] + 3));
    commands.barrier();
    run(surface, nodes_of(task));
    for (int level = 0; level < task.levels; ++level) {
        parameters.step = static_cast<std::uint32_t>(level);
        const std::size_t of_points =
            offsetof(SmoothCounters, of_points) + static_cast<std::size_t>(level) * sizeof(shared::SmoothGroups);
        if (level > 0) {
            run(merge, (rows_of(task) >> 2 * level) * static_cast<std::uint64_t>(task.boxes[0] >> level));
            commands.barrier();
        }
        run(rows, rows_of(task) >> 2 * level);
        commands.barrier();
        run_over(order, of_points);
        run_over(sort, of_points);
    }
    for (std::size_t wave = 0; wave < shared::kMostWaves; ++wave) {
        parameters.step = static_cast<std::uint32_t>(wave);
        run_over(sides, offsetof(SmoothCounters, of_waves) + wave * sizeof(shared::SmoothGroups));
    }
    run(edges, step.rays);
    commands.barrier();
    run_over(ends, offsetof(SmoothCounters, of_ends));
    run_over(rays, offsetof(SmoothCounters, of_rays));
    run(store, step.rays);
    commands.barrier();
}

Result<bool> SmoothPasses::make_room() {
    must_clear_ = true;
    const SmoothCounters counters = counters_.from_device<SmoothCounters>().front();
    if ((counters.why & shared::kBeyondDevice) != 0) return false;
    if (counters.why == 0) return true;
    Lengths lengths{};
    bool is_short = false, fits = true;
    const auto want = [&](List list, std::uint64_t wanted) {
        if (wanted <= length(list)) return;
        is_short = true;
        fits = fits && wanted * kSharedLists.at(list).element_bytes <= device_.capabilities().max_storage_buffer_bytes;
        // Later lists were not counted in this pass.
        lengths.at(list) = std::max(wanted, std::min<std::uint64_t>(2 * wanted, 4 * std::uint64_t{length(list)}));
    };
    std::uint64_t all_points = 0, all_nodes = 0;
    for (const std::uint32_t of_level : counters.points) {
        want(points, of_level);
        all_points += of_level;
    }
    for (const std::uint32_t of_wave : counters.waves) all_nodes += of_wave;
    want(sorted, all_points);
    want(waves, all_nodes);
    want(moved, counters.ends);
    want(changing, counters.rays);
    want(fresh, counters.fresh);
    if (!is_short || !fits) return false;
    BURIN_TRY_DO(grow(lengths));
    return true;
}

}  // namespace burin::compute
