// SPDX-License-Identifier: MIT
// Pictures of a moving view, drawn with larger pixels and fewer triangles, and the full ones after them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {
namespace {

constexpr ImageSize kMovingSize{241, 179};  // no multiple of any pixel

// A bumpy plate in patches of 16 x 16 squares, which share the vertices of their borders.
std::vector<Surface> bumpy_patches(int side) {
    constexpr int kSquares = 16;
    constexpr double kEdge_m = 0.0015;
    std::vector<Surface> patches;
    const auto height = [](double x, double y) { return 0.002 * std::sin(x / 0.011) * std::cos(y / 0.013); };
    for (int b = 0; b < side; ++b)
        for (int a = 0; a < side; ++a) {
            Surface s;
            for (int j = 0; j <= kSquares; ++j)
                for (int i = 0; i <= kSquares; ++i) {
                    const double x = kEdge_m * (a * kSquares + i) - 0.5 * kEdge_m * kSquares * side,
                                 y = kEdge_m * (b * kSquares + j) - 0.5 * kEdge_m * kSquares * side;
                    const double e = 1e-5;
                    const Vec3 n{height(x - e, y) - height(x + e, y), height(x, y - e) - height(x, y + e), 2.0 * e};
                    s.vertex({x, 0.15 + y, -0.1 + height(x, y)}, glm::normalize(n), kGrey);
                }
            constexpr std::uint32_t kRow = kSquares + 1;
            for (std::uint32_t j = 0; j < kSquares; ++j)
                for (std::uint32_t i = 0; i < kSquares; ++i) {
                    const std::uint32_t v = j * kRow + i;
                    s.indices.insert(s.indices.end(), {v, v + 1, v + kRow + 1, v, v + kRow + 1, v + kRow});
                }
            patches.push_back(std::move(s));
        }
    return patches;
}

picture::Picture turned_scene(double angle_rad) {
    picture::Picture picture = bare_scene();
    picture.show_grid = true;
    picture.world_from_object.orientation = glm::angleAxis(angle_rad, Vec3(0.0, 0.0, 1.0));
    picture.tool.visible = true;
    picture.tool.radius_m = 0.004;
    picture.tool.center_world = {0.01, 0.16, -0.09};
    return picture;
}

class MovingPicture : public gpu::DeviceTest {
protected:
    Renderer renderer() {
        auto made = Renderer::create(device(), kMovingSize, {.samples = 1});
        EXPECT_TRUE(made) << made.error().line();
        const std::vector<Surface> patches = bumpy_patches(6);
        for (std::uint32_t i = 0; i < patches.size(); ++i)
            made->surface().set_patch(i, patches[i].vertices, patches[i].indices);
        return std::move(*made);
    }
    RenderStats draw(Renderer& renderer, const picture::Picture& picture, std::uint32_t pixel) {
        auto commands = gpu::Commands::begin(device());
        const auto drawn = renderer.record(*commands, picture, pixel);
        EXPECT_TRUE(drawn) << drawn.error().line();
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        return *drawn;
    }
    // Draws until the groups of patches are worked out, on their thread.
    void wait_for_groups(Renderer& renderer, const picture::Picture& picture) {
        for (bool all = false; !all; std::this_thread::yield()) {
            draw(renderer, picture, 1);
            renderer.surface().refine_beside(true);
            const auto& groups = renderer.surface().patches().groups();
            all = std::ranges::all_of(groups, [](const auto& one) { return !one.second.levels.empty(); });
        }
    }
};

// Returns the mean difference of two pictures' bytes.
double mean_difference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    return sum / static_cast<double>(a.rgba.size());
}

}  // namespace

TEST_F(MovingPicture, ARestingPictureIsTheFullOneToTheBitAfterTurning) {
    Renderer moved = renderer(), rested = renderer();
    for (const std::uint32_t pixel : {2u, 3u}) {
        draw(moved, turned_scene(0.0), 1);
        for (int i = 1; i < 4; ++i) draw(moved, turned_scene(0.1 * i), pixel);
        draw(moved, turned_scene(0.3), pixel);  // a pause
        const auto after = moved.render(turned_scene(0.3)), wanted = rested.render(turned_scene(0.3));
        ASSERT_TRUE(after && wanted);
        EXPECT_EQ(after->left.rgba, wanted->left.rgba) << pixel;
        EXPECT_EQ(after->right.rgba, wanted->right.rgba) << pixel;
    }
}

TEST_F(MovingPicture, NothingIsDrawnWhereNothingMovesBetweenTwoOfItsFrames) {
    Renderer moved = renderer();
    EXPECT_TRUE(draw(moved, turned_scene(0.0), 2).whole);
    EXPECT_TRUE(draw(moved, turned_scene(0.0), 2).parts.empty());
    EXPECT_TRUE(draw(moved, turned_scene(0.0), 1).whole) << "the full picture is still owed";
    EXPECT_TRUE(draw(moved, turned_scene(0.0), 1).parts.empty());
}

TEST_F(MovingPicture, ShowsWhatTheFullOneShowsWithAFractionOfItsTriangles) {
    Renderer moved = renderer();
    const picture::Picture picture = turned_scene(0.2);
    wait_for_groups(moved, picture);
    const RenderStats full = draw(moved, picture, 1);
    EXPECT_EQ(full.patch_counts.groups, 0u) << "a full picture has its patches' own triangles";
    moved.set_savings({.coarser_levels = false});
    const auto all = moved.render(picture);
    const auto shown = moved.render(picture, 2);
    const RenderStats& coarse = moved.stats();
    EXPECT_GT(coarse.patch_counts.groups, 0u);
    EXPECT_EQ(coarse.patch_counts.drawn, 0u);
    EXPECT_LT(4 * coarse.patch_counts.triangles, coarse.triangles);
    EXPECT_EQ(coarse.parts, std::vector<PixelRect>{all_of(kMovingSize)});
    ASSERT_TRUE(all && shown);
    EXPECT_LT(mean_difference(shown->left, all->left), 4.0);
    EXPECT_LT(mean_difference(shown->right, all->right), 4.0);
}

TEST_F(MovingPicture, AGroupThatIsCutIsDrawnByItsPatchesUntilItIsWorkedOutAgain) {
    Renderer moved = renderer();
    const picture::Picture picture = turned_scene(0.2);
    wait_for_groups(moved, picture);
    moved.surface().remove_patch(0);
    const RenderStats cut = draw(moved, picture, 2);
    EXPECT_GT(cut.patch_counts.drawn, 0u);
    EXPECT_GT(cut.patch_counts.groups, 0u) << "the others stay as they are";
    wait_for_groups(moved, picture);
    EXPECT_EQ(draw(moved, picture, 3).patch_counts.drawn, 0u);
}

}  // namespace burin::renderer
