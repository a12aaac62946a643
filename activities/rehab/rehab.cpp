// SPDX-License-Identifier: MIT
#include "activities/rehab/rehab.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/text.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;

constexpr const char* kBall = "ball";  // the world's object that is squeezed
constexpr std::array<const char*, devices::kGloveFingers> kFingers{"thumb", "index", "middle", "ring"};

// The world's ball, as assets/worlds/hand.toml has it: its number, its place and its size.
constexpr std::uint32_t kBallObject = 2;
constexpr Vec3 kBallPlace_m{0.02, 0.0825, 0.0};
constexpr double kBallRadius_m = 0.035;
constexpr double kElementsAlongRadius = 3.2;  // 1,632 elements: the scene's thread has more to do than them

std::string name_of(BallColour colour) { return std::string(kind_of(colour).name); }

// Calls back with the ticks of one turn for each turn that all fingers have.
template <typename Each>
void each_turn(std::span<const session::PartView> parts, Each each) {
    for (const haptics::TickRecord& first : parts[0].ticks) {
        std::array<const haptics::TickRecord*, kFelt> ticks{};
        bool all = true;
        for (std::size_t i = 0; i < kFelt && all; ++i) {
            const auto tick = std::ranges::lower_bound(parts[i].ticks, first.tick, {}, &haptics::TickRecord::tick);
            all = tick != parts[i].ticks.end() && tick->tick == first.tick;
            if (all) ticks[i] = &*tick;
        }
        if (all) each(ticks);
    }
}

FingersTurn fingers_of(const std::array<const haptics::TickRecord*, kFelt>& ticks, double dt_s) {
    FingersTurn turn;
    turn.dt_s = dt_s;
    for (std::size_t i = 0; i < kFelt; ++i) {
        turn.forces_N[i] = glm::length(ticks[i]->gate.given.force_device_N);
        std::copy_n(ticks[i]->sample.joints.begin(), turn.joints_rad[i].size(), turn.joints_rad[i].begin());
    }
    return turn;
}

Json json_of(const BallEvent& event, Nanoseconds begun_ns) {
    return {{"what", text_of(event.what)}, {"time_s", seconds(event.time_ns - begun_ns)}, {"force_N", event.force_N}};
}

Json json_of(const FingerMeasures& finger, const char* name) {
    Json ranges = Json::array();
    for (std::size_t joint = 0; joint < finger.least_rad.size(); ++joint) ranges.push_back(finger.range_rad(joint));
    return {{"finger", name},
            {"peak_force_N", finger.peak_N},
            {"mean_force_N", finger.mean_N()},
            {"pushed_s", finger.pushed_s},
            {"range_of_motion_rad", std::move(ranges)}};
}

}  // namespace

Result<BallSettings> ball_settings_of(const std::string& settings) {
    BallSettings ball;
    std::array<char, 16> colour{};
    if (std::sscanf(settings.c_str(),
                    "rehab ball --colour %15s --level %u --repetitions %u --hold %lg --time-limit %lg", colour.data(),
                    &ball.level, &ball.repetitions, &ball.hold_s, &ball.time_limit_s) == 5) {
        const auto known = ball_named(colour.data());
        if (known) ball.colour = *known;
        if (known && problems(ball).empty() && Rehab(ball).settings() == settings) return ball;
    }
    return fail(settings, "are no settings of burin rehab", "replay it with the program that recorded it");
}

Rehab::Rehab(const BallSettings& settings) : settings_(settings), hand_(GraspOptions{}) {
    bodies::SoftPartSetup setup;
    setup.object = kBallObject;
    setup.scene_from_body.position_m = kBallPlace_m;
    setup.half_axes_m = Vec3(kBallRadius_m);
    setup.spacing_m = kBallRadius_m / kElementsAlongRadius;
    setup.material.young_Pa = kind_of(settings.colour).young_Pa;
    auto made = bodies::SoftPart::create(setup);
    BURIN_CHECK(made.has_value());
    if (made) body_ = std::move(*made);
}

std::string Rehab::settings() const {
    return formatted("rehab ball --colour %s --level %u --repetitions %u --hold %.17g --time-limit %.17g",
                     name_of(settings_.colour).c_str(), settings_.level, settings_.repetitions, settings_.hold_s,
                     settings_.time_limit_s);
}

Result<void> Rehab::act(std::span<const std::string> words, session::ActivityOrders&) {
    return fail("command do " + words[0], "is nothing that an exercise is told", "squeeze the ball instead");
}

