// SPDX-License-Identifier: MIT
#include "desk/opening/opening_picture.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "base/longest_side.hpp"
#include "base/try.hpp"
#include "desk/live/opened_desk.hpp"
#include "desk/panel/live_panel.hpp"
#include "desk/viewer/viewed_picture.hpp"
#include "session/live/opened_room.hpp"

namespace burin::session {
namespace {

// Before anything is known of the workpiece: as large as a shape without a name.
const Box kUnknownBox{Vec3(-0.1), Vec3(0.1)};

// The letters of the session's panel are others than the card's, however many atlases either has had.
constexpr std::uint64_t kCardsAtlases = 1ull << 32;

}  // namespace

OpeningPicture::OpeningPicture(const SessionSetup& options, const SessionWall& wall, Room room,
                               wall::OutputSettings output)
    : options_(options),
      room_(std::move(room)),
      desk_(open_desk(options, wall, room_)),
      output_(output),
      name_(std::filesystem::path(options.carve.workpiece.source).filename().string()) {
    room_.workpiece_object = kUnknownBox;
}

Result<OpeningPicture> OpeningPicture::create(const SessionSetup& options, const SessionWall& wall) {
    BURIN_TRY(opened, open_room(options));
    BURIN_TRY(output, first_output(wall, options.desk));
    return OpeningPicture(options, wall, std::move(opened.room), output);
}

void OpeningPicture::take(FirstLook look) {
    room_.workpiece_object = look.bounds_object;
    look_ = std::move(look);
}

// The scene as the session begins it, with the mesh in the workpiece's place.
picture::Picture OpeningPicture::scene() const {
    const double longest_m = longest_side_m(room_.workpiece_object);
    const auto tool = toolbox::parse_tool_settings(toolbox::with_tool({}, longest_m));
    Viewer viewer = begin_viewer(desk_, output_);
    const SessionState state =
        begin_session(room_, tool.value_or(toolbox::ToolSettings{}), {}, placed_before(viewer, room_, desk_, nullptr));
    take_hand(viewer, state);
    const ViewedSession seen{state, room_, viewer, desk_};
    auto scene = scene_of(seen, desk_.wall.main, Vec3(0.0), {}).value_or(picture::Picture{});
    scene.pedestal.visible = scene.pedestal.visible && look_.has_value();
    if (!look_) return scene;
    constexpr double kPlain = 200.0 / 255.0;  // a material's colour where the file has none
    scene.objects.push_back({look_->mesh, state.world_from_object, Vec3(kPlain)});
    return scene;
}

Result<StillPicture> OpeningPicture::lay_out(const WorkWatch::Seen& seen, Nanoseconds time_ns, ImageSize window) {
    const ImageSize eye = wall::eye_size(output_.mode, window);
    fit_desk_screen(desk_.wall, eye);
    desk_.free_width = beside_panel(desk_, eye, window);
    StillPicture picture{scene(), output_, std::nullopt};
    const auto width = static_cast<std::uint32_t>(std::lround(kPanelWidth_px * desk_.panel_scale));
    if (!panel_) {
        BURIN_TRY(made, Panel::create({.size = {width, eye.height}, .scale = desk_.panel_scale}));
        panel_.emplace(std::move(made));
    }
    panel_->resize({width, eye.height});
    panel_->lie_over(eye);
    PanelModel model;
    model.visible = false;
    model.workpiece.name = name_;
    model.opening = PanelOpening{name_, seen.step, static_cast<int>(std::floor(100.0 * seen.done)),
                                 static_cast<int>(time_ns / kNanosecondsPerSecond)};
    const PanelFrame& card = panel_->show(model, time_ns);
    picture.panel.emplace(
        PanelPicture{card.mesh, panel_->atlas(), card.size, kCardsAtlases + panel_->atlases(), card.parts});
    return picture;
}

}  // namespace burin::session
