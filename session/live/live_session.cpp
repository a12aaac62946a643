// SPDX-License-Identifier: MIT
#include "session/live/live_session.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "session/live/session_events.hpp"
#include "session/state/governed.hpp"
#include "session/state/view_cube.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kEditsNoted_ns = 500'000'000;  // how often the journal has what was done to objects

}  // namespace

// ---- One step

void LiveSession::step(const FrameInput& input, const wall::OutputPlace& output,
                       std::span<const haptics::ToolState> tools, const Give& give, ImageSize panel_output) {
    // Each keeps its last size while it is minimised.
    if (!is_empty(output.size)) output_ = output;
    if (!is_empty(panel_output)) panel_output_ = panel_output;
    fit_desk_screen(room_.wall, main_eye());
    log_.begin_step(input.time_ns);
    tools_.assign(tools.begin(), tools.end());
    std::vector<haptics::ToolState> of_hands;  // by the first part of each
    for (std::size_t hand = 0; hand < hands().hands(); ++hand) of_hands.push_back(tools_[hands().first_part(hand)]);
    const haptics::ToolState tool = tool_in_use();
    times_.sampled(start_ns_ + head_sampled_ns(input), tool.time_ns);
    if (tool.buttons != 0) times_.works();
    for (const InputEvent& event : input.events) {
        const auto* click = std::get_if<MouseClick>(&event.input);
        if (click != nullptr && click->pressed && click->button == MouseButton::left)
            times_.pressed(start_ns_ + event.time_ns);
    }
    const double dt_s = seconds(std::max<Nanoseconds>(input.time_ns - last_step_ns_, 0));
    last_step_ns_ = input.time_ns;
    if (!input.events.empty()) files_.note_line(input.events.back().line);
    const SceneInput left = feed_panel(input);
    room_.free_width = panel_.free_width(room_, main_eye(), output_.size);
    const auto before = activity_.governs() ? std::optional(state_) : std::nullopt;
    const wall::StereoMode begun_in = output_on(room_.wall.main).mode;
    SessionStep step =
        step_session(state_, room_, left.events,
                     {dt_s, input.display_ns, main_eye(), tool, left.captured, of_hands, output_, &seen_});
    state_ = std::move(step.state);
    fit_into_mode(begun_in, step.orders);
    step.orders.line = input.events.empty() ? 0 : input.events.back().line;
    for (const CommandInput& action : panel_.actions()) {
        if (const auto done = run_command(state_, step.orders, action); !done)
            step.orders.messages.push_back({done.error().line()});
    }
    // Before the parameters are published: else the hand would go on feeling the tool that was put down.
    if (const auto taken = take_up(state_); !taken) step.orders.messages.push_back({taken.error().line()});
    if (before) hold_governed(*before, step.orders);
    if (!left.captured.keyboard) activity_.press_keys(left.events, step.orders);
    activity_.step(state_, step.orders, input.time_ns, hands(), tools_);
    for (SceneSide::Order& order : activity_.take_on_scene()) give(std::move(order));
    scene_.news().frames_for_ticks(activity_.is_running());
    fit_desk_screen(room_.wall, main_eye());  // a command may have changed the mode
    hands().move_hand(step.led_hand, step.hand_way, input.time_ns, step.hand,
                      state_.mouse == MouseMode::surface ? SessionHands::Source::mouse : SessionHands::Source::path);
    carry_out(std::move(step.orders), give);
    watch(input.time_ns);
    if (input.time_ns - edits_noted_ns_ >= kEditsNoted_ns) {
        edits_noted_ns_ = input.time_ns;
        note_edits(state_.world.get(), give);
    }
    if (state_.world) tell_work();
    watch_journal(give);
}

