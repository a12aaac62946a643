// SPDX-License-Identifier: MIT
#include "desk/panel/live_panel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "desk/viewer/viewed_picture.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::session {
namespace {

// Size of a panel that stands in the scene: its picture in pixels, and its width as a share of the screen's height, so
// that its letters are as large as those beside a desktop window's picture.
constexpr ImageSize kStanding_px{static_cast<std::uint32_t>(kPanelWidth_px), 680};
constexpr double kStandingWidth = 0.34, kStandingTurn_rad = 0.3;
// At most this share of the screen's width, since the workpiece stands in the middle.
constexpr double kOfScreensWidth = 0.26;

constexpr double kTaskWidth_px = 940.0;  // of a picture over which a task lies at scale 1

// How long the panel tells that the hand has been let go.
constexpr Nanoseconds kTold_ns = 5'000'000'000;

PanelTouch touch_of(const HandState& hand, const haptics::ToolState& tool) {
    PanelTouch touch;
    touch.force_on = hand.force_on;
    touch.in_contact = (tool.flags & haptics::kTickInContact) != 0;
    touch.cause = tool.cause;
    touch.was_let_go = tool.let_go_ns > 0 && tool.time_ns - tool.let_go_ns < kTold_ns;
    touch.flags = tool.flags & haptics::kTickInContact;
    return touch;
}

PanelSource tracker_source(const wall::TrackerReport& report) {
    if (report.state == wall::TrackerState::ok) return {"Head tracker", "follows the head", Condition::good};
    return {"Head tracker", report.cause,
            report.state == wall::TrackerState::lost ? Condition::fault : Condition::warning};
}

// Places the panel at the right of the screen that the viewer faces, turned towards the viewer.
picture::PanelStand stand_in(const DeskRoom& room, ImageSize size) {
    const wall::Screen s = room.screen();
    const Vec3 across = s.lower_right_world - s.lower_left_world, upright = s.upper_left_world - s.lower_left_world;
    const double width_m = std::min(kStandingWidth * glm::length(upright), kOfScreensWidth * glm::length(across));
    const Vec3 place = s.lower_right_world - (0.6 * width_m) * glm::normalize(across) + 0.55 * upright;
    const Quat turned = world_from_screen(s) * glm::angleAxis(-kStandingTurn_rad, Vec3(0.0, 1.0, 0.0));
    return picture::stand_of_width({place, turned}, width_m, size);
}

// Describes the chosen object; the first where none is.
void add_objects(PanelModel& m, const SessionState& state, const Viewer& viewer) {
    m.carves = state.carves;
    if (!state.world || state.world->objects.empty()) return;
    for (const auto& object : state.world->objects) m.object_names.push_back(object->name);
    const scene::SceneObject* chosen = state.world->find(viewer.selected);
    const scene::SceneObject& object = chosen != nullptr ? *chosen : *state.world->objects.front();
    m.object = PanelObject{.name = object.name,
                           .state = "",
                           .material = object.material,
                           .scale = object.scale,
                           .seen = object.seen,
                           .felt = object.felt,
                           .orientation = object.pose.orientation,
                           .own_colours = object.corner_colours != nullptr};
    if (std::holds_alternative<scene::HeldMotion>(object.motion)) m.object->state = "held";
    if (std::holds_alternative<scene::PathMotion>(object.motion)) m.object->state = "moves";
    for (std::size_t i = 0; i < 3; ++i) m.object->colour_srgb.at(i) = object.colour.at(i) / 255.0;
}

// Fills in what each hand's device renders of the chosen object's material.
void add_rendered(PanelModel& m, const PanelContext& context) {
    if (!m.object || !m.object->felt) return;
    for (std::size_t hand = 0; hand < context.session.hands().hands(); ++hand) {
        const devices::DeviceDescription& device =
            context.session.hands().device(context.session.hands().first_part(hand));
        const haptics::TickParameters parameters = parameters_of(context.seen.state, context.seen.room, hand, device);
        const auto with = [&](std::uint32_t points) {
            return scene::rendered_material(m.object->material, device, parameters, points);
        };
        PanelRendered rendered{
            context.session.hands().hands() > 1 ? context.session.hands().name_of_hand(hand) : "", with(1), {}};
        if (parameters.probe.count > 1) rendered.all = with(parameters.probe.count);
        m.object->rendered.push_back(std::move(rendered));
    }
}

// Fills in what is known of the document, and what the user is asked about it.
void add_document(PanelModel& m, const SessionState& state) {
    const AskedClose& asked = state.asked;
    if (!asked.told) return;
    const DocumentTold& told = *asked.told;
    const std::string name = short_name(told), kept = kept_text(told, state.carves ? "stroke" : "change");
    m.document = PanelDocument{name, state_text(told), kept, told.is == DocumentIs::saving, told.keeps};
    using What = PanelQuestion::What;
    if (asked.naming)
        m.question = PanelQuestion{asked.naming->is == NameIs::taken ? What::replace : What::name,
                                   name,
                                   {},
                                   asked.naming->name,
                                   told.has_file};
    else if (asked.closing != Closing::no)
        m.question =
            PanelQuestion{asked.closing == Closing::asked ? What::close : What::saving, name, kept, {}, told.has_file};
}

PanelNote note_of(const Message& message) { return {message.text, message.kind, message.count, message.time_ns}; }

}  // namespace

