// SPDX-License-Identifier: MIT
// The taps of `burin devices test` along one axis: when there is a force, and what is measured of the handle. No clock
// and no device: it is told the time and the place at each tick. Lengths in metres, times in seconds; frame: device.
//
// A tap is a slot of 0.25 s. In half of the taps, the controls, there is no force. In the others there is one for the
// first 0.13 s. From each comes one figure, how far the handle is moved: its mean place from 0.10 to 0.14 s, less the
// straight line through its mean places before 0.02 s and after 0.22 s. So drift and slow sway cancel, and the hand's
// answer to the force is hardly in it: an intended one takes more than 0.1 s from the beginning of the force, and only
// reflexes, which stiffen the hand and do not turn its motion round, are faster (Pruszynski and Scott, Optimal feedback
// control and the long-latency stretch response, 2012).
//
// The order is drawn at random (Fisher and Yates), anew for each direction and after each interruption, from a seed
// that is told. So the hand's own motion is as likely to be seen in one kind of tap as in another, however it sways: no
// assumption is needed about its spectrum, or its correlation from tap to tap (R. A. Fisher, The Design of Experiments,
// 1935: the physical basis of the validity of the test).
//
// A tap whose force the gate held back, or of which the machine missed a part, is taken once more.
#pragma once

#include <random>
#include <vector>

#include "bench/devices/tap_response.hpp"

namespace burin::bench {

inline constexpr double kTapSlot_s = 0.25, kTapForce_s = 0.13;
inline constexpr std::size_t kTapsToALook = 24, kMostTaps = 48;

// Returns the ways of kMostTaps taps. Each look's share has half controls, and as many forwards as backwards; where a
// part drives one way, all others forwards.
[[nodiscard]] std::vector<int> tap_order(std::mt19937_64& random, bool is_one_way);

// Keeps where the handle is at the start of a tap, at its answer to the force, and at the end.
class TapPlaces {
public:
    void add(double time_s, const Vec3& place_m);  // since the tap began
    // Tells whether samples came at each of these times.
    [[nodiscard]] bool is_whole() const;
    [[nodiscard]] Vec3 moved_m() const;  // needs is_whole()

private:
    struct Sums {
        double time_s = 0.0;
        Vec3 place_m{0.0};
        double count = 0.0;
    };
    Sums before_, moved_, after_;
};

// Holds what the series needs of a haptic tick.
struct TapTick {
    double time_s = 0.0;
    Vec3 place_m{0.0};
    double let_through = 1.0;  // the share of a wanted force that the gate lets through
};

class TapSeries {
public:
    // The generator must outlive the series.
    TapSeries(const TapQuestion& question, std::mt19937_64& random);

    // Forgets all taps, and draws another order.
    void restart();
    // Returns the way in which the force acts until the next tick: 1, -1, or 0.
    [[nodiscard]] int tick(const TapTick& tick);
    [[nodiscard]] bool has_begun() const { return has_begun_; }
    [[nodiscard]] bool is_over() const { return is_over_; }
    [[nodiscard]] const TapAnswer& answer() const { return answer_; }
    [[nodiscard]] std::size_t count() const { return taps_.size(); }

private:
    void begin_tap(double time_s);
    void end_tap();
    [[nodiscard]] bool is_undisturbed() const;

    TapQuestion question_;
    std::mt19937_64& random_;
    std::vector<int> order_;
    std::vector<Tap> taps_;
    TapPlaces places_;
    double begun_s_ = 0.0, let_through_ = 0.0, force_ticks_ = 0.0;  // of the tap
    bool has_begun_ = false, is_over_ = false;
    TapAnswer answer_;
};

}  // namespace burin::bench
