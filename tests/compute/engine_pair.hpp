// SPDX-License-Identifier: MIT
// Both engines on the same solid: every cut is made by each, and whatever they hold or report must be equal.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute::test {

// STROKE-1000: a ball of radius 0.06 at 1000 places on the unit cube's upper face. Sixteen times fewer of them, as far
// apart, when `every` is 16.
[[nodiscard]] inline std::vector<BallSweep> stroke_1000(int every = 1) {
    std::vector<BallSweep> sweeps;
    for (int i = 0; i < 1000; i += every) {
        const double t = i / 999.0, pi = std::numbers::pi;
        const Vec3 p(0.5 + 0.42 * std::sin(6.0 * pi * t), 0.5 + 0.42 * std::sin(4.0 * pi * t + 0.6),
                     0.985 + 0.03 * std::sin(10.0 * pi * t));
        sweeps.push_back({p, p, 0.06, 0});
    }
    return sweeps;
}

[[nodiscard]] inline Solid unit_cube(int resolution) {
    auto made = make_block(Vec3(1.0), resolution, geometry::Material{});
    EXPECT_TRUE(made) << made.error().line();
    Solid solid = made ? std::move(*made) : Solid{};
    solid.materials.push_back(geometry::Material{});  // what cuts leave may differ from the solid
    return solid;
}

// Names the first ray of two solids that differs; nothing when none does.
[[nodiscard]] inline std::string first_difference(const Solid& a, const Solid& b) {
    if (a.same_content(b)) return "";
    const auto text = [](std::span<const shared::DexelEnd> ends) {
        std::string line;
        for (const shared::DexelEnd& end : ends) {
            line += " " + std::to_string(depth_of(end)) + "/" + std::to_string(material_of(end)) + "/" +
                    std::to_string(end.normal);
        }
        return line;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t ray = 0; ray < a.sets[axis].ray_count(); ++ray) {
            const std::string held = text(a.sets[axis].ends(ray)), other = text(b.sets[axis].ends(ray));
            if (held == other) continue;
            return "axis " + std::to_string(axis) + " ray " + std::to_string(ray) + ":" + held + " and" + other;
        }
    }
    return "the lattices differ";
}

class EnginePair {
public:
    EnginePair(const Solid& solid, const gpu::Device& device, const VulkanEngineOptions& options = {})
        : cpu_(make_cpu_engine(solid, pool_)) {
        auto made = VulkanEngine::create(Solid(solid), device, pool_, options);
        EXPECT_TRUE(made) << made.error().line();
        if (made) vulkan_ = std::move(*made);
    }

    // False after the first difference, so that loops can stop there.
    bool cut(std::span<const BallSweep> sweeps) {
        if (vulkan_ == nullptr) return false;
        const auto expected = cpu_->carve(sweeps);
        const auto actual = vulkan_->carve(sweeps);
        EXPECT_TRUE(expected) << expected.error().line();
        EXPECT_TRUE(actual) << actual.error().line();
        if (!expected || !actual) return false;
        EXPECT_EQ(actual->rays_touched, expected->rays_touched);
        EXPECT_EQ(actual->rays_changed, expected->rays_changed);
        EXPECT_EQ(first_difference(vulkan_->solid(), cpu_->solid()), "");
        changed_ += expected->rays_changed;
        return !testing::Test::HasFailure();
    }
    bool cut(const BallSweep& sweep) { return cut(std::span(&sweep, 1)); }

    bool carve(std::span<const ToolSweep> sweeps) {
        if (vulkan_ == nullptr) return false;
        const auto expected = cpu_->carve(sweeps), actual = vulkan_->carve(sweeps);
        EXPECT_TRUE(expected) << expected.error().line();
        EXPECT_TRUE(actual) << actual.error().line();
        if (!expected || !actual) return false;
        EXPECT_EQ(actual->rays_touched, expected->rays_touched);
        EXPECT_EQ(actual->rays_changed, expected->rays_changed);
        EXPECT_EQ(first_difference(vulkan_->solid(), cpu_->solid()), "");
        return !testing::Test::HasFailure();
    }

    bool assign(const RayBatch& rays) {
        if (vulkan_ == nullptr) return false;
        const auto expected = cpu_->assign(rays);
        const auto actual = vulkan_->assign(rays);
        EXPECT_TRUE(expected) << expected.error().line();
        EXPECT_TRUE(actual) << actual.error().line();
        if (!expected || !actual) return false;
        EXPECT_EQ(actual->rays_changed, expected->rays_changed);
        EXPECT_TRUE(vulkan_->solid().same_content(cpu_->solid())) << "the engines hold different intervals";
        return !testing::Test::HasFailure();
    }

    [[nodiscard]] CarvingEngine& cpu() { return *cpu_; }
    [[nodiscard]] VulkanEngine& vulkan() { return *vulkan_; }
    [[nodiscard]] WorkerPool& pool() { return pool_; }
    [[nodiscard]] std::uint64_t changed() const { return changed_; }

private:
    WorkerPool pool_{2};
    std::unique_ptr<CarvingEngine> cpu_;
    std::unique_ptr<VulkanEngine> vulkan_;
    std::uint64_t changed_ = 0;
};

}  // namespace burin::compute::test