// Two pictures side by side or one above the other leave each another shape: what filled one is cut off in the other.
// A mode that the step itself has come to is the next one's: screen and panel still have the shape of the one before.
void LiveSession::fit_into_mode(wall::StereoMode mode, SessionOrders& orders) {
    const wall::StereoMode before = std::exchange(framed_, mode).value_or(mode);
    const bool other_shape = wall::eye_size(mode, output_.size) != wall::eye_size(before, output_.size);
    if (other_shape && room_.wall.desk && state_.mouse == MouseMode::surface)
        static_cast<void>(run_command(state_, orders, RunAction{Action::fit_view}));
}

// A hand that goes on turning the scene is told once that it stays.
void LiveSession::hold_governed(const SessionState& before, SessionOrders& orders) {
    const std::size_t told = orders.messages.size();
    keep_governed(before, state_, orders);
    if (orders.messages.size() > told && orders.line == 0 && log_.newest() == kGovernedMessage)
        orders.messages.pop_back();
}

SceneInput LiveSession::feed_panel(const FrameInput& input) {
    laid_out_changes_ = log_.changes();
    auto left = panel_.feed(input,
                            {.state = state_,
                             .room = room_,
                             .tool = tool_in_use(),
                             .hands = hands(),
                             .tools = tools_,
                             .tracker = tracker_.report(),
                             .workpiece = workpiece_,
                             .tool_sizes = tool_sizes_,
                             .undoable = undoable_,
                             .redoable = redoable_,
                             .exporting = exporting_,
                             .activity = activity_.panel(),
                             .times = times_,
                             .tick_duration = hands().loop().duration(),
                             .shown = output_on(room_.wall.main),
                             .output = output_,
                             .panel_output = panel_output_,
                             .acknowledged = acknowledged_,
                             .recording_ended = recording_ended_,
                             .tells_late_pictures = tells_late_pictures()},
                            log_);
    for (const std::string& line : times_.take_new_warnings())
        if (tells_late_pictures()) std::fprintf(stderr, "burin: %s\n", line.c_str());
    if (left) return std::move(*left);
    notify(left.error().line());
    state_.panel = false;
    return {{input.events.begin(), input.events.end()}, {}};
}

// What the device answers comes from outside the session: a replay has it from the recording, and the ticks with it.
void LiveSession::switch_amplifiers(const AskedAmplifiers& asked) {
    if (log_.follows_recording()) return;
    const std::optional<devices::AmplifierAnswer> answer = hands().switch_amplifiers(state_.hand, asked.on);
    if (answer == devices::AmplifierAnswer::done)
        return log_.notify_of_event(asked.on ? "the amplifiers are on; the force comes back from zero"
                                             : "the amplifiers are off: no force until they are enabled again");
    const std::string why = answer ? "they stay off, since what tripped them is not over; see to the device first"
                                   : "those of " + std::string(hands().device(hands().first_part(state_.hand)).name) +
                                         " cannot be switched from here";
    log_.notify_of_event("amplifiers: " + why, MessageKind::warning, {files_.failed_on(asked.line), {}});
}

void LiveSession::carry_out(SessionOrders orders, const Give& give) {
    for (const AskedAmplifiers& asked : orders.amplifiers) switch_amplifiers(asked);
    if (orders.parameters) publish_parameters();
    if (orders.parameters) hands_.spread(state_, room_, scene_, give);
    auto wanted_save = orders.saves.begin();
    for (std::size_t given = 0; given < orders.carving.size(); ++given) {
        for (; wanted_save != orders.saves.end() && wanted_save->after <= given; ++wanted_save)
            save(*wanted_save, give);
        sculpt::SculptOrder& order = orders.carving[given];
        if (const auto* use = std::get_if<sculpt::UseTool>(&order)) watch_misfit(use->tool);
        auto* wanted = std::get_if<sculpt::ExportSurface>(&order);
        if (wanted != nullptr && !files_.write()) continue;
        if (wanted != nullptr) files_.place(*wanted);
        give(scene_.carving(std::move(order), state_.hand));
    }
    for (; wanted_save != orders.saves.end(); ++wanted_save) save(*wanted_save, give);
    for (const Asked& wanted : orders.names)
        news_of_document_.name_looked_at(wanted.text, document_.is_taken(wanted.text, files_));
    for (WorldOrder& order : orders.world) give(scene_.editing(std::move(order)));
    for (HoldOrder& order : orders.holds) give(scene_.holding(std::move(order)));
    if (const auto lamp = scene_.carved() != nullptr ? lamp_.look(state_, last_step_ns_) : std::nullopt)
        give(scene_.carving(sculpt::LightFrom{*lamp}, state_.hand));
    for (const Asked& message : orders.messages) {
        if (message.line == 0) {
            notify(message.text, message.kind);
        } else {
            log_.notify(message.text, message.kind, {files_.failed_on(message.line), {}});
        }
    }
    files_.ask_for_pictures(std::move(orders.screenshots));
    if (orders.put_away) log_.dismiss();
    exchange_full_screen_ = exchange_full_screen_ || orders.full_screen;
}

