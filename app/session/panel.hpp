// SPDX-License-Identifier: MIT
// The panel of the live session: what it shows is a PanelModel, what it wants leaves as commands. It changes nothing itself: whoever runs
// the commands (app/session/command_table.hpp) makes the next model, so that panel, keys, scripts and replays go the same way.
//
//   auto panel = Panel::create({.size = {340, 1080}, .scale = 1.0});
//   auto painter = PanelPainter::create(device, panel->size(), panel->atlas());
//   each frame:
//     panel->feed(events, place);                       // before the desk's step, which gets wants_mouse and wants_keyboard
//     const PanelFrame& frame = panel->show(model, time_ns);
//     for (const CommandInput& action : frame.actions) run(action);
//     if (frame.changed) painter->record(commands, frame.mesh);
//
// The same models, events and times give the same meshes, bit for bit. A model that is as it was, without events, is not laid out again.
// Clicks between two frames are not lost: a frame in which buttons change is laid out once for each change.
// Several panels may live side by side, each with a context of its own; all on one thread. No file is read but the type's, none written.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/panel_model.hpp"
#include "renderer/panel/panel_mesh.hpp"

namespace burin {

struct PanelOptions {
    ImageSize size{340, 1080};  // pixels; 340 times the scale wide
    // 1 for a desk at 60 cm. On a wall letters of 15 px times this must be seen under half a degree: read from 3 m that is 26 mm.
    double scale = 1.0;
    std::string type_file =
        {};  // of the letters; empty: Roboto, DejaVu Sans, or the toolkit's own, the first that is there
};

// The scale at which letters are seen under the angle that is comfortable to read (ISO 9241-303: capitals of 20 to 22 minutes of arc).
[[nodiscard]] double panel_scale(double reading_distance_m, double metres_per_px);
inline constexpr double kPanelWidth_px = 340.0;  // at scale 1

// Where the panel is in the output: pixel = origin + panel's pixel * scale.
struct PanelPlace {
    Vec2 origin_px{0.0};
    Vec2 px_per_panel_px{1.0};
};

struct PanelFrame {
    PanelMesh mesh;
    std::vector<CommandInput> actions;  // in their order
    bool wants_mouse = false;           // the mouse is over it, or drags what it holds: the desk's step leaves it alone
    bool wants_keyboard = false;        // a text field has the keys
    bool changed = false;               // the mesh is not the one before
};

class Panel {
public:
    // The Error is a type file that was named and cannot be used.
    [[nodiscard]] static Result<Panel> create(const PanelOptions& options);
    Panel(Panel&&) noexcept;
    Panel& operator=(Panel&&) noexcept;
    ~Panel();

    void resize(ImageSize size);
    [[nodiscard]] ImageSize size() const;
    [[nodiscard]] const PanelAtlas& atlas() const;
    // What users should know of the letters; empty: all is well.
    [[nodiscard]] const std::string& notice() const;

    // Mouse, keys and text; all else is ignored.
    void feed(std::span<const InputEvent> events, const PanelPlace& place = {});
    // A wand's ray in place of the mouse (renderer/panel/panel_stand.hpp): where it meets the panel, in panel pixels, and its trigger.
    void point(const std::optional<Vec2>& at_px, bool pressed);

    // time_ns: since the session's start, not falling. Valid until the next call.
    [[nodiscard]] const PanelFrame& show(const PanelModel& model, Nanoseconds time_ns);

    // Where the widget of this label is, of the last frame; nothing where it is not, or is scrolled away. For tests and scripts. Labels are
    // the commands they give ("undo", "operation paint", "radius") or the section's title.
    [[nodiscard]] std::optional<PixelRect> place_of(std::string_view label) const;
    [[nodiscard]] std::vector<std::string> labels() const;
    [[nodiscard]] std::uint64_t laid_out() const;  // how often
    [[nodiscard]] std::uint64_t spared() const;    // how often it was not needed

private:
    class Implementation;
    explicit Panel(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace burin
