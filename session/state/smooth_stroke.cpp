// SPDX-License-Identifier: MIT
#include "session/state/smooth_stroke.hpp"

#include <utility>

#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

// In which the carving side reads the ticks of a hand. Longer than its slowest usual update.
constexpr double kCarvedWithin_s = 0.15;
// In which a hand presses that has been told to. It never does where the mouse's button was down too shortly.
constexpr double kPressesWithin_s = 0.7;

}  // namespace

bool SmoothStroke::is_over() const { return begun ? carved_s >= kCarvedWithin_s : released_s >= kPressesWithin_s; }

SmoothStroke followed(SmoothStroke stroke, const SmoothStrokeStep& step) {
    stroke.begun = stroke.begun || step.hand_pressed;
    stroke.released_s = step.mouse_pressed ? 0.0 : stroke.released_s + step.dt_s;
    stroke.carved_s = step.mouse_pressed || step.hand_pressed ? 0.0 : stroke.carved_s + step.dt_s;
    return stroke;
}

Result<void> follow_smooth_stroke(SessionState& state, SessionOrders& orders, std::span<const Gesture> strokes,
                                  const SessionView& view) {
    const auto give_back = [&]() -> Result<void> {
        const SmoothStroke done = *std::exchange(state.smooth_stroke, std::nullopt);
        if (done.only_touches) return run_command(state, orders, RunAction{Action::tool_5});
        return run_command(state, orders, SetOperation{done.otherwise});
    };
    for (const Gesture stroke : strokes) {
        if (stroke == Gesture::smooth_surface && !state.smooth_stroke) {
            SmoothStroke smooth{state.hand, state.tool.operation, state.only_touch};
            if (const auto taken = run_command(state, orders, SetOperation{compute::Operation::smooth}); !taken)
                return taken;
            state.smooth_stroke = smooth;
        } else if (stroke != Gesture::smooth_surface && state.smooth_stroke) {
            if (const auto given = give_back(); !given) return given;
        }
    }
    if (!state.smooth_stroke || state.smooth_stroke->hand != state.hand) return {};
    constexpr std::uint32_t kWorks = 1;
    state.smooth_stroke =
        followed(*state.smooth_stroke, {view.dt_s, state.desk.on_surface.pressed, (view.tool.buttons & kWorks) != 0});
    return state.smooth_stroke->is_over() ? give_back() : Result<void>{};
}

}  // namespace burin::session