void LiveSession::save(const AskedSave& wanted, const Give& give) {
    if (!files_.write()) return;
    news_of_document_.save_ordered();
    note_edits(wanted.world.get(), give);  // so that a save that fails leaves them in the journal
    document::SaveRequest request = document_.request(wanted, files_, options_, saved_content());
    if (wanted.world && !request.refused)
        request.content.parts.push_back(saved_world_.save(*wanted.world, !request.changed_alone));
    request.state = wanted.edits_state << 32;
    give(scene_.saving(std::move(request), document_.writer()));
}

document::Content LiveSession::saved_content() const {
    return {.facts = saved_facts(settled(options_), state_, room_.carved_object.value_or(Box{})),
            .commands = saved_commands(state_)};
}

// Returns the number of the state in which the workpiece and the objects are.
std::uint64_t LiveSession::work_state() const { return carved_state_ + (state_.edits.state() << 32); }

// Before the scene's thread starts, or where there is no workpiece.
void LiveSession::keep_journal(const std::string& folder) {
    document::Content beginning = saved_content();
    if (scene_.workpiece() != nullptr) scene_.workpiece()->copy(beginning.parts.emplace_back());
    if (state_.world) beginning.parts.push_back(saved_world_.all(*state_.world));
    if (const auto kept = document_.keep_journal(folder, options_, opened_, std::move(beginning)); !kept) {
        news_of_document_.journal_keeps(false);
        return notify(kept.error().line());
    }
    if (scene_.carved() != nullptr)
        scene_.carved()->keep_journal([&writer = document_.writer()](scene::Pages change) {
            writer.note({.part = 0, .pages = std::move(change)});
        });
}

// Notes for the journal what was done to objects. By way of the scene's thread, as saves go: one that was asked for
// before would take the place of what was noted since.
void LiveSession::note_edits(const WorldObjects* world, const Give& give) {
    if (world == nullptr || !state_.saves || options_.live.journal.empty()) return;
    std::optional<scene::Pages> change = saved_world_.take_change(*world);
    if (!change) return;
    if (std::exchange(begins_journal_, false)) keep_journal(options_.live.journal);
    give(scene_.noting({.part = state_.carves ? 1 : 0, .pages = std::move(*change)}, document_.writer()));
}

// What was done to objects and is not noted yet will be the next change.
void LiveSession::tell_work() {
    if (!news_of_document_.tells()) return;
    std::int64_t not_noted = scene_.to_be_noted();  // before those that are: one more is told of later, none too early
    if (state_.world && saved_world_.has_change(*state_.world)) ++not_noted;
    news_of_document_.work_is(work_state(), undoable_ + state_.edits.undoable(), document_.noted() + not_noted);
}

std::vector<CommandInput> LiveSession::take_told() {
    const bool works = (tool_in_use().buttons & 1u) != 0;
    return news_of_document_.take(document_.name(options_), document_.has_file(), document_.safe_up_to(), works);
}

