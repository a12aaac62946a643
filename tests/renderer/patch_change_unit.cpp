// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_change.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "compute/rays/normal_code.hpp"
#include "renderer/surface/patch_detail.hpp"

namespace burin::renderer {
namespace {

constexpr std::uint32_t kGrey = 0xff808080u;

// A flat square of so many by so many cells of 1 m, seen from z.
struct Plate {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<geometry::VertexLight> light;

    explicit Plate(std::uint32_t cells) {
        for (std::uint32_t y = 0; y <= cells; ++y)
            for (std::uint32_t x = 0; x <= cells; ++x)
                vertices.push_back(
                    {static_cast<float>(x), static_cast<float>(y), 0.0f, compute::normal_code({0, 0, 1}), kGrey});
        const std::uint32_t row = cells + 1;
        for (std::uint32_t y = 0; y < cells; ++y)
            for (std::uint32_t x = 0; x < cells; ++x) {
                const std::uint32_t a = y * row + x;
                indices.insert(indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
            }
        light.resize(vertices.size());
    }
    [[nodiscard]] PatchLook look() const { return {vertices, indices, light}; }
    [[nodiscard]] shared::SurfaceVertex& at(std::uint32_t x, std::uint32_t y, std::uint32_t cells) {
        return vertices[y * (cells + 1) + x];
    }
};

void expect_box(const Box& box, const Vec3& lo, const Vec3& hi) {
    EXPECT_EQ(box.lo, lo);
    EXPECT_EQ(box.hi, hi);
}

}  // namespace

TEST(PatchChange, OfAPatchAndItselfIsEmpty) {
    const Plate plate(8);
    EXPECT_TRUE(changed_bounds(plate.look(), plate.look()).empty());
    // Full light may be left out.
    EXPECT_TRUE(changed_bounds(plate.look(), {plate.vertices, plate.indices, {}}).empty());
}

TEST(PatchChange, HoldsTheTrianglesOfAVertexThatMovedBeforeAndAfter) {
    const Plate before(8);
    Plate after(8);
    after.at(3, 4, 8).z = -0.25f;
    expect_box(changed_bounds(before.look(), after.look()), {2, 3, -0.25}, {4, 5, 0});
}

TEST(PatchChange, SeesNormalColourAndLight) {
    const Plate before(8);
    Plate turned(8), painted(8), shaded(8);
    turned.at(1, 1, 8).normal = compute::normal_code({0.1, 0.0, 0.995});
    painted.at(1, 1, 8).colour = 0xff808081u;
    shaded.light[9 + 1].sun = 254;
    for (const Plate* after : {&turned, &painted, &shaded})
        expect_box(changed_bounds(before.look(), after->look()), {0, 0, 0}, {2, 2, 0});
}

// A cut gives vertices other numbers; what it left as it was is drawn as it was.
TEST(PatchChange, DoesNotMindWhereVerticesAreKept) {
    const Plate before(8);
    Plate after(8);
    std::vector<std::uint32_t> place(after.vertices.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    std::ranges::shuffle(place, std::mt19937(3));
    for (std::uint32_t i = 0; i < place.size(); ++i) after.vertices[place[i]] = before.vertices[i];
    for (std::uint32_t& i : after.indices) i = place[i];
    EXPECT_TRUE(changed_bounds(before.look(), after.look()).empty());
    after.vertices[place[0]].z = 1.0f;
    expect_box(changed_bounds(before.look(), after.look()), {0, 0, 0}, {1, 1, 1});
}

TEST(PatchChange, HoldsTrianglesThatWentOrTurnedRound) {
    const Plate before(4);
    Plate holed(4), turned(4);
    holed.indices.erase(holed.indices.begin(), holed.indices.begin() + 6);
    expect_box(changed_bounds(before.look(), holed.look()), {0, 0, 0}, {1, 1, 0});
    expect_box(changed_bounds(holed.look(), before.look()), {0, 0, 0}, {1, 1, 0});
    std::swap(turned.indices[1], turned.indices[2]);
    expect_box(changed_bounds(before.look(), turned.look()), {0, 0, 0}, {1, 1, 0});
}

TEST(SmoothFirst, PutsTrianglesAlongAnEdgeOfColourNormalOrLightLast) {
    const Plate flat(4);
    EXPECT_EQ(smooth_first(flat.vertices, flat.indices, flat.light).smooth, flat.indices.size());
    Plate painted(4), bent(4), shaded(4);
    painted.at(0, 0, 4).colour = 0xff0000ffu;
    bent.at(0, 0, 4).normal = compute::normal_code(glm::normalize(Vec3(0.2, 0.0, 1.0)));
    shaded.light[0].open = 100;
    for (const Plate* plate : {&painted, &bent, &shaded}) {
        const SmoothFirst sorted = smooth_first(plate->vertices, plate->indices, plate->light);
        // The two triangles at the corner were the first.
        ASSERT_EQ(sorted.smooth, plate->indices.size() - 6);
        EXPECT_TRUE(std::equal(plate->indices.begin() + 6, plate->indices.end(), sorted.indices.begin()));
        EXPECT_TRUE(std::equal(plate->indices.begin(), plate->indices.begin() + 6, sorted.indices.end() - 6));
    }
}

}  // namespace burin::renderer
