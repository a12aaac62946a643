// SPDX-License-Identifier: MIT
#include "bench/workspace/workspace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/signals/filters.hpp"

namespace burin::bench {
namespace {

constexpr double kTick_s = 1e-3;
constexpr std::size_t kPathTicks = 20;  // paths are sampled every 20 ms, so that encoder steps and tremor add no length
constexpr double kEdge_m = 0.1;         // no target is nearer to the wall's sides
constexpr double kPoll_s = 0.02;

std::vector<Vec3> targets_on(const WorkspaceTask& task) {
    Chance chance(task.seed);
    const Vec3 half = 0.5 * task.wall_m - Vec3(kEdge_m, kEdge_m, 0.0);
    std::vector<Vec3> targets;
    for (int i = 0; i < task.targets; ++i) {
        const double x = chance.uniform(-half.x, half.x), y = chance.uniform(-half.y, half.y);
        targets.emplace_back(x, y, chance.uniform(-half.z, half.z));
    }
    return targets;
}

Vec3 in_omni_steps(const Vec3& p, double step_m) { return glm::floor(p / step_m + 0.5) * step_m; }

// Delays a position by the time of vision: what is seen now is what was a while ago.
class Delay {
public:
    explicit Delay(double delay_s) : places_(static_cast<std::size_t>(delay_s / kTick_s) + 1) {}
    // Stores the newest position and returns the oldest.
    Vec3 pass(const Vec3& newest) {
        if (!filled_) std::ranges::fill(places_, newest);
        filled_ = true;
        places_[at_] = newest;
        at_ = (at_ + 1) % places_.size();
        return places_[at_];
    }

private:
    std::vector<Vec3> places_;
    std::size_t at_ = 0;
    bool filled_ = false;
};

// The hand at the device, the technique, and the scene's tool; persists from target to target.
class Session {
public:
    Session(const Approach& approach, const WorkspaceTask& task)
        : task_(task),
          settings_(settings_of(approach, task)),
          strategist_(approach, settings_),
          hand_(task.hand, omni_.workspace_m, task.seed + 1),
          seen_(task.vision_s),
          seen_before_(task.vision_s + 0.05),
          felt_(task.vision_s) {
        tick();
    }

    [[nodiscard]] Reach reach(const Vec3& target_object);

private:
    void tick();
    void decide(const Vec3& target_object);
    void note_path(Reach& reach);
    [[nodiscard]] double error_m(const Vec3& target_object) const { return glm::length(target_object - tool_object_); }
    [[nodiscard]] double hold_m(const Vec3& target_object);

