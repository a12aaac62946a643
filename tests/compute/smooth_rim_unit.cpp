// SPDX-License-Identifier: MIT
// What smoothing makes of a straight rim that lies askew on the lattice: how far it sinks, and how much the result
// varies along it. Both are measured on the mesh that is exported, and on the rays' ends, since a rounded rim's mesh
// varies by itself: the yardstick for it is the mesh of an exact fillet that lies as deep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "compute/tools/apply.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/compute/test_meshes.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& rim_pool() {
    static WorkerPool two(2);
    return two;
}

constexpr Vec3 kRimHalf{0.1, 0.07, 0.05};  // of the block, m
constexpr double kRimMiddle = 0.03;        // m to each side of the rim's middle are measured

// The rim along a turned block's x, at its upper y and z.
struct TurnedRim {
    Quat turn;
    [[nodiscard]] Vec3 along() const { return turn * Vec3(1, 0, 0); }
    [[nodiscard]] Vec3 out() const { return turn * glm::normalize(Vec3(0, 1, 1)); }
    [[nodiscard]] Vec3 across() const { return turn * glm::normalize(Vec3(0, 1, -1)); }
    // Returns a place's coordinates along the rim, across it and out of it.
    [[nodiscard]] Vec3 seen(const Vec3& p) const {
        const Vec3 off = p - turn * Vec3(0, kRimHalf.y, kRimHalf.z);
        return {glm::dot(off, along()), glm::dot(off, across()), glm::dot(off, out())};
    }
    [[nodiscard]] Vec3 at(double along_m, double out_m = 0.0) const {
        return turn * Vec3(0, kRimHalf.y, kRimHalf.z) + along_m * along() + out_m * out();
    }
};

TurnedRim turned_by_20_degrees(const Vec3& axis) {
    return {glm::angleAxis(20.0 * std::numbers::pi / 180.0, glm::normalize(axis))};
}

Solid block_with(const TurnedRim& rim, int resolution) {
    return scan_convert(transformed(box_mesh(-kRimHalf, kRimHalf), rim.turn), resolution, rim_pool())->solid;
}

// The same block on the same lattice, its four edges along x rounded so that each lies `sink_m` deeper.
Solid fillet_of(const TurnedRim& rim, const Lattice& lattice, double sink_m) {
    constexpr int kSteps = 64;
    const double radius_m = sink_m / (std::numbers::sqrt2 - 1.0);
    geometry::TriangleMesh mesh;
    std::vector<Vec2> outline;
    for (int i = 0; i < 4 * (kSteps + 1); ++i) {
        const int corner = i / (kSteps + 1);
        const double angle = 0.5 * std::numbers::pi * (corner + double(i % (kSteps + 1)) / kSteps);
        const Vec2 middle((kRimHalf.y - radius_m) * (corner == 0 || corner == 3 ? 1 : -1),
                          (kRimHalf.z - radius_m) * (corner < 2 ? 1 : -1));
        outline.push_back(middle + radius_m * Vec2(std::cos(angle), std::sin(angle)));
    }
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double x : {-kRimHalf.x, kRimHalf.x})
        for (const Vec2& p : outline) mesh.positions_m.emplace_back(x, p.x, p.y);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        mesh.triangles.push_back({i, next, next + n});
        mesh.triangles.push_back({i, next + n, i + n});
        if (i == 0 || next == 0) continue;
        mesh.triangles.push_back({0, next, i});
        mesh.triangles.push_back({n, n + i, n + next});
    }
    return scan_convert_onto(transformed(mesh, rim.turn), lattice, rim_pool())->solid;
}

struct RimFigures {
    double sink_m = 0.0;       // mean depth below the sharp rim
    double variation_m = 0.0;  // standard deviation of the depth along the rim
    double slope_deg = 0.0;    // root mean square of the surface's slope along the rim
    double rays_m = 0.0;       // root mean square distance of the rays' ends from one profile for the whole rim
};

