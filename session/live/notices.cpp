// SPDX-License-Identifier: MIT
#include "session/live/notices.hpp"
#include "base/longest_side.hpp"

namespace burin::session {

void Notices::look(const SessionState& state, const SessionHands& hands, std::span<const haptics::ToolState> tools,
                   const haptics::ToolState& in_use, const Led& led, double spacing_m, Nanoseconds time_ns) {
    if (const auto nothing = strokes_.look(state, in_use, led.stroke_depth_m, spacing_m, time_ns))
        log_.notify(*nothing);
    for (DeviceWatch::News& news : devices_.look(hands, tools)) {
        log_.notify(news.message, news.kind);
        events_.push_back(std::move(news.event));
    }
}

void Notices::look_at_tool(const toolbox::ToolSettings& settings, const toolbox::Tool& tool,
                           const Box& workpiece_object, double spacing_m) {
    const double longest_m = longest_side_m(workpiece_object);
    if (const auto misfit = misfit_.look(settings, tool, longest_m, spacing_m)) log_.notify(*misfit);
}

void Notices::take(const scene::SurfaceUpdate& update) {
    for (const std::string& message : update.messages) log_.notify(message);
    for (const scene::ExportOutcome& ended : update.exports) files_.tell(ended);
    strokes_.take(update);
}

void Notices::tell(const std::vector<Asked>& messages) {
    for (const Asked& message : messages) {
        if (message.line == 0)
            log_.notify(message.text, message.kind);
        else
            log_.notify(message.text, message.kind, {files_.failed_on(message.line), {}});
    }
}

void Notices::tell_of(const HandSide::Switched& amplifiers, std::size_t line) {
    if (amplifiers.done) return log_.notify_of_event(amplifiers.told);
    log_.notify_of_event(amplifiers.told, MessageKind::warning, {files_.failed_on(line), {}});
}

std::optional<Nanoseconds> Notices::changes_ns() const {
    std::optional<Nanoseconds> next;
    for (const auto& other : {log_.next_change_ns(), strokes_.due_ns()})
        if (other) next = std::min(next.value_or(*other), *other);
    return next;
}

}  // namespace burin::session
