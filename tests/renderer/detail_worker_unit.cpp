// SPDX-License-Identifier: MIT
#include "renderer/surface/detail_worker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "compute/rays/normal_code.hpp"

namespace burin::renderer {
namespace {

// A gentle hill, whose levels have many triangles less.
std::shared_ptr<const geometry::SurfaceTile> hill(int cells, double height) {
    auto tile = std::make_shared<geometry::SurfaceTile>();
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            const double u = 2.0 * x / cells - 1.0, v = 2.0 * y / cells - 1.0;
            tile->vertices.push_back(
                {static_cast<float>(u), static_cast<float>(v), static_cast<float>(-height * (u * u + v * v)),
                 compute::normal_code(glm::normalize(Vec3(2 * height * u, 2 * height * v, 1.0))), 0xff808080u});
        }
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t y = 0; y + 1 < row; ++y)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = y * row + x;
            tile->indices.insert(tile->indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
        }
    return tile;
}

}  // namespace

TEST(DetailWorker, GivesTheLevelsOfEveryPatchWithWhatTheyAreOf) {
    constexpr std::uint32_t kPatches = 40;
    DetailWorker worker;
    EXPECT_TRUE(worker.take().empty());
    std::vector<std::shared_ptr<const geometry::SurfaceTile>> tiles;
    for (std::uint32_t i = 0; i < kPatches; ++i) {
        tiles.push_back(hill(12, 0.01 * i));
        worker.give({i, tiles.back(), {}, 2.0 / 12.0});
    }
    EXPECT_EQ(worker.waiting(), kPatches);
    std::vector<DetailDone> done;
    while (worker.waiting() > 0) {
        std::ranges::move(worker.take(), std::back_inserter(done));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_EQ(done.size(), kPatches);
    for (std::uint32_t i = 0; i < kPatches; ++i) {  // in the order given
        ASSERT_EQ(done[i].job.patch, i);
        EXPECT_EQ(done[i].job.surface, tiles[i]);
        const std::vector<PatchLevel> wanted = coarser_levels(tiles[i]->vertices, tiles[i]->indices, {}, 2.0 / 12.0);
        ASSERT_FALSE(wanted.empty());
        ASSERT_EQ(done[i].levels.size(), wanted.size());
        for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(done[i].levels[k].indices, wanted[k].indices);
    }
}

// All of it would take the worker many seconds.
TEST(DetailWorker, EndsWithWorkLeft) {
    constexpr std::uint32_t kGiven = 5000;
    std::weak_ptr<const geometry::SurfaceTile> held;
    {
        DetailWorker worker;
        const auto tile = hill(40, 0.1);
        held = tile;
        for (std::uint32_t i = 0; i < kGiven; ++i) worker.give({i, tile, {}, 0.05});
        worker.end();
        const std::vector<DetailDone> done = worker.take();
        EXPECT_LT(done.size(), std::size_t{kGiven}) << "it begins no other patch";
        EXPECT_EQ(worker.waiting() + done.size(), std::size_t{kGiven});
        for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i].job.patch, i) << "what was begun is whole";
        const std::vector<PatchLevel> wanted = coarser_levels(tile->vertices, tile->indices, {}, 0.05);
        for (const DetailDone& one : done) EXPECT_EQ(one.levels.size(), wanted.size());
        worker.end();
        EXPECT_TRUE(worker.take().empty()) << "once it has ended it stays so";
    }
    EXPECT_TRUE(held.expired()) << "it keeps nothing of what it was given";
}

TEST(DetailWorker, EndsWithoutHavingBeenGivenAnything) {
    DetailWorker worker;
    worker.end();
    EXPECT_TRUE(worker.take().empty());
    EXPECT_EQ(worker.waiting(), 0u);
}

}  // namespace burin::renderer