// Returns how far the ends within 2 mm of the rim lie from the parabola through those with about the same place across
// it, wherever these lie along the rim.
double scatter_of_ends(const Solid& solid, const TurnedRim& rim) {
    std::vector<Vec2> profile;  // across, out
    for (int axis = 0; axis < 3; ++axis) {
        const DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
        for (int v = 0; v < set.rays_v(); ++v)
            for (int u = 0; u < set.rays_u(); ++u)
                for (const shared::DexelEnd& end : set.ends(u, v)) {
                    Vec3 units(0.0);
                    units[axis] = depth_of(end);
                    units[(axis + 1) % 3] = u * 4096.0;
                    units[(axis + 2) % 3] = v * 4096.0;
                    const Vec3 p = rim.seen(solid.lattice.object_from_units(units));
                    if (std::abs(p.x) < kRimMiddle && std::abs(p.y) < 3e-3 && std::abs(p.z) < 6e-3)
                        profile.emplace_back(p.y, p.z);
                }
    }
    std::ranges::sort(profile, {}, [](const Vec2& p) { return p.x; });
    constexpr std::size_t kSides = 12;  // neighbours to each side
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = kSides; i + kSides < profile.size(); ++i) {
        if (std::abs(profile[i].x) > 2e-3) continue;
        const double unit = profile[i + kSides].x - profile[i - kSides].x + 1e-12;
        glm::dmat3 squares(0.0);
        Vec3 by_height(0.0);
        for (std::size_t k = i - kSides; k <= i + kSides; ++k) {
            const double t = (profile[k].x - profile[i].x) / unit;
            const Vec3 powers(1.0, t, t * t);
            squares += glm::outerProduct(powers, powers);
            by_height += powers * profile[k].y;
        }
        const Vec3 fit = glm::inverse(squares) * by_height;
        const double off = (profile[i].y - fit.x) / std::hypot(1.0, fit.y / unit);
        sum += off * off;
        ++count;
    }
    return std::sqrt(sum / std::max(count, 1));
}

// Measures the mesh where a plane through the rim and its outward direction cuts it.
RimFigures rim_of(const Solid& solid, const TurnedRim& rim) {
    Surface surface(solid.lattice);
    surface.mesh_all(solid, rim_pool());
    const geometry::TriangleMesh mesh = surface.welded();
    constexpr int kPlaces = 600;
    std::vector<double> height(kPlaces + 1, -1.0), slope(kPlaces + 1, 0.0);
    for (const auto& triangle : mesh.triangles) {
        std::array<Vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p.at(i) = rim.seen(mesh.positions_m[triangle.at(i)]);
        const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
        const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (low > 0.0 || high < 0.0 || normal.z <= 0.0) continue;
        for (int i = 0; i <= kPlaces; ++i) {
            const double x = kRimMiddle * (2.0 * i / kPlaces - 1.0);
            bool within = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 a = p.at(k), b = p.at((k + 1) % 3);
                within = within && (b.x - a.x) * (0.0 - a.y) - (b.y - a.y) * (x - a.x) >= 0.0;
            }
            const double z = p[0].z - (normal.x * (x - p[0].x) - normal.y * p[0].y) / normal.z;
            const auto place = static_cast<std::size_t>(i);
            if (!within || z <= height[place]) continue;
            height[place] = z;
            slope[place] = std::atan(normal.x / std::hypot(normal.y, normal.z)) * 180.0 / std::numbers::pi;
        }
    }
    RimFigures figures;
    for (const double z : height) figures.sink_m -= z / (kPlaces + 1);
    for (std::size_t i = 0; i <= kPlaces; ++i) {
        figures.variation_m += std::pow(height[i] + figures.sink_m, 2.0) / (kPlaces + 1);
        figures.slope_deg += slope[i] * slope[i] / (kPlaces + 1);
    }
    return {figures.sink_m, std::sqrt(figures.variation_m), std::sqrt(figures.slope_deg), scatter_of_ends(solid, rim)};
}

