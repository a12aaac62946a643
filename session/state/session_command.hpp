// SPDX-License-Identifier: MIT
// Every command that a session accepts, as a type; names, help and parsers are in session/state/command_table.hpp.
// Numbers are in SI units. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "compute/rays/operation.hpp"
#include "haptics/workspace/workspace_picture.hpp"
#include "session/input/actions.hpp"
#include "session/objects/edit_object.hpp"
#include "session/options/edge_comfort.hpp"
#include "session/state/asked_close.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/mirror.hpp"
#include "toolbox/tool_kinds.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::session {

// One without arguments that a key can give as well.
struct RunAction {
    Action action = Action::undo;
    bool operator==(const RunAction&) const = default;
};
struct SetTool {
    toolbox::ToolSpec tool;
    bool operator==(const SetTool&) const = default;
};
struct SetOperation {
    compute::Operation operation = compute::Operation::cut;
    bool operator==(const SetOperation&) const = default;
};
// Sets the colour of the material that the tool leaves; sRGB, 0 to 1.
struct SetColour {
    std::array<double, 3> srgb{};
    bool operator==(const SetColour&) const = default;
};
// Makes the workpiece feel like a material.
struct SetMaterial {
    toolbox::FeelPreset preset = toolbox::FeelPreset::medium;
    bool operator==(const SetMaterial&) const = default;
};
// Names a number that a session keeps and a command can set.
enum class Quantity : std::uint8_t {
    radius,           // m; of a ball, or of one as wide as another tool
    hardness,         // N s/m^3
    friction,         // Coulomb's mu
    stiffness,        // N/m
    velocity_filter,  // factor a of the moving average; 0: off
    force_filter,     // factor a of the moving average; 0: off
    scale,            // position gain of the workspace
    eye_distance,     // m
    strength,         // of the mouse on a surface: a stroke's depth, as a share of the tool's half width
};
struct SetQuantity {
    Quantity quantity = Quantity::radius;
    double value = 0.0;
    bool operator==(const SetQuantity&) const = default;
};
struct SetTechnique {
    haptics::WorkspaceTechnique technique = haptics::WorkspaceTechnique::fixed;
    bool operator==(const SetTechnique&) const = default;
};
struct SetStereoMode {
    wall::StereoMode mode = wall::StereoMode::mono;
    bool operator==(const SetStereoMode&) const = default;
};
struct SetTestPattern {
    wall::TestPattern pattern = wall::TestPattern::none;
    bool operator==(const SetTestPattern&) const = default;
};
struct SetEyeSwap {
    bool on = false;
    bool operator==(const SetEyeSwap&) const = default;
};
// Switches the force; off: the device is held at zero force.
struct SetForce {
    bool on = true;
    bool operator==(const SetForce&) const = default;
};
// Switches the amplifiers of the device's motors: on again after they have tripped, or off at once.
struct SetAmplifiers {
    bool on = true;
    bool operator==(const SetAmplifiers&) const = default;
};
// Shows or hides the arrow at the tool that stands for the force.
struct SetForceShown {
    bool on = false;
    bool operator==(const SetForceShown&) const = default;
};
// Whether parallax fades towards the screen's edges.
struct SetEdgeComfort {
    EdgeComfort comfort = EdgeComfort::automatic;
    bool operator==(const SetEdgeComfort&) const = default;
};
// A drill: the search for contact stops where it is, as if its work never sufficed, until the watch lets the hand go
// (haptics/contact/contact_watch.hpp).
struct SetCatchDrill {
    bool on = false;
    bool operator==(const SetCatchDrill&) const = default;
};
struct ExportTo {
    std::string path;
    bool operator==(const ExportTo&) const = default;
};
// Ends the session; what was not saved is not wanted.
struct QuitDiscard {
    bool operator==(const QuitDiscard&) const = default;
};
// Saves the work and ends the session; goes on with it after all.
struct QuitSave {
    bool operator==(const QuitSave&) const = default;
};
struct QuitStay {
    bool operator==(const QuitStay&) const = default;
};
// Saves the work as a document; an empty path: the one that it has.
struct SaveTo {
    std::string path;
    bool operator==(const SaveTo&) const = default;
};
// Saves the work under a name, once it is known whether there is a file of that name (session/state/asked_close.hpp).
struct SaveAs {
    std::string path;
    NameIs is = NameIs::given;
    bool operator==(const SaveAs&) const = default;
};
// Tells what is known of the document.
struct TellDocument {
    DocumentTold told;
    bool operator==(const TellDocument&) const = default;
};
struct ScreenshotTo {
    std::string path;
    bool operator==(const ScreenshotTo&) const = default;
};

// Chooses the object that the panel shows.
struct SelectObject {
    std::string object;
    bool operator==(const SelectObject&) const = default;
};

// Has mouse, keys and panel lead another hand.
struct LeadHand {
    std::string hand;
    bool operator==(const LeadHand&) const = default;
};

// Tells the activity something: one of its acts, and its arguments (session/activity/activity.hpp).
struct DoAct {
    std::vector<std::string> words;
    bool operator==(const DoAct&) const = default;
};
// Takes the handle for being in its jig, or takes that back.
struct CalibrateHandle {
    bool reset = false;
    bool operator==(const CalibrateHandle&) const = default;
};

// Carves the other sides of these planes as well.
struct SetMirror {
    toolbox::Mirror mirror;
    bool operator==(const SetMirror&) const = default;
};

// Has the mouse lead the hand along the surface, or freely.
struct SetMouse {
    MouseMode mode = MouseMode::free;
    bool operator==(const SetMouse&) const = default;
};

using SessionCommand =
    std::variant<RunAction, SetTool, SetOperation, SetColour, SetMaterial, SetQuantity, SetTechnique, SetStereoMode,
                 SetTestPattern, SetEyeSwap, SetEdgeComfort, SetForce, SetForceShown, SetCatchDrill, ExportTo,
                 ScreenshotTo, EditObject, SelectObject, DoAct, CalibrateHandle, SetAmplifiers, LeadHand, SetMouse,
                 SetMirror, SaveTo, QuitDiscard, QuitSave, QuitStay, SaveAs, TellDocument>;

// Returns whether a command is about how a session is seen, which is a viewer's (leader.hpp), and not the session's.
[[nodiscard]] bool is_of_a_viewer(Action action);
[[nodiscard]] bool is_of_a_viewer(const SessionCommand& command);

}  // namespace burin::session
