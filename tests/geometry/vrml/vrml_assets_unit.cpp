// SPDX-License-Identifier: MIT
// What assets/worlds/README.md says of the worlds there.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

VrmlWorld asset_world(const std::string& name) {
    const auto file = read_vrml_file("assets/worlds/" + name);
    EXPECT_TRUE(file) << file.error().line();
    if (!file) return {};
    auto world = shapes_of(*file);
    EXPECT_TRUE(world) << world.error()[0].line();
    return world ? std::move(*world) : VrmlWorld{};
}

}  // namespace

TEST(VrmlAssets, TheTubeHasItsPartsRadiusAndBox) {
    const VrmlWorld world = asset_world("tube.wrl");
    std::vector<std::string> names;
    Box bounds;
    for (const VrmlShape& shape : world.shapes) {
        names.push_back(shape.name);
        EXPECT_EQ(shape.haptics.at("stiffness"), 700.0);
        for (const Vec3& p : mesh_in_world(shape).positions_m) bounds.include(p);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"Tube", "StartFunnel", "StartCap", "EndFunnel", "EndCap"}));
    EXPECT_GE(bounds.lo.x, -0.24);
    EXPECT_LE(bounds.hi.x, 0.24);
    EXPECT_GE(bounds.lo.y, 0.085);
    EXPECT_LE(bounds.hi.y, 0.335);
    EXPECT_GE(bounds.lo.z, -0.215);
    EXPECT_LE(bounds.hi.z, 0.235);
    EXPECT_TRUE(world.remarks.empty() && world.skipped.empty());
    // The tube's rings stand square to its middle line: each corner is one radius away from the ring's middle.
    const std::vector<Vec3>& corners = world.shapes[0].surface->mesh.positions_m;
    constexpr std::size_t kSides = 32;
    for (std::size_t ring = 0; ring + kSides <= corners.size(); ring += kSides) {
        Vec3 middle(0.0);
        for (std::size_t i = 0; i < kSides; ++i) middle += corners[ring + i] / static_cast<double>(kSides);
        for (std::size_t i = 0; i < kSides; ++i)
            EXPECT_NEAR(glm::length(corners[ring + i] - middle), 0.045, 1e-6);  // written to the micrometre
    }
}

// A wand that slides from a funnel into the tube meets neither a gap nor a step.
TEST(VrmlAssets, TheTubesEndRingsMeetItsFunnelsCornerByCorner) {
    const VrmlWorld world = asset_world("tube.wrl");
    ASSERT_EQ(world.shapes.size(), 5u);
    const std::vector<Vec3> tube = mesh_in_world(world.shapes[0]).positions_m;
    for (const std::size_t funnel : {1u, 3u}) {
        const std::vector<Vec3> corners = mesh_in_world(world.shapes[funnel]).positions_m;
        std::size_t met = 0;
        for (const Vec3& corner : corners)
            met += std::ranges::any_of(tube, [&](const Vec3& p) { return glm::length(p - corner) < 3e-6; }) ? 1u : 0u;
        EXPECT_EQ(met, 32u) << world.shapes[funnel].name;
    }
}

TEST(VrmlAssets, TheCapsAreClosedAndTheTubeIsFeltFromBothSides) {
    const VrmlWorld world = asset_world("tube.wrl");
    for (const VrmlShape& shape : world.shapes) {
        const MeshHealth health = examine(shape.surface->mesh);
        const bool cap = shape.name.ends_with("Cap");
        EXPECT_EQ(health.closed, cap) << shape.name;
        EXPECT_EQ(shape.surface->two_sided, !cap) << shape.name;
        EXPECT_EQ(health.misoriented_edges, 0u) << shape.name;
        EXPECT_EQ(health.closed && health.signed_volume_m3 > 0.0, cap) << shape.name;
    }
}

TEST(VrmlAssets, TheCubeIsABoxOfAFifthOfAMetre) {
    const VrmlWorld world = asset_world("wand-cube.wrl");
    ASSERT_EQ(world.shapes.size(), 1u);
    EXPECT_EQ(world.shapes[0].name, "Cube");
    EXPECT_NEAR(examine(mesh_in_world(world.shapes[0])).signed_volume_m3, 8e-3, 1e-15);
}

}  // namespace burin::geometry::test