void pass_along(CarvingEngine& engine, const TurnedRim& rim, double radius_m, double piece_m = 0.2) {
    constexpr double kReach = 0.06;
    const int pieces = static_cast<int>(std::ceil(2.0 * kReach / piece_m));
    for (int i = 0; i < pieces; ++i) {
        const auto at = [&](int k) { return Pose{rim.at(kReach * (2.0 * k / pieces - 1.0))}; };
        const ToolSweep sweep{BallTool{radius_m}, at(i), at(i + 1), Operation::smooth};
        const auto done = engine.carve({&sweep, 1});
        ASSERT_TRUE(done) << done.error().line();
    }
}

void print_rim(const char* what, int passes, const RimFigures& figures) {
    std::printf("%18s, %d passes: sinks %.3f mm, varies by %.1f um, slope %.2f degrees, rays by %.1f um\n", what,
                passes, figures.sink_m * 1e3, figures.variation_m * 1e6, figures.slope_deg, figures.rays_m * 1e6);
}

}  // namespace

// The mesh of an exact fillet varies by up to 0.06 cells where its radius is a cell, 0.01 where it is eight.
TEST(SmoothRim, SixPassesLeaveItAsEvenAsAFillet) {
    for (const int resolution : {128, 256}) {
        for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 1, 1)}) {
            const TurnedRim rim = turned_by_20_degrees(axis);
            const auto engine = make_cpu_engine(block_with(rim, resolution), rim_pool());
            const Lattice& lattice = engine->solid().lattice;
            std::printf("N = %d, turned about (%g, %g, %g), cells of %.3f mm\n", resolution, axis.x, axis.y, axis.z,
                        lattice.spacing_m * 1e3);
            print_rim("sharp", 0, rim_of(engine->solid(), rim));
            RimFigures last;
            for (int i = 1; i <= 6; ++i) {
                pass_along(*engine, rim, 0.008);
                if (i % 3 != 0 && i != 1) continue;
                const RimFigures now = rim_of(engine->solid(), rim);
                const RimFigures fillet = rim_of(fillet_of(rim, lattice, now.sink_m), rim);
                print_rim("smoothed", i, now);
                print_rim("a fillet as deep", i, fillet);
                EXPECT_GT(now.sink_m, last.sink_m + 0.02e-3);
                EXPECT_LT(now.variation_m, fillet.variation_m + 0.01 * lattice.spacing_m);
                EXPECT_LT(now.slope_deg, fillet.slope_deg + 1.0);
                EXPECT_LT(now.rays_m, 0.02 * lattice.spacing_m);
                if (i > 1) {
                    EXPECT_LT(now.rays_m, last.rays_m);
                }
                last = now;
            }
            EXPECT_NEAR(last.sink_m, 2.5e-3, 0.1e-3);  // the same at either resolution, however turned
        }
    }
}

// A ball carves notches along the rim, 0.4 mm deep and 2 mm apart. Each pass leaves less of them.
TEST(SmoothRim, EveryPassMakesANotchedRimEvener) {
    const TurnedRim rim = turned_by_20_degrees({1, 1, 1});
    const auto engine = make_cpu_engine(block_with(rim, 256), rim_pool());
    for (double x = -0.07; x < 0.07; x += 0.004) {
        const BallSweep notch{rim.at(x, 0.0026), rim.at(x, 0.0026), 0.003, 0, Operation::cut};
        ASSERT_TRUE(engine->carve({&notch, 1}));
    }
    const RimFigures notched = rim_of(engine->solid(), rim);
    RimFigures last = notched;
    print_rim("notched", 0, notched);
    for (int i = 1; i <= 6; ++i) {
        pass_along(*engine, rim, 0.008);
        const RimFigures now = rim_of(engine->solid(), rim);
        print_rim("smoothed", i, now);
        EXPECT_LT(now.variation_m, 0.25 * notched.variation_m);
        EXPECT_LT(now.slope_deg, 0.35 * notched.slope_deg);
        EXPECT_LT(now.variation_m, last.variation_m);
        EXPECT_LT(now.slope_deg, last.slope_deg);
        EXPECT_LT(now.rays_m, last.rays_m);
        last = now;
    }
}

