// SPDX-License-Identifier: MIT
// Seeking: the person touches the objects of a world one after the other, as soon as each is named, and the times are
// taken. The smallest activity that is of use; docs/first-activity.md walks through it.
//
//   waiting -> "start" -> one target after the other, in an order drawn from the seed -> over -> "start" ...
// Each start begins a search of its own, numbered from 1, in the same order; what earlier ones measured is kept. One
// that is under way is broken off then, and its target counts as given up.
// A target glows while it is sought. It is found as soon as any part of any hand begins to touch it; touches of other
// objects on the way are counted. Time and path are those of the ticks of the first part of the first hand, from the
// tick that found the target before, or that came first after the start.
// Frame: the scene's, metres. One thread, the frame's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "session/activity/activity.hpp"

namespace burin::activities {

struct SeekOptions {
    unsigned targets = 0;  // how many objects are sought; 0: each that is seen and felt, once
    std::uint64_t seed = 1;
};

// Reads what Seek::settings() has written. Fails on anything else.
[[nodiscard]] Result<SeekOptions> seek_options_of(const std::string& settings);

struct Sought {
    std::size_t search = 0;  // 1: the first
    std::string object;
    bool skipped = false;               // or broken off
    double time_s = 0.0, path_m = 0.0;  // until it was found or skipped
    unsigned others = 0;                // touches of other objects meanwhile
};

class Seek final : public session::Activity {
public:
    explicit Seek(const SeekOptions& options) : options_(options) {}

    [[nodiscard]] std::string settings() const override;
    [[nodiscard]] std::span<const session::Act> acts() const override;
    [[nodiscard]] Result<void> act(std::span<const std::string> words, session::ActivityOrders& orders) override;
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override;
    [[nodiscard]] bool is_running() const override { return phase_ == Phase::seeking; }
    [[nodiscard]] std::uint64_t check() const override;
    [[nodiscard]] session::ActivityPanel panel() const override;

    // Returns the targets of all searches, in the order in which they were found or given up.
    [[nodiscard]] const std::vector<Sought>& found() const { return found_; }
    // Returns all that was measured, for a report.
    [[nodiscard]] Json report() const;

private:
    enum class Phase : std::uint8_t { waiting, starting, seeking, over };

    void begin(const session::WorldObjects& world, session::ActivityOrders& orders);
    void go_on_by(const haptics::TickRecord& tick, const session::WorldObjects& world, session::ActivityOrders& orders);
    void feel(const scene::ContactEvent& event, const session::WorldObjects& world, session::ActivityOrders& orders);
    void touch(scene::ObjectId id, Nanoseconds time_ns, const session::WorldObjects& world,
               session::ActivityOrders& orders);
    void give_up(session::ActivityOrders& orders);
    void break_off(session::ActivityOrders& orders);
    void take_next(session::ActivityOrders& orders);
    void let_glow(const session::WorldObjects& world, session::ActivityOrders& orders);
    void end_glow(session::ActivityOrders& orders);
    [[nodiscard]] std::size_t sought_now() const;  // targets of the present search that are done with

    SeekOptions options_;
    Phase phase_ = Phase::waiting;
    std::size_t searches_ = 0;  // begun
    std::vector<std::string> targets_;
    std::vector<Sought> found_;                       // of all searches
    std::vector<std::size_t> ended_;                  // the searches in which every target was found or skipped
    Sought now_;                                      // the present target
    std::optional<scene::PropertyValue> its_colour_;  // before it glowed; none: it does not yet
    std::optional<Nanoseconds> since_ns_;             // when it was named; none: no tick has come since
    Nanoseconds last_ns_ = 0;                         // of the last tick
    Vec3 last_place_scene_{0.0};
    bool counts_anew_ = false;              // what is touched while a search begins counts as touched by its first tick
    std::vector<scene::ObjectId> touched_;  // now, once for each part of a hand that touches it
};

}  // namespace burin::activities
