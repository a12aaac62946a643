// SPDX-License-Identifier: MIT
// A watch over the contact search: no hand is held by a contact that is not there.
//
// The god-object (god_object.hpp) is bounded in its work and continues from its own last result, so a fault in it, or
// work that never suffices, could hold a hand in free air for good, at the device's full force. The watch asks the
// surface itself, by queries of its own that share nothing with that search but the surface:
//   1. At the proxy: is the surface within kTouching of the radius, would it come nearer on the way to the hand, and
//      does the ball fit there, with nothing deeper in it than kDeep?
//   2. Has the search run out of work in kShort ticks in a row, so that the proxy falls behind the hand?
//   3. Only where 1 or 2 speaks against the contact: is the hand free? It is where the ball at the hand touches nothing
//      and its centre is outside, by the nearest triangle's side.
// A contact that is found wanting in kLooks looks in a row, one each kInterval ticks, is faded out over kFade ticks and
// then given up: the proxy is set to the hand, and the gate gives no force, with a cause of its own. That is at most
// kInterval kLooks + kFade = 56 ticks after the hand has come free. A look that finds the contact sound, or the hand
// not free, takes the doubt back. What it does not end: a contact that is sound although the hand is in free air, such
// as one with a wall, or the rim of a hole too narrow for the ball, between proxy and hand. Cost: a look each kInterval
// ticks in contact, of at most kMostLooks triangles for each query, and of no more work than it is given; where these
// do not suffice, the query says nothing. Its work is counted. Frame: relative to the surface's origin, metres. No
// heap, lock, throw.
#pragma once

#include <cstdint>

#include "geometry/contact/posed_surface.hpp"
#include "haptics/contact/contact_work.hpp"
#include "haptics/contact/tool_shape.hpp"

namespace burin::haptics {

struct WatchState {
    std::uint32_t ticks_to_look = 0;
    std::uint32_t short_ticks = 0;     // in a row in which the work did not suffice
    std::uint32_t doubtful_looks = 0;  // in a row
    std::uint32_t faded_ticks = 0;     // of kFade
};

class ContactWatch {
public:
    static constexpr std::uint32_t kInterval = 12, kShort = 8, kLooks = 3, kFade = 20;
    static constexpr std::uint32_t kMostLooks = 2000;
    static constexpr double kUnbounded_ns = 1e12;
    // Multiples of the radius: the farthest a touched surface may be, and the deepest it may be in the ball. A ball on
    // very fine triangles sinks in by up to a tenth of its radius (touching.cpp).
    static constexpr double kTouching = 1.15, kDeep = 0.2;
    // The surface stands in the way where a step of kStep radii to the hand brings it nearer by this part of the step.
    // A wall along which the ball could go does not.
    static constexpr double kStep = 0.1, kInTheWay = 0.25;

    // A contact as the last tick has left it.
    struct Contact {
        Vec3 proxy_m{0.0}, hand_m{0.0};
        double radius_m = 0.0;
        // A tool that is no ball, and how it stands at the proxy and in the hand (shape_watch.hpp); null: a ball.
        const ToolShape* shape = nullptr;
        Quat proxy_orientation{1.0, 0.0, 0.0, 0.0}, hand_orientation{1.0, 0.0, 0.0, 0.0};
        // The tool cuts: its hand is in material that it presses on, and is free only where that is proved.
        bool cuts = false;
    };

    // Looks, where a look is due, and adds its work, which costs at most most_ns. Call it once a tick in contact,
    // before the proxy moves.
    static void look(WatchState& state, const Contact& contact, const geometry::PosedSurface& surface,
                     ContactWork& work, double most_ns = kUnbounded_ns) noexcept;
    // Lets a tick pass in which nothing is searched.
    static void wait(WatchState& state) noexcept {
        if (state.ticks_to_look > 0) --state.ticks_to_look;
        if (state.short_ticks > 0) ++state.short_ticks;
    }
    // Notes what the search has done in this tick.
    static void note(WatchState& state, bool work_limited) noexcept;
    // Fades a doubted contact by a tick. Returns whether it is to be given up now; then the state is as new.
    [[nodiscard]] static bool gives_up(WatchState& state) noexcept;
    // The share of the force that is left.
    [[nodiscard]] static double share(const WatchState& state) noexcept {
        return 1.0 - static_cast<double>(state.faded_ticks) / kFade;
    }
};

}  // namespace burin::haptics
