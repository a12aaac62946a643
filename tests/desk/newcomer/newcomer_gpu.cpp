// SPDX-License-Identifier: MIT
// A newcomer's first session, step by step: what each step's picture and the part itself must show.
#include "desk/viewer/view_cube.hpp"
#include "geometry/files/mesh_import.hpp"
#include "tests/desk/newcomer/newcomer_desk.hpp"

namespace burin::session {
namespace {

class Newcomer : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
};

constexpr double kFree_px = 940.0;  // of the window, left of the panel
// A tool of the panel, and the least that it takes away along 10 mm at a depth of 1.2 mm, on one side of the mirror.
struct Cutter {
    const char* label;
    double x_mm, least_mm3;
};
constexpr std::array<Cutter, 5> kCutters{{{"tool ball", 20.0, 50.0},
                                          {"tool cylinder", 32.0, 130.0},
                                          {"tool cone", 44.0, 3.0},
                                          {"tool bullnose", 60.0, 120.0},
                                          {"tool box", 71.0, 130.0}}};

// The rectangle of the window that the untouched part covers.
struct Extent {
    Vec2 lo{1e9}, hi{-1e9};
};
Extent extent_of(const NewcomerDesk& desk) {
    Extent all;
    for (const double x : {0.0, 80.0})
        for (const double y : {0.0, 60.0})
            for (const double z : {0.0, x == 0.0 ? kUpright_mm : kFoot_mm}) {
                all.lo = glm::min(all.lo, desk.px_of({x, y, z}));
                all.hi = glm::max(all.hi, desk.px_of({x, y, z}));
            }
    return all;
}

// How far the foot's face lies below where it was, at most, near a place.
double depth_at_mm(const std::vector<Vec3>& vertices_mm, const Vec2& place_mm, double near_mm) {
    double depth = 0.0;
    for (const Vec3& p : vertices_mm)
        if (p.z > 2.0 && p.z <= kFoot_mm && glm::length(Vec2(p) - place_mm) < near_mm)
            depth = std::max(depth, kFoot_mm - p.z);
    return depth;
}

bool was_warned(const NewcomerDesk& desk) {
    return std::ranges::any_of(desk.session().log().all(),
                               [](const Message& m) { return m.kind != MessageKind::info; });
}

void cut_with_each_tool(NewcomerDesk& desk) {
    Image before = desk.picture("04-mirror");
    double volume = desk.volume_mm3();
    for (const Cutter& cutter : kCutters) {
        const double x = cutter.x_mm;
        desk.press_button(cutter.label);
        desk.stroke({{x, 6, kFoot_mm}, {x, 16, kFoot_mm}});
        const Image after = desk.picture(std::string("05-") + (cutter.label + 5));
        const double left = desk.volume_mm3();
        EXPECT_GT(volume - left, 2.0 * cutter.least_mm3) << cutter.label;
        volume = left;
        const std::vector<Vec3> vertices = desk.vertices_mm();
        for (const double y : {8.0, 12.0}) {
            const double depth = depth_at_mm(vertices, {x, y}, 1.5 * desk.cell_mm());
            EXPECT_NEAR(depth, 1.2, 0.1) << cutter.label << " at " << y;
            EXPECT_NEAR(depth, depth_at_mm(vertices, {x, 60.0 - y}, 1.5 * desk.cell_mm()), 0.03) << cutter.label;
            EXPECT_GT(changed(before, after, desk.around_mm({x, y, kFoot_mm}, 3)), 0.3) << cutter.label;
            EXPECT_GT(changed(before, after, desk.around_mm({x, 60.0 - y, kFoot_mm}, 3)), 0.3) << cutter.label;
        }
        before = after;
    }
}

void fill_above_the_top(NewcomerDesk& desk) {
    desk.press_button("tool ball");
    desk.press_button("operation fill");
    const double volume = desk.volume_mm3();
    desk.stroke({{5, 10, kUpright_mm}, {5, 22, kUpright_mm}});
    desk.picture("06-fill");
    EXPECT_GT(desk.volume_mm3(), volume + 2.0 * 400.0);
    // As high along all of its way, on both sides: a ball of 4 mm that is led 1.2 mm into the surface.
    const std::vector<Vec3> vertices = desk.vertices_mm();
    for (const double y : {10.0, 14.0, 18.0, 22.0, 38.0, 42.0, 46.0, 50.0}) {
        double top = 0.0;
        for (const Vec3& p : vertices)
            if (glm::length(Vec2(p) - Vec2(5.0, y)) < 1.5 * desk.cell_mm()) top = std::max(top, p.z);
        EXPECT_NEAR(top, kUpright_mm + 6.8, 0.15) << "at " << y;
    }
}

void paint_a_stripe(NewcomerDesk& desk) {
    desk.press_button("operation paint");
    desk.press_button("colour 6");
    const double volume = desk.volume_mm3();
    desk.stroke({{76, 20, kFoot_mm}, {66, 20, kFoot_mm}});
    const Image painted = desk.picture("07-paint");
    EXPECT_EQ(desk.volume_mm3(), volume) << "paint takes nothing away";
    for (const double y : {20.0, 40.0}) {
        const Vec2 at = desk.px_of({73, y, kFoot_mm});
        const std::uint8_t* p = painted.pixel(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
        EXPECT_GT(p[2], p[0] + 60) << "blue at y " << y;
    }
}

// The picture is the same again, and the part as well.
void smooth_and_undo(NewcomerDesk& desk) {
    desk.press_button("operation smooth");
    desk.step_back();
    const Image before = desk.picture("08-before");
    const double volume = desk.volume_mm3();
    desk.stroke({{67, 6, kFoot_mm}, {67, 15, kFoot_mm}, {67, 6, kFoot_mm}});
    desk.step_back();
    const Image smoothed = desk.picture("08-smooth");
    EXPECT_GT(std::abs(desk.volume_mm3() - volume), 1.0);
    EXPECT_GT(changed(before, smoothed, desk.around_mm({67, 10, kFoot_mm}, 12), 6), 0.05);
    desk.press_button("undo");
    desk.step_back();
    const Image undone = desk.picture("09-undone");
    EXPECT_EQ(desk.volume_mm3(), volume);
    const Extent all = extent_of(desk);
    const auto px = [](double at) { return static_cast<std::uint32_t>(at); };
    EXPECT_EQ(
        changed(before, undone, {px(all.lo.x), px(all.lo.y), px(all.hi.x - all.lo.x), px(all.hi.y - all.lo.y)}, 0),
        0.0);
}

// By a press on the cube's face, and then turned by hand again.
void look_from_the_right_and_back(NewcomerDesk& desk) {
    const auto cube = [&] { return view_cube(desk.desk->seen()).value(); };
    desk.click(desk.px_of_world(cube() * Vec3(0.5, 0.1, 0.0)));
    desk.step_back();
    desk.picture("03-from-the-right");
    const Vec3 right = desk.session().state().world_from_object.orientation * Vec3(1.0, 0.0, 0.0);
    const SeenFrom& from = desk.viewer().seen_from;
    const Vec3 middle = desk.session().state().world_from_object * desk.session().room().workpiece_object.center();
    EXPECT_LT(glm::length(right - glm::normalize(from.eye_world - middle)), 1e-3);
    desk.press_button("view-front");
    desk.turn({-120.0, -110.0});
    desk.press_button("fit-view");
}

// A user's file goes to the folder that the program was started in.
void export_it(NewcomerDesk& desk) {
    const std::filesystem::path here = std::filesystem::current_path();
    std::filesystem::current_path(desk.place() / "");
    desk.press_button("export");
    desk.rest(0.5);
    std::filesystem::current_path(here);
    desk.picture("10-exported");
    const auto read = geometry::import_mesh(desk.place() / "part.stl");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->report.unit.unit, LengthUnit::mm);
    EXPECT_NEAR(read->report.size_m.x, 0.080, 1e-4);
    EXPECT_NEAR(read->report.size_m.y, 0.060, 1e-4);
    const geometry::MeshHealth health = geometry::examine(read->mesh);
    EXPECT_TRUE(health.closed && health.consistently_oriented && health.manifold());
    EXPECT_EQ(health.shells, 1u);
    EXPECT_NEAR(1e9 * health.signed_volume_m3, desk.volume_mm3(), 1.0);
}

}  // namespace

