// SPDX-License-Identifier: MIT
// A person who has never seen the program: a mouse, an own part in millimetres, no option but the file. Buttons are
// pressed where the panel has drawn them, what is scrolled away is scrolled to. Pictures are taken off screen; with
// BURIN_NEWCOMER_PICTURES naming a folder they are left there to be looked at.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "desk/present/presenter.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "gpu/device.hpp"
#include "tests/desk/mouse_desk.hpp"
#include "tests/renderer/output/output_pictures.hpp"

namespace burin::session {

// A bracket of 80 x 60 mm, 10 mm thick, whose upright at the left is 40 mm high; a hole of 18 mm goes through its foot.
inline constexpr double kFoot_mm = 10.0, kUpright_mm = 40.0;
inline constexpr Vec2 kHole_mm{52.0, 30.0};
inline std::string bracket() {
    Corners all;
    const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { add_quad(all, a, b, c, d); };
    const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        for (const Vec3& corner : {a, b, c}) all.push_back(corner);
    };
    constexpr int kSides = 48;
    const auto rim = [](int i, double z) {
        const double angle = 2.0 * std::numbers::pi * i / kSides;
        return Vec3(kHole_mm.x + 9.0 * std::cos(angle), kHole_mm.y + 9.0 * std::sin(angle), z);
    };
    // A face of the foot around the hole: each quarter of the rim is joined to the corner on its side.
    const auto face = [&](double from_x, double z, bool up) {
        const std::array<Vec3, 4> corners{{{80, 60, z}, {from_x, 60, z}, {from_x, 0, z}, {80, 0, z}}};
        for (int i = 0; i < kSides; ++i) {
            const std::size_t quarter = static_cast<std::size_t>(4 * i / kSides);
            const Vec3 a = rim(i, z), b = rim(i + 1, z), corner = corners.at(quarter);
            up ? triangle(b, a, corner) : triangle(a, b, corner);
            if ((i + 1) % (kSides / 4) != 0) continue;
            const Vec3 next = corners.at((quarter + 1) % 4);
            up ? triangle(b, corner, next) : triangle(b, next, corner);
        }
    };
    face(10.0, kFoot_mm, true);
    face(0.0, 0.0, false);
    for (int i = 0; i < kSides; ++i) quad(rim(i, 0), rim(i, kFoot_mm), rim(i + 1, kFoot_mm), rim(i + 1, 0));
    const double f = kFoot_mm, u = kUpright_mm;
    quad({80, 0, 0}, {80, 60, 0}, {80, 60, f}, {80, 0, f});
    quad({10, 0, f}, {10, 60, f}, {10, 60, u}, {10, 0, u});
    quad({0, 0, u}, {10, 0, u}, {10, 60, u}, {0, 60, u});
    quad({0, 60, 0}, {0, 0, 0}, {0, 0, u}, {0, 60, u});
    for (const double y : {0.0, 60.0}) {
        const std::array<Vec3, 6> side{{{10, y, f}, {10, y, u}, {0, y, u}, {0, y, 0}, {80, y, 0}, {80, y, f}}};
        for (std::size_t i = 1; i + 1 < side.size(); ++i)
            y == 0.0 ? triangle(side[0], side.at(i), side.at(i + 1)) : triangle(side[0], side.at(i + 1), side.at(i));
    }
    return stl_of(all);
}

// Share of a rectangle's pixels that differ by more than `by` in a channel.
inline double changed(const Image& one, const Image& other, const PixelRect& in, int by = 12) {
    if (one.size != other.size || in.empty()) return 1.0;
    std::size_t count = 0;
    for (std::uint32_t y = in.y; y < in.y + in.height; ++y)
        for (std::uint32_t x = in.x; x < in.x + in.width; ++x) {
            int most = 0;
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(one.pixel(x, y)[c] - other.pixel(x, y)[c]));
            count += most > by ? 1 : 0;
        }
    return static_cast<double>(count) / (static_cast<double>(in.width) * in.height);
}

class NewcomerDesk : public MouseDesk {
public:
    explicit NewcomerDesk(DeskOptions shown = {}, int resolution = 112) {
        place().write("bracket.stl", bracket());
        options.carve.workpiece.source = (place() / "bracket.stl").string();
        options.carve.workpiece.resolution = resolution;
        options.carve.workpiece.close_small_holes = true;
        options.desk = shown;
        options.desk.offscreen = true;
        settle_room(options, true);
        wall_ = session_wall(options.desk).value();
        options.desk.first_steps = wall_.desk;
        open();
        draws = false;
        Result<Presenter> opened = Presenter::open(options.desk, wall_);
        if (!opened) throw std::runtime_error(opened.error().line());
        presenter_.emplace(std::move(*opened));
        presenter_->look();
        output = presenter_->place();
        rest(0.1);
    }

    // ---- What the person does

