// SPDX-License-Identifier: MIT
// Smooths within balls on a Vulkan device, with ends equal to those of smoothed_rays() (compute/tools/smooth.hpp), to
// the bit.
//
// Data flow of one ball, whose order is the host's because every sum is taken in an order that no atomic decides:
//   begin           nothing, if anything before it in the submission is undone
//   gather, signs   ends near the path -> points, counted in boxes; nodes -> which side they are on
//   rows, order, sort (a level of merged points at a time; merge makes the next from it)
//                   points -> sorted by boxes, within a box by the order in which the host finds them
//   surface, sides  nodes next to the surface -> the side on which the field has them; then their neighbours, in waves
//   edges, ends     rays -> ends to be moved or made -> where they go
//   rays, store     ends -> rays, which find room in the store and among the exported ends -> the solid
// Nothing in the solid changes before store, and store does nothing where anything is missing: then the pass has not
// begun (shaders/shared/cut_job.h), make_room() grows what was too small, and the ball is done again.
//
// How a list grows: each has a count in SmoothCounters, which goes on where the list is too short. Kernels that begin
// after that add nothing to it, so a list may grow several times.
// Hardest to keep: the counts of boxes are zero between passes. A pass that goes through leaves them so; after one that
// stopped, all of them are cleared by the next submission.
// Cost: 19 dispatches and four more a level of merged points, of which most wait for the one before. Sent of a ball:
// 152 bytes. Memory: some 250 bytes an end near the path, 14 a cell around it, 16 a node of the ball.
// Thread: one, as gpu::Device. Failure: as gpu::Buffer and gpu::ComputePipeline.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compute/tools/smooth_cover.hpp"
#include "compute/vulkan/vulkan_engine_memory.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "gpu/pipelines.hpp"
#include "shaders/shared/smooth_job.h"

namespace burin::compute {

// A ball of a sweep, as the device takes it.
struct SmoothStep {
    shared::SmoothTask task;
    std::size_t ball = 0;    // its number among those of the sweep
    std::uint32_t rays = 0;  // that it may change
};

// Returns the balls of a sweep that may change anything; nothing where one of them is beyond the device: larger than
// some 60 cells, if it lies deep in the lattice.
[[nodiscard]] std::optional<std::vector<SmoothStep>> smooth_steps(const Lattice& lattice, const ToolSweep& sweep);

class SmoothPasses {
public:
    // What a pass works on, beside its own lists.
    struct Engine {
        const gpu::Buffer &rays, &counters, &changed, &exported;
    };

    // Says whether a device binds as many buffers at once as the kernels take.
    [[nodiscard]] static bool suits(const gpu::Device& device);
    // The device must suit, and round as the processor does (rounding_check.hpp). `percent` is the space at first, of
    // what a ball usually takes; tests choose 0, so that growth happens.
    [[nodiscard]] static Result<SmoothPasses> create(const gpu::Device& device, std::uint32_t percent = 100);

    // Makes room for balls. No commands that record() has been given may be left to submit.
    [[nodiscard]] Result<void> prepare(std::span<const SmoothStep> steps);
    // Sends the balls of one submission, before the first of them is recorded.
    [[nodiscard]] Result<void> send(gpu::Commands& commands, std::span<const shared::SmoothTask> tasks);
    // Records a ball. Of the parameters, those of the store, the pass and its ball are given.
    void record(gpu::Commands& commands, const SmoothStep& step, shared::SmoothParameters parameters,
                const Engine& engine);
    // Copies the counters home.
    void fetch(gpu::Commands& commands) const { counters_.fetch(commands, sizeof(shared::SmoothCounters)); }
    // After a submission in which a ball was not begun: makes the room that it lacked. Returns false where that does
    // not help.
    [[nodiscard]] Result<bool> make_room();
    // After work that may not have been carried out.
    void forget() { must_clear_ = true; }

private:
    enum Kernel { begin, gather, rows, order, sort, merge, signs, surface, sides, edges, ends, rays, store, kKernels };
    enum List { points, sorted, places, boxes, nodes, waves, moved, changing, fresh, kLists };
    using Lengths = std::array<std::uint64_t, kLists>;

    explicit SmoothPasses(const gpu::Device& device) : device_(device) {}
    [[nodiscard]] Result<void> grow(const Lengths& lengths);
    [[nodiscard]] std::uint32_t length(List list) const;

    gpu::Device device_;
    std::uint32_t percent_ = 100;
    std::array<gpu::ComputePipeline, kKernels> kernels_;
    std::array<gpu::Buffer, kLists> lists_;
    // Counts at the front of the list of boxes: of boxes, and of rows.
    std::uint64_t box_counts_ = 0, row_counts_ = 0;
    bool must_clear_ = true;  // these counts may not be zero
    SharedBuffer tasks_{"smoothing balls", SharedBuffer::Traffic::to_device};
    SharedBuffer counters_{"smoothing counters", SharedBuffer::Traffic::from_device};
};

}  // namespace burin::compute
