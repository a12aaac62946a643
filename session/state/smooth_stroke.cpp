// SPDX-License-Identifier: MIT
#include "session/state/smooth_stroke.hpp"

#include <utility>

#include "base/try.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_step.hpp"

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

Result<void> follow_smooth_stroke(SessionState& state, SessionOrders& orders, const Led& led, const StepView& view) {
    const auto give_back = [&]() -> Result<void> {
        const SmoothStroke done = *std::exchange(state.smooth_stroke, std::nullopt);
        if (done.only_touches) return run_command(state, orders, RunAction{Action::tool_5});
        return run_command(state, orders, SetOperation{done.otherwise});
    };
    for (const bool smooths : led.strokes) {
        if (smooths && !state.smooth_stroke) {
            SmoothStroke smooth{state.hand, state.led().tool.operation, state.led().only_touch};
            BURIN_TRY_DO(run_command(state, orders, SetOperation{compute::Operation::smooth}));
            state.smooth_stroke = smooth;
        } else if (!smooths && state.smooth_stroke) {
            BURIN_TRY_DO(give_back());
        }
    }
    if (!state.smooth_stroke || state.smooth_stroke->hand != state.hand) return {};
    constexpr std::uint32_t kWorks = 1;
    state.smooth_stroke =
        followed(*state.smooth_stroke, {view.dt_s, led.strokes_now, (view.tool.buttons & kWorks) != 0});
    return state.smooth_stroke->is_over() ? give_back() : Result<void>{};
}

}  // namespace burin::session
