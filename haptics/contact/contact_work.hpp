// SPDX-License-Identifier: MIT
// Counts of the work that a tick does on contact, what it costs, and how much of it a tick may do.
//
// Counts do not depend on the machine, so that the same inputs give the same ticks everywhere; their cost in time does.
// A tick's budget is therefore a cost in nanoseconds of a reference core, computed from the counts, and a machine that
// is slower than the reference by a factor (WorkSettings::pace, measured when a session begins) gets a budget that is
// smaller by this factor. What is left when the budget is used up goes on in the next tick.
#pragma once

#include <algorithm>
#include <cstdint>

#include "haptics/contact/work_counts.hpp"

namespace burin::haptics {

// Costs on the reference core, an Intel Xeon of 2.9 GHz without other load, in nanoseconds: a least-squares fit to
// 216,000 ticks on three public models and in grooves, of balls from a five-hundredth to 25 edges in radius, that
// explains nine ticks in ten to a third. Tests that hardly occur without gathering and measuring come out too cheap, so
// theirs is the time of one alone.
struct WorkCost {
    static constexpr double kTick_ns = 250.0, kTest_ns = 60.0, kLook_ns = 10.0, kGathered_ns = 55.0, kPoint_ns = 15.0,
                            kFour_ns = 120.0, kStep_ns = 360.0, kPiece_ns = 20.0, kTerm_ns = 4.0, kSupport_ns = 90.0;
};

[[nodiscard]] inline double cost_ns(const ContactWork& work) noexcept {
    return WorkCost::kTick_ns + WorkCost::kTest_ns * work.triangles_tested + WorkCost::kLook_ns * work.triangles_seen +
           WorkCost::kGathered_ns * work.gathered + WorkCost::kPoint_ns * work.points +
           WorkCost::kFour_ns * work.fours_measured + WorkCost::kStep_ns * work.steps +
           WorkCost::kPiece_ns * work.pieces + WorkCost::kTerm_ns * work.cutting_terms +
           WorkCost::kSupport_ns * work.supports;
}

// The looks and the exact tests of one search, paid from one budget: each test leaves the search fewer looks. Refers to
// the looks left of the search (geometry::Near::looks_left), which must outlive it.
class SearchWork {
public:
    SearchWork(double budget_ns, std::uint32_t most_looks, std::uint32_t& looks_left) noexcept
        : budget_ns_(budget_ns), looks_left_(looks_left) {
        looks_left_ = std::min(most_looks, looks_in(budget_ns));
        began_with_ = looks_left_;
    }
    // Counts a test; false: nothing is left for it.
    [[nodiscard]] bool pay_test() noexcept {
        const double left_ns = budget_ns_ - WorkCost::kTest_ns * (tests_ + 1) - WorkCost::kLook_ns * looks();
        if (left_ns < 0.0) return false;
        ++tests_;
        const std::uint32_t affordable = std::min(looks_in(left_ns), looks_left_);
        taken_away_ += looks_left_ - affordable;
        looks_left_ = affordable;
        return true;
    }
    [[nodiscard]] std::uint32_t looks() const noexcept { return began_with_ - taken_away_ - looks_left_; }
    [[nodiscard]] std::uint32_t tests() const noexcept { return tests_; }

private:
    [[nodiscard]] static std::uint32_t looks_in(double ns) noexcept {
        return static_cast<std::uint32_t>(std::clamp(ns / WorkCost::kLook_ns, 0.0, 4e9));
    }
    double budget_ns_;
    std::uint32_t& looks_left_;
    std::uint32_t began_with_ = 0, taken_away_ = 0, tests_ = 0;
};

[[nodiscard]] inline double budget_ns(const WorkSettings& settings, double period_s) noexcept {
    return 1e9 * settings.share * period_s / settings.pace;
}

}  // namespace burin::haptics