TEST_F(Newcomer, MakesAnOwnPartAnother) {
    NewcomerDesk desk;
    EXPECT_NEAR(desk.volume_mm3(), 60.0 * (80.0 * 10.0 + 10.0 * 30.0) - 10.0 * std::numbers::pi * 81.0, 60.0);
    const Image opened = desk.picture("01-opened");
    const Extent at_first = extent_of(desk);
    EXPECT_TRUE(at_first.lo.x > 0.0 && at_first.lo.y > 0.0 && at_first.hi.x < kFree_px && at_first.hi.y < 720.0);
    EXPECT_TRUE(desk.desk->place_on_panel("first-steps")) << "the card that says what a mouse does";
    for (const char* const label : {"undo", "export", "colour 1"})
        EXPECT_TRUE(desk.desk->place_on_panel(label)) << label << " without scrolling";

    desk.turn({-120.0, -110.0});
    EXPECT_FALSE(desk.desk->place_on_panel("first-steps")) << "the first press puts it away";
    const Image turned = desk.picture("02-turned");
    EXPECT_GT(changed(opened, turned, {100, 250, 740, 400}), 0.5);
    desk.press_button("fit-view");
    desk.step_back();
    desk.picture("03-fitted");
    const Extent fitted = extent_of(desk);
    EXPECT_TRUE(fitted.lo.x > 0.0 && fitted.lo.y > 0.0 && fitted.hi.x < kFree_px && fitted.hi.y < 720.0);
    EXPECT_GT(std::max((fitted.hi.x - fitted.lo.x) / kFree_px, (fitted.hi.y - fitted.lo.y) / 720.0), 0.6);

    look_from_the_right_and_back(desk);
    desk.press_button("mirror y");
    cut_with_each_tool(desk);
    fill_above_the_top(desk);
    paint_a_stripe(desk);
    smooth_and_undo(desk);
    export_it(desk);
    EXPECT_FALSE(was_warned(desk)) << "all of it was done";
}

}  // namespace burin::session