PanelSource hand_source(const SessionHands& hands, std::size_t part, haptics::GateCause cause, std::size_t led_hand) {
    const std::string name = hands.parts() > 1 ? "Hand, " + hands.name_of(part) : "Hand";
    if (cause != haptics::GateCause::none) return {name, haptics::text(cause), Condition::fault};
    const devices::DeviceDescription& device = hands.device(part);
    if (device.felt_by_person) return {name, device.name, Condition::good};
    if (*device.led_by != '\0') return {name, std::string("simulated, led by ") + device.led_by, Condition::good};
    const bool led = hands.part_of_hand(part).hand == led_hand;
    return {name, led ? "simulated, steered by the mouse" : "simulated, rests", Condition::good};
}

PanelModel LivePanel::model_of(const PanelContext& context, const MessageLog& log) const {
    const SessionState& state = context.seen.state;
    const Viewer& viewer = context.seen.viewer;
    const DeskRoom& desk = context.seen.desk;
    const Session& session = context.session;
    const SessionHands& hands = session.hands();
    const HandState& led = state.led();
    const haptics::ToolState& tool_state = session.tool_in_use();
    PanelModel m;
    m.visible = viewer.panel;
    m.show_help = viewer.help;
    m.show_figures = viewer.figures;
    m.show_devices = viewer.devices;
    m.workpiece = {session.found().name, session.found().size};
    add_objects(m, state, viewer);
    add_rendered(m, context);
    const auto value = [&](Quantity quantity) { return value_of(state, viewer, quantity); };
    m.tool = led.tool.shape;
    m.tool_sizes = context.tool_sizes;
    m.operation = led.tool.operation;
    m.only_touch = led.only_touch;
    const geometry::Material material = toolbox::material_of(led.tool);
    for (std::size_t i = 0; i < 3; ++i) m.colour_srgb[i] = material.colour[i] / 255.0;
    if (!state.feel.hardness_kPa_per_mm_s) m.material = state.feel.preset;
    m.hardness_Ns_per_m3 = value(Quantity::hardness);
    m.friction = value(Quantity::friction);
    m.stiffness_N_per_m = value(Quantity::stiffness);
    m.velocity_filter = value(Quantity::velocity_filter);
    m.force_filter = value(Quantity::force_filter);
    m.mirror = state.mirror;
    m.mouse = state.mouse;
    m.offers_mouse = desk.offers_mouse;
    m.strength = value(Quantity::strength);
    m.half_width_m = led.held ? led.held->half_width_m() : 0.0;
    m.technique = led.technique;
    m.phase = tool_state.workspace.phase;
    m.scale = value(Quantity::scale);
    m.stereo_mode = viewer.output.mode;
    m.eyes_swapped = viewer.output.swap_eyes;
    m.test_pattern = viewer.output.test_pattern;
    m.eye_distance_m = value(Quantity::eye_distance);
    m.force_shown = viewer.force_shown;
    const std::size_t main = desk.wall.main;
    if (could_fade_at_edges(context.seen, main)) m.fades_at_edges = fades_at_edges(context.seen, main);
    m.undo_count = static_cast<std::uint32_t>(session.scene_side().strokes().undoable + state.edits.undoable());
    m.redo_count = static_cast<std::uint32_t>(session.scene_side().strokes().redoable + state.edits.redoable());
    m.saves = state.saves;
    m.export_path = state.export_path;
    m.exporting = session.scene_side().strokes().exporting;
    m.activity = session.activity().panel();
    add_document(m, state);
    for (const Message& message : log.all()) {
        m.log.push_back(note_of(message));
        if (log.is_shown(message)) m.notes.push_back(note_of(message));
    }
    m.first_steps = viewer.first_steps;
    m.touch = touch_of(led, tool_state);
    for (std::size_t part = 0; part < session.tools().size(); ++part)
        m.sources.push_back(hand_source(hands, part, session.tools()[part].cause, state.hand));
    for (std::size_t i = 0; state.hands.size() > 1 && i < state.hands.size(); ++i) {
        const HandState& hand = state.hands[i];
        m.hands.push_back({hand.hand_name, touch_of(hand, session.tools()[hands.first_part(i)]), hand.velocity_filter,
                           hand.force_filter});
    }
    m.hand = state.hand;
    if (viewer.head.tracked) m.sources.push_back(tracker_source(context.tracker));
    feed_.show_on(m);
    m.force_N.limit = static_cast<float>(hands.device(hands.first_part(state.hand)).max_force_N);
    if (!context.tells_late_pictures) m.warnings.clear();
    return m;
}

