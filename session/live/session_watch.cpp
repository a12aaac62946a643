// SPDX-License-Identifier: MIT
#include "session/live/session_watch.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/text.hpp"
#include "picture/frame_setup.hpp"
#include "session/held/hand_state.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

// How long a workpiece must not have turned until its shadows are computed anew: all of its surface is, which takes a
// processor's core for a second, and a turn that goes on would have it do so without end.
constexpr Nanoseconds kShadowsFollow_ns = 150'000'000;
constexpr double kSame = 1e-9;  // of two directions

// Returns whether it is the device, and not what is done with it, that takes the force off.
bool is_of_device(haptics::GateCause cause) {
    using enum haptics::GateCause;
    return cause == device_fault || cause == stale_sample || cause == future_sample || cause == out_of_reach;
}

// Returns the hands, but one, none of whose parts is lost: ", and right goes on".
std::string who_goes_on(const SessionHands& hands, std::size_t but, const std::vector<bool>& lost) {
    std::vector<std::string_view> names;
    for (std::size_t hand = 0; hand < hands.hands(); ++hand) {
        const auto first = lost.begin() + static_cast<std::ptrdiff_t>(hands.first_part(hand));
        if (hand != but &&
            std::none_of(first, first + static_cast<std::ptrdiff_t>(hands.parts_of(hand)), std::identity{}))
            names.push_back(hands.name_of_hand(hand));
    }
    if (names.empty()) return "";
    return "; " + joined(names) + (names.size() == 1 ? " goes on" : " go on");
}

// Says of a stroke that has changed nothing what it did not do, and what would do it.
std::string why_nothing(const HandState& hand, bool touched, double depth_m, double spacing_m) {
    if (hand.only_touch)
        return "the tool only touches: choose Cut, Fill, Paint or Smooth (keys 1 to 4) to work with it";
    if (!hand.force_on)
        return "nothing was changed: the force is off, and the tool keeps out of the material; switch it on under "
               "Touch";
    if (!touched) return "the tool touched nothing on its way: press where it stands on the workpiece";
    switch (hand.tool.operation) {
        case compute::Operation::paint: return "nothing was painted: the surface has this colour already";
        case compute::Operation::smooth: return "nothing was smoothed: the surface is as smooth there as it gets";
        case compute::Operation::cut:
        case compute::Operation::fill: break;
    }
    const std::string what = hand.tool.operation == compute::Operation::cut ? "removed" : "added";
    if (depth_m < 0.25 * spacing_m)
        return "nothing was " + what + ": the stroke is " + formatted("%.2g", 1e3 * depth_m) +
               " mm deep, and a cell of the workpiece is " + formatted("%.2g", 1e3 * spacing_m) +
               " mm; set a greater Depth, or turn the wheel while the button is down";
    return "nothing was " + what +
           ": the material gives way more slowly than the stroke went; go slowly, or choose a softer one under "
           "Material";
}

}  // namespace

std::vector<DeviceWatch::News> DeviceWatch::look(const SessionHands& hands, std::span<const haptics::ToolState> tools) {
    parts_.resize(hands.parts());
    std::vector<bool> lost;
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        const bool now = is_of_device(tools[i].cause);
        if (now) part.last_ns = tools[i].time_ns;
        const bool is_lost = now || (part.lost && tools[i].time_ns - part.last_ns < kWell_ns);
        if (std::exchange(part.lost, is_lost) != is_lost) changed.push_back(i);
        lost.push_back(is_lost);
    }
    std::vector<News> news;
    const auto tell = [&](const std::string& who, std::size_t part) {
        const haptics::ToolState& tool = tools[part];
        const std::string why = haptics::text(tool.cause);
        const std::string others = who_goes_on(hands, hands.part_of_hand(part).hand, lost);
        if (lost[part])
            news.push_back({who + ": " + why + others, {tool.time_ns, who + " is lost", why}});
        else
            news.push_back(
                {who + ": its device is well again", {tool.time_ns, who + " is well again", ""}, MessageKind::info});
    };
    for (std::size_t hand = 0; hand < hands.hands(); ++hand) {
        const std::size_t first = hands.first_part(hand), count = hands.parts_of(hand);
        const auto own = [&](std::size_t part) { return part >= first && part < first + count; };
        const bool whole = std::cmp_equal(std::ranges::count_if(changed, own), count);
        const std::string& name = hands.name_of_hand(hand);
        if (whole) tell(name.empty() ? std::string(hands.device(first).name) : name, first);
        for (const std::size_t part : changed)
            if (!whole && own(part)) tell(hands.name_of(part), part);
    }
    return news;
}

// Tiles are meshed anew where a tool has only passed; what a stroke has changed can be undone.
void StrokeWatch::take(const scene::SurfaceUpdate& update) {
    changed_ = changed_ || update.undoable != undoable_;
    undoable_ = update.undoable;
    told_ = told_ || !update.messages.empty();
}

std::optional<std::string> StrokeWatch::look(const SessionState& state, const haptics::ToolState& tool, double depth_m,
                                             double spacing_m, Nanoseconds time_ns) {
    if (!state.carves || state.mouse != MouseMode::surface) return std::nullopt;
    constexpr std::uint32_t kWorks = 1;
    const bool pressed = (tool.buttons & kWorks) != 0;
    if (pressed && !std::exchange(pressed_, true)) {
        touched_ = told_ = changed_ = false;
        undoable_before_ = undoable_;
        due_ns_.reset();
    }
    if (pressed) touched_ = touched_ || (tool.flags & haptics::kTickInContact) != 0;
    if (!pressed && std::exchange(pressed_, false)) due_ns_ = time_ns + kSettled_ns;
    if (!due_ns_ || time_ns < *due_ns_) return std::nullopt;
    due_ns_.reset();
    if (changed_ || undoable_ != undoable_before_ || told_) return std::nullopt;
    return why_nothing(state.led(), touched_, depth_m, spacing_m);
}

std::optional<std::string> MisfitWatch::look(const toolbox::ToolSettings& settings, const toolbox::Tool& tool,
                                             double longest_side_m, double spacing_m) {
    if (silent_) return std::nullopt;
    auto misfit = toolbox::misfit(settings, tool, longest_side_m, spacing_m);
    if (std::exchange(misfits_, misfit.has_value())) return std::nullopt;
    return misfit;
}

std::optional<compute::Lamp> LampWatch::look(const SessionState& state, bool turns_it, Nanoseconds time_ns) {
    const Vec3 direction = inverse(state.world_from_object.orientation) * picture::direction_to_light();
    const bool first = direction_object_ == Vec3(0.0);
    const bool turns = glm::length(direction - seen_object_) > kSame;
    if (turns) turned_ns_ = time_ns;
    seen_object_ = direction;
    if (glm::length(direction - direction_object_) <= kSame) return std::nullopt;
    // Once the button that turns it is up, the next frame in which it rests is soon enough.
    const Nanoseconds rests_ns = turns || turns_it ? kShadowsFollow_ns : 0;
    if (!first && time_ns - turned_ns_ < rests_ns) return std::nullopt;
    direction_object_ = direction;
    return compute::Lamp{direction, picture::kLightHalfAngleTangent};
}

}  // namespace burin::session