bool LiveSession::waits_for_the_disk() const { return news_of_document_.waits(document_.safe_up_to()); }

void LiveSession::watch_misfit(const sculpt::Tool& tool) {
    const double longest_m = sculpt::longest_side_m(room_.workpiece_object);
    if (const auto misfit = misfit_.look(state_.tool, tool, longest_m, scene_.spacing_m())) notify(*misfit);
}

void LiveSession::watch(Nanoseconds time_ns) {
    for (const document::SaveOutcome& ended : document_.take_outcomes()) {
        files_.tell(ended);
        news_of_document_.save_ended(ended);
    }
    if (const auto strain = comfort_.look(state_, room_, tool_in_use())) notify(*strain);
    if (const auto change = tracker_.look(state_, room_, time_ns)) notify(*change);
    if (const auto change = wand_.look(state_.wands)) notify(*change);
    for (const std::string& message : hands().take_messages()) notify_of_event(message);
    if (const auto nothing = strokes_.look(state_, tool_in_use(), scene_.spacing_m(), time_ns)) notify(*nothing);
    for (DeviceWatch::News& news : devices_.look(hands(), tools_)) {
        notify(news.message, news.kind);
        events_.push_back(std::move(news.event));
    }
    std::ranges::move(activity_.take_events(), std::back_inserter(events_));
}

void LiveSession::watch_journal(const Give& give) {
    if (options_.live.journal.empty()) return;
    for (const document::JournalNews& news : document_.writer().take_journal_news()) {
        news_of_document_.journal_keeps(!news.failed);
        if (news.failed)
            log_.notify_of_event("strokes are not kept until they are saved: " + news.failed->line() +
                                     "; it is tried again every few seconds",
                                 MessageKind::error);
        else
            log_.notify_of_event("strokes are kept again, with all that was done meanwhile", MessageKind::info);
    }
    if (!document_.writer().wants_all()) return;
    document::Content now = saved_content();
    if (state_.world) now.parts.push_back(saved_world_.all(*state_.world));
    give(scene_.journalling(std::move(now), document_.writer()));
}

void LiveSession::take_loaded() {
    if (scene_.carved() == nullptr) return;
    if (auto loaded = scene_.carved()->take_surface_update()) take(std::move(*loaded));
}

void LiveSession::take_news(std::uint64_t updates) {
    SceneNews::Taken news = scene_.news().take(updates);
    if (news.surface) take(std::move(*news.surface));
    for (const std::string& message : news.messages) notify(message);
    for (const scene::ContactEvent& contact : news.hands.contacts)
        events_.push_back(event_of(contact, hands(), state_.world.get()));
    activity_.take(std::move(news.hands), std::move(news.drawn));
    if (scene_.world() == nullptr) return;
    scene_.world()->drawn().take(news.objects);
    const auto before = state_.world;
    state_.world = followed(before, news.objects, news.materials ? &*news.materials : nullptr);
    if (state_.saves && before != state_.world) state_.edits.follow(*before, *state_.world, state_.strokes);
    if (news.materials) publish_parameters();
}

std::optional<picture::Picture> LiveSession::scene_on(std::size_t screen) const {
    if (room_.wall.is_panel(screen)) return std::nullopt;
    std::optional<picture::Picture> scene = scene_of(state_, room_, screen, lattice_origin_object(), tool_in_use());
    if (scene && state_.mouse == MouseMode::surface) stand_on_plinth(*scene);
    for (std::size_t part = 0; scene && !activity_.draws_hands() && part < hands().parts(); ++part)
        if (part != hands().first_part(state_.hand))
            add_tool(*scene, state_, hands().part_of_hand(part).hand, tools_[part]);
    if (scene) add_mirror(*scene, state_, tool_in_use());
    if (scene && screen == room_.wall.main) add_view_cube(*scene, state_, room_);
    if (scene) add_border(*scene, state_, room_, tool_in_use());
    if (scene && scene_.world() != nullptr)
        std::ranges::move(scene_.world()->drawn().in_world(state_.world_from_object),
                          std::back_inserter(scene->objects));
    if (scene && activity_.draws_hands()) scene->tool.visible = false;
    if (scene) activity_.stage(*scene, screen);
    // What an activity shows is its own: a shadow would tell of a study's tube that nobody may see.
    if (scene && (!options_.live.shadows || options_.activity != nullptr))
        for (picture::DrawnObject& object : scene->objects) object.casts_shadow = false;
    return scene;
}