// A replay's pictures do not depend on what is plugged in where it is replayed.
void LivePanel::add_devices(PanelModel& model, bool follows_recording) {
    look_.show(model.show_devices && !model.show_help && !follows_recording);
    if (!model.show_devices) return;
    model.devices = look_.found();
    if (follows_recording)
        model.devices_note = "a replay looks for no devices; see burin devices";
    else if (model.devices.empty())
        model.devices_note = "looking ...";
}

void LivePanel::feed_times(const FrameInput& input, const PanelContext& context) {
    const haptics::ToolState& tool = context.session.tool_in_use();
    const bool stirring = !input.events.empty() || (tool.flags & haptics::kTickInContact) != 0 ||
                          tool.workspace.phase != haptics::WorkspacePhase::editing;
    feed_.feed({input.time_ns, glm::length(tool.given.force_device_N), tool.late_ticks, tool.dropped_samples, stirring,
                context.times, context.session.hands().loop().duration(), drawn_, context.eye(), context.acknowledged,
                context.recording_ended, recorded_ ? &*recorded_ : nullptr, tool.energy_share});
}

double panel_scale_in(const DeskRoom& room, ImageSize window) {
    return std::min(room.panel_scale, std::max(1.0, window.width / (2.0 * kPanelWidth_px)));
}

std::uint32_t panel_width(const DeskRoom& room, ImageSize eye, ImageSize window) {
    const auto width = static_cast<std::uint32_t>(std::floor(kPanelWidth_px * panel_scale_in(room, window)));
    const bool has_room = room.wall.desk && !room.wall.has_panel_window() && eye.height > 0 && eye.width > width &&
                          window.width >= 2 * width;
    return has_room ? width : 0;
}

double beside_panel(const DeskRoom& room, ImageSize eye, ImageSize window) {
    constexpr double kLeast = 0.1;  // of a picture that the panel covers
    const std::uint32_t width = panel_width(room, eye, window);
    return width == 0 ? 1.0 : std::max(1.0 - static_cast<double>(width) / eye.width, kLeast);
}

Result<void> LivePanel::open(std::optional<Panel>& panel, ImageSize size, double scale) {
    if (!panel) {
        BURIN_TRY(made, Panel::create({.size = size, .scale = scale}));
        panel.emplace(std::move(made));
    }
    panel->resize(size);
    return panel->rescale(scale);
}

Result<SceneInput> LivePanel::feed(const FrameInput& input, const PanelContext& context, MessageLog& log) {
    actions_.clear();
    layout_ = page_layout_ = nullptr;
    feed_times(input, context);
    const ImageSize eye = context.eye();
    const bool stands = !context.seen.desk.wall.desk, in_window = context.seen.desk.wall.has_panel_window();
    const bool asks = context.seen.state.asked.naming || context.seen.state.asked.closing != Closing::no;
    const std::uint32_t width = in_window || stands
                                    ? static_cast<std::uint32_t>(kPanelWidth_px)
                                    : std::max(panel_width(context.seen.desk, eye, context.output.size), 1u);
    const bool has_column =
        in_window ? !is_empty(context.panel_output)
        : stands  ? (context.seen.viewer.panel || asks) && eye.height > 0
                  : context.seen.viewer.panel && panel_width(context.seen.desk, eye, context.output.size) > 0;
    const bool has_place = has_column || (!in_window && !stands && !is_empty(eye));
    column_shown_ = has_column;
    SceneInput left{{input.events.begin(), input.events.end()}, {}};
    if (left_out_) return left;
    if (has_place) {
        const ImageSize size = in_window ? ImageSize{width, context.panel_output.height}
                               : stands  ? kStanding_px
                                         : ImageSize{width, eye.height};
        const double scale = in_window || stands ? 1.0 : panel_scale_in(context.seen.desk, context.output.size);
        BURIN_TRY_DO(open(panel_, size, scale));
        panel_->lie_over(in_window || stands ? ImageSize{} : eye);
        left = in_window ? feed_in_window(input, context.panel_output) : feed_over_picture(input, context, size);
        PanelModel model = model_of(context, log);
        model.visible = has_column;
        model.may_be_hidden = !in_window;
        model.for_operator = in_window;
        add_devices(model, log.follows_recording());
        layout_ = &panel_->show(model, input.time_ns);
        if (told_notice_ != panel_->notice()) {
            told_notice_ = panel_->notice();
            if (!told_notice_.empty()) log.notify(told_notice_, MessageKind::info);
        }
        actions_ = layout_->actions;
        left.captured = {(layout_->wants_mouse && !in_window) || asks, layout_->wants_keyboard};
    } else {
        const OnPicture on = mouse_on_picture(pointer_, input.events, context.shown, context.output);
        pointer_ = {.mouse_px = on.pointer.mouse_px};
    }
    if (!in_window) return left;
    BURIN_TRY_DO(lay_out_page(context, input.time_ns));
    return left;
}

