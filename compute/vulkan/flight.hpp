// SPDX-License-Identifier: MIT
// Holds what the Vulkan engine has under way: sweeps as stages, stages as passes of a submission. Plain data and the
// rules by which it goes on; the engine records and submits (vulkan_engine_updates.cpp).
//
// A stage is what one kind of pass carries out: balls that follow each other, cut together; one convex tool; or one
// tool that smooths, a ball a pass. A submission holds as many passes as follow each other without the host. A pass
// that leaves anything undone keeps the later ones from beginning (shaders/shared/cut_job.h), and the next submission
// goes on from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compute/mesher/made_cells.hpp"
#include "compute/rays/carve_stats.hpp"
#include "compute/tools/convex_pieces.hpp"
#include "compute/tools/tool.hpp"
#include "compute/vulkan/smooth_passes.hpp"
#include "compute/vulkan/vulkan_engine_tasks.hpp"
#include "gpu/commands.hpp"

namespace burin::compute {

// Most ends of a ray for which one cut, and the export, stay within the turns of loops that a pass may take.
constexpr std::uint32_t kLongestRay = 7500;
// Returns how many spans a ray may take in one pass when no ray has more than `longest` ends; each span may add two.
[[nodiscard]] std::uint32_t cuts_a_pass(std::uint32_t longest);

struct Stage {
    std::size_t first_sweep = 0;
    // Tasks of balls that cut, or balls that smooth: those that were not carried out.
    std::size_t next_task = 0, end_task = 0;
    ConvexPieces pieces;              // of a convex tool that cuts
    std::vector<SmoothStep> smooths;  // of a tool that smooths
    std::uint32_t visited = 0;        // rays that it may cover
    std::uint32_t work = 0;           // what it does with what it covers (shaders/shared/capsule.h)
    [[nodiscard]] bool is_smooth() const { return !smooths.empty(); }
    [[nodiscard]] bool is_covered() const { return !pieces.pieces.empty(); }
    [[nodiscard]] bool is_of_balls() const { return !is_smooth() && !is_covered(); }
};

// A part of a stage: these tasks, or the rays that the last submission left pending.
struct Pass {
    std::size_t stage = 0;
    std::size_t first_task = 0, end_task = 0;
    std::uint32_t pending = 0;
    std::uint32_t rays = 0;       // that it looks at
    std::uint32_t cuts = 0;       // most spans that a ray takes
    std::uint32_t most_ends = 0;  // of a ray behind it
};

struct Flight {
    std::size_t updates = 0;  // that it carries out as one
    std::vector<ToolSweep> sweeps;
    std::size_t on_host = 0;     // the first sweep that is left to the host
    std::size_t first_ball = 0;  // of it, if it smooths
    std::vector<shared::Capsule> capsules;
    CutTasks tasks;
    std::vector<shared::PatchRay> patches;  // rays that were assigned, to be sent before the first pass
    std::vector<shared::DexelEnd> patch_ends;
    std::vector<Stage> stages;
    std::size_t next_stage = 0;
    std::uint32_t pending = 0;  // rays of that stage that the last submission left
    bool one_pass = false;      // the next submission has only one, to count what a tool covers
    // The submission under way.
    std::optional<gpu::Submission> submission;
    std::vector<Pass> passes;
    CarveStats stats;
    // The cells around what it has changed: nothing where another takes them, where they are not all from one
    // submission, or where the device had no room.
    bool is_between = false;  // sweeps that the host carries out: who makes cells makes them after those
    bool makes_cells = false;
    int changing_submissions = 0;
    std::optional<MadeCells> made;

    [[nodiscard]] bool is_done() const { return !submission && next_stage == stages.size(); }
    // Returns the passes that come next: of about so many work groups, one task at least, and as long as no ray can
    // have become too long. `longest` is the number of ends of the longest ray.
    [[nodiscard]] std::vector<Pass> next_passes(std::size_t most_groups, std::uint32_t longest) const;
    // Returns the tasks of balls that a pass cuts with.
    [[nodiscard]] std::span<const shared::CutTask> tasks_of(const Pass& pass) const;
    // Goes on to after the first `count` passes of the submission; the one behind them has left rays pending.
    void pass(std::size_t count, std::uint32_t left_pending);
    // Leaves what was not carried out of a stage, and all that follow, to the host.
    void leave_to_host(std::size_t stage);
};

}  // namespace burin::compute
