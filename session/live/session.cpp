// SPDX-License-Identifier: MIT
#include "session/live/session.hpp"

#include <utility>

#include "session/live/orders_between.hpp"
#include "session/live/session_events.hpp"
#include "session/state/governed.hpp"
#include "session/state/session_step.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {

void Session::begin_step(Nanoseconds time_ns, std::span<const haptics::ToolState> tools, std::size_t line) {
    log().begin_step(time_ns);
    hands_.take_tools(tools);
    time_.dt_s = seconds(std::max<Nanoseconds>(time_ns - time_.step_ns, 0));
    time_.step_ns = time_ns;
    if (line != 0) files().note_line(line);
}

void Session::step(const Input& input, Leader& leader, const Give& give) {
    const auto before = activity_.governs() ? std::optional(state_) : std::nullopt;
    const std::vector<haptics::ToolState> of_hands = hands_.tools_of_hands();
    SessionStep step =
        step_session(std::move(state_), room_, input.events, {time_.dt_s, of_hands[state_.hand], of_hands}, leader);
    state_ = std::move(step.state);
    SessionOrders& orders = step.orders;
    orders.line = input.line;
    for (const CommandInput& command : leader.later_commands(state_))
        if (const auto done = run_command(state_, orders, command, leader); !done)
            orders.messages.push_back({done.error().line()});
    // Before the parameters are published: else the hand would go on feeling the tool that was put down.
    if (const auto taken = take_up(state_); !taken) orders.messages.push_back({taken.error().line()});
    if (before) keep_governed(*before, state_, orders, leader.keep_governed(), log().newest());
    if (!input.keys_taken) activity_.press_keys(input.events, orders);
    activity_.step(state_, orders, time_.step_ns, hands(), tools(), leader);
    for (auto& order : activity_.take_on_scene()) give(std::move(order));
    scene_.news().frames_for_ticks(activity_.is_running());
    if (step.led.hand)
        hands().move_hand(
            step.led_hand, step.led.hand_way, time_.step_ns, *step.led.hand,
            state_.mouse == MouseMode::surface ? SessionHands::Source::mouse : SessionHands::Source::path);
    carry_out(std::move(orders), give);
    if (!activity_.brought_hand()) scene_.light(state_, step.led.turns_scene, time_.step_ns, give);  // for who looks on
    work_.take_outcomes();
    for (const std::string& message : leader.watch(state_, tool_in_use())) notify(message);
    for (const std::string& message : hands().take_messages()) notify_of_event(message);
    notices_.look(state_, hands(), tools(), tool_in_use(), step.led, scene_.spacing_m(), time_.step_ns);
    notices_.add_events(activity_.take_events());
    work_.go_on(state_, time_.step_ns, give);
}

void Session::carry_out(SessionOrders orders, const Give& give) {
    // What the device answers comes from outside: a replay has it from the recording, and the ticks with it.
    for (const AskedAmplifiers& asked : orders.amplifiers)
        if (!log().follows_recording()) notices_.tell_of(hands_.switch_amplifiers(state_.hand, asked.on), asked.line);
    if (orders.parameters) publish_parameters();
    if (orders.parameters) hands_.spread(state_, room_, scene_, give);
    OrdersBetween between(orders, scene_, work_, state_, give);
    for (std::size_t given = 0; given < orders.carving.size(); ++given) {
        between.give_up_to(given);
        workpiece::CarveOrder& order = orders.carving[given];
        if (const auto* use = std::get_if<workpiece::UseTool>(&order))
            notices_.look_at_tool(state_.led().tool, use->tool, room_.workpiece_object, scene_.spacing_m());
        auto* wanted = std::get_if<workpiece::ExportSurface>(&order);
        if (wanted != nullptr && !files().write()) continue;
        if (wanted != nullptr) files().place(*wanted);
        give(scene_.carving(std::move(order), state_.hand));
    }
    between.give_up_to(SIZE_MAX);
    for (const Asked& wanted : orders.names) work_.look_at_name(wanted.text);
    for (WorldOrder& order : orders.world) give(scene_.editing(std::move(order)));
    for (HoldOrder& order : orders.holds) give(scene_.holding(std::move(order)));
    notices_.tell(orders.messages);
    files().ask_for_pictures(std::move(orders.screenshots));
    if (orders.put_away) log().dismiss();
}

std::optional<scene::SurfaceUpdate> Session::take_loaded() {
    std::optional<scene::SurfaceUpdate> loaded;
    if (scene_.carved() != nullptr) loaded = scene_.carved()->take_surface_update();
    if (loaded) take(*loaded);
    return loaded;
}

std::optional<scene::SurfaceUpdate> Session::take_news(std::uint64_t updates) {
    SceneNews::Taken news = scene_.news().take(updates);
    if (news.surface) take(*news.surface);
    for (const auto& [part, now] : news.steps) {
        state_.history.follow(static_cast<std::uint32_t>(part), now);
        if (part == scene_.brought_part()) work_.brought_has_changed();
    }
    for (const std::string& message : news.messages) notify(message);
    for (const scene::ContactEvent& contact : news.hands.contacts)
        notices_.add_event(event_of(contact, hands(), state_.world.get()));
    activity_.take(std::move(news.hands), std::move(news.drawn));
    if (scene_.world() == nullptr) return std::move(news.surface);
    scene_.world()->drawn().take(news.objects);
    const auto before = state_.world;
    state_.world = followed(before, news.objects, news.materials ? &*news.materials : nullptr);
    const bool has_moved = state_.saves && before != state_.world;
    if (has_moved) state_.edits.follow(*before, *state_.world);
    if (has_moved) state_.history.follow(state_.objects_part(), state_.edits.steps());
    if (news.materials) publish_parameters();
    return std::move(news.surface);
}

void Session::take(const scene::SurfaceUpdate& news) {
    notices_.take(news);
    scene_.note(news);
    work_.tell(state_);
}

void Session::finish_scene() {
    scene_.service().finish();
    work_.finish(state_);
    collect({});
    static_cast<void>(take_news(UINT64_MAX));
    // What the activity orders now has nobody to carry it out, but for its words.
    SessionOrders orders;
    Leader nobody;
    activity_.step(state_, orders, time_.step_ns, hands(), tools(), nobody);
    notices_.add_events(activity_.take_events());
    for (const Asked& message : orders.messages) notify(message.text);
    if (const auto done = activity_.finish(); !done) files().notify_of_loss(done.error().line());
}

document::Content Session::saved_content() const {
    return {.facts = saved_facts(settled(options_), state_, room_.carved_object.value_or(Box{})),
            .commands = saved_commands(state_)};
}

SessionSetup Session::settled(SessionSetup options) const {
    found_.settle(options);
    if (state_.crumbs_m > 0.0) options.carve.exports.crumbs_m = state_.crumbs_m;
    hands_.settle(options.hands);
    return options;
}

}  // namespace burin::session
