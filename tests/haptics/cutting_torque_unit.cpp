// SPDX-License-Identifier: MIT
// The torque of the material on every kind of tool that cuts, against an integral of its own: each small piece of the
// tool's mesh that lies in the material is resisted along its normal by the hardness times its speed along it, and the
// torque is the sum of arm times force about the tool's origin.
// The tool is pressed over the edge of a block, beside its axis, towards four sides in turn, and may turn besides. The
// block, the mapping and the tool lie slanted, at scale 1.7.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "haptics/tick.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/uneven_poses.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::haptics {
namespace {

constexpr double kCutTick_s = 1e-3, kCutHardness_Ns_per_m3 = 1e6;

struct CuttingKind {
    const char* name;
    compute::ToolShape shape;
    double turns_rad_per_s = 0.0;
    // Of the torque: the samples with which a tool cuts lie sparsely on a cone's tip and on a box's edges.
    double within = 0.0;
};

std::vector<CuttingKind> cutting_kinds() {
    return {{"ball", compute::BallTool{0.003}, 15.0, 0.2},
            {"mill", compute::CylinderTool{0.003, 0.012}, 15.0, 0.18},
            {"cone", compute::ConeTool{0.0015, 0.004, 0.012}, 5.0, 0.4},
            {"bull-nose", compute::BullNoseTool{0.003, 0.001, 0.012}, 15.0, 0.15},
            {"box", compute::BoxTool{{0.004, 0.0025, 0.003}}, 5.0, 0.28},
            {"mesh", compute::MeshTool{std::make_shared<geometry::TriangleMesh>(test::six_sided_bar(0.003, 0.01))}, 5.0,
             0.2}};
}

// The upper face of a block that ends at x = 0 of the bench's frame: its material is where x < 0 and y < 0.
test::Surface half_plane(const Pose& object_from_bench) {
    test::SurfaceBuilder builder(object_from_bench.position_m);
    constexpr int kSquares = 40;
    constexpr double kSide_m = 0.001;
    const auto at = [&](int i, int j) {
        return object_from_bench * Vec3(-kSide_m * (kSquares - i), 0.0, kSide_m * (j - kSquares));
    };
    for (int i = 0; i < kSquares; ++i)
        for (int j = 0; j < 2 * kSquares; ++j) builder.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    return builder.finish();
}

// Returns the torque at the device, in the object's axes, of a tool that was at `before` a tick ago.
Vec3 torque_by_pieces(const geometry::TriangleMesh& mesh, const Pose& before, const Pose& now,
                      const Pose& object_from_bench, double scale) {
    constexpr int kParts = 2;
    const Quat bench_from_object = glm::conjugate(object_from_bench.orientation);
    Vec3 torque_Nm(0.0);
    for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.positions_m[t[0]], u = (mesh.positions_m[t[1]] - a) / double(kParts),
                   v = (mesh.positions_m[t[2]] - a) / double(kParts);
        const Vec3 area = 0.5 * glm::cross(u, v);
        const double area_m2 = glm::length(area);
        if (!(area_m2 > 0.0)) continue;
        const Vec3 out = now.orientation * (area / area_m2);
        for (int j = 0; j < kParts; ++j)
            for (int i = 0; i + j < kParts; ++i)
                for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
                    if (third > 0.5 && i + j + 1 >= kParts) continue;
                    const Vec3 piece = a + (i + third) * u + (j + third) * v, place = now * piece;
                    const Vec3 in_bench = bench_from_object * (place - object_from_bench.position_m);
                    if (in_bench.x >= 0.0 || in_bench.y >= 0.0) continue;
                    const double speed = glm::dot(out, place - before * piece) / (scale * kCutTick_s);
                    if (speed <= 0.0) continue;
                    const Vec3 force_N = -kCutHardness_Ns_per_m3 * speed * area_m2 / (scale * scale) * out;
                    torque_Nm += glm::cross((place - now.position_m) / scale, force_N);
                }
    }
    return torque_Nm;
}

