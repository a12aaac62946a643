// SPDX-License-Identifier: MIT
// Judges from taps whether a handle moves with the force that its motors are told to give, while a hand holds it: the
// statistics of `burin devices test`. Pure; one thread. Lengths in metres, times in seconds, forces in newtons; frame:
// device.
//
// Taps and their order: bench/devices/tap_series.hpp.
//
// Remnants. What a tap leaves behind (a handle that still swings, a hand that answers late) moves it in the next one.
// Its part that follows the way of the tap before is taken off by least squares within the kinds of tap (analysis of
// covariance). The order is random, so this favours no kind.
//
// Contrast. Of the means of the taps: those with the force forwards less those backwards, or less the controls where a
// part drives one way. Its standard deviation is s sqrt(1/n + 1/m), with n and m taps in the two means (J. Neyman 1923:
// never too small on average for an order drawn at random). s is the standard deviation of the controls, that is of
// what the hand does without force; or that of the taps with force about their means, where this is larger, so that one
// jerk which no control has seen does not count as an answer; and no less than a step of the device's encoders.
//
// Doubt. What must be exceeded: 4 standard deviations of a normal law, one-sided probability 3.2e-5. There are two
// looks at the taps, after 24 and after 48, so each gets half of that: 4.16 deviations. As s itself is estimated from
// few taps, Student's quantile of the same probability counts (Abramowitz and Stegun 26.7.5, whose probability is
// within 3 % here): 7.6 deviations after 24 taps, 5.3 after 48.
//
// Findings, the first that holds:
//   against    the contrast is below zero by more than the doubt
//   elsewhere  it is exceeded by what is seen along another axis, by more than the doubt; as this is asked four times,
//              each has a quarter of the probability: 4.47 deviations
//   felt       it exceeds the doubt, and what is seen along each other axis by 2 deviations
//   absent     even with the doubt added it is less than the least by which a working motor moves the handle
//   unclear    none of these: the hand moves too much
// Assumptions: the hand does not know the order, and the mean of 12 or more taps is about normal. The hand holds
// loosely, as it is asked to, with no more than 2000 N/m: working_m(). It gives way less than 1 along another axis for
// 1 along the force: its stiffest direction is less than 5.8 times as stiff as its softest.
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin::bench {

struct Tap {
    int way = 0;  // of the force: 1 forwards, -1 backwards, 0 none
    Vec3 moved_m{0.0};
};

struct TapQuestion {
    int axis = 0;             // along which it taps
    bool is_one_way = false;  // then only the axis is looked at
    double working_m = 0.0;   // working_m() of the taps; 0 or less: absence cannot be found
    double resolution_m = 0.0;
};

enum class TapFinding : std::uint8_t { felt, against, elsewhere, absent, unclear };

struct TapAnswer {
    TapFinding finding = TapFinding::unclear;
    double moved_m = 0.0, doubt_m = 0.0;  // the contrast along the axis
    double sway_m = 0.0;                  // the standard deviation of a tap without force
};

// Needs three taps of each way at least; unclear otherwise.
[[nodiscard]] TapAnswer judge_taps(std::span<const Tap> measured, const TapQuestion& question);

// Returns the least contrast that a working motor causes in a hand that holds loosely. Friction takes its part of the
// force, and as much again keeps the handle from coming back. 0 or less: the force may not be felt at all.
[[nodiscard]] double working_m(double force_N, double friction_N, bool is_one_way);

// Returns Student's quantile with the probability that the normal law has beyond so many deviations.
[[nodiscard]] double student_quantile(double deviations, double degrees_of_freedom);

}  // namespace burin::bench