double LivePanel::free_width(const DeskRoom& room, ImageSize eye, ImageSize window) const {
    return column_shown_ ? beside_panel(room, eye, window) : 1.0;
}

// Returns what the panel leaves to the scene.
SceneInput LivePanel::feed_over_picture(const FrameInput& input, const PanelContext& context, ImageSize size) {
    SceneInput left{{input.events.begin(), input.events.end()}, {}};
    const SessionWall& wall = context.seen.desk.wall;
    if (wall.desk) {
        OnPicture on = mouse_on_picture(pointer_, input.events, context.shown, context.output);
        pointer_ = on.pointer;
        // At the right of an eye's picture, in its pixels.
        panel_->feed(on.events, {{static_cast<double>(context.eye().width) - size.width, 0.0}, {1.0, 1.0}});
        return left;
    }
    const View view = context.seen.view_of(wall.main);
    const MouseView mouse{view.screen, wall::eyes_of(view.viewer), context.shown, context.output};
    Pointed pointed = point_at_panel(pointer_, input.events, stand_in(context.seen.desk, size), size, mouse);
    pointer_ = pointed.pointer;
    panel_->feed(pointed.panel);
    left.events = std::move(pointed.rest);
    return left;
}

// At the right of the window, where that is wider.
SceneInput LivePanel::feed_in_window(const FrameInput& input, ImageSize window) {
    InWindows to = divide_by_window(mouse_on_window_, input.events);
    panel_->feed(to.panel, {{static_cast<double>(window.width) - kPanelWidth_px, 0.0}, {1.0, 1.0}});
    return {std::move(to.rest), {}};
}

// The activity's page for the person before the pictures, as high as its text.
Result<void> LivePanel::lay_out_page(const PanelContext& context, Nanoseconds time_ns) {
    const std::optional<ActivityPanel> activity = context.session.activity().panel();
    if (!activity || activity->page.empty()) return {};
    PanelModel model;
    model.page_alone = true;
    model.activity = ActivityPanel{};
    model.activity->page = activity->page;
    model.activity->task = activity->task;
    const ImageSize eye = context.eye();
    const bool has_task = model.activity->task.has_value();
    // A task lies over the picture, and is read from farther away: its letters grow with the picture.
    if (has_task && context.seen.desk.wall.desk && !is_empty(eye)) {
        model.visible = false;
        BURIN_TRY_DO(open(page_, eye, std::clamp(eye.width / kTaskWidth_px, 0.5, 4.0)));
        page_->lie_over(eye);
        page_layout_ = &page_->show(model, time_ns);
        return {};
    }
    const auto width = static_cast<std::uint32_t>(has_task ? kTaskWidth_px : kPanelWidth_px);
    const ImageSize size = page_ ? page_->size() : ImageSize{width, width};
    BURIN_TRY_DO(open(page_, size, 1.0));
    page_layout_ = &page_->show(model, time_ns);
    if (page_->page_height() == page_->size().height) return {};
    page_->resize({width, page_->page_height()});
    page_layout_ = &page_->show(model, time_ns);
    return {};
}

std::optional<PanelPicture> LivePanel::picture_on(std::size_t screen, const DeskRoom& room) const {
    const SessionWall& wall = room.wall;
    const bool in_own_window = wall.is_panel(screen);
    const bool is_page = wall.has_panel_window() && !in_own_window;
    const PanelFrame* const layout = is_page ? page_layout_ : layout_;
    const bool stands = !wall.desk && !in_own_window;
    if (layout == nullptr || (wall.desk && !in_own_window && screen != wall.main)) return std::nullopt;
    const Panel& panel = is_page ? *page_ : *panel_;
    return PanelPicture{layout->mesh,  panel.atlas(),
                        layout->size,  panel.atlases(),
                        layout->parts, stands ? std::optional(stand_in(room, panel.size())) : std::nullopt};
}

}  // namespace burin::session
