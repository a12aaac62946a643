// SPDX-License-Identifier: MIT
// A tube without thickness, open at both ends, touched from inside and from outside by whole ticks of a simulated Omni
// in a simulated hand, which goes through the wall and round it: the force is the spring's, towards the side on which
// the proxy is. How proxies hold on bent tubes, at all radii, is tested in two_sided_prop.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>

#include "base/plot/figures.hpp"
#include "tests/haptics/rig.hpp"
#include "tests/haptics/smooth_shapes.hpp"

namespace burin::haptics {
namespace {

constexpr double kTube_m = 0.012, kHalfLength_m = 0.02, kBall_m = 0.001, kStiffness_N_per_m = 600.0;
constexpr int kSides = 72;
const double kFacet = std::numbers::pi / kSides;  // half of what a facet sees of the circle

// Around the y axis. Each triangle is seen from both sides.
test::Surface tube() {
    geometry::TriangleMesh mesh;
    constexpr int kRings = 20;
    for (int j = 0; j <= kRings; ++j)
        for (int i = 0; i < kSides; ++i) {
            const double angle = 2.0 * kFacet * i;
            mesh.positions_m.push_back(
                {kTube_m * std::cos(angle), kHalfLength_m * (2.0 * j / kRings - 1.0), kTube_m * std::sin(angle)});
        }
    for (std::uint32_t j = 0; j < kRings; ++j)
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t a = j * kSides + i, b = j * kSides + (i + 1) % kSides;
            mesh.triangles.push_back({a, a + kSides, b});
            mesh.triangles.push_back({b, a + kSides, b + kSides});
        }
    test::Surface surface = test::touchable(mesh);
    surface->meshes[0].two_sided = true;
    return surface;
}

Vec3 out_of(const Vec3& p) { return glm::normalize(Vec3(p.x, 0.0, p.z)); }
double from_axis(const Vec3& p) { return glm::length(Vec3(p.x, 0.0, p.z)); }

// What a round tube pushes back with.
Vec3 force_by_the_book(const Vec3& hand_m, bool inside) {
    const double depth_m = inside ? from_axis(hand_m) - (kTube_m - kBall_m) : kTube_m + kBall_m - from_axis(hand_m);
    return depth_m > 0.0 ? (inside ? -1.0 : 1.0) * kStiffness_N_per_m * depth_m * out_of(hand_m) : Vec3(0.0);
}

// Chords lie inside the circle; a proxy on one of them is off along it too, by the facet's tilt.
constexpr double kDeepest_m = 0.003;
const double kTolerance_N =
    kStiffness_N_per_m * ((kTube_m + kDeepest_m) * (1.0 - std::cos(kFacet)) + 1e-3 * kBall_m + 1e-6);

TickParameters parameters(bool keeps_promise) {
    TickParameters p;
    p.probe = ball_probe(kBall_m);
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.materials[0].stiffness_N_per_m = kStiffness_N_per_m;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    p.passivity.control = keeps_promise;
    return p;
}

// The hand is led to the wall and beyond it, once round while it presses more and less, and back, in 3.6 s.
constexpr int kTicks = 3600;
std::vector<devices::HandPose> once_round(bool inside) {
    std::vector<devices::HandPose> script;
    for (double t = 0.0; t <= 1e-3 * kTicks; t += 0.01) {
        const double closed = std::clamp((t - 0.3) / 0.4, 0.0, 1.0) - std::clamp((t - 3.0) / 0.4, 0.0, 1.0);
        const double angle = 2.0 * std::numbers::pi * std::clamp((t - 0.8) / 2.1, 0.0, 1.0);
        const double beyond_m = 0.0015 + 0.0025 * std::cos(5.0 * angle);
        const double away_m = inside ? 0.0 : 0.02, pressed_m = inside ? kTube_m + beyond_m : kTube_m - beyond_m;
        const double at_m = away_m + closed * (pressed_m - away_m);
        script.push_back({t, {at_m * std::cos(angle), 0.0, at_m * std::sin(angle)}});
    }
    return script;
}

// A hand that holds firmly: half of what it wants to press it does press.
constexpr devices::HandGrip kFirm{0.1, 800.0, 12.0};

}  // namespace

TEST(Tube, WithoutThicknessPushesBackByTheDepthFromInsideAndFromOutside) {
    const test::Surface surface = tube();
    for (const bool keeps_promise : {false, true})
        for (const bool inside : {true, false}) {
            test::Rig rig(once_round(inside), kFirm);
            rig.publish(*surface, 1);
            rig.publish(parameters(keeps_promise), 1);
            int touched = 0, beyond = 0, in_full = 0;
            double most_N = 0.0, worst_N = 0.0;
            for (int i = 0; i < kTicks; ++i) {
                const TickRecord r = rig.tick();
                const Vec3 hand = r.sample.position_device_m, book = force_by_the_book(hand, inside);
                const Vec3 wanted = r.deepest().force_device_N, given = r.gate.given.force_device_N;
                worst_N = std::max(worst_N, std::abs(glm::length(wanted) - glm::length(book)));
                ASSERT_NEAR(glm::length(wanted), glm::length(book), kTolerance_N) << inside << ' ' << i;
                ASSERT_LE(glm::length(wanted - book), kTolerance_N + kFacet * glm::length(book)) << inside << ' ' << i;
                ASSERT_LE(glm::length(given), glm::length(wanted) + 1e-9) << inside << ' ' << i;
                if (!r.in_contact()) continue;
                ++touched;
                ASSERT_LT(from_axis(hand), kTube_m + kDeepest_m);
                // The proxy is never on the hand's side where the hand is beyond the wall.
                beyond += (from_axis(hand) > kTube_m) == inside ? 1 : 0;
                in_full += glm::length(given - wanted) < 1e-9 ? 1 : 0;
                ASSERT_EQ(from_axis(r.deepest().proxy_object_m) < kTube_m, inside) << i;
                most_N = std::max(most_N, glm::length(book));
            }
            std::printf("%s%s: %d ticks of contact, hand beyond the wall in %d; up to %.2f N, off by up to %.1f mN\n",
                        inside ? "inside" : "outside", keeps_promise ? ", with the account" : "", touched, beyond,
                        most_N, 1e3 * worst_N);
            EXPECT_GT(touched, 2000);
            EXPECT_GT(beyond, 1000) << "else a wall with a back would do";
            EXPECT_GT(most_N, 0.8);
            EXPECT_EQ(in_full, touched) << "the account affords it";
        }
}

