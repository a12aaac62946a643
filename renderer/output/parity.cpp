// SPDX-License-Identifier: MIT
#include "renderer/output/parity.hpp"

namespace burin {

FieldChoice choose_field(const FieldParity& state, std::uint64_t vblank_now, Eye eye_of_even_vblanks,
                         std::uint64_t queued) {
    FieldChoice choice;
    choice.vblank = vblank_now + 1 + queued;
    choice.eye = choice.vblank % 2 == 0 ? eye_of_even_vblanks : other(eye_of_even_vblanks);
    choice.repaired = state.pictures > 0 && choice.eye == state.last_eye;
    choice.state = state;
    choice.state.repairs += choice.repaired ? 1 : 0;
    if (state.pictures > 0 && choice.vblank > state.next_vblank) {
        choice.state.missed += choice.vblank - state.next_vblank - 1;
    }
    choice.state.next_vblank = choice.vblank;
    choice.state.last_eye = choice.eye;
    ++choice.state.pictures;
    return choice;
}

}  // namespace burin