TickParameters cutting_parameters(const toolbox::FeltTool& felt) {
    TickParameters parameters;
    parameters.probe = felt.probe;
    parameters.shape = felt.shape;
    parameters.tool = felt.surface;
    parameters.action = ToolAction::cut;
    parameters.clearance_ratio = 0.0;
    parameters.limit_stiffness = false;
    parameters.passivity.control = false;
    parameters.max_surface_age_s = 0.0;
    parameters.materials[0].hardness_Ns_per_m3 = kCutHardness_Ns_per_m3;
    parameters.materials[0].cutting_yield_Pa = 0.0;
    parameters.materials[0].stiffness_N_per_m = 600.0;
    parameters.materials[0].damping_Ns_per_m = 0.0;
    return parameters;
}

struct CutTorque {
    Vec3 told_Nm{0.0}, expected_Nm{0.0};  // in the device's axes
    double force_N = 0.0;
};

// Presses the tool down over the edge, which lies towards `side_rad` of its axis, and turns it in the last ticks.
CutTorque press_over_the_edge(const toolbox::FeltTool& felt, const geometry::TriangleMesh& mesh, double side_rad,
                              const Vec3& turning_rad_per_s) {
    constexpr int kTicks = 80;                            // down to half of the size of the smallest
    constexpr double kFall_m = 3e-5, kTurned_rad = 0.08;  // in a tick, and in all
    const Similarity map{uneven_offset(2), uneven_turn(3), kUnevenScales[0]};
    const Pose slanted = uneven_pose(0);
    const Pose object_from_bench{slanted.position_m,
                                 slanted.orientation * glm::angleAxis(side_rad, Vec3(0.0, 1.0, 0.0))};
    const test::Surface surface = half_plane(object_from_bench);
    const Quat tool_turn = slanted.orientation * glm::angleAxis(0.4, Vec3(0.0, 1.0, 0.0));
    double lowest_m = HUGE_VAL;
    for (const Vec3& p : mesh.positions_m) lowest_m = std::min(lowest_m, p.y);
    TickParameters parameters = cutting_parameters(felt);
    parameters.workspace.object_from_device = map;
    TickState state;
    TickRecord record;
    Pose now, before;
    for (int i = 0; i < kTicks; ++i) {
        const double height_m = 0.001 - lowest_m - kFall_m * i, speed = glm::length(turning_rad_per_s);
        const double turning_s = std::max(0.0, kCutTick_s * (i - kTicks + 1) + kTurned_rad / std::max(speed, 1e-9));
        const Quat turned =
            speed > 0.0 ? glm::angleAxis(speed * turning_s, turning_rad_per_s / speed) * tool_turn : tool_turn;
        const Vec3 hip = slanted * Vec3(0.0, height_m, 0.0);
        devices::DeviceSample sample;
        sample.time_ns = (i + 1) * 1'000'000;
        sample.buttons = 1;
        sample.position_device_m = glm::conjugate(map.orientation) * (hip - map.position_m) / map.scale;
        sample.orientation_device = glm::conjugate(map.orientation) * turned;
        const Tick t = tick(state, sample, *surface, parameters, test::kStrongDevice, sample.time_ns, kCutTick_s);
        state = t.next;
        record = t.record;
        before = now;
        now = {record.contact.cut_object_m, turned};
    }
    EXPECT_NE(record.flags & kTickCutting, 0u);
    const Quat device_from_object = glm::conjugate(map.orientation);
    return {record.contact.wrench.torque_device_Nm,
            device_from_object * torque_by_pieces(mesh, before, now, object_from_bench, map.scale),
            glm::length(record.contact.wrench.force_device_N)};
}

}  // namespace

