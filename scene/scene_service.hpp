// SPDX-License-Identifier: MIT
// The service of a scene: has its parts do what the hands have done, and publishes what the hands touch.
//
// Data flow of an update: the ticks of each hand are read from its ring, of which the service is the only
// reader -> contact events are made of them (scene/contact_events.hpp) -> every part takes both -> every part updates,
// in the order in which they were given -> the touch publisher writes each hand's local surface around where its tool
// rests -> parts do what hands need not wait for. The service knows no part by its kind: orders and what the frame
// shows go between the frame and the part itself, on the thread of the service (scene/scene_thread.hpp). Replay: an
// update depends on orders, time, ticks and on what its parts have seen. seen() has all but the orders, and repeat()
// does it again to the bit.
// Frame: the scene's. Threads: one at a time, a SceneThread's or, where time is simulated, the caller's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/contact_events.hpp"
#include "scene/scene_part.hpp"
#include "scene/scene_update.hpp"
#include "scene/touch_publisher.hpp"

namespace burin::haptics {

struct HapticChannels;  // haptics/channels.hpp
struct TickRecord;      // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::scene {
class ContactFollower;  // scene/contact_follower.hpp

// One hand's side of a scene.
struct SceneHand {
    haptics::HapticChannels* channels = nullptr;
    Vec3 start_scene{0.0};  // where its tool is before the first sample
    double around_m =
        0.0;               // radius of a ball about its place that holds its probe and what the tick looks at around it
    double reach_m = 0.0;  // how far it may move until the next update
    PartOfHand of = {};    // for its contact events
};

class SceneService {
public:
    // Between updates while a hand moves.
    static constexpr Nanoseconds kHandsMove_ns = 10'000'000;

    // Parts and channels must outlive the service.
    SceneService(std::vector<ScenePart*> parts, std::vector<SceneHand> hands);
    ~SceneService();

    // Tells the parts, before the first update, that time is real (ScenePart::let_lag).
    void let_lag();
    // Sets the size of a hand's probe from the next update on.
    void use_probe(std::size_t hand, double around_m) { hands_[hand].around_m = around_m; }
    // Does what the hands have done since the last update. Fails when a part cannot go on; nothing is published then.
    [[nodiscard]] Result<void> update(Nanoseconds now_ns) { return update(now_ns, nullptr); }
    // Sets where a hand's tool is before its first sample.
    void start_at(std::size_t hand, const Vec3& position_scene) { places_[hand] = position_scene; }
    // Does an update again: with the samples and at the time of the recorded one. Fails on one of more hands or parts
    // than there are; of those that it does not name no samples are read.
    [[nodiscard]] Result<void> repeat(const SceneUpdate& recorded);
    // Returns the inputs of the last update; `orders` is 0 unless it was given.
    [[nodiscard]] const SceneUpdate& seen() const { return seen_; }
    // Adds what the parts have changed since the last call, and what the hands have begun and ended to touch in the
    // last update.
    void take_changes(SceneChanges& changes);
    // Returns the time until the next update: the shortest that a part asks for, and at most kHandsMove_ns while a hand
    // moves.
    [[nodiscard]] Nanoseconds period_ns() const;
    // Waits for the parts' work elsewhere.
    void finish();
    // Returns where the hand's tool rested in the last sample.
    [[nodiscard]] const Vec3& tool_scene(std::size_t hand) const { return places_[hand]; }
    // Returns the number of local surfaces published for a hand so far.
    [[nodiscard]] std::uint64_t published(std::size_t hand) const { return publisher_.published(hand); }

private:
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const SceneUpdate* recorded);
    void read_ticks(std::size_t hand, std::uint64_t last_tick);

    std::vector<ScenePart*> parts_;
    std::vector<SceneHand> hands_;
    TouchPublisher publisher_;
    std::vector<Vec3> places_;                // of each hand's tool
    std::vector<double> sunk_m_;              // how far each hand was beyond where its tool rested
    std::vector<haptics::TickRecord> ticks_;  // of one hand in one update
    std::vector<ContactFollower> followers_;  // of each hand
    std::vector<ContactEvent> contacts_;      // of one update, until they are told
    std::vector<PartSteps> told_steps_;       // of each part, as the frames know them
    bool hands_move_ = false;
    SceneUpdate seen_;
};

}  // namespace burin::scene
