// SPDX-License-Identifier: MIT
// Cuts ears: a corner is one when its triangle lies inside the polygon that is left. For polygons that the sweep cannot
// split: whose edges cross, fold back or overlap.
#include "geometry/mesh/flat_polygon.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/mesh/exact_sign.hpp"

namespace burin::geometry {
namespace {

// A file could hold nothing but such polygons: each may take some 10 microseconds a corner.
constexpr std::uint64_t kStepsPerCorner = 4096;
// Cost of a determinant in steps, where a step is a comparison of coordinates; more where it needs exact arithmetic.
constexpr std::uint64_t kSteps = 64, kStepsWhenExact = 256;

class EarClipper {
public:
    explicit EarClipper(std::span<const Vec2> corners)
        : p_(corners),
          left_(static_cast<std::uint32_t>(corners.size())),
          before_(left_),
          after_(left_),
          gone_(left_),
          waits_(left_),
          by_x_(left_),
          steps_left_(kStepsPerCorner * left_) {
        for (std::uint32_t i = 0; i < left_; ++i) {
            before_[i] = i == 0 ? left_ - 1 : i - 1;
            after_[i] = i + 1 == left_ ? 0 : i + 1;
        }
        std::iota(by_x_.begin(), by_x_.end(), 0u);
        std::ranges::stable_sort(by_x_, {}, [&](std::uint32_t i) { return p_[i].x; });
        result_.triangles.reserve(left_ - 2);
    }

    ClippedPolygon run() {
        ask_all();
        while (left_ > 3) {
            const std::vector<std::uint32_t> asked = std::exchange(asked_, {});
            for (const std::uint32_t i : asked) {
                waits_[i] = false;
                if (left_ == 3 || gone_[i] || !is_ear(i)) continue;
                cut(i);
                ask(before_[i]);  // what else may have become an ear is asked when these are done
                ask(after_[i]);
            }
            if (!asked_.empty() || left_ == 3) continue;
            if (std::exchange(left_when_all_were_asked_, left_) == left_) cut_without_ear();
            ask_all();
        }
        while (gone_[first_]) ++first_;
        if (turn(before_[first_], first_, after_[first_]) < 0) result_.folded = true;
        cut(first_);
        return std::move(result_);
    }

private:
    int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const int side = turn_in_plane(p_[a], p_[b], p_[c]);
        spend(side == 0 ? kStepsWhenExact : kSteps);
        return side;
    }
    void spend(std::uint64_t steps) { steps_left_ -= std::min(steps, steps_left_); }

    void cut(std::uint32_t i) {
        result_.triangles.push_back({before_[i], i, after_[i]});
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        gone_[i] = true;
        --left_;
        if (by_x_.size() > 2 * std::size_t{left_}) std::erase_if(by_x_, [&](std::uint32_t k) { return gone_[k]; });
    }

    void ask(std::uint32_t i) {
        if (!waits_[i]) asked_.push_back(i);
        waits_[i] = true;
    }

    void ask_all() {
        while (gone_[first_]) ++first_;
        ask(first_);
        for (std::uint32_t i = after_[first_]; i != first_; i = after_[i]) ask(i);
    }

    // Cuts what has no area: the rest may have ears again. Else cuts off a convex corner, whatever it covers, or any.
    void cut_without_ear() {
        while (gone_[first_]) ++first_;
        const std::uint32_t was_left = left_;
        std::uint32_t at = first_, chosen = first_;
        for (std::uint32_t tried = 0; tried < was_left && left_ > 3; ++tried, at = after_[at]) {
            const int side = turn(before_[at], at, after_[at]);
            if (side == 0) cut(at);
            if (side > 0) chosen = at;
        }
        if (left_ < was_left) return;
        result_.folded = true;
        cut(chosen);
    }

    bool is_ear(std::uint32_t i) {
        if (steps_left_ == 0) return result_.folded = true;  // no more time to look
        const CornerTriple ear{before_[i], i, after_[i]};
        if (turn(ear[0], ear[1], ear[2]) <= 0) return false;
        const auto [low_x, high_x] = std::minmax({p_[ear[0]].x, p_[ear[1]].x, p_[ear[2]].x});
        const auto [low_y, high_y] = std::minmax({p_[ear[0]].y, p_[ear[1]].y, p_[ear[2]].y});
        const auto first = std::ranges::lower_bound(by_x_, low_x, {}, [&](std::uint32_t k) { return p_[k].x; });
        for (auto at = first; at != by_x_.end() && p_[*at].x <= high_x; ++at) {
            spend(1);
            const std::uint32_t k = *at;
            if (p_[k].y < low_y || p_[k].y > high_y || gone_[k] || std::ranges::count(ear, k) > 0) continue;
            if (is_in_the_way(k, ear)) return false;
        }
        return true;
    }

    // Tells whether a corner lies in the ear, or at its rim and an edge goes on from there into it.
    bool is_in_the_way(std::uint32_t k, const CornerTriple& ear) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (p_[k] != p_[ear[i]]) continue;
            const std::uint32_t a = ear[i], b = ear[(i + 1) % 3], c = ear[(i + 2) % 3];
            return one_neighbour(k, [&](std::uint32_t d) { return turn(a, b, d) > 0 && turn(c, a, d) > 0; });
        }
        std::array<int, 3> sides{};
        for (std::size_t i = 0; i < 3; ++i) {
            sides[i] = turn(ear[i], ear[(i + 1) % 3], k);
            if (sides[i] < 0) return false;
        }
        if (sides[2] == 0) return true;  // on the side that the cut would make
        for (std::size_t i = 0; i < 2; ++i) {
            if (sides[i] != 0) continue;
            return one_neighbour(k, [&](std::uint32_t d) { return turn(ear[i], ear[(i + 1) % 3], d) > 0; });
        }
        return true;
    }

    bool one_neighbour(std::uint32_t k, const auto& holds) { return holds(before_[k]) || holds(after_[k]); }

    std::span<const Vec2> p_;
    std::uint32_t left_;
    std::vector<std::uint32_t> before_, after_;
    std::vector<bool> gone_, waits_;
    std::vector<std::uint32_t> asked_;  // corners to be tried next; they wait
    std::uint32_t first_ = 0;           // none before it is left
    std::uint32_t left_when_all_were_asked_ = 0;
    std::vector<std::uint32_t> by_x_;  // corners that are left, and at most as many that are gone
    std::uint64_t steps_left_;
    ClippedPolygon result_;
};

}  // namespace

ClippedPolygon clip_ears(std::span<const Vec2> corners) { return EarClipper(corners).run(); }

}  // namespace burin::geometry
