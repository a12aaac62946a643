// SPDX-License-Identifier: MIT
// The panel as people see it, painted by the graphics device: in several states, at both ends of its sizes. With
// BURIN_PANEL_PICTURES naming a folder each picture is left there, over a mid-grey scene.
#include <cstdlib>
#include <filesystem>

#include "desk/panel/panel.hpp"
#include "picture/png.hpp"
#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "renderer/panel/panel_painter.hpp"
#include "tests/desk/panel_models.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::session {

namespace {

// The panel over one colour, mixed in linear light as the output stage does.
Image over(const Image& panel, std::uint8_t scene) {
    Image eye{panel.size, std::vector<std::uint8_t>(panel.rgba.size(), 255)};
    for (std::size_t i = 0; i < eye.rgba.size(); ++i) {
        if (i % 4 != 3) eye.rgba[i] = scene;
    }
    const renderer::Overlay overlay{panel,
                                    {0, 0, static_cast<int>(panel.size.width), static_cast<int>(panel.size.height)},
                                    wall::OverlayColour::coded};
    wall::OutputSettings settings;
    settings.mode = wall::StereoMode::left;
    return renderer::compose(eye, eye, settings, {.size = panel.size}, &overlay);
}

// How many pixels have a colour, within a step of each channel.
std::size_t count_of(const Image& image, std::array<int, 3> colour) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        bool same = true;
        for (std::size_t k = 0; k < 3; ++k) same = same && std::abs(image.rgba[i + k] - colour[k]) <= 2;
        count += same ? 1 : 0;
    }
    return count;
}

}  // namespace

