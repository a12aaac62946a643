// SPDX-License-Identifier: MIT
// Panel of the live session: shows a PanelModel and returns the user's wishes as commands. It changes nothing itself:
// whoever runs the commands (session/state/command_table.hpp) makes the next model, so that panel, keys, scripts and
// replays take the same path.
//
//   auto panel = Panel::create({.size = {340, 1080}, .scale = 1.0});
//   auto painter = PanelPainter::create(device, panel->size(), panel->atlas());
//   each frame:
//     panel->feed(events, place);                    // before step_desk(), which gets wants_mouse and wants_keyboard
//     const PanelFrame& frame = panel->show(model, time_ns);
//     for (const CommandInput& action : frame.actions) run(action);
//     if (frame.changed) painter->record(commands, frame.mesh);
//
// The same models, events and times give the same meshes, bit for bit. An unchanged model without events is not laid
// out again. Clicks between two frames are not lost: a frame in which buttons change is laid out once for each change.
// Several panels may exist side by side, each with a context of its own; all on one thread. Reads no file but the
// font's and writes none.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "desk/panel/panel_model.hpp"
#include "renderer/panel/panel_mesh.hpp"
#include "session/input/input_event.hpp"

namespace burin::session {

struct PanelOptions {
    ImageSize size{340, 1080};  // pixels; the width is 340 times the scale
    // 1 for a desktop display at 60 cm. On a wall, choose it so that letters of 15 px times the scale subtend half a
    // degree: read from 3 m that is 26 mm.
    double scale = 1.0;
    // Font file; empty: Roboto, DejaVu Sans or the toolkit's own, the first that exists.
    std::string type_file = {};
};

// Returns the scale at which letters subtend the angle that is comfortable to read (ISO 9241-303: capitals of 20 to 22
// minutes of arc).
[[nodiscard]] double panel_scale(double reading_distance_m, double metres_per_px);
inline constexpr double kPanelWidth_px = 340.0;  // at scale 1

// Position of the panel in the output: pixel = origin + panel's pixel * scale.
struct PanelPlace {
    Vec2 origin_px{0.0};
    Vec2 px_per_panel_px{1.0};
};

struct PanelFrame {
    renderer::PanelMesh mesh;
    // Of the mesh: the panel's, or that of the whole picture while something lies over it beside the panel.
    ImageSize size;
    std::vector<PixelRect> parts;  // of that, where anything is painted
    // When the panel changes by itself, without another model or event; none: it does not.
    std::optional<Nanoseconds> changes_ns;
    std::vector<CommandInput> actions;  // in order
    // The mouse is over the panel or drags something on it; step_desk() then ignores it.
    bool wants_mouse = false;
    bool wants_keyboard = false;  // a text field has the keyboard
    bool changed = false;         // the mesh differs from the previous one
};

class Panel {
public:
    // Creates a panel. Fails when a named font file cannot be used.
    [[nodiscard]] static Result<Panel> create(const PanelOptions& options);
    Panel(Panel&&) noexcept;
    Panel& operator=(Panel&&) noexcept;
    ~Panel();

    void resize(ImageSize size);
    // Sets its letters in another size. Fails where a named font file can be used no more.
    [[nodiscard]] Result<void> rescale(double scale);
    // Has the panel lie at the right of a picture of this size, over which messages, tool-tips and the card of first
    // steps are shown; empty: there is none, and they lie over the panel itself.
    void lie_over(ImageSize picture);
    [[nodiscard]] ImageSize size() const;
    // Returns the height that the last page_alone took.
    [[nodiscard]] std::uint32_t page_height() const;
    [[nodiscard]] const renderer::PanelAtlas& atlas() const;
    // Counts the atlases that there have been: a letter that was not shown before makes another.
    [[nodiscard]] std::uint64_t atlases() const;
    // Notice for the user about the font, which may lack a letter of the last model; empty: none.
    [[nodiscard]] const std::string& notice() const;

    // Feeds mouse, keys and text; ignores all other events.
    void feed(std::span<const InputEvent> events, const PanelPlace& place = {});
    // Feeds a wand's ray in place of the mouse (picture/panel_stand.hpp): the point where it meets the panel, in
    // panel pixels, and its trigger.
    void point(const std::optional<Vec2>& at_px, bool pressed);

    // Shows the model. time_ns: since the session's start, non-decreasing. The frame is valid until the next call.
    [[nodiscard]] const PanelFrame& show(const PanelModel& model, Nanoseconds time_ns);

    // Returns the rectangle of the widget with this label in the last frame; nothing where it does not exist or is
    // scrolled away. For tests and scripts. A label is the command that the widget gives ("undo", "operation paint",
    // "radius") or its section's title.
    [[nodiscard]] std::optional<PixelRect> place_of(std::string_view label) const;
    // Likewise of what lies over the picture, in its pixels: "message 0", "tip", "first-steps".
    [[nodiscard]] std::optional<PixelRect> place_over_picture(std::string_view label) const;
    [[nodiscard]] std::vector<std::string> labels() const;
    [[nodiscard]] std::uint64_t laid_out() const;  // number of layouts made
    [[nodiscard]] std::uint64_t spared() const;    // number of frames that needed none

private:
    class Implementation;
    explicit Panel(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace burin::session
