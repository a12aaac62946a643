// SPDX-License-Identifier: MIT
// Times ticks of HapticLoop along a pressed path: whole steps, from reading the device to publishing the tool.
//
// Cold: the thread sleeps until the deadline, after twice the second-level cache has been written over, as the work of
// other threads does; timed from waking. Rehearsed: as HapticLoop::run ticks where a device is driven, with a warm-up
// tick just before the deadline. Back to back: one after the other, with nothing between.
// Only ticks in which the hand is down and moves are counted; coming down is neither paced nor counted. As in a session
// the hand is read in the encoder's steps, and the surface is published anew a hundred times a second.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/haptics/surface_walk.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {

enum class Pacing : std::uint8_t { cold, rehearsed, back_to_back };
[[nodiscard]] const char* name_of(Pacing pacing);

// Writes over what the processor's caches hold of other things.
class CacheEvictor {
public:
    CacheEvictor();
    void evict() noexcept;
    [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

private:
    std::vector<std::uint64_t> words_;
};

class TouchRun {
public:
    static constexpr std::uint64_t kTicksAnUpdate = 10;
    // Farther from the hand than this beyond its radius a probe counts as left behind.
    static constexpr double kLeftBehind_m = 0.01;

    // Called between ticks with the loop's time, once every kTicksAnUpdate ticks and before the first.
    using Update = std::function<void(Nanoseconds now_ns)>;

    // Fills `costs`, which must outlive the run, as must the clock. `cuts`: the tool's button is held while the hand is
    // down, and the stroke samples are left to whoever carves.
    TouchRun(TickCosts& costs, Clock& clock, const haptics::TickParameters& parameters, PressedWalk path, bool cuts);

    [[nodiscard]] haptics::HapticChannels& channels() { return *channels_; }
    [[nodiscard]] const PressedWalk& path() const { return path_; }

    // Takes so many ticks that count.
    void take(std::uint64_t ticks, Pacing pacing, const Update& update);

    // Where the hand was in ticks that counted and had no contact.
    [[nodiscard]] const std::vector<Vec3>& hands_without_contact_m() const { return without_contact_m_; }

private:
    void move_hand();
    void wait(Nanoseconds deadline_ns, Pacing pacing);
    void tick(Nanoseconds lateness_ns);
    void publish_parameters();
    void count(const haptics::TickRecord& record, double took_us);

    TickCosts& costs_;
    Clock& clock_;
    haptics::TickParameters parameters_;
    PathDevice device_;
    PressedWalk path_;
    bool cuts_;
    std::unique_ptr<haptics::HapticChannels> channels_ = std::make_unique<haptics::HapticChannels>();
    haptics::HapticLoop loop_;
    CacheEvictor evictor_;
    Nanoseconds time_ns_ = 0;
    std::uint64_t surface_ = 0;
    bool let_go_ = true;  // the parameters published last
    std::vector<Vec3> without_contact_m_;
};

}  // namespace burin::bench
