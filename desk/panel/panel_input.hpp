// SPDX-License-Identifier: MIT
// Converts a session's events to those of the panel's toolkit. The toolkit reads mouse and keys once per layout, so
// that several events between two layouts must reach it in steps: a button that goes down and up, a drag that ends and
// continues elsewhere.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <variant>

#include "session/input/input_event.hpp"

namespace burin::session::panel {

// The pointer left the panel: a wand points elsewhere.
struct PointerGone {};
using PanelInput = std::variant<MouseMove, PointerGone, MouseClick, Scroll, KeyInput, TextInput, WindowFocus>;

class PanelEvents {
public:
    void add(PanelInput input) { waiting_.push_back(std::move(input)); }
    [[nodiscard]] bool empty() const { return waiting_.empty(); }
    // Hands the toolkit's current context all events that can happen within one layout.
    void hand_over();
    void drop() { waiting_.clear(); }

private:
    std::deque<PanelInput> waiting_;
};

// Converts a session's event to the panel's pixels; nothing where it does not concern the panel.
[[nodiscard]] std::optional<PanelInput> panel_input(const Input& input, const Vec2& origin_px,
                                                    const Vec2& px_per_panel_px);
// Maps the session's keys that the toolkit asks for by name, in the current context.
void name_keys();

}  // namespace burin::session::panel
