// SPDX-License-Identifier: MIT
#include "compute/vulkan/flight.hpp"

#include <algorithm>

#include "shaders/shared/cut_job.h"

namespace burin::compute {
namespace {

constexpr std::size_t kGroup = shared::kCutGroup;

// A software driver stops the loops of a group of up to 16 invocations after 65535 iterations in total. About half of
// them are for testing capsules (kLooks in vulkan_engine.cpp), half for cutting.
constexpr std::uint32_t kCutTurns = 32000;
// Upper bound of the iterations in capsule_span and capsule_normal: about 5 x 28 halvings.
constexpr std::uint32_t kSearchTurns = 140;
constexpr std::uint32_t kMostCuts = 64;
// A ball that smooths may add twice this many ends to a ray, and takes about as long as so many visits of each ray.
constexpr std::uint32_t kMostMade = 8;
constexpr std::size_t kSmoothVisits = 16;

}  // namespace

std::uint32_t cuts_a_pass(std::uint32_t longest) {
    std::uint32_t cuts = kMostCuts;
    const auto turns = [&] { return cuts * (kSearchTurns + 3 * (longest + 2 * cuts)) + longest + 2 * cuts; };
    while (cuts > 1 && turns() > kCutTurns) --cuts;
    return cuts;
}

std::vector<Pass> Flight::next_passes(std::size_t most_groups, std::uint32_t longest) const {
    std::vector<Pass> next;
    const std::size_t most = one_pass ? 1 : shared::kMostPasses;
    std::size_t left = most_groups;
    if (pending > 0) {
        const std::size_t done = stages[next_stage].next_task;
        next.push_back({next_stage, done, done, pending, pending});
    }
    for (std::size_t i = next_stage; i < stages.size() && next.size() < most && left > 0; ++i) {
        const Stage& stage = stages[i];
        if (stage.is_of_balls()) {
            std::size_t end = stage.next_task, groups = 0;
            while (end < stage.end_task && groups < left) groups += groups_of(tasks.tasks[end++]);
            if (groups == 0) continue;
            next.push_back({i, stage.next_task, end, 0, static_cast<std::uint32_t>(groups * kGroup)});
            left -= std::min(left, groups);
            if (end < stage.end_task) break;
        } else if (stage.is_smooth()) {
            std::size_t ball = stage.next_task;
            for (; ball < stage.end_task && next.size() < most && left > 0; ++ball) {
                const std::uint32_t rays = stage.smooths[ball].rays;
                next.push_back({i, ball, ball + 1, 0, rays});
                left -= std::min<std::size_t>(left, kSmoothVisits * groups_of(rays));
            }
            if (ball < stage.end_task) break;
        } else {
            if (pending > 0 && i == next_stage) continue;
            const std::size_t groups = (stage.visited + kGroup - 1) / kGroup;
            if (groups > left && !next.empty()) break;
            next.push_back({i, 0, 0, 0, stage.visited});
            left -= std::min(left, groups);
        }
    }
    for (std::size_t i = 0; i < next.size(); ++i) {
        if (longest > kLongestRay) next.resize(i);
        if (i == next.size()) break;
        next[i].cuts = stages[next[i].stage].is_smooth() ? kMostMade : cuts_a_pass(longest);
        longest += 2 * next[i].cuts;
        next[i].most_ends = longest;
    }
    return next;
}

std::span<const shared::CutTask> Flight::tasks_of(const Pass& pass) const {
    if (!stages[pass.stage].is_of_balls()) return {};
    return std::span(tasks.tasks).subspan(pass.first_task, pass.end_task - pass.first_task);
}

void Flight::pass(std::size_t count, std::uint32_t left_pending) {
    pending = 0;
    for (std::size_t i = 0; i < std::min(passes.size(), count + (left_pending > 0 ? 1 : 0)); ++i) {
        Stage& stage = stages[passes[i].stage];
        if (!stage.is_covered()) stage.next_task = passes[i].end_task;
        next_stage = passes[i].stage;
        const bool is_done = i < count && (stage.is_covered() || stage.next_task == stage.end_task);
        if (is_done) ++next_stage;
    }
    pending = left_pending;
}

void Flight::leave_to_host(std::size_t stage) {
    on_host = stages[stage].first_sweep;
    first_ball = stages[stage].is_smooth() ? stages[stage].smooths[stages[stage].next_task].ball : 0;
    stages.resize(stage);
}

}  // namespace burin::compute
