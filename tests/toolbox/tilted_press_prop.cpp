// SPDX-License-Identifier: MIT
// A tool that is pressed with half of what the material bears holds still, however it is tilted: below the yield
// nothing is cut, and it does not slip along its own face.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/text.hpp"
#include "haptics/forces/cutting.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/sculpt/area_in_plane.hpp"
#include "tests/support/property_cases.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::toolbox {
namespace {

using compute::test::Random;

constexpr double kDt_s = 1e-3, kStiffness_N_per_m = 600.0, kYield_Pa = 2.4e4;

struct Tilted {
    const char* name;
    compute::ToolShape shape;
};

// A tool that has sunk into the plane y = 0, which was not cut yet, under a hand that presses straight down.
class SunkTool {
public:
    SunkTool(const compute::ToolShape& shape, const Quat& turn, double depth_m)
        : tool_(felt_tool(shape).surface), mesh_(mesh_of(shape)), turn_(turn) {
        double lowest_m = HUGE_VAL;
        for (const Vec3& p : mesh_.positions_m) lowest_m = std::min(lowest_m, (turn * p).y);
        on_plane_m_ = {0.0, -lowest_m, 0.0};
        state_.engaged = true;
        state_.orientation_object = turn;
        state_.point_object_m = on_plane_m_ - Vec3(0.0, depth_m, 0.0);
    }
    // Of the pressure p0 on all that faces down below the plane; by the clipped mesh.
    [[nodiscard]] double threshold_N() const {
        const Vec3 sum_m2 = haptics::test::area_in_plane(mesh_, {state_.point_object_m, turn_}).vector_m2;
        return -kYield_Pa * sum_m2.y;
    }
    // One tick under this force.
    void press(double force_N) {
        haptics::CuttingInput in;
        in.orientation_object = turn_;
        in.proxy_object_m = on_plane_m_;
        in.hip_object_m = state_.point_object_m - Vec3(0.0, force_N / kStiffness_N_per_m, 0.0);
        in.cutting = true;
        in.slack_m = 1.0;
        in.stiffness_N_per_m = kStiffness_N_per_m;
        in.dt_s = kDt_s;
        static const haptics::test::Surface plane = haptics::test::plane(0.05, 200);
        state_.known = haptics::look_at(state_, in, tool_, *plane, {1'000'000, 1'000'000}).known;
        haptics::TouchMaterial material;
        material.hardness_Ns_per_m3 = 4e6;
        material.cutting_yield_Pa = kYield_Pa;
        state_ = haptics::cut(state_, in, tool_, material).next;
    }
    [[nodiscard]] Vec3 place_m() const { return state_.point_object_m; }

private:
    haptics::ToolSurface tool_;
    geometry::TriangleMesh mesh_;
    Quat turn_;
    Vec3 on_plane_m_{0.0};
    haptics::CuttingState state_;
};

std::array<Tilted, 5> tools() {
    return {Tilted{"mill", compute::CylinderTool{0.001, 0.006}},
            Tilted{"cone", compute::ConeTool{0.0005, 0.002, 0.006}},
            Tilted{"bull-nose", compute::BullNoseTool{0.0015, 0.0005, 0.006}},
            Tilted{"box", compute::BoxTool{{0.002, 0.0015, 0.0025}}},
            Tilted{"mesh", compute::MeshTool{
                               std::make_shared<geometry::TriangleMesh>(haptics::test::six_sided_bar(0.0015, 0.005))}}};
}

Quat tilted_by(double degrees, double towards) {
    const double half = 0.5 * degrees * std::numbers::pi / 180.0;
    return {std::cos(half), std::sin(half) * std::cos(towards), 0.0, std::sin(half) * std::sin(towards)};
}

}  // namespace

TEST(TiltedPress, HalfTheYieldHoldsStill) {
    const burin::test::PropertyCases cases = burin::test::property_cases();
    Random random(cases.seed);
    const bool is_soak = burin::test::costly_cases(10) == 10;
    const int times = burin::test::costly_cases(20), ticks = is_soak ? 1000 : 300;
    for (const Tilted& tool : tools())
        for (const double degrees : {0.0, 1.0, 3.0, 5.0, 10.0})
            for (int i = 0; i < times; ++i) {
                const double depth_m = random.between(0.0002, 0.0006), towards = random.between(0.0, 6.28);
                SunkTool sunk(tool.shape, tilted_by(degrees, towards), depth_m);
                const double threshold_N = sunk.threshold_N();
                const Vec3 before = sunk.place_m();
                // The press begins beyond what the material bears, so that the tool goes somewhere.
                for (int k = 0; k < 20; ++k) sunk.press(1.1 * threshold_N);
                for (int k = 0; k < 20; ++k) sunk.press(0.5 * threshold_N);
                const Vec3 still = sunk.place_m();
                for (int k = 0; k < ticks; ++k) sunk.press(0.5 * threshold_N);
                EXPECT_LT(glm::length(sunk.place_m() - still), 1e-9 * ticks)
                    << formatted("%s tilted by %g degrees towards %g, %g mm deep, %g N, went %g mm before", tool.name,
                                 degrees, towards, 1e3 * depth_m, threshold_N, 1e3 * glm::length(still - before));
            }
}

}  // namespace burin::toolbox
