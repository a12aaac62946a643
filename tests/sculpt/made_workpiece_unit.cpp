// SPDX-License-Identifier: MIT
#include "compute/engine/chosen_engine.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "sculpt/made_workpiece.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace burin::sculpt {
namespace {

constexpr const char* kBallOfAFile = "assets/workpieces/soccer_ball.obj";

}  // namespace

TEST(MadeWorkpiece, TellsItsStepsAndEndsWithAllOfThemDone) {
    WorkWatch work;
    std::size_t triangles = 0;
    std::string at_look;
    const workpiece::LoadWatch watch{&work, [&](const geometry::TriangleMesh& mesh) {
                                         triangles = mesh.triangles.size();
                                         at_look = work.look().step;
                                     }};
    const auto made = make_workpiece({.source = kBallOfAFile, .resolution = 32}, compute::on_processor, 1, watch);
    ASSERT_TRUE(made) << made.error().line();
    EXPECT_EQ(at_look, "reading the file");
    EXPECT_GT(triangles, 1000u);
    EXPECT_STREQ(work.look().step, "meshing the surface");
    EXPECT_DOUBLE_EQ(work.look().done, 1.0);
    EXPECT_GT(made->carving->surface().triangles(), 0u);
    EXPECT_GT(made->loaded.bounds_object.extent().x, 0.0);
}

TEST(MadeWorkpiece, IsTheSameWhetherOrNotAnybodyLooks) {
    WorkWatch work;
    const auto seen = make_workpiece({.source = kBallOfAFile, .resolution = 32}, compute::on_processor, 2, {&work});
    const auto unseen = make_workpiece({.source = kBallOfAFile, .resolution = 32}, compute::on_processor, 1);
    ASSERT_TRUE(seen && unseen);
    EXPECT_EQ(seen->carving->surface().triangles(), unseen->carving->surface().triangles());
    EXPECT_EQ(seen->carving->surface().volume_m3(), unseen->carving->surface().volume_m3());
    EXPECT_EQ(seen->loaded.size, unseen->loaded.size);
}

TEST(MadeWorkpiece, IsNotMadeWhereItIsNoLongerWanted) {
    for (const std::string source : {kBallOfAFile, "ball:0.05"}) {
        WorkWatch work;
        work.stop();
        const auto made = make_workpiece({.source = source, .resolution = 32}, compute::on_processor, 1, {&work});
        ASSERT_FALSE(made) << source;
        EXPECT_EQ(made.error().line(), geometry::no_longer_wanted().error().line());
    }
}

TEST(MadeWorkpiece, IsMeshedNoFurtherThanItIsWanted) {
    WorkerPool pool(1);
    auto loaded = load_workpiece({.source = "ball:0.05", .resolution = 64}, pool);
    ASSERT_TRUE(loaded);
    WorkWatch work;
    work.stop();
    const Sculpture carving(compute::make_cpu_engine(std::move(loaded->solid), pool), pool, &work);
    EXPECT_EQ(carving.surface().triangles(), 0u);
}

}  // namespace burin::sculpt