TEST(CuttingTorque, OfEveryKindOfToolIsThatOfTheMaterialOnItsPiecesAboutItsOrigin) {
    for (const CuttingKind& kind : cutting_kinds()) {
        const toolbox::FeltTool felt = toolbox::felt_tool(kind.shape);
        const geometry::TriangleMesh mesh = toolbox::mesh_of(kind.shape);
        const double size_m = felt.surface.size_m / kUnevenScales[0];
        for (int side = 0; side < 4; ++side)
            for (const double rate_rad_per_s : {0.0, kind.turns_rad_per_s, -kind.turns_rad_per_s}) {
                const Vec3 turning = rate_rad_per_s * uneven_direction(static_cast<std::size_t>(side));
                const CutTorque torque = press_over_the_edge(felt, mesh, 0.3 + 0.5 * std::numbers::pi * side, turning);
                const std::string what = std::string(kind.name) + ", side " + std::to_string(side) + ", turning " +
                                         std::to_string(rate_rad_per_s);
                if (std::getenv("BURIN_PRINT_TORQUES") != nullptr)
                    std::printf("%s: off by %.2f of %g\n", what.c_str(),
                                glm::length(torque.told_Nm - torque.expected_Nm) / glm::length(torque.expected_Nm),
                                glm::length(torque.expected_Nm));
                const double most_Nm =
                    kind.within * std::max(glm::length(torque.expected_Nm), 0.1 * size_m * torque.force_N);
                EXPECT_LT(glm::length(torque.told_Nm - torque.expected_Nm), most_Nm) << what;
                EXPECT_GT(torque.force_N, 0.01) << what;
            }
    }
}

// By the law alone: half of a mill's face is over the edge of a block, so that the material presses on half a disc,
// whose middle is 4 r / 3 pi beside the axis, with H v on each place. With a session's clearance nothing but what cuts
// bears it.
TEST(CuttingTorque, OfAMillThatCutsBesideItsAxisIsItsForceAtTheMiddleOfHalfADisc) {
    constexpr double kRadius_m = 0.003, kFallsIn_m = 2e-5, kDeep_m = 0.0008;
    const toolbox::FeltTool felt = toolbox::felt_tool(compute::CylinderTool{kRadius_m, 0.012});
    const Pose bench{Vec3(0.0), Quat(1.0, 0.0, 0.0, 0.0)};
    const test::Surface surface = half_plane(bench);
    TickParameters parameters = cutting_parameters(felt);
    parameters.clearance_ratio = TickParameters{}.clearance_ratio;
    const double tip_m = toolbox::tip_m(compute::CylinderTool{kRadius_m, 0.012});
    const double half_disc_m2 = 0.5 * std::numbers::pi * kRadius_m * kRadius_m;
    const double lever_m = 4.0 * kRadius_m / (3.0 * std::numbers::pi);
    TickState state;
    double last_m = HUGE_VAL;
    int judged = 0;
    for (int i = 0; 0.001 - kFallsIn_m * i > -kDeep_m; ++i) {
        devices::DeviceSample sample;
        sample.time_ns = (i + 1) * 1'000'000;
        sample.buttons = 1;
        sample.position_device_m = Vec3(0.0, tip_m + 0.001 - kFallsIn_m * i, 0.0);
        const Tick t = tick(state, sample, *surface, parameters, test::kStrongDevice, sample.time_ns, kCutTick_s);
        state = t.next;
        const double at_m = t.record.contact.cut_object_m.y;
        const double speed_m_per_s = (last_m - at_m) / kCutTick_s;
        last_m = at_m;
        if (at_m > tip_m - 0.1 * kDeep_m) continue;
        ++judged;
        const double law_N = kCutHardness_Ns_per_m3 * speed_m_per_s * half_disc_m2;
        EXPECT_GT(law_N, 0.05) << i;
        const devices::DeviceWrench& wrench = t.record.contact.wrench;
        EXPECT_NEAR(wrench.force_device_N.y, law_N, 0.05 * law_N) << i;
        // The material is where x < 0: arm (-lever, 0, 0) times force (0, F, 0).
        EXPECT_NEAR(wrench.torque_device_Nm.z, -lever_m * law_N, 0.05 * lever_m * law_N) << i;
        EXPECT_NEAR(wrench.torque_device_Nm.x, 0.0, 0.05 * lever_m * law_N) << i;
        EXPECT_NEAR(wrench.torque_device_Nm.y, 0.0, 0.05 * lever_m * law_N) << i;
    }
    EXPECT_GT(judged, 20);
}

}  // namespace burin::haptics