void Rehab::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    if (!has_ball_ && view.world != nullptr && object_named(*view.world, kBall)) {
        has_ball_ = true;
        orders.edits.push_back({kBall, ObjectProperty::felt, {0.0}});
        orders.edits.push_back({kBall, ObjectProperty::seen, {0.0}});
    }
    const scene::SceneObject* own = view.world != nullptr ? view.world->find(kBallObject) : nullptr;
    has_given_way_ = own == nullptr || !own->seen;
    hand_.step(view, orders);
    orders.trials.clear();  // a trial is a squeeze here, not a grasp
    orders.holds.clear();   // the ball stays on its stand
    const auto parts = view.hands.front().parts;
    if (parts.size() < kFelt) return;
    const bool holds = hand_.gesture().grasps() && !hand_.grasps().empty() && hand_.grasps().back().object == kBall;
    each_turn(parts, [&](const std::array<const haptics::TickRecord*, kFelt>& ticks) {
        const Nanoseconds now_ns = ticks[0]->time_ns;
        const double dt_s = turn_ns_ > 0 ? seconds(now_ns - turn_ns_) : 0.0;
        turn_ns_ = now_ns;
        BallStep step = step_ball(state_, settings_, {now_ns, holds, fingers_of(ticks, dt_s)});
        state_ = step.state;
        for (const BallEvent& event : step.events) tell(event, orders);
    });
}

// The body is put where the world's own ball was among the objects: so the hand's shadows find a ball there.
void Rehab::stage(renderer::Scene& scene, std::size_t screen) const {
    if (has_given_way_ && scene.objects.size() + 1 >= kBallObject) {
        const auto shape = body_->shape();
        if (!drawn_ || shape->version != drawn_version_) {
            drawn_ = renderer::smooth_mesh(shape->places_m, body_->triangles());
            drawn_version_ = shape->version;
        }
        const Pose& pose = body_->setup().scene_from_body;
        const auto& srgb = kind_of(settings_.colour).srgb;
        scene.objects.insert(scene.objects.begin() + (kBallObject - 1),
                             {drawn_,
                              scene.world_from_object * Similarity{pose.position_m, pose.orientation, 1.0},
                              {srgb[0], srgb[1], srgb[2]}});
    }
    hand_.stage(scene, screen);
}

void Rehab::tell(const BallEvent& event, session::ActivityOrders& orders) {
    using What = BallEvent::What;
    events_.push_back(event);
    const unsigned number = state_.repetitions;
    if (event.what == What::reached)
        orders.trials.push_back({event.time_ns, formatted("squeeze %u", number + state_.too_short + 1)});
    if (event.what == What::counted || event.what == What::too_short)
        orders.trials.push_back({event.time_ns, "", std::string(text_of(event.what))});
    if (event.what == What::counted)
        orders.messages.push_back(formatted("squeeze %u of %u counted", number, settings_.repetitions));
    if (event.what == What::too_short) orders.messages.push_back("held too short; squeeze again");
    if (event.what == What::done || event.what == What::time_over)
        orders.messages.push_back(formatted("%s: score %.0f of 100", event.what == What::done ? "done" : "time is over",
                                            score_of(state_, settings_)));
}

session::ActivityPanel Rehab::panel() const {
    session::ActivityPanel panel{
        .title = "Ball", .aside = name_of(settings_.colour), .page = {}, .rows = {}, .buttons = {}};
    panel.page = formatted("Squeeze the ball with %.0f N in all fingers for %.1f s, then relax.", settings_.target_N(),
                           settings_.hold_s);
    panel.rows.push_back({"Squeezes", formatted("%u of %u", state_.repetitions, settings_.repetitions)});
    if (state_.too_short > 0) panel.rows.push_back({"Held too short", formatted("%u", state_.too_short)});
    panel.rows.push_back({"Time", formatted("%.0f of %.0f s", state_.time_s(), settings_.time_limit_s)});
    if (state_.phase == BallPhase::ended)
        panel.rows.push_back({"Score", formatted("%.0f of 100", score_of(state_, settings_))});
    return panel;
}

Json Rehab::report() const {
    Json json{{"exercise", "ball"},
              {"colour", name_of(settings_.colour)},
              {"level", settings_.level},
              {"target_N", settings_.target_N()},
              {"repetitions_wanted", settings_.repetitions},
              {"hold_s", settings_.hold_s},
              {"time_limit_s", settings_.time_limit_s},
              {"young_Pa", kind_of(settings_.colour).young_Pa},
              {"ended", state_.end == BallEnd::done        ? "done"
                        : state_.end == BallEnd::time_over ? "time over"
                                                           : "broken off"},
              {"score", score_of(state_, settings_)},
              {"repetitions", state_.repetitions},
              {"held_too_short", state_.too_short},
              {"grasps", state_.grasps},
              {"time_s", state_.time_s()},
              {"fingers", Json::array()},
              {"events", Json::array()}};
    for (std::size_t i = 0; i < kFingers.size(); ++i)
        json["fingers"].push_back(json_of(state_.measures.fingers[i], kFingers[i]));
    for (const BallEvent& event : events_) json["events"].push_back(json_of(event, state_.begun_ns));
    return json;
}

}  // namespace burin::activities
