// SPDX-License-Identifier: MIT
// Carving with planes of symmetry: both sides get the same, whatever the tool, and one undo takes back both.
#include "compute/engine/engine.hpp"
#include "sculpt/stroke_mirror.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"

namespace burin::sculpt {
namespace {

// A block off the origin, so that its middle is no special place.
struct MirroredBlock {
    static constexpr int kCells = 48;
    WorkerPool pool{1};
    Sculpture carving;

    MirroredBlock() : carving(engine(pool), pool) { carving.keep_history(1 << 26); }
    static std::unique_ptr<compute::CarvingEngine> engine(WorkerPool& pool) {
        compute::Solid block = *compute::make_block({0.06, 0.05, 0.04}, kCells, {"skin"});
        block.lattice.origin_object += Vec3(0.013, -0.021, 0.007);
        return compute::make_cpu_engine(std::move(block), pool);
    }
    [[nodiscard]] Vec3 middle() const { return workpiece::workpiece_bounds(carving.surface().lattice()).center(); }
    // How much a stroke near the corner of the largest x, y and z takes away, on one side of each plane.
    double removed(const compute::ToolShape& shape, const toolbox::Mirror& mirror) {
        carving.mirror(mirror);
        const Box box = workpiece::workpiece_bounds(carving.surface().lattice());
        const Quat leans = glm::angleAxis(0.5, glm::normalize(Vec3(0.3, 0.2, 1.0)));
        const Quat turned = glm::angleAxis(0.9, glm::normalize(Vec3(1.0, -0.4, 0.3))) * leans;
        const compute::ToolSweep sweep{
            shape, {box.hi - Vec3(0.012, 0.010, 0.001), leans}, {box.hi - Vec3(0.006, 0.008, 0.002), turned}};
        const double before = carving.surface().volume_m3();
        EXPECT_TRUE(carving.update({&sweep, 1}));
        return before - carving.surface().volume_m3();
    }
    // How much of the rays' interval ends lie off the mirror images of other ends: the share of those more than a
    // hundredth of a cell away, and of those on rays whose images have another number of ends.
    [[nodiscard]] double asymmetry(const toolbox::MirrorImage& image) const {
        const compute::Solid& solid = carving.engine().solid();
        std::size_t ends = 0, off = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t along_u = (axis + 1) % 3, along_v = (axis + 2) % 3;
            const compute::DexelSet& set = solid.sets.at(axis);
            for (int v = 0; v < set.rays_v(); ++v) {
                for (int u = 0; u < set.rays_u(); ++u) {
                    const auto here = set.ends(u, v);
                    const auto there = set.ends(image.across.at(along_u) ? set.rays_u() - 1 - u : u,
                                                image.across.at(along_v) ? set.rays_v() - 1 - v : v);
                    ends += here.size();
                    if (here.size() != there.size()) off += here.size();
                    for (std::size_t i = 0; i < here.size() && here.size() == there.size(); ++i) {
                        const bool turned = image.across.at(axis);
                        const int depth = shared::depth_of(turned ? there[here.size() - 1 - i] : there[i]);
                        const int reflected =
                            turned ? solid.lattice.cells.at(axis) * shared::kUnitsPerCell - depth : depth;
                        if (std::abs(reflected - shared::depth_of(here[i])) > shared::kUnitsPerCell / 100) ++off;
                    }
                }
            }
        }
        return static_cast<double>(off) / static_cast<double>(ends);
    }
};

// A tetrahedron whose mirror image is another one.
compute::MeshTool crooked() {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    mesh->positions_m = {{0.0, 0.0, 0.0}, {0.008, 0.001, 0.0}, {0.001, 0.005, 0.001}, {0.002, 0.001, 0.009}};
    mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return {mesh};
}

}  // namespace