    WorkspaceTask task_;
    devices::OmniModel omni_;
    haptics::WorkspaceSettings settings_;
    Strategist strategist_;
    ReachingHand hand_;
    Delay seen_, seen_before_, felt_;
    haptics::WorkspaceState state_;
    haptics::VelocityWindow window_;
    Vec3 force_device_N_{0.0}, tool_object_{0.0};
    View view_;
    bool paused_ = false;
    std::optional<bool> finger_;  // its state after the press or release under way
    double time_s_ = 0.0, finger_at_s_ = 0.0, ready_s_ = 0.0;
    bool waits_for_hand_ = false;
    double rest_s_ = 0.0;
    std::size_t ticks_ = 0;
    Vec3 path_hand_{0.0}, path_tool_{0.0};  // the last samples of the paths
};

void Session::tick() {
    time_s_ += kTick_s;
    ++ticks_;
    if (finger_ && time_s_ >= finger_at_s_) {
        view_.button = *finger_;
        finger_.reset();
    }
    haptics::WorkspaceInput input;
    input.position_device_m = in_omni_steps(hand_.step(force_device_N_, kTick_s), omni_.resolution_m);
    window_ = haptics::with_position(window_, input.position_device_m);
    input.velocity_device_m_per_s = velocity_m_per_s(window_, omni_.resolution_m, kTick_s);
    input.buttons = view_.button ? settings_.button_mask : 0;
    input.dt_s = kTick_s;
    const haptics::WorkspaceStep step = haptics::step_workspace(state_, settings_, input);
    state_ = step.next;
    paused_ = step.paused;
    const double wanted_N = glm::length(step.force_device_N);
    force_device_N_ = step.force_device_N * (wanted_N > omni_.max_force_N ? omni_.max_force_N / wanted_N : 1.0);
    tool_object_ = step.object_from_device * input.position_device_m;
    view_.tool_object = seen_.pass(tool_object_);
    view_.tool_before_object = seen_before_.pass(tool_object_);
    view_.felt_device_m = felt_.pass(input.position_device_m);
    view_.hand_device_m = input.position_device_m;
    view_.goal_device_m = hand_.goal_device_m();
}

// Decides once the last decision has been carried out and its result has been seen.
void Session::decide(const Vec3& target_object) {
    if (waits_for_hand_) {
        if (hand_.moving()) return;
        waits_for_hand_ = false;
        ready_s_ = time_s_ + rest_s_;
    }
    if (time_s_ < ready_s_ || finger_) return;
    view_.target_object = target_object;
    view_.vision_s = task_.vision_s;
    view_.finger_s = task_.finger_s;
    const Decision decision = strategist_.decide(view_);
    if (decision.goal_device_m) hand_.aim(*decision.goal_device_m);
    if (decision.button) {
        finger_ = decision.button;
        finger_at_s_ = time_s_ + task_.finger_s;
    }
    rest_s_ = decision.rest_s;
    waits_for_hand_ = decision.goal_device_m.has_value() && !decision.keeps_moving;
    ready_s_ = time_s_ + std::max(kPoll_s, rest_s_) + (decision.button ? task_.finger_s : 0.0);
}

void Session::note_path(Reach& reach) {
    if (ticks_ % kPathTicks != 0) return;
    reach.hand_path_m += glm::length(view_.hand_device_m - path_hand_);
    reach.tool_path_m += glm::length(tool_object_ - path_tool_);
    path_hand_ = view_.hand_device_m;
    path_tool_ = tool_object_;
}

double Session::hold_m(const Vec3& target_object) {
    const int ticks = static_cast<int>(task_.hold_s / kTick_s);
    double sum = 0.0;
    for (int i = 0; i < ticks; ++i) {
        tick();
        decide(target_object);
        if (2 * i >= ticks) sum += error_m(target_object) * error_m(target_object);
    }
    return std::sqrt(sum / (ticks - ticks / 2));
}

Reach Session::reach(const Vec3& target_object) {
    Reach reach;
    const Vec3 start = tool_object_;
    const std::uint32_t presses = state_.presses;
    reach.distance_m = error_m(target_object);
    const Vec3 way = reach.distance_m > 0.0 ? (target_object - start) / reach.distance_m : Vec3(0.0);
    path_hand_ = view_.hand_device_m;
    path_tool_ = tool_object_;
    ready_s_ = time_s_ + task_.vision_s + 0.1;  // time to see the target and to begin
    const double began_s = time_s_;
    double arrived_s = time_s_;
    // A fixed workspace that does not contain the target never will.
    const bool fixed = settings_.technique == haptics::WorkspaceTechnique::fixed;
    const double give_up_s = fixed ? std::min(task_.give_up_s, 5.0) : task_.give_up_s;
    while (time_s_ - began_s < give_up_s && time_s_ - arrived_s < task_.dwell_s) {
        tick();
        decide(target_object);
        note_path(reach);
        reach.overshoot_m = std::max(reach.overshoot_m, glm::dot(tool_object_ - target_object, way));
        if (paused_ || error_m(target_object) > task_.target_radius_m) arrived_s = time_s_;
    }
    reach.reached = time_s_ - arrived_s >= task_.dwell_s;
    reach.time_s = arrived_s - began_s;
    reach.presses = static_cast<int>(state_.presses - presses);
    if (reach.reached) reach.precision_m = hold_m(target_object);
    return reach;
}

}  // namespace

haptics::WorkspaceSettings settings_of(const Approach& approach, const WorkspaceTask& task) {
    haptics::WorkspaceSettings settings;
    settings.technique = approach.technique;
    settings.workspace_device_m = devices::OmniModel{}.workspace_m;
    const Vec3& w = settings.workspace_device_m;
    settings.scaling_gain = std::max(task.wall_m.x / w.x, task.wall_m.y / w.y);
    // Leaves room for the boxes at the wall's edge and at the ends of its depth.
    const Vec3 half = 0.5 * task.wall_m + Vec3(0.0, 0.0, w.z);
    settings.reach_object = {-half, half};
    return settings;
}

WorkspaceFigures reach_targets(const Approach& approach, const WorkspaceTask& task,
                               const std::vector<Vec3>& targets_object) {
    WorkspaceFigures figures{approach, {}};
    Session session(approach, task);
    for (const Vec3& target : targets_object) figures.reaches.push_back(session.reach(target));
    return figures;
}

WorkspaceFigures reach_targets(const Approach& approach, const WorkspaceTask& task) {
    return reach_targets(approach, task, targets_on(task));
}

}  // namespace burin::bench
