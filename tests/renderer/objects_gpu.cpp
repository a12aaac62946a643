// SPDX-License-Identifier: MIT
// Objects come into a scene, more than the buffers hold: the picture is that of a renderer that has never seen others.
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

using Objects = PictureTest;

namespace {

// A strip of so many squares across the picture's middle.
std::shared_ptr<const DrawnMesh> strip(int squares, double height_m) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i <= squares; ++i)
        for (const double y : {height_m, height_m + 0.02})
            mesh.positions_m.push_back({0.3 * i / squares - 0.15, y, 0.02 * (i % 2)});
    for (int i = 0; i < squares; ++i) {
        const auto at = static_cast<std::uint32_t>(2 * i);
        mesh.triangles.push_back({at, at + 2, at + 1});
        mesh.triangles.push_back({at + 1, at + 2, at + 3});
    }
    return drawn_mesh(mesh);
}

}  // namespace

TEST_F(Objects, AFewThatFitAndOneThatDoesNotComeTogether) {
    const auto first = strip(4, 0.05), small = strip(6, 0.1), large = strip(9000, 0.15);
    const auto show = [&](const std::vector<std::shared_ptr<const DrawnMesh>>& meshes) {
        Scene scene = bare_scene();
        for (const auto& mesh : meshes) scene.objects.push_back({mesh, {}, {0.8, 0.3, 0.2}});
        return render(scene).left.rgba;
    };
    const auto alone = show({first});
    // The small one fits into the buffers there are; the large one needs others.
    const auto all = show({first, small, large});
    EXPECT_FALSE(all == alone);
    EXPECT_TRUE(show({first}) == alone);
    EXPECT_TRUE(show({large, small, first}) == all) << "whatever their order in the buffers";
}

// A red strip behind one of blue glass: both colours are in the picture where they cross, the glass alone hides
// nothing, and it makes no difference which of them comes first in the scene.
TEST_F(Objects, BehindClearOnesOthersAreSeen) {
    const auto strips = strip(1, 0.1);
    const auto show = [&](double opacity, bool clear_first) {
        Scene scene = bare_scene();
        const DrawnObject red{strips, {{0.0, 0.0, -0.03}, {1, 0, 0, 0}, 1.0}, {0.9, 0.1, 0.1}};
        const DrawnObject blue{strips, {{0.0, 0.0, 0.03}, {1, 0, 0, 0}, 1.0}, {0.1, 0.1, 0.9}, opacity};
        if (opacity > 0.0 && clear_first) scene.objects = {blue, red};
        if (opacity > 0.0 && !clear_first) scene.objects = {red, blue};
        if (opacity == 0.0) scene.objects = {red};
        return render(scene).left;
    };
    const Image hidden = show(1.0, true), through = show(0.4, true), bare = show(0.0, true);
    EXPECT_TRUE(show(0.4, false).rgba == through.rgba);
    std::size_t mixed = 0, red = 0;
    for (std::size_t i = 0; i < bare.rgba.size(); i += 4) {
        const bool is_red = bare.rgba[i] > bare.rgba[i + 2] + 40;
        red += is_red ? 1 : 0;
        mixed += is_red && through.rgba[i] < bare.rgba[i] && through.rgba[i] > hidden.rgba[i] + 10 &&
                         through.rgba[i + 2] > bare.rgba[i + 2]
                     ? 1
                     : 0;
    }
    ASSERT_GT(red, 100u);
    EXPECT_GT(mixed, red / 2);
}

}  // namespace burin::renderer