class SessionPanel : public gpu::DeviceTest {
protected:
    Image paint(Panel& panel, const PanelModel& model, Nanoseconds time_ns = 0) {
        const PanelFrame& frame = panel.show(model, time_ns);
        auto painter = renderer::PanelPainter::create(device(), panel.size(), panel.atlas());
        EXPECT_TRUE(painter) << painter.error().line();
        auto commands = gpu::Commands::begin(device());
        const auto painted = painter->record(*commands, frame.mesh);
        EXPECT_TRUE(painted && *painted);
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        auto image = renderer::read_back(device(), painter->image(), panel.size(), VK_FORMAT_R8G8B8A8_UNORM,
                                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        EXPECT_TRUE(image) << image.error().line();
        return std::move(*image);
    }

    static void keep(const Image& panel, const std::string& name) {
        const char* const folder = std::getenv("BURIN_PANEL_PICTURES");
        if (folder != nullptr) {
            EXPECT_TRUE(
                picture::write_png(std::filesystem::path(folder) / ("panel_" + name + ".png"), over(panel, 128)));
        }
    }
};

TEST_F(SessionPanel, ShowsEachStateOfASession) {
    const std::array<std::pair<const char*, PanelModel>, 6> states{{{"idle", idle_model()},
                                                                    {"carving", carving_model()},
                                                                    {"no_force", no_force_model()},
                                                                    {"export", export_model()},
                                                                    {"help", help_model()},
                                                                    {"study", study_model()}}};
    std::vector<Image> pictures;
    for (const auto& [name, model] : states) {
        auto panel = Panel::create({.size = {340, 1180}});
        ASSERT_TRUE(panel) << panel.error().line();
        pictures.push_back(paint(*panel, model));
        keep(pictures.back(), name);
        // Letters are there, and no ground is brighter than a third: nothing for the other eye to see as a ghost.
        EXPECT_GT(count_of(pictures.back(), {222, 225, 228}), 100u) << name;
    }
    // The fault's own red is in the picture of the state without force, and in none other but by chance.
    EXPECT_GT(count_of(pictures[2], {230, 124, 112}), 100u);
    EXPECT_LT(count_of(pictures[0], {230, 124, 112}), 5u);
}

// An activity's widgets of each kind: as they are, none of them enabled, at the panel's foot, and as small as half of a
// side-by-side picture of 1280 x 720 has them.
TEST_F(SessionPanel, ShowsEachKindOfWidgetOfAnActivity) {
    struct Shown {
        const char* name;
        ImageSize size;
        double scale;
        bool enabled, governs;
    };
    for (const Shown& shown :
         {Shown{"widgets", {340, 900}, 1.0, true, false}, Shown{"widgets_off", {340, 900}, 1.0, false, false},
          Shown{"widgets_foot", {340, 720}, 1.0, true, true}, Shown{"widgets_half", {170, 360}, 0.5, true, false}}) {
        PanelModel model = all_widgets_model();
        model.activity->governs = shown.governs;
        for (ActivityPanel::Widget& widget : model.activity->widgets)
            std::visit(
                [&](auto& one) {
                    if constexpr (requires { one.enabled; }) one.enabled = one.enabled && shown.enabled;
                },
                widget);
        auto panel = Panel::create({.size = shown.size, .scale = shown.scale});
        ASSERT_TRUE(panel) << panel.error().line();
        const Image picture = paint(*panel, model);
        keep(picture, shown.name);
        for (const char* const label : {"do apart", "do shape ball", "do kind", "do colour 1"}) {
            const auto at = panel->place_of(label);
            ASSERT_TRUE(at) << label << ", " << shown.name;
            EXPECT_LE(at->x + at->width, shown.size.width) << label << ", " << shown.name;
        }
    }
}

TEST_F(SessionPanel, IsLargerForAWallSeenFromAfar) {
    auto panel = Panel::create({.size = {680, 1440}, .scale = 2.0});
    ASSERT_TRUE(panel) << panel.error().line();
    keep(paint(*panel, carving_model()), "wall");
    auto small = Panel::create({.size = {340, 720}, .scale = 1.0});
    ASSERT_TRUE(small);
    (void)small->show(carving_model(), 0);
    const auto a = small->place_of("operation paint"), b = panel->place_of("operation paint");
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(b->width, 2.0 * a->width, 3.0);
    EXPECT_NEAR(b->height, 2.0 * a->height, 3.0);
}

TEST_F(SessionPanel, ShowsAnOpenListOverAllElse) {
    auto panel = Panel::create({.size = {340, 1180}});
    ASSERT_TRUE(panel);
    const PanelModel model = carving_model();
    (void)panel->show(model, 0);
    const auto at = panel->place_of("stereo-mode");
    ASSERT_TRUE(at);
    const Vec2 middle(at->x + 0.5 * at->width, at->y + 0.5 * at->height);
    const std::array<InputEvent, 3> click{{{0, MouseMove{middle}},
                                           {0, MouseClick{MouseButton::left, true, {}}},
                                           {0, MouseClick{MouseButton::left, false, {}}}}};
    panel->feed(click);
    (void)panel->show(model, 16'000'000);
    keep(paint(*panel, model, 32'000'000), "list");
    EXPECT_TRUE(panel->place_of("stereo-mode mono"));
}

TEST_F(SessionPanel, AsksTheOperatorOfAStudyInALineOfItsOwn) {
    auto panel = Panel::create({.size = {340, 720}});
    ASSERT_TRUE(panel);
    PanelModel model = study_model();
    (void)panel->show(model, 0);
    const auto at = panel->place_of("do stop");
    ASSERT_TRUE(at);
    const Vec2 middle(at->x + 0.5 * at->width, at->y + 0.5 * at->height);
    const std::array<InputEvent, 3> click{{{0, MouseMove{middle}},
                                           {0, MouseClick{MouseButton::left, true, {}}},
                                           {0, MouseClick{MouseButton::left, false, {}}}}};
    panel->feed(click);
    model.warnings = {"Picture 61 ms behind the hand; 15 is noticed"};
    (void)panel->show(model, 16'000'000);
    keep(paint(*panel, model, 32'000'000), "study_asks");
    const auto yes = panel->place_of("yes, do stop"), stop = panel->place_of("do stop"),
               field = panel->place_of("field do note");
    ASSERT_TRUE(yes && stop && field);
    EXPECT_EQ(stop->y, at->y);
    EXPECT_GE(yes->y, stop->y + stop->height);
    EXPECT_LE(yes->y + yes->height, field->y);
    EXPECT_LE(field->y + field->height, 720u);
}

}  // namespace burin::session
