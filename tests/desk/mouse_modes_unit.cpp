// SPDX-License-Identifier: MIT
// A person with a mouse before each stereo mode: two pictures in one window leave each another shape, and the part
// stays whole and beside the panel in it.
#include "desk/panel/live_panel.hpp"
#include "tests/desk/mouse_desk.hpp"

namespace burin::session {
namespace {

// As a person begins, with the panel shown.
struct ModesDesk : MouseDesk {
    explicit ModesDesk(const std::string& stereo = {}) {
        place().write("part.stl", plate(12.0));
        options.carve.workpiece.source = (place() / "part.stl").string();
        options.carve.workpiece.resolution = 64;
        options.hands.mouse = MouseMode::surface;
        options.desk.stereo = stereo;
        open();
        rest(0.2);
    }
    // Where its corners are seen, as shares of what the panel leaves free of an eye's picture.
    [[nodiscard]] Box seen_share() const {
        const wall::StereoMode mode = desk->output_on(desk->room().wall.main).mode;
        const ImageSize eye = wall::eye_size(mode, output.size);
        const double free_px = eye.width * desk->room().free_width;
        Box box;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 at((corner & 1) != 0 ? 80.0 : 0.0, (corner & 2) != 0 ? 60.0 : 0.0,
                          (corner & 4) != 0 ? 12.0 : 0.0);
            const Vec2 px = px_of(at) * wall::picture_px_per_px(mode);
            box.include({px.x / free_px, px.y / eye.height, 0.0});
        }
        return box;
    }
    void press_key(Key key) {
        run({{KeyInput{key, KeyMotion::press, {}}, 8'000'000}, {KeyInput{key, KeyMotion::release, {}}, 1}},
            200'000'000);
    }
};

void expect_whole(const ModesDesk& desk, const std::string& when) {
    const Box seen = desk.seen_share();
    EXPECT_GT(std::min(seen.lo.x, seen.lo.y), 0.02) << when;
    EXPECT_LT(std::max(seen.hi.x, seen.hi.y), 0.98) << when;
    EXPECT_GT(std::max(seen.hi.x - seen.lo.x, seen.hi.y - seen.lo.y), 0.6) << when << ": and not tiny";
}

}  // namespace

// After some presses of M a third of the part was out of the picture, also where the mode was mono again.
TEST(MouseInStereoModes, AKeyLeadsThroughThemAndThePartStaysWhole) {
    ModesDesk desk;
    expect_whole(desk, "at first");
    const Box first = desk.seen_share();
    std::size_t modes = 0;
    do {
        desk.press_key(Key::m);
        expect_whole(desk, std::string(file_name_of(desk.viewer().output.mode)));
        ++modes;
    } while (desk.viewer().output.mode != wall::StereoMode::mono && modes < 40);
    EXPECT_GT(modes, 8u);
    EXPECT_LT(glm::length(desk.seen_share().lo - first.lo) + glm::length(desk.seen_share().hi - first.hi), 0.02);
}

// `--stereo side-by-side` began with half of the part beyond the left border.
TEST(MouseInStereoModes, ASessionThatBeginsInOneShowsThePartWhole) {
    for (const wall::StereoMode mode : wall::stereo_modes()) {
        if (wall::shows_one_eye_at_a_time(mode)) continue;
        expect_whole(ModesDesk(std::string(file_name_of(mode))), std::string(file_name_of(mode)));
    }
}

}  // namespace burin::session