// A session cuts a stroke into pieces as its frames come. Pieces of 0.2 mm to 4 mm, and one of 120 mm, do the same.
TEST(SmoothRim, HowAStrokeIsCutDoesNotMatter) {
    const TurnedRim rim = turned_by_20_degrees({1, 1, 1});
    std::vector<double> sinks_m;
    for (const double piece_m : {0.0002, 0.001, 0.004, 0.2}) {
        const auto engine = make_cpu_engine(block_with(rim, 128), rim_pool());
        pass_along(*engine, rim, 0.008, piece_m);
        sinks_m.push_back(rim_of(engine->solid(), rim).sink_m);
        std::printf("in pieces of %.1f mm it sinks %.3f mm\n", piece_m * 1e3, sinks_m.back() * 1e3);
    }
    const auto [least, most] = std::ranges::minmax(sinks_m);
    EXPECT_LT(most, 1.02 * least);
}

TEST(SmoothRim, SinksAlikeAtEveryResolution) {
    const TurnedRim rim = turned_by_20_degrees({0, 0, 1});
    std::vector<double> sinks_m;
    for (const int resolution : {96, 128, 192, 256}) {
        const auto engine = make_cpu_engine(block_with(rim, resolution), rim_pool());
        for (int i = 0; i < 3; ++i) pass_along(*engine, rim, 0.016);
        sinks_m.push_back(rim_of(engine->solid(), rim).sink_m);
        std::printf("N = %d: sinks %.3f mm\n", resolution, sinks_m.back() * 1e3);
    }
    const auto [least, most] = std::ranges::minmax(sinks_m);
    EXPECT_LT(most, 1.03 * least);
}

// A ball of 2 mm has carved a groove 1 mm deep along a face.
TEST(SmoothRim, AGrooveFills) {
    for (const int resolution : {128, 256}) {
        const auto engine = make_cpu_engine(*make_block(2.0 * kRimHalf, resolution, {"block", {}}), rim_pool());
        const Vec3 from(0.05, 0.07, 0.1), to(0.15, 0.08, 0.1);
        const BallSweep groove{from + Vec3(0, 0, 0.001), to + Vec3(0, 0, 0.001), 0.002, 0, Operation::cut};
        ASSERT_TRUE(engine->carve({&groove, 1}));
        const auto depth_m = [&] {  // in the rays along z near the middle of the groove
            const Lattice& lattice = engine->solid().lattice;
            double deepest_m = 0.0;
            for (int v = 0; v < lattice.rays_v(2); ++v)
                for (int u = 0; u < lattice.rays_u(2); ++u) {
                    const auto ends = engine->solid().sets[2].ends(u, v);
                    if (ends.empty()) continue;
                    const Vec3 p = lattice.object_from_units(Vec3(u * 4096.0, v * 4096.0, depth_of(ends.back())));
                    if (std::abs(p.x - 0.1) < 0.01 && std::abs(p.y - 0.075) < 0.01)
                        deepest_m = std::max(deepest_m, 0.1 - p.z);
                }
            return deepest_m;
        };
        const double before_m = depth_m();
        double last_m = before_m;
        for (int i = 0; i < 6; ++i) {
            const ToolSweep sweep{BallTool{0.008}, Pose{from}, Pose{to}, Operation::smooth};
            ASSERT_TRUE(engine->carve({&sweep, 1}));
            const double now_m = depth_m();
            std::printf("N = %d: the groove is %.3f mm deep, %.3f mm after pass %d\n", resolution, before_m * 1e3,
                        now_m * 1e3, i + 1);
            EXPECT_LT(now_m, last_m);
            last_m = now_m;
        }
        EXPECT_LT(last_m, 0.25 * before_m);
    }
}

}  // namespace burin::compute::test
