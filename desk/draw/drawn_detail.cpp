// SPDX-License-Identifier: MIT
#include "desk/draw/drawn_detail.hpp"

#include <algorithm>

namespace burin::session {
namespace {

constexpr std::uint32_t kLateInARow = 2;  // one may be a hitch

// Returns the state with what the frame before has shown of this machine.
DetailState learned(DetailState state, const WholePicture& last) {
    if (state.moved_ns) *state.moved_ns += last.took_ns;  // what moved while it was drawn is not known yet
    if (last.pixel == 1) {
        state.full_ns = last.took_ns;
        return state;
    }
    state.late = last.took_ns > kLateFrame_ns ? state.late + 1 : 0;
    if (state.late >= kLateInARow && last.pixel == state.moving_pixel && state.moving_pixel < kMostPixel) {
        ++state.moving_pixel;
        state.late = 0;
    }
    // A finer picture would take as much more as it has pixels; the next motion may begin with it.
    const std::uint32_t finer = state.moving_pixel - 1;
    const auto would_take_ns = last.took_ns * (last.pixel * last.pixel) / (finer * finer);
    if (!state.moved_ns && finer > 1 && would_take_ns <= kMovingFrame_ns) state.moving_pixel = finer;
    return state;
}

std::uint32_t begins_with(const DetailState& state) {
    return state.full_ns && *state.full_ns <= kMovingFrame_ns ? 1 : state.moving_pixel;
}

}  // namespace

DetailStep step_detail(DetailState state, const DetailView& view) {
    if (view.last) state = learned(state, *view.last);
    if (view.in_full) {
        state.moved_ns.reset();
        state.pixel = 1;
    } else if (view.moves) {
        const bool goes_on = state.moved_ns.has_value();
        state.pixel = goes_on && state.pixel == 1 ? 1
                      : goes_on                   ? std::max(state.pixel, state.moving_pixel)
                                                  : begins_with(state);
        state.moved_ns = view.now_ns;
    } else if (state.moved_ns && view.now_ns - *state.moved_ns >= kSettles_ns) {
        state.moved_ns.reset();
        state.pixel = 1;
    }
    return {state, state.pixel};
}

}  // namespace burin::session
