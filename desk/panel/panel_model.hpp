// SPDX-License-Identifier: MIT
// Everything that the panel shows, as plain data: the session fills it in, and the panel asks for nothing else. Equal
// models give equal pictures. Units are in the names. Plots hold the newest value last. panel_feed.hpp fills in what
// changes continuously, rarely enough to be read.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "compute/rays/operation.hpp"
#include "haptics/stability/gate_output.hpp"
#include "haptics/workspace/workspace_picture.hpp"
#include "scene/haptic_material.hpp"
#include "scene/rendered_material.hpp"
#include "session/activity/activity_panel.hpp"
#include "session/input/actions.hpp"
#include "session/notices/message_kind.hpp"
#include "session/record/panel_measured.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/mirror.hpp"
#include "toolbox/tool_kinds.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::session {

enum class Condition : std::uint8_t { good, idle, warning, fault };

// A device, a tracker or another source that may be present or not.
struct PanelSource {
    std::string name;    // "Haptic device"
    std::string detail;  // "simulated hand, 1000 Hz"
    Condition condition = Condition::idle;

    bool operator==(const PanelSource&) const = default;
};

// A line of `burin devices`.
struct PanelDevice {
    std::string option, name;          // "--device", "omni"
    std::string state, cause, remedy;  // "absent", "the library ... cannot be loaded", what can be done; may be empty
    Condition condition = Condition::idle;

    bool operator==(const PanelDevice&) const = default;
};

// The last ten seconds or so of a figure. Empty where there is no device.
struct PanelPlot {
    std::vector<float> values;
    float limit = 0.0f;  // period of a tick or frame, drawn as a line; 0: none

    bool operator==(const PanelPlot&) const = default;
};

struct PanelTouch {
    bool force_on = true;     // the user's choice
    bool in_contact = false;  // kTickInContact
    // ToolState::cause: why there is no force although it is on.
    haptics::GateCause cause = haptics::GateCause::none;
    bool was_let_go = false;  // within the last seconds: the watch has let the hand go
    std::uint32_t flags = 0;  // ToolState::flags, TickFlag bits
    std::uint64_t late_ticks = 0, dropped_samples = 0;
    double force_N = 0.0;

    bool operator==(const PanelTouch&) const = default;
};

// What a hand has of its own beside the others.
struct PanelHand {
    std::string name;
    PanelTouch touch;
    double velocity_filter = 0.0, force_filter = 0.0;

    bool operator==(const PanelHand&) const = default;
};

// The range that sliders offer for a tool's radius; its other sizes go up to twice as much.
struct ToolSizeRange {
    double from_m = 0.0005, radius_to_m = 0.05;

    bool operator==(const ToolSizeRange&) const = default;
};
// Returns the range for a workpiece: from 1/400 to 1/4 of its longest side, within the bounds of the command.
[[nodiscard]] ToolSizeRange tool_sizes_for(double longest_side_m);

struct PanelWorkpiece {
    std::string name, size;  // "cube.stl", "50 x 50 x 50 mm, 256 cells"

    bool operator==(const PanelWorkpiece&) const = default;
};

// What a hand's device renders of the chosen object's material.
struct PanelRendered {
    std::string hand;                            // empty: there is one
    scene::RenderedMaterial one;                 // with one point alone
    std::optional<scene::RenderedMaterial> all;  // with all of its points at once; none: it has one

    bool operator==(const PanelRendered&) const = default;
};

// The object of a world that is chosen.
struct PanelObject {
    std::string name, state;  // "moves", "held"
    scene::HapticMaterial material;
    std::vector<PanelRendered> rendered = {};  // for each hand; none where it is not felt
    int energy_percent = 0;                    // of the force, that the energy account takes while it is touched
    double scale = 1.0;
    std::array<double, 3> colour_srgb{};
    bool seen = true, felt = true;
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    bool own_colours = false;  // those of its file, several

    bool operator==(const PanelObject&) const = default;
};

// A message to the user, and how often it was told.
struct PanelNote {
    std::string text;  // "Saved part.stl, 983328 triangles"
    MessageKind kind = MessageKind::info;
    std::uint32_t count = 1;
    Nanoseconds time_ns = 0;  // of the session

    bool operator==(const PanelNote&) const = default;
};

