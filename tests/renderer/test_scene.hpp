// SPDX-License-Identifier: MIT
// What the picture tests share: a renderer on a validated device, a desk-sized screen, and simple surfaces.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "renderer/frame/renderer.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/gpu/test_device.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {

inline constexpr ImageSize kTestSize{240, 180};

struct Surface {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;

    std::uint32_t vertex(const Vec3& p, const Vec3& normal, std::uint32_t colour) {
        const Vec3 n = glm::normalize(normal) * 1048576.0;
        vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                            shared::encode_normal({std::llround(n.x), std::llround(n.y), std::llround(n.z)}), colour});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }
    // Counter-clockwise seen from the side that u x v points to.
    void quad(const Vec3& center, const Vec3& half_u, const Vec3& half_v, std::uint32_t colour) {
        const Vec3 n = glm::cross(half_u, half_v);
        const std::uint32_t a = vertex(center - half_u - half_v, n, colour),
                            b = vertex(center + half_u - half_v, n, colour);
        const std::uint32_t c = vertex(center + half_u + half_v, n, colour),
                            d = vertex(center - half_u + half_v, n, colour);
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
};

inline constexpr std::uint32_t kGrey = 0xffc0c0c0u;
inline constexpr std::uint32_t kRed = 0xff0000ffu;
inline constexpr std::uint32_t kGreen = 0xff00ff00u;
inline constexpr std::uint32_t kBlack = 0xff000000u;

inline Surface ball_surface(const Vec3& center, double radius, std::uint32_t colour = kGrey, int rings = 64) {
    Surface s;
    const int segments = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        const double latitude = std::numbers::pi * (static_cast<double>(i) / rings - 0.5);
        for (int j = 0; j <= segments; ++j) {
            const double a = 2.0 * std::numbers::pi * j / segments;
            const Vec3 n{std::cos(latitude) * std::cos(a), std::sin(latitude), -std::cos(latitude) * std::sin(a)};
            s.vertex(center + radius * n, n, colour);
        }
    }
    const auto row = static_cast<std::uint32_t>(segments + 1);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(rings); ++i) {
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            const std::uint32_t a = i * row + j;
            s.indices.insert(s.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
        }
    }
    return s;
}

// A screen of 0.4 by 0.3 m, 0.6 m before the viewer, and nothing in the room.
inline picture::Picture bare_scene() {
    picture::Picture picture;
    picture.wall = {0.4, 0.3};
    picture.screen = wall::screen_of(picture.wall);
    picture.viewer.head_world.position_m = {0.0, 0.15, 0.6};
    picture.show_wall_frame = false;
    picture.show_grid = false;
    return picture;
}

inline Vec3 pixel_centre_world(const picture::Picture& picture, std::uint32_t x, std::uint32_t y) {
    return {(x + 0.5) / kTestSize.width * picture.wall.width_m - 0.5 * picture.wall.width_m,
            (1.0 - (y + 0.5) / kTestSize.height) * picture.wall.height_m, 0.0};
}

inline double pixel_m(const picture::Picture& picture) { return picture.wall.width_m / kTestSize.width; }

inline bool same_colour(const std::uint8_t* a, const std::uint8_t* b, int tolerance = 0) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(int{a[i]} - int{b[i]}) > tolerance) return false;
    }
    return true;
}

class PictureTest : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        auto created = Renderer::create(device(), kTestSize);
        ASSERT_TRUE(created) << created.error().line();
        renderer_.emplace(std::move(*created));
    }
    void TearDown() override {
        renderer_.reset();
        gpu::DeviceTest::TearDown();
    }
    Renderer& renderer() { return *renderer_; }
    void set(std::uint32_t id, const Surface& s) { renderer_->surface().set_patch(id, s.vertices, s.indices); }
    StereoImage render(const picture::Picture& picture) {
        auto image = renderer_->render(picture);
        EXPECT_TRUE(image) << image.error().line();
        if (!image) return {};
        return std::move(*image);
    }

private:
    std::optional<Renderer> renderer_;
};

}  // namespace burin::renderer
