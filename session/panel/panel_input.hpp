// SPDX-License-Identifier: MIT
// A session's events as the panel's toolkit takes them. The toolkit looks at the mouse and the keys as they are once a layout, so what
// happened in between must be given to it in steps: a button that goes down and up, a drag that ends and goes on elsewhere.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <variant>

#include "app/session/input_event.hpp"

namespace burin::panel {

struct PointerGone {};  // a wand that points elsewhere
using PanelInput = std::variant<MouseMove, PointerGone, MouseClick, Scroll, KeyInput, TextInput, WindowFocus>;

class PanelEvents {
public:
    void add(PanelInput input) { waiting_.push_back(std::move(input)); }
    [[nodiscard]] bool empty() const { return waiting_.empty(); }
    // Hands the toolkit's current context all that can happen within one layout.
    void hand_over();
    void drop() { waiting_.clear(); }

private:
    std::deque<PanelInput> waiting_;
};

// What of a session's event concerns the panel, in the panel's pixels.
[[nodiscard]] std::optional<PanelInput> panel_input(const Input& input, const Vec2& origin_px,
                                                    const Vec2& px_per_panel_px);
// Which of the session's keys the toolkit asks for by name; into the current context.
void name_keys();

}  // namespace burin::panel
