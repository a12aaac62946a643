// SPDX-License-Identifier: MIT
// The newest sets of a glove, each with the time at which its controller took it.
//
// Sets come when the line brings them: an adapter that waits for 16 ms hands over two at once, and one that is lost
// leaves a gap. Their numbers tell how they follow each other. A set was taken at the time of the one before and as
// many periods later as their numbers are apart; one that comes before that shows that all were taken so much earlier.
// The controller's clock is followed: its period by the newest kWatched sets, and what is left by how late the soonest
// of kSoonestOf sets came, over as many sets more.
// A set whose number says nothing, or says another time than that of its arrival by more than kAstray_ns, begins anew.
//
// A set in which a joint has turned faster than any finger does is left out and counted: a check may let a false one
// pass. It is taken where the next one agrees with it, and after kMostRejected in a row: then the hand has moved so.
// Units: nanoseconds of the host's clock. Pure; no heap, lock or throw; one thread. Copied whole from the line's thread
// to the haptic one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/clock.hpp"
#include "devices/gloves/glove_frame.hpp"

namespace burin::devices {

struct TimedSet {
    Nanoseconds taken_ns = 0;  // by the controller, on the host's clock
    GloveSet set;
};

// The newest sets that were taken for true, in their order.
struct GloveSets {
    static constexpr std::size_t kKept = 8;

    std::array<TimedSet, kKept> list{};
    std::size_t count = 0;       // of the list, from its beginning
    std::uint64_t heard = 0;     // in all
    std::uint64_t rejected = 0;  // sets that were left out, in all
    Nanoseconds shifted_ns = 0;  // by how much all times have been put earlier, in all
    Nanoseconds needs_ns = 0;    // a set is there so long after the one before it was taken; at most, lately
    [[nodiscard]] const TimedSet& newest() const { return list[count > 0 ? count - 1 : 0]; }
};

// Returns the time on a line between two sets that are sent one after the other.
[[nodiscard]] Nanoseconds set_period_ns(const GloveSet& set) noexcept;

class GloveTimeline {
public:
    static constexpr std::size_t kWatched = 128, kSoonestOf = 16;
    static constexpr Nanoseconds kAstray_ns = 60'000'000;
    static constexpr std::uint32_t kMostRejected = 3;
    static constexpr Nanoseconds kMostNeeded_ns = 40'000'000;

    // Takes a set that has come now; returns whether it was taken for true.
    bool take(const GloveSet& set, Nanoseconds now_ns) noexcept;
    [[nodiscard]] const GloveSets& sets() const noexcept { return sets_; }

private:
    struct Arrival {
        std::uint64_t number = 0;  // that does not begin again
        Nanoseconds time_ns = 0;
    };
    [[nodiscard]] Nanoseconds time_of(const GloveSet& set, Nanoseconds now_ns) noexcept;
    void begin_anew(std::uint64_t number, Nanoseconds now_ns, bool keeps_period) noexcept;
    [[nodiscard]] Nanoseconds catch_up(Nanoseconds late_ns) noexcept;
    void follow_period(std::uint64_t number, Nanoseconds now_ns) noexcept;
    [[nodiscard]] bool is_plausible(const TimedSet& timed) noexcept;

    GloveSets sets_;
    std::optional<std::uint8_t> last_number_;
    std::uint64_t number_ = 0;    // of the newest set, that does not begin again
    Nanoseconds taken_ns_ = 0;    // of the newest set, rejected ones included
    Nanoseconds arrived_ns_ = 0;  // the newest set
    Nanoseconds period_ns_ = 0;
    std::array<Arrival, kWatched> arrivals_{};
    std::size_t next_arrival_ = 0, arrivals_known_ = 0;
    Nanoseconds soonest_ns_ = 0, catches_up_ns_ = 0;  // the least delay of soonest_of_ sets; and a set, since then
    std::size_t soonest_of_ = 0;
    std::optional<TimedSet> left_out_;  // the newest set, where it was
    std::uint32_t in_a_row_ = 0;        // sets that were left out
};

}  // namespace burin::devices
