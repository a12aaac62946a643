// SPDX-License-Identifier: MIT
// What burin convert --center, --place and --scale make of a carved solid and of a mesh, corner for corner: the formula
// of geometry/mesh/mesh_placing.hpp on numbers of which no two are alike, mirrored or not.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/meshes/convert_placing.hpp"
#include "base/text.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/scan_convert.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::app {
namespace {

// A slanted pyramid with no two equal sides, away from the origin.
geometry::TriangleMesh slanted_pyramid() {
    geometry::TriangleMesh mesh;
    const Vec3 at(0.13, -0.29, 0.41);
    mesh.positions_m = {at, at + Vec3(0.05, 0.004, 0.002), at + Vec3(0.007, 0.003, 0.033),
                        at + Vec3(0.011, 0.041, 0.009)};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    return mesh;
}

WorkerPool& placing_pool() {
    static WorkerPool one(1);
    return one;
}

// All corners of a solid's surface, tile by tile, in the object frame.
std::vector<Vec3> corners_of(const compute::Solid& solid) {
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, placing_pool());
    std::vector<Vec3> corners;
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t)
        for (const shared::SurfaceVertex& v : surface.tile(t).vertices)
            corners.push_back(solid.lattice.origin_object + Vec3(v.x, v.y, v.z));
    return corners;
}

Box box_of(const std::vector<Vec3>& corners) {
    Box box;
    for (const Vec3& p : corners) box.include(p);
    return box;
}

struct PlacingCase {
    double scale = 1.0;
    std::optional<Vec3> place_m = std::nullopt;
    bool center = false;

    [[nodiscard]] geometry::Placing placing() const {
        ConvertOptions options;
        options.center = center;
        options.place_m = place_m;
        options.scale = scale;
        const auto placing = placing_of(options);
        EXPECT_TRUE(placing);
        return placing.value_or(geometry::Placing{});
    }
    // p -> (p - middle) scale + place where there is a place, and else p -> p scale.
    [[nodiscard]] Vec3 placed(const Vec3& p, const Vec3& middle) const {
        if (center) return scale * (p - middle);
        return place_m ? scale * (p - middle) + *place_m : scale * p;
    }
    [[nodiscard]] std::string text() const {
        return formatted("scale %g, %s", scale, center ? "center" : place_m ? "place" : "as it lies");
    }
};

std::vector<PlacingCase> placing_cases() {
    std::vector<PlacingCase> cases;
    for (const double scale : {1.0, 1.7, 0.3, -1.0, -1.7, -0.3}) {
        cases.push_back({scale});
        cases.push_back({scale, std::nullopt, true});
        for (std::size_t i = 0; i < 2; ++i) cases.push_back({scale, 10.0 * uneven_offset(i)});
    }
    return cases;
}

// Six times the volume within: above 0 where the triangles face outwards.
double facing_outwards(const geometry::TriangleMesh& mesh) {
    double sum = 0.0;
    const Vec3& from = mesh.positions_m[0];
    for (const auto& t : mesh.triangles)
        sum += glm::dot(mesh.positions_m[t[0]] - from,
                        glm::cross(mesh.positions_m[t[1]] - from, mesh.positions_m[t[2]] - from));
    return sum;
}

}  // namespace

TEST(PlacedSolid, LiesWhereTheFormulaPutsEveryCornerOfItAlsoMirrored) {
    const auto converted = compute::scan_convert(slanted_pyramid(), 32, placing_pool());
    ASSERT_TRUE(converted);
    const std::vector<Vec3> before = corners_of(converted->solid);
    const Vec3 middle = box_of(before).center();
    ASSERT_GT(before.size(), 100u);
    for (const PlacingCase& of : placing_cases()) {
        compute::Solid solid = converted->solid;
        testing::internal::CaptureStdout();
        const auto placed = place_solid(solid, of.placing(), LengthUnit::m, placing_pool());
        const std::string said = testing::internal::GetCapturedStdout();
        ASSERT_TRUE(placed) << of.text();
        // The surface as it is exported: mirrored at the origin once it is meshed.
        geometry::TriangleMesh mesh{corners_of(solid), {}, {}, {}, {}};
        if (of.scale < 0.0) mirror(mesh);
        ASSERT_EQ(mesh.positions_m.size(), before.size());
        for (std::size_t i = 0; i < before.size(); i += 7)
            for (int k = 0; k < 3; ++k)
                ASSERT_NEAR(mesh.positions_m[i][k], of.placed(before[i], middle)[k], 2e-8 * std::abs(of.scale))
                    << of.text() << ", corner " << i << ", axis " << k;
        const Vec3 said_middle = glm::round(of.placed(middle, middle) * 1e6) / 1e6;
        if (of.placing().changes_nothing()) {
            EXPECT_EQ(said, "") << of.text();
        } else {
            double x = NAN, y = NAN, z = NAN;
            ASSERT_EQ(std::sscanf(said.c_str(), "  placed: the middle of its box is at %lf, %lf, %lf m", &x, &y, &z), 3)
                << said;
            EXPECT_LT(glm::length(Vec3(x, y, z) - said_middle), 2e-6) << of.text() << ": " << said;
            EXPECT_EQ(said.contains("mirrored"), of.scale < 0.0) << said;
        }
    }
}

TEST(PlacedMesh, LiesWhereTheFormulaPutsEveryCornerOfItAndFacesOutwardsAlsoMirrored) {
    const geometry::TriangleMesh before = slanted_pyramid();
    ASSERT_GT(facing_outwards(before), 0.0);
    const Vec3 middle = geometry::bounds_of(before).center();
    for (const PlacingCase& of : placing_cases()) {
        geometry::TriangleMesh mesh = before;
        geometry::place_mesh(mesh, of.placing());
        for (std::size_t i = 0; i < before.positions_m.size(); ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(mesh.positions_m[i][k], of.placed(before.positions_m[i], middle)[k], 1e-15)
                    << of.text() << ", corner " << i << ", axis " << k;
        EXPECT_NEAR(facing_outwards(mesh), facing_outwards(before) * std::pow(std::abs(of.scale), 3.0), 1e-12)
            << of.text();
    }
}

TEST(PlacedMesh, MirroredAsASolidsSurfaceIsFacesOutwardsToo) {
    geometry::TriangleMesh mesh = slanted_pyramid();
    mirror(mesh);
    const geometry::TriangleMesh before = slanted_pyramid();
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i)
        EXPECT_EQ(mesh.positions_m[i], -before.positions_m[i]) << i;
    EXPECT_NEAR(facing_outwards(mesh), facing_outwards(before), 1e-15);
}

}  // namespace burin::app
