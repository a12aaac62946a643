// SPDX-License-Identifier: MIT
// A tool's shape on bumps that are meshed finely: a tick whose work does not suffice still goes as far as what was
// looked at proves, so that the tool never stands still while the hand draws it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "haptics/contact/shape_proxy.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/haptics/smooth_shapes.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

using compute::test::Random;

constexpr double kTick_s = 0.001;

// A square field of bumps in the plane y = 0, 0.5 mm high and 3 mm apart; rough: each vertex moved by up to a fifth of
// an edge.
test::Surface field_of_bumps(double edge_m, double half_m, bool rough, std::uint64_t seed) {
    Random random(seed);
    const int n = static_cast<int>(std::ceil(2.0 * half_m / edge_m));
    const double waves = 2.0 * std::numbers::pi / 0.003, height_m = 0.00025, aside_m = rough ? 0.2 * edge_m : 0.0;
    geometry::TriangleMesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = -half_m + i * edge_m, z = -half_m + j * edge_m;
            const auto off = [&] { return random.between(-aside_m, aside_m); };
            mesh.positions_m.push_back(
                {x + off(), height_m * std::sin(waves * x) * std::sin(waves * z) + off(), z + off()});
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return test::touchable(mesh);
}

// What a hand that goes on all the time gets.
struct Progress {
    int ticks = 0, limited = 0, frozen = 0, frozen_in_a_row = 0;
    double most_ns = 0.0;
    void count(const ShapeResult& moved, const Vec3& before, double least_m) {
        ++ticks;
        limited += moved.proxy.work_limited;
        most_ns = std::max(most_ns, cost_ns(moved.proxy.work));
        const bool stands =
            moved.proxy.work_limited && glm::length(moved.proxy.next.position_object_m - before) < least_m;
        frozen += stands;
        row_ = stands ? row_ + 1 : 0;
        frozen_in_a_row = std::max(frozen_in_a_row, row_);
    }

private:
    int row_ = 0;
};

// The hand goes to and fro over the surface along its normal's plane, pressed in, and rocks the tool.
struct HandOnBumps {
    double speed_m_per_s = 0.02, friction = 0.0, pressed_m = 0.001, half_m = 0.002;
};

Progress go_over_bumps(const geometry::LocalSurface& surface, const ToolShape& shape, const HandOnBumps& hand,
                       int ticks, Random& random) {
    Progress progress;
    ProxyState state;
    const double heading = random.between(0.0, 2.0 * std::numbers::pi);
    const Vec3 way(std::cos(heading), 0.0, std::sin(heading)), axis(-way.z, 0.0, way.x);
    const Vec3 start(random.between(-0.001, 0.001), 0.0, random.between(-0.001, 0.001));
    const auto rocked = [&](double time_s) {
        const double angle = 0.175 * std::sin(2.0 * std::numbers::pi * time_s);
        return glm::normalize(Quat(std::cos(angle), std::sin(angle) * axis));
    };
    Quat held = rocked(0.0);
    const auto put = [&](double height_m, double along_m, double time_s) {
        const Quat wanted = rocked(time_s);
        const Vec3 hip = start + along_m * way + Vec3(0.0, height_m, 0.0);
        const ShapeResult moved = move_shape(state, {hip, held, wanted, hand.friction, hand.friction}, shape, surface);
        const Vec3 before = state.position_object_m;
        state = moved.proxy.next;
        held = moved.orientation_object;
        return std::pair{moved, before};
    };
    for (int i = 0; i < 200; ++i) put(0.002 - (0.002 + hand.pressed_m) * (i / 199.0), 0.0, 0.0);
    for (int i = 1; i <= ticks; ++i) {
        const double gone = hand.speed_m_per_s * kTick_s * i, turn = std::fmod(gone, 4.0 * hand.half_m);
        const double along = turn < hand.half_m         ? turn
                             : turn < 3.0 * hand.half_m ? 2.0 * hand.half_m - turn
                                                        : turn - 4.0 * hand.half_m;
        const auto [moved, before] = put(-hand.pressed_m, along, kTick_s * i);
        progress.count(moved, before, 1e-4 * shape.rounding_m);
    }
    return progress;
}

}  // namespace

TEST(ShapeBumps, AToolThatIsDrawnOverFineBumpsNeverStandsStill) {
    const burin::test::PropertyCases cases = burin::test::property_cases();
    Random random(cases.seed);
    const int ticks = burin::test::costly_cases(2500);
    for (const double edge_m : {0.0002, 0.0001, 0.00005})
        for (const bool rough : {false, true}) {
            const test::Surface surface = field_of_bumps(edge_m, 0.006, rough, cases.seed);
            for (const test::NamedTool& tool : test::session_tools(0.003))
                for (const double speed : {0.02, 0.1})
                    for (const double friction : {0.0, 0.3}) {
                        const Progress p = go_over_bumps(*surface, tool.shape, {speed, friction}, ticks, random);
                        const std::string what = std::string(tool.name) + (rough ? ", rough" : ", smooth") +
                                                 ", edges of " + std::to_string(1e3 * edge_m) + " mm, friction " +
                                                 std::to_string(friction) + ", m/s " + std::to_string(speed);
                        EXPECT_EQ(p.frozen, 0) << what << ", " << p.frozen_in_a_row << " in a row";
                        EXPECT_LE(p.most_ns, 1.02 * ProxyBudget{}.max_cost_ns) << what;
                    }
        }
}

}  // namespace burin::haptics
