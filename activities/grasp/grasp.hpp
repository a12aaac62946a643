// SPDX-License-Identifier: MIT
// A hand in a glove among rigid things: its fingers close, feel, grasp, carry, let go and point.
//
// The hand is drawn as the glove reads it, with fingers that touch opened as far as the surface asks. Gestures follow
// from the fingers' closures and from their contacts (geometry/hand/gesture.hpp); what is grasped moves with the
// fingertips that hold it until they open, and they go on feeling it. What the index points at is lit up.
//
// Each fingertip feels by a patch of points on its pad (geometry/hand/fingertip_patch.hpp).
// Frame: the scene's. One thread, the frame's.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "activities/grasp/drawn_hand.hpp"
#include "activities/grasp/grasp_options.hpp"
#include "activities/grasp/hand_reading.hpp"
#include "geometry/hand/fingertip_patch.hpp"
#include "geometry/hand/gesture.hpp"
#include "session/activity/activity.hpp"

namespace burin::activities {

// One grasp of an object, from when the hand took it until it let go.
struct Grasped {
    std::string object;
    geometry::Gesture gesture = geometry::Gesture::none;
    Nanoseconds begun_ns = 0, ended_ns = 0;  // on the loop's clock; ended: 0 while it is held
    Vec3 carried_m{0.0};                     // the way of the fingertips that hold it since then, or until then
};

class Grasp final : public session::Activity {
public:
    explicit Grasp(const GraspOptions& options);
    ~Grasp() override;

    [[nodiscard]] std::string settings() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    [[nodiscard]] bool is_running() const override { return true; }
    void adjust(session::PartOfHand of, haptics::TickParameters& parameters) const override;
    [[nodiscard]] bool draws_hands() const override { return true; }
    void stage(picture::Picture& scene, std::size_t screen) const override;
    [[nodiscard]] session::ActivityPanel panel() const override;

    // Returns all grasps that were begun, in their order.
    [[nodiscard]] const std::vector<Grasped>& grasps() const { return grasps_; }
    [[nodiscard]] const geometry::GestureState& gesture() const { return gesture_; }
    // Returns how many of the glove's sets were left out, since a finger jumped in them.
    [[nodiscard]] std::uint64_t rejected_sets() const { return rejected_sets_; }
    // Returns the hand as the newest ticks had it; none before the first.
    [[nodiscard]] const std::optional<HandReading>& hand() const { return hand_; }

private:
    // Says when the glove is lost and when it is back, and lets go of what a hand that is lost for long holds.
    void watch_glove(const std::array<const haptics::TickRecord*, kFelt>& ticks, const session::WorldObjects* world,
                     session::ActivityOrders& orders);
    void tell_of_fingers(const std::array<const haptics::TickRecord*, kFelt>& ticks, session::ActivityOrders& orders);
    void count_rejected(const std::array<const haptics::TickRecord*, kFelt>& ticks, session::ActivityOrders& orders);
    // Sets a fingertip that stays behind a thing to the hand, when that has left and holds nothing.
    void free_fingers(const HandReading& hand, session::ActivityOrders& orders);
    void go_on_by(const HandReading& hand, const session::WorldObjects* world, session::ActivityOrders& orders);
    [[nodiscard]] Vec3 grip_scene_m() const;
    void begin_grasp(const session::WorldObjects& world, session::ActivityOrders& orders);
    void end_grasp(Nanoseconds time_ns, session::ActivityOrders& orders);
    void cast_balls(picture::Picture& scene) const;
    void point_at(const HandReading& hand, const session::WorldObjects& world, session::ActivityOrders& orders);

    GraspOptions options_;
    std::array<std::vector<geometry::PatchPoint>, kFelt> patches_;
    std::array<std::vector<double>, kFelt> shares_;   // of a surface's stiffness, of each point of a patch
    mutable std::unique_ptr<const DrawnHand> drawn_;  // made when a picture is first wanted
    std::array<std::optional<haptics::TickRecord>, kFelt> last_ticks_;
    std::optional<HandReading> hand_;
    bool has_fault_ = false, told_of_fault_ = false;             // of all parts: the glove's
    Nanoseconds well_ns_ = 0;                                    // when it had none for the last time
    std::array<devices::DeviceFault, kFelt> told_of_fingers_{};  // what was told of each finger's own fault last
    std::uint64_t rejected_sets_ = 0, told_of_sets_ = 0;
    geometry::GestureState gesture_;
    std::array<bool, geometry::kHandFingers> holding_{};  // the fingers with which the last grasp began
    Vec3 taken_at_m_{0.0};                                // where they were then, on average
    std::vector<Grasped> grasps_;
    std::array<Nanoseconds, kFelt> behind_since_ns_{};         // since when a finger is far behind; 0: it is not
    std::array<haptics::ProxyPlacement, kFelt> placements_{};  // where it was set to the hand last
    std::vector<bool> is_ball_;                                // of the objects that are seen at the beginning
    std::string pointed_at_;                                   // empty: nothing
    std::optional<scene::PropertyValue> its_colour_;           // before it was lit up
};

}  // namespace burin::activities
