// SPDX-License-Identifier: MIT
// The torque of a tool that lies flat: of a pressure that is even over where it lies, however the surface is meshed.
// Whole ticks within the budget of a session, on a device that drives torque.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "haptics/tick.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/fine_plane.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/support/property_cases.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

using test::fine_plane;
using test::FinePlane;

struct FlatTool {
    const char* name;
    toolbox::FeltTool felt;
    double below_m;  // from the tool's origin to its flat side
};

std::vector<FlatTool> flat_tools() {
    const auto bar = std::make_shared<geometry::TriangleMesh>(test::six_sided_bar(0.0015, 0.005));
    return {{"mill", toolbox::felt_tool(compute::CylinderTool{0.001, 0.006}), 0.0},
            {"bull-nose", toolbox::felt_tool(compute::BullNoseTool{0.0015, 0.0005, 0.006}), 0.0},
            {"box", toolbox::felt_tool(compute::BoxTool{{0.002, 0.0015, 0.0025}}), 0.0015},
            {"mesh", toolbox::felt_tool(compute::MeshTool{bar}), 0.0}};
}

// A tool that a hand presses onto the plane and draws over it.
class FlatPress {
public:
    FlatPress(const FinePlane& plane, const FlatTool& tool, double turn_rad) : plane_(plane), tool_(tool) {
        parameters_.sequence = 1;
        parameters_.probe = tool.felt.probe;
        parameters_.shape = tool.felt.shape;
        parameters_.tool = tool.felt.surface;
        parameters_.action = ToolAction::cut;
        parameters_.limit_stiffness = false;
        parameters_.passivity.control = false;
        parameters_.max_surface_age_s = 0.0;
        const Quat upright = glm::quat_cast(glm::dmat3(plane.across, plane.normal, plane.along));
        held_ = glm::normalize(upright * glm::angleAxis(turn_rad, Vec3(0.0, 1.0, 0.0)));
    }
    // The wrench with the tool's origin over this place of the plane, pressed in so far.
    devices::DeviceWrench press(const Vec3& place, double pressed_m) {
        devices::DeviceSample sample;
        sample.time_ns = ++tick_ * 1'000'000;
        sample.position_device_m = place + (tool_.below_m - pressed_m) * plane_.normal;
        sample.orientation_device = held_;
        const Tick t =
            haptics::tick(state_, sample, *plane_.surface, parameters_, test::kStrongDevice, sample.time_ns, kDt);
        state_ = t.next;
        limited = (t.record.flags & kTickWorkLimited) != 0;
        return t.record.contact.wrench;
    }
    bool limited = false;

private:
    const FinePlane& plane_;
    const FlatTool& tool_;
    TickParameters parameters_;
    TickState state_;
    Quat held_{1.0, 0.0, 0.0, 0.0};
    std::int64_t tick_ = 0;
};

}  // namespace

TEST(ShapeTorque, AFlatToolInTheMiddleOfAPlaneHasNone) {
    const burin::test::PropertyCases cases = burin::test::property_cases();
    compute::test::Random random(cases.seed);
    const int ticks = compute::test::repeated(static_cast<int>(cases.count / 10));
    for (const double edge_m : {0.001, 0.0005, 0.00025, 0.0001, 0.00005}) {
        const FinePlane plane = fine_plane(edge_m, 0.0055, test::Meshed::as_mesh);
        for (const FlatTool& tool : flat_tools()) {
            FlatPress press(plane, tool, random.between(0.0, 2.0 * std::numbers::pi));
            const double heading = random.between(0.0, 2.0 * std::numbers::pi);
            const Vec3 way = std::cos(heading) * plane.across + std::sin(heading) * plane.along;
            for (int i = 0; i <= 60; ++i) press.press(Vec3(0.0), 0.0008 * (i / 50.0 - 0.2));
            double most_m = 0.0;
            for (int i = 0; i < ticks; ++i) {
                const devices::DeviceWrench wrench = press.press(2e-6 * i * way, 0.0008);
                EXPECT_GT(glm::dot(wrench.force_device_N, plane.normal), 0.3) << tool.name;
                most_m = std::max(most_m, glm::length(wrench.torque_device_Nm) / glm::length(wrench.force_device_N));
            }
            EXPECT_LT(most_m, 0.02 * tool.felt.shape.size_m) << tool.name << ", edges of " << 1e3 * edge_m << " mm";
        }
    }
}

// Half of the box hangs over the plane's rim: the other half bears it, in the middle of that half.
TEST(ShapeTorque, AFlatToolThatHangsOverARimIsBorneWhereItLies) {
    const FlatTool box = flat_tools()[2];
    for (const double edge_m : {0.001, 0.0005, 0.00025, 0.0001, 0.00005}) {
        const FinePlane plane = fine_plane(edge_m, 0.0055, test::Meshed::as_mesh);
        FlatPress press(plane, box, 0.0);
        const Vec3 rim = 0.0055 * plane.across;
        devices::DeviceWrench wrench;
        for (int i = 0; i <= 80; ++i) wrench = press.press(rim, 0.0008 * std::min(i / 50.0 - 0.2, 1.0));
        // The torque of a force at an arm a along -across.
        const Vec3 expected = glm::cross(-0.001 * plane.across, wrench.force_device_N);
        EXPECT_GT(glm::length(wrench.force_device_N), 0.3);
        EXPECT_LT(glm::length(wrench.torque_device_Nm - expected), 0.1 * glm::length(expected))
            << "edges of " << 1e3 * edge_m << " mm: " << glm::length(wrench.torque_device_Nm - expected) << " of "
            << glm::length(expected);
    }
}

}  // namespace burin::haptics