// What is opened before there is anything to work on.
struct PanelOpening {
    std::string name, step;  // "part.stl", "reading the file"
    int percent = 0;         // done of all
    int seconds = 0;         // since it began

    bool operator==(const PanelOpening&) const = default;
};

// What is known of the document.
struct PanelDocument {
    std::string name, state, kept;  // "bracket.burin", "changed", "kept: all 12 strokes"
    bool saving = false, keeps = true;

    bool operator==(const PanelDocument&) const = default;
};

// What the user is asked about the document before anything else goes on.
struct PanelQuestion {
    // The session is to end with unsaved work; it ends once that is saved; the name of a file is wanted; that file is
    // another's.
    enum class What : std::uint8_t { close, saving, name, replace };
    What what = What::close;
    std::string name, kept;  // of the document
    std::string path;        // that typing begins with, or that is there
    bool has_file = false;   // the document has

    bool operator==(const PanelQuestion&) const = default;
};

struct PanelModel {
    bool visible = true, show_help = false, show_figures = false;  // Tab, F1, F2
    bool show_devices = false;                                     // F3: the page of devices, in place of the sections
    std::string devices_note;                                      // above them: "looking"
    std::vector<PanelDevice> devices;
    bool may_be_hidden = true;
    bool for_operator = false;  // it has a window of its own, where the person does not look
    bool page_alone = false;    // of the activity, for the person who is not to see the rest
    std::string title = "Burin";
    std::optional<PanelOpening> opening;  // in place of all else
    PanelWorkpiece workpiece;

    std::optional<ActivityPanel> activity;  // none: the session has no activity
    std::vector<std::string> object_names;  // of a world
    std::optional<PanelObject> object;      // none: there is no world
    bool carves = true;                     // there is a workpiece
    std::vector<PanelHand> hands;           // where there are several
    std::size_t hand = 0;                   // that mouse, keys and panel lead; tool, touch and filters are its
    toolbox::ToolSpec tool;
    ToolSizeRange tool_sizes;
    compute::Operation operation = compute::Operation::cut;
    bool only_touch = false;  // none of them works
    std::array<double, 3> colour_srgb{0.88, 0.56, 0.21};
    std::optional<toolbox::FeelPreset> material;  // none: its hardness was given as a number
    double hardness_Ns_per_m3 = 1e6;
    double friction = 0.3;
    double stiffness_N_per_m = 600.0;
    double velocity_filter = 0.0, force_filter = 0.0;  // factor a of the moving average; 0: off

    toolbox::Mirror mirror;
    MouseMode mouse = MouseMode::free;
    bool offers_mouse = false;  // the choice of how the mouse leads the hand is shown
    double strength = 0.3;      // of a stroke on the surface
    double half_width_m = 0.0;  // of the tool
    haptics::WorkspaceTechnique technique = haptics::WorkspaceTechnique::moving;
    haptics::WorkspacePhase phase = haptics::WorkspacePhase::editing;
    double scale = 1.0;

    wall::StereoMode stereo_mode = wall::StereoMode::mono;
    bool eyes_swapped = false;
    wall::TestPattern test_pattern = wall::TestPattern::none;
    double eye_distance_m = 0.063;
    bool force_shown = false;  // the arrow
    // Whether parallax fades towards the screen's edges; none: it never does on these screens.
    std::optional<bool> fades_at_edges;

    bool saves = true;  // the work can be saved, and what is done undone
    std::uint32_t undo_count = 0, redo_count = 0;
    std::string export_path = "part.stl";
    bool exporting = false;                 // an export is running
    std::optional<PanelDocument> document;  // none: nothing is told of it
    std::optional<PanelQuestion> question;  // before all else
    std::vector<PanelNote> notes;           // that lie over the picture now, the oldest first
    std::vector<PanelNote> log;             // all that are kept, the oldest first
    bool first_steps = false;               // the card for who sees this for the first time

    PanelTouch touch;
    std::vector<PanelSource> sources;   // device, tracker
    std::vector<std::string> warnings;  // FrameWarning::title
    PanelPlot force_N, tick_us, frame_ms;
    PanelFigures figures;
    std::optional<PanelSavings> savings;

    bool operator==(const PanelModel&) const = default;
};

}  // namespace burin::session
