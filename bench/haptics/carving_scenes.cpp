// SPDX-License-Identifier: MIT
#include "bench/haptics/carving_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "toolbox/tool_mesh.hpp"

namespace burin::bench {
namespace {

// Steps of a tick, and how far a hand that leads is before the tool.
constexpr double kLeads_m = 0.0025, kFall_m = 1e-5, kGoes_m = 2e-5, kPushes = 0.1;
constexpr double kLiftedFrom_m = 0.003, kOfTool = 0.8, kClear_m = 0.0005, kNoForce_N = 0.01;
constexpr double kFirstGroove_m = 0.0015, kAgainDeeper_m = 0.0007;
constexpr double kTick_s = 1e-3;
const CarvedBlock kPlungedBlock{{0.03, 0.016, 0.03}};

bool has(const haptics::TickRecord& record, std::uint32_t flag) { return (record.flags & flag) != 0; }

double asked_N(const haptics::TickRecord& record) { return glm::length(record.contact.wrench.force_device_N); }

template <typename Figures>
void note(Figures& figures, const haptics::TickRecord& record) {
    ++figures.ticks;
    figures.limited += has(record, haptics::kTickWorkLimited) ? 1 : 0;
}

// Leads the tool down to a depth and along to x, pressed as much as that takes, and rests.
void carve_groove(CarvingHand& hand, double from_x, double to_x, double depth_m) {
    double pushed_m = 0.0;
    const auto lead = [&](double x, double y) {
        const Vec3 at = hand.cut_m();
        // Pushed down the farther the longer it lies too high, and never lifted by more than it lies too low. A push
        // that follows the error at once swings between the yield and free air.
        pushed_m = std::clamp(pushed_m + kPushes * (at.y - y), 0.0, kLeads_m);
        hand.go_to({std::min(x, at.x + kLeads_m), y - pushed_m, 0.0}, true);
    };
    for (int i = 0; i < 50; ++i) hand.go_to({from_x, 0.001, 0.0}, false);
    for (int i = 0; i < 4000 && hand.cut_m().y > -depth_m; ++i) lead(from_x, std::max(0.001 - kFall_m * i, -depth_m));
    double x = from_x;
    for (int i = 0; i < 4000 && hand.cut_m().x < to_x; ++i) lead(x += kGoes_m, -depth_m);
    const Vec3 at = hand.cut_m();
    for (int i = 0; i < 200; ++i) hand.go_to(at, i < 100);
}

}  // namespace

Lifted lift_out(const compute::ToolShape& tool, int resolution, double speed_m_per_s) {
    CarvingHand hand(tool, {.resolution = resolution});
    // A ball is as wide as its groove up to its middle alone, and a box that is wholly in it cuts itself a roof.
    double depth_m = kLiftedFrom_m;
    if (const auto* ball = std::get_if<compute::BallTool>(&tool)) depth_m = kOfTool * ball->radius_m;
    if (const auto* box = std::get_if<compute::BoxTool>(&tool)) depth_m = kOfTool * 2.0 * box->half_size_m.y;
    carve_groove(hand, -0.005, 0.005, depth_m);
    const Vec3 at = hand.cut_m();
    Lifted figures;
    for (double up = 0.0; up < 4.0 * kLiftedFrom_m; up += speed_m_per_s * kTick_s) {
        const haptics::TickRecord& record = hand.go_to(at + Vec3(0.0, up, 0.0), false);
        note(figures, record);
        figures.let_go += has(record, haptics::kTickLetGo) ? 1 : 0;
        const double given_N = glm::length(record.gate.given.force_device_N);
        figures.way.push_back({up, given_N});
        if (at.y + up <= kClear_m) {
            figures.most_inside_N = std::max(figures.most_inside_N, asked_N(record));
            continue;
        }
        figures.most_clear_N = std::max(figures.most_clear_N, given_N);
        figures.held_clear += std::max(given_N, asked_N(record)) > kNoForce_N ? 1 : 0;
    }
    return figures;
}

Sunk sink(const compute::ToolShape& tool, int resolution, double of_yield, double from_m) {
    constexpr int kSettles = 150, kMost = 900, kLeast = 400;
    constexpr double kDown_m = 0.0012, kStrong = 3.0, kMost_N = 3.0;
    CarvedBlock block = kPlungedBlock;
    block.resolution = resolution;
    CarvingHand hand(tool, block);
    const geometry::TriangleMesh mesh = toolbox::mesh_of(tool);
    const double yield_Pa = hand.material().cutting_yield_Pa, hardness = hand.material().hardness_Ns_per_m3;
    for (int i = 0; i < 200; ++i) hand.go_to({0.0, 0.002 - 2e-5 * i, 0.0}, i > 110);
    for (int i = 0; i < 6000 && -hand.cut_m().y < from_m; ++i)
        hand.press(
            std::min(kStrong * yield_Pa * plunged_areas(mesh, std::max(-hand.cut_m().y, 1e-4)).section_m2, kMost_N));
    Sunk figures;
    double law_m = 0.0, began_m = 0.0;
    for (int i = 0; i < kMost; ++i) {
        const PlungedAreas areas = plunged_areas(mesh, -hand.cut_m().y);
        if (i == kSettles) began_m = -hand.cut_m().y;
        const haptics::TickRecord& record = hand.press(of_yield * yield_Pa * areas.section_m2);
        if (i < kSettles) continue;
        note(figures, record);
        law_m += kTick_s * std::max(of_yield - 1.0, 0.0) * yield_Pa * areas.section_m2 / (hardness * areas.into_m2);
        if (i > kLeast && -hand.cut_m().y > from_m + kDown_m) break;
    }
    const double time_s = kTick_s * static_cast<double>(figures.ticks);
    figures.law_m_per_s = law_m / time_s;
    figures.found_m_per_s = (-hand.cut_m().y - began_m) / time_s;
    return figures;
}

CarvedAgain carve_again(const compute::ToolShape& tool, int resolution, double speed_m_per_s) {
    constexpr double kEnd_m = 0.006, kJudged_m = 0.0045, kAbove_m = 0.008;
    CarvingHand hand(tool, {.resolution = resolution});
    carve_groove(hand, -kEnd_m, kEnd_m, kFirstGroove_m);
    const Vec3 at = hand.cut_m();
    for (int i = 0; i < 200; ++i) hand.go_to(at + Vec3(0.0, 5e-5 * i, 0.0), false);
    for (int i = 0; i < 300; ++i) hand.go_to({at.x - i / 300.0 * (at.x + kJudged_m), kAbove_m, 0.0}, false);
    const double deep_m = at.y - kAgainDeeper_m;
    for (int i = 0; i < 400; ++i)
        hand.go_to({-kJudged_m, kAbove_m + std::min(1.0, i / 300.0) * (deep_m - kAbove_m), 0.0}, false);
    CarvedAgain figures;
    figures.right_N = kAgainDeeper_m * hand.stiffness_N_per_m();
    for (double x = -kJudged_m; x < kJudged_m; x += speed_m_per_s * kTick_s) {
        const haptics::TickRecord& record = hand.go_to({x, deep_m, 0.0}, false);
        note(figures, record);
        figures.let_go += has(record, haptics::kTickLetGo) ? 1 : 0;
        figures.mean_N += asked_N(record);
        figures.most_N = std::max(figures.most_N, asked_N(record));
        figures.cost_us.push_back(hand.cost_us());
    }
    figures.mean_N /= static_cast<double>(figures.ticks);
    return figures;
}

Drawn draw_along(const compute::ToolShape& tool, int resolution) {
    constexpr double kDeep_m = 0.0015, kEnd_m = 0.006, kJudgedFrom_m = -0.003, kSpeed_m_per_s = 0.011;
    CarvingHand hand(tool, {.resolution = resolution});
    for (int i = 0; i < 50; ++i) hand.go_to({-kEnd_m, 0.001, 0.0}, false);
    for (int i = 0; i < 500; ++i)
        hand.go_to({-kEnd_m, 0.001 - std::min(1.0, i / 250.0) * (0.001 + kDeep_m), 0.0}, true);
    Drawn figures;
    double judged = 0.0;
    for (double x = -kEnd_m; x < kEnd_m; x += kSpeed_m_per_s * kTick_s) {
        const haptics::TickRecord& record = hand.go_to({x, -kDeep_m, 0.0}, true);
        note(figures, record);
        figures.let_go += has(record, haptics::kTickLetGo) ? 1 : 0;
        figures.cost_us.push_back(hand.cost_us());
        if (x < kJudgedFrom_m) continue;
        figures.mean_N += asked_N(record);
        ++judged;
    }
    figures.mean_N /= judged;
    for (int i = 0; i < 20; ++i) hand.go_to({kEnd_m, 0.005, 0.0}, false);
    figures.removed_mm3 = hand.removed_mm3();
    return figures;
}

Plunged plunge(const compute::ToolShape& tool, int resolution, bool at_once) {
    constexpr double kPressed_m = 0.002, kDown_m = 0.004, kFeltFrom_N = 0.05;
    constexpr int kTicks = 1200, kFelt = 150, kWindow = 10;
    CarvedBlock block = kPlungedBlock;
    block.resolution = resolution;
    CarvingHand hand(tool, block);
    if (at_once)
        for (int i = 0; i < 15; ++i) hand.go_to({0.0, 0.0001 - kFall_m * i, 0.0}, i > 5);
    else
        for (int i = 0; i < 150; ++i) hand.go_to({0.0, 0.001 - kFall_m * std::min(i, 110), 0.0}, false);
    Plunged figures;
    std::vector<double> depths;
    for (int i = 0; i < kTicks; ++i) {
        const double deep_m = std::max(0.0, -hand.cut_m().y) + std::min(1.0, i / 20.0) * kPressed_m;
        const haptics::TickRecord& record = hand.go_to({0.0, -deep_m, 0.0}, true);
        ++figures.ticks;
        figures.let_go += has(record, haptics::kTickLetGo) ? 1 : 0;
        figures.without_force += i > kFelt && asked_N(record) < kFeltFrom_N ? 1 : 0;
        figures.most_cost_us = std::max(figures.most_cost_us, hand.cost_us());
        depths.push_back(-hand.cut_m().y);
        if (i >= kWindow)
            figures.fastest_m_per_s = std::max(
                figures.fastest_m_per_s, (depths.back() - depths[depths.size() - 1 - kWindow]) / (kWindow * kTick_s));
        if (depths.back() > kDown_m) break;
    }
    return figures;
}

}  // namespace burin::bench