TEST(Tube, IsGoneRoundByItsOpenEndAndThenFeltFromItsOtherSide) {
    // Pressed from inside, along the wall past the end, over the rim, and pressed from outside at the same place.
    const auto place = [](double x, double y) { return Vec3(x, y, 0.0); };
    const std::vector<devices::HandPose> script{
        {0.0, place(0.0, 0.0)},     {0.3, place(0.0, 0.0)},     {0.7, place(0.015, 0.0)},   {1.1, place(0.015, 0.0)},
        {1.6, place(0.010, 0.015)}, {2.0, place(0.010, 0.028)}, {2.4, place(0.018, 0.028)}, {2.9, place(0.018, 0.0)},
        {3.3, place(0.009, 0.0)},   {3.8, place(0.009, 0.0)}};
    test::Rig rig(script, kFirm);
    rig.publish(*tube(), 1);
    rig.publish(parameters(false), 1);
    int inward = 0, outward = 0;
    for (int i = 0; i < 3800; ++i) {
        const TickRecord r = rig.tick();
        if (!r.in_contact()) continue;
        const Vec3 force = r.gate.given.force_device_N;
        if (i > 700 && i < 1100) {
            ASSERT_LT(force.x, -0.5) << i;
            ++inward;
        }
        if (i > 3300) {
            ASSERT_GT(force.x, 0.5) << i;
            ++outward;
        }
        ASSERT_FALSE(r.contact.jumped) << i;
    }
    EXPECT_GT(inward, 390);
    EXPECT_GT(outward, 490);
}

// docs/pictures/tube.svg is this file.
TEST(Tube, IsSeenInAPicture) {
    const test::Surface surface = tube();
    std::vector<plot::Plot> plots;
    for (const bool inside : {true, false}) {
        test::Rig rig(once_round(inside), kFirm);
        rig.publish(*surface, 1);
        rig.publish(parameters(false), 1);
        const std::string side = inside ? "from inside" : "from outside";
        plot::Plot ways{side + ": ways in the section y = 0", "x, mm", "z, mm", {}};
        plot::Plot force{side + ": force, outwards positive", "time, s", "force, N", {}};
        ways.x_linear = ways.y_linear = ways.same_scale = force.x_linear = force.y_linear = true;
        ways.markers = force.markers = false;
        ways.series = {{"hand", {}, 1.5},
                       {"proxy: middle of the ball", {}, 1.5},
                       {"commanded force", {}, {}},
                       {"spring times depth, of a round tube", {}, {}},
                       {"wall of the tube", {}, 2.5}};
        force.series = {{"spring times depth, of a round tube", {}, 4.0}, {"commanded force", {}, 1.2}};
        for (int i = 0; i < kTicks; ++i) {
            const TickRecord r = rig.tick();
            if (i % 10 != 0) continue;
            const Vec3 hand = r.sample.position_device_m, proxy = r.deepest().proxy_object_m;
            ways.series[0].points.push_back({1e3 * hand.x, 1e3 * hand.z, ""});
            ways.series[1].points.push_back({1e3 * proxy.x, 1e3 * proxy.z, ""});
            const Vec3 out = from_axis(hand) > 1e-9 ? out_of(hand) : Vec3(1.0, 0.0, 0.0);
            const Vec3 book = from_axis(hand) > 1e-9 ? force_by_the_book(hand, inside) : Vec3(0.0);
            force.series[0].points.push_back({1e-3 * i, glm::dot(book, out), ""});
            force.series[1].points.push_back({1e-3 * i, glm::dot(r.gate.given.force_device_N, out), ""});
        }
        for (int i = 0; i <= kSides; ++i)
            ways.series[4].points.push_back(
                {1e3 * kTube_m * std::cos(2.0 * kFacet * i), 1e3 * kTube_m * std::sin(2.0 * kFacet * i), ""});
        plots.push_back(std::move(ways));
        plots.push_back(std::move(force));
    }
    const std::string text = plot::svg_figure("A tube without thickness, touched from both sides", plots, 2);
    EXPECT_NE(text.find("from outside: ways"), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
    std::ofstream file(testing::TempDir() + "tube.svg");
    file << text;
    EXPECT_TRUE(file.good());
}

}  // namespace burin::haptics