TEST(Mirror, IsReadAsItIsWritten) {
    for (unsigned planes = 0; planes < 8; ++planes) {
        const toolbox::Mirror mirror{{(planes & 1u) != 0, (planes & 2u) != 0, (planes & 4u) != 0}};
        EXPECT_EQ(*toolbox::parse_mirror(name_of(mirror), "--mirror"), mirror) << name_of(mirror);
        EXPECT_EQ(toolbox::images_of(mirror).size() + 1,
                  1u << static_cast<unsigned>(std::ranges::count(mirror.across, true)));
    }
    EXPECT_EQ(*toolbox::parse_mirror("zx", ""), (toolbox::Mirror{{true, false, true}}));
    EXPECT_EQ(*toolbox::parse_mirror("XZ", ""), (toolbox::Mirror{{true, false, true}})) << "as the buttons show them";
    for (const char* wrong : {"", "w", "xx", "Xx", "x,y", "nones"})
        EXPECT_EQ(toolbox::parse_mirror(wrong, "--mirror").error().remedy, "write none or axes, such as x or xz")
            << wrong;
}

// A point of a tool and its image keep their distance from every plane.
TEST(Mirror, ReflectsEveryPointOfATool) {
    const Pose pose{{0.3, -0.2, 0.7}, glm::angleAxis(1.1, glm::normalize(Vec3(0.2, 0.9, -0.4)))};
    const Vec3 middle{0.1, 0.2, -0.3}, at_tool{0.05, -0.02, 0.03};
    for (const toolbox::MirrorImage& image : toolbox::images_of({{true, true, true}})) {
        const Vec3 at_image = image.reverses() ? Vec3(-at_tool.x, at_tool.y, at_tool.z) : at_tool;
        const Vec3 expected = toolbox::image_of(pose * at_tool, image, middle);
        EXPECT_LT(glm::length(toolbox::image_of(pose, image, middle) * at_image - expected), 1e-15);
    }
}

TEST(Mirror, GivesBothSidesTheSameWhateverTheTool) {
    const std::vector<std::pair<const char*, compute::ToolShape>> tools{
        {"ball", compute::BallTool{0.006}},
        {"cylinder", compute::CylinderTool{0.004, 0.012}},
        {"cone", compute::ConeTool{0.001, 0.006, 0.012}},
        {"bullnose", compute::BullNoseTool{0.005, 0.002, 0.012}},
        {"box", compute::BoxTool{{0.003, 0.006, 0.004}}},
        {"mesh", crooked()}};
    for (const auto& [name, shape] : tools) {
        MirroredBlock alone;
        const double one_m3 = alone.removed(shape, {});
        ASSERT_GT(one_m3, 2e-8) << name;
        EXPECT_GT(alone.asymmetry({{true, false, false}}), 0.01) << "the measure sees a stroke on one side";
        for (const toolbox::Mirror& mirror :
             {toolbox::Mirror{{true, false, false}}, toolbox::Mirror{{false, true, true}},
              toolbox::Mirror{{true, true, true}}}) {
            MirroredBlock block;
            const auto images = toolbox::images_of(mirror);
            // A mesh is no exact mirror image: it takes a node on the surface for one side or the other.
            const double all_m3 = static_cast<double>(1 + images.size()) * one_m3;
            EXPECT_NEAR(block.removed(shape, mirror), all_m3, 2e-3 * all_m3) << name << ' ' << name_of(mirror);
            for (const toolbox::MirrorImage& image : images)
                EXPECT_LT(block.asymmetry(image), 2e-4) << name << ' ' << name_of(mirror);
        }
    }
}

TEST(Mirror, IsUndoneWithItsStroke) {
    MirroredBlock block;
    const double whole_m3 = block.carving.surface().volume_m3();
    ASSERT_GT(block.removed(compute::BallTool{0.006}, {{true, true, false}}), 0.0);
    block.carving.end_stroke();
    ASSERT_EQ(*block.carving.undo(5), 1u);
    EXPECT_EQ(block.carving.surface().volume_m3(), whole_m3);
    ASSERT_EQ(*block.carving.redo(5), 1u);
    EXPECT_LT(block.asymmetry({{true, true, false}}), 2e-4);
}

}  // namespace burin::sculpt