// A part that was turned or cut touches its plinth with what is lowest of it now, and not with its box's corner.
void LiveSession::stand_on_plinth(picture::Picture& scene) const {
    const Similarity& pose = state_.world_from_object;
    const auto lowest_m = seen_.lowest_along_m(glm::conjugate(pose.orientation) * Vec3(0.0, 1.0, 0.0));
    if (!lowest_m) return;
    const PlinthPlace plinth = plinth_under(room_.workpiece_object, pose, middle_of(wall::eyes_of(scene.viewer)),
                                            pose.position_m.y + pose.scale * *lowest_m);
    scene.pedestal.visible = plinth.visible;
    scene.pedestal.top_center_world = plinth.top_center_world;
    scene.pedestal.radius_m = plinth.radius_m;
}

void LiveSession::finish_scene() {
    scene_.service().finish();
    note_edits(state_.world.get(), [](const SceneSide::Order& order) { order(); });
    document_.finish();
    for (const document::SaveOutcome& ended : document_.take_outcomes()) files_.tell(ended);
    if (const std::string kept = document_.end_journal(state_.discards); !kept.empty())
        notify("what was not saved is kept: burin sculpt " + kept);
    if (!options_.live.journal.empty())
        for (const document::JournalNews& news : document_.writer().take_journal_news())
            if (news.failed) log_.notify_of_event(news.failed->line(), MessageKind::error);
    collect({});
    take_news(UINT64_MAX);
    // What the activity orders now has nobody to carry it out, but for its words.
    SessionOrders orders;
    activity_.step(state_, orders, last_step_ns_, hands(), tools_);
    std::ranges::move(activity_.take_events(), std::back_inserter(events_));
    for (const Asked& message : orders.messages) notify(message.text);
    if (const auto done = activity_.finish(); !done) files_.notify_of_loss(done.error().line());
}

void LiveSession::take(sculpt::SurfaceUpdate news) {
    for (const std::string& message : news.messages) notify(message);
    for (const sculpt::ExportOutcome& ended : news.exports) files_.tell(ended);
    undoable_ = state_.strokes = news.undoable;
    redoable_ = news.redoable;
    carved_state_ = news.state;
    exporting_ = news.exporting;
    tell_work();
    times_.cut(news.cut_ns);
    seen_.take(news);
    strokes_.take(news);
    // Merged, because a session that draws rarely, as off screen, would keep every version of each tile.
    if (updates_.empty())
        updates_.push_back(std::move(news));
    else
        sculpt::merge(updates_.back(), std::move(news));
}

void LiveSession::refuse_mode(wall::StereoMode working, const Error& error) {
    const std::string refused(wall::title_of(state_.output.mode)), goes_on(wall::title_of(working));
    state_.output.mode = working;
    refused_ = working;
    notify_of_event("stereo mode " + refused + " is not shown, " + goes_on + " goes on: " + error.line(),
                    MessageKind::warning);
}

std::optional<Nanoseconds> LiveSession::changes_ns() const {
    if (log_.changes() != laid_out_changes_) return last_step_ns_;
    std::optional<Nanoseconds> next = panel_.changes_ns();
    for (const auto& other : {log_.next_change_ns(), strokes_.due_ns()})
        if (other) next = std::min(next.value_or(*other), *other);
    return next;
}

}  // namespace burin::session