    // Turns the scene by a drag of the right button.
    void turn(const Vec2& by_px) {
        const Vec2 from(300.0, 400.0);
        move_to(from);
        run({{MouseClick{MouseButton::right, true, {}}, 50'000'000}});
        drag(from, from + by_px, 600.0);
        run({{MouseClick{MouseButton::right, false, {}}, 100'000'000}}, 500'000'000);
    }
    // Presses a button of the panel with the mouse, having scrolled to it.
    void press_button(const std::string& label) {
        const std::optional<Vec2> at = found(label);
        ASSERT_TRUE(at) << "the panel has no " << label;
        click(*at);
    }
    void click(const Vec2& px) {
        move_to(px);
        run({{MouseClick{}, 100'000'000}, {MouseClick{MouseButton::left, false, {}}, 80'000'000}}, 300'000'000);
    }
    // Takes the mouse off the part and the panel.
    void step_back() {
        move_to({30.0, 30.0});
        rest(1.0);
    }

    // ---- What there is to see

    // Takes a picture of the main screen as it is now; name: what it is left as.
    Image picture(const std::string& name) {
        testing::internal::CaptureStderr();
        const std::string file = (place() / (name + ".png")).string();
        session().files().ask_for_picture(file);
        const Result<bool> drawn = presenter_->draw(*desk, now_ns());
        testing::internal::GetCapturedStderr();
        EXPECT_TRUE(drawn) << drawn.error().line();
        if (!desk->viewer().first_steps) run({{CommandInput{"put-away", {}}, 10'000'000}}, 50'000'000);
        const std::string& screen = wall_.screens[wall_.main].name;
        const bool one = screen.empty() || wall_.screens.size() == 1;
        const Image image =
            renderer::read_png(one ? place() / (name + ".png") : place() / (name + "-" + screen + ".png"));
        if (const char* const folder = std::getenv("BURIN_NEWCOMER_PICTURES"))  // NOLINT(concurrency-mt-unsafe)
            for (const auto& one : std::filesystem::directory_iterator(place() / ""))
                if (one.path().filename().string().starts_with(name))
                    std::filesystem::copy_file(one, std::filesystem::path(folder) / one.path().filename(),
                                               std::filesystem::copy_options::overwrite_existing);
        return image;
    }
    // The part of the picture around a place of the part.
    [[nodiscard]] PixelRect around_mm(const Vec3& place_mm, std::uint32_t half_px = 24) const {
        const Vec2 at = px_of(place_mm);
        return {static_cast<std::uint32_t>(at.x) - half_px, static_cast<std::uint32_t>(at.y) - half_px, 2 * half_px,
                2 * half_px};
    }
    [[nodiscard]] double volume_mm3() const {
        return 1e9 * geometry::examine(session().scene_side().surface()->welded()).signed_volume_m3;
    }
    using MouseDesk::place;
    [[nodiscard]] const SessionWall& wall() const { return wall_; }

    // The right border of the main screen's picture that the panel leaves free, in the window.
    [[nodiscard]] double free_px() const {
        const ImageSize eye_px = wall::eye_size(desk->output_on(wall_.main).mode, output.size);
        return desk->room().free_width * eye_px.width / px_per_window_px().x;
    }

private:
    [[nodiscard]] Vec2 px_per_window_px() const { return wall::picture_px_per_px(desk->output_on(wall_.main).mode); }
    // Where a pixel of the panel is seen in the window: over the picture, or on a panel that stands in the scene.
    [[nodiscard]] Vec2 in_window(const Vec2& panel_px) const {
        const std::optional<PanelPicture> panel = desk->panel_on(wall_.main);
        if (!panel || !panel->stand) return panel_px / px_per_window_px();
        const Vec2 share = panel_px / Vec2(panel->size.width, panel->size.height) - Vec2(0.5);
        const Vec2 at_m = Vec2(share.x, -share.y) * panel->stand->size_m;
        return px_of_world(panel->stand->world_from_panel * Vec3(at_m, 0.0));
    }
    // Scrolls the panel until it shows a label, downwards and then up; returns where that is in the window.
    std::optional<Vec2> found(const std::string& label) {
        const ImageSize eye_px = wall::eye_size(desk->output_on(wall_.main).mode, output.size);
        const bool stands = !wall_.desk;
        const Vec2 on_panel = stands ? Vec2(170.0, 300.0) : Vec2(eye_px.width - 20.0, 0.5 * eye_px.height);
        for (int i = 0; i < 80; ++i) {
            const auto at = desk->place_on_panel(label);
            if (at && at->height >= 8) return in_window({at->x + 0.5 * at->width, at->y + 0.5 * at->height});
            move_to(in_window(on_panel));
            run({{Scroll{{0.0, i < 40 ? -1.0 : 2.0}, {}}, 20'000'000}}, 100'000'000);
        }
        return std::nullopt;
    }

    SessionWall wall_;
    std::optional<Presenter> presenter_;
};

}  // namespace burin::session
