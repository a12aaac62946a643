// SPDX-License-Identifier: MIT
// The mouse as a hand where its cursor leaves the part: what is shown of the tool there, and what a stroke leaves.
#include "tests/desk/mouse_desk.hpp"

namespace burin::session {

// It hung before the part, large and at the border of the hand's reach.
TEST(MouseInTheAir, NoToolIsShownWhereItDoesNotGetToTheCursor) {
    MouseDesk desk("");  // a ball of 40 mm
    const auto shown = [&] { return desk.desk->scene_on(0).value().tool.visible; };
    desk.point_at({20, 0, 30});
    EXPECT_TRUE(shown());
    desk.point_at({48, 0, 0});
    EXPECT_TRUE(shown()) << "beside the part it hovers";
    desk.move_to({20, 20});
    desk.rest(0.3);
    EXPECT_FALSE(shown());
    desk.point_at({-20, 0, 30});
    EXPECT_TRUE(shown());
}

// A strand of material grew into the air, since the tool touched what it had just added.
TEST(MouseInTheAir, AFillThatLeavesTheSilhouetteLeavesNoStrand) {
    MouseDesk desk("", "ball:0.004", 60, 128, 0.2);  // on a ball of 40 mm
    desk.run({{CommandInput{"operation", {"fill"}}, 8'000'000}}, 50'000'000);
    desk.point_at({20, 0, 34});
    desk.press();
    desk.drag(desk.px_of({20, 0, 34}), desk.px_of({52, 0, 0}));
    desk.drag(desk.px_of({52, 0, 0}), desk.px_of({52, 20, 0}));
    desk.drag(desk.px_of({52, 20, 0}), desk.px_of({20, 20, 28}));
    desk.release();
    EXPECT_EQ(desk.strokes(), 1u);
    double most_mm = 0.0;
    for (const Vec3& p : desk.vertices_mm()) most_mm = std::max(most_mm, glm::length(p));
    EXPECT_GT(most_mm, 40.0 + 2.0 * 4.0 - 1.2 - 0.2) << "a bead";
    EXPECT_LT(most_mm, 40.0 + 2.0 * 4.0 + 0.1 * 4.0 + 0.2) << "and no more than it hovers beside the silhouette";
}

}  // namespace burin::session
