// SPDX-License-Identifier: MIT
// A tool's shape on a flat plane, however finely it is meshed: what the hand feels is known exactly, since the plane's
// edges are nothing to be felt. Led, rocked and turned, with and without friction, within the budget of a tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "haptics/contact/separation.hpp"
#include "haptics/contact/shape_proxy.hpp"
#include "tests/compute/effort.hpp"
#include "tests/haptics/fine_plane.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

using compute::test::Random;
using test::fine_plane;
using test::FinePlane;
using test::Meshed;

constexpr double kPressed_m = 0.0008;
constexpr int kTicksOfARun = 100;

enum class Handling { led, rocked, turned };
constexpr std::array kHandlingNames{"led", "rocked", "turned"};

// How the hand holds the tool; turned about the plane's normal or rocked about an axis in it.
Quat held_at(const FinePlane& plane, Handling hand, double time_s) {
    const Quat upright = glm::quat_cast(glm::dmat3(plane.across, plane.normal, plane.along));
    const auto about = [](const Vec3& axis, double angle) {
        return glm::normalize(Quat(std::cos(0.5 * angle), std::sin(0.5 * angle) * axis));
    };
    if (hand == Handling::led) return upright;
    if (hand == Handling::turned) return about(plane.normal, 2.0 * time_s) * upright;
    const Vec3 axis = glm::normalize(plane.across + 0.3 * plane.along);
    return about(axis, 0.35 * std::sin(2.0 * std::numbers::pi * time_s)) * upright;
}

// The height of the rounded tool's lowest place above the plane.
double lowest_m(const ToolShape& shape, const Quat& orientation, const Vec3& place, const Vec3& normal) {
    const Vec3 normal_tool = glm::conjugate(orientation) * normal;
    double least = HUGE_VAL;
    for (std::uint32_t i = 0; i < shape.piece_count; ++i)
        least = std::min(least, lowest(shape, shape.pieces[i], normal_tool));
    return least + glm::dot(place, normal) - shape.rounding_m;
}

struct Felt {
    int ticks = 0, wrong = 0, far_off = 0, limited = 0;
    double most = 0.0, most_ns = 0.0;

    Felt& operator+=(const Felt& other) {
        ticks += other.ticks, wrong += other.wrong, far_off += other.far_off, limited += other.limited;
        most = std::max(most, other.most), most_ns = std::max(most_ns, other.most_ns);
        return *this;
    }
};

// The hand is pressed in by 0.8 mm and goes at 2 mm/s. Wrong: the force is off by more than 5 %; far off: by 30.
Felt feel(const FinePlane& plane, const ToolShape& shape, Handling hand, double friction, int ticks, Random& random) {
    constexpr double kSpeed_m_per_s = 0.002, kTick_s = 0.001;
    Felt felt;
    ProxyState state;
    const double heading = random.between(0.0, 2.0 * std::numbers::pi), begins_s = random.between(0.0, 1.0);
    const Vec3 way = std::cos(heading) * plane.across + std::sin(heading) * plane.along;
    Vec3 place = random.between(-5e-4, 5e-4) * plane.across + random.between(-5e-4, 5e-4) * plane.along;
    Quat orientation = held_at(plane, hand, begins_s);
    const auto put = [&](double pressed_m, double time_s) {
        const Quat wanted = held_at(plane, hand, begins_s + time_s);
        const Vec3 hip = place - (pressed_m + lowest_m(shape, wanted, Vec3(0.0), plane.normal)) * plane.normal;
        const ShapeResult moved =
            move_shape(state, {hip, orientation, wanted, friction, friction}, shape, *plane.surface);
        state = moved.proxy.next;
        orientation = moved.orientation_object;
        felt.limited += moved.proxy.work_limited;
        felt.most_ns = std::max(felt.most_ns, cost_ns(moved.proxy.work));
        return state.position_object_m - hip;
    };
    for (int i = 0; i <= 60; ++i) put(kPressed_m * (i / 50.0 - 0.2), 0.0);
    felt = {};
    for (int i = 0; i < ticks; ++i) {
        place += kSpeed_m_per_s * kTick_s * way;
        const Vec3 spring = put(kPressed_m, i * kTick_s);
        const double normal_m = glm::dot(spring, plane.normal), aside_m = glm::length(spring - normal_m * plane.normal);
        const double off = std::max(std::abs(normal_m - kPressed_m), aside_m - friction * kPressed_m) / kPressed_m;
        ++felt.ticks;
        felt.wrong += off > 0.05;
        felt.far_off += off > 0.30;
        felt.most = std::max(felt.most, off);
    }
    return felt;
}

void expect_planes_felt_as_planes(const std::vector<double>& edges_m, Meshed how, int ticks) {
    const burin::test::PropertyCases cases = burin::test::property_cases();
    Random random(cases.seed);
    const std::vector<test::NamedTool> tools = test::session_tools(0.003);
    for (const double edge_m : edges_m) {
        const FinePlane plane = fine_plane(edge_m, 0.0055, how);
        for (const test::NamedTool& tool : tools)
            for (const Handling hand : {Handling::led, Handling::rocked, Handling::turned})
                for (const double friction : {0.0, 0.3}) {
                    Felt felt;
                    for (int left = ticks; left > 0; left -= kTicksOfARun)
                        felt += feel(plane, tool.shape, hand, friction, std::min(left, kTicksOfARun), random);
                    const std::string what = std::string(tool.name) + " " +
                                             kHandlingNames[static_cast<std::size_t>(hand)] + ", edges of " +
                                             std::to_string(1e3 * edge_m) + " mm, friction " + std::to_string(friction);
                    EXPECT_LE(felt.wrong, felt.ticks / 1000) << what << ", off by up to " << felt.most;
                    EXPECT_EQ(felt.far_off, 0) << what << ", off by up to " << felt.most;
                    EXPECT_EQ(felt.limited, 0) << what;
                }
    }
}

}  // namespace

TEST(FinePlane, IsFeltByEachToolAsThePlaneItIs) {
    constexpr int kCases = 5 * 5 * 3 * 2;
    const char* asked = std::getenv("BURIN_SOAK_OPERATIONS");  // so many ticks in all
    const int ticks =
        asked != nullptr ? 1 + std::atoi(asked) / kCases : static_cast<int>(burin::test::property_cases().count / 10);
    expect_planes_felt_as_planes({0.001, 0.0005, 0.00025, 0.0001, 0.00005}, Meshed::as_mesh,
                                 compute::test::repeated(ticks));
}

TEST(FinePlane, OfLooseTrianglesIsFeltByEachToolAsThePlaneItIs) {
    const int ticks = compute::test::repeated(static_cast<int>(burin::test::property_cases().count / 10));
    expect_planes_felt_as_planes({0.001, 0.0005, 0.00025, 0.0001}, Meshed::loose, ticks);
}

}  // namespace burin::haptics
