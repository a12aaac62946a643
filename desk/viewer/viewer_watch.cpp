// SPDX-License-Identifier: MIT
#include "desk/viewer/viewer_watch.hpp"

#include <algorithm>
#include <utility>

#include "desk/viewer/viewed_picture.hpp"

namespace burin::session {

std::optional<std::string> ComfortWatch::look(const ViewedSession& seen, const haptics::ToolState& tool) {
    if (wall::needs_of(seen.viewer.output.mode).one_eye_point) return std::nullopt;
    const wall::ComfortFinding finding = comfort_of(seen, tool);
    const bool strains = finding.crossed_too_much || finding.uncrossed_too_much;
    if (std::exchange(strained_, strains) || !strains) return std::nullopt;
    return wall::warning_of(finding, seen.desk.wall.setup.budget);
}

std::optional<std::string> TrackerWatch::look(const Viewer& viewer, const DeskRoom& desk, Nanoseconds time_ns) {
    if (!viewer.head.tracked) return std::nullopt;
    const wall::TrackerState before = report_.state;
    report_ = wall::report(wall::head_settings(desk.wall.setup), viewer.head.track, time_ns);
    if (report_.state == before) return std::nullopt;
    if (report_.state == wall::TrackerState::ok) {
        if (before == wall::TrackerState::waiting) return std::nullopt;
        return "the tracker sees the head again";
    }
    // A loss is reported once, until the tracker has been well again.
    if (before != wall::TrackerState::ok && before != wall::TrackerState::waiting) return std::nullopt;
    return "head tracker: " + report_.cause;
}

std::optional<std::string> WandWatch::look(const WandState& wands) {
    const auto far = std::ranges::find_if(wands.wands, [](const WandNow& wand) { return wand.too_far_m > 0.0; });
    const bool is_far = far != wands.wands.end();
    if (std::exchange(far_, is_far) == is_far) return std::nullopt;
    if (!is_far) return "the tracker has the wand within reach again";
    return wall::too_far_away("wand " + std::to_string(far - wands.wands.begin()), far->too_far_m,
                              WandSettings{}.farthest_m);
}

std::optional<std::string> FirstWordWatch::look(bool heard, Nanoseconds time_ns) {
    if (!begun_ns_) begun_ns_ = time_ns;
    if (heard_) return std::nullopt;
    heard_ = heard;
    if (heard && told_) return "tracker " + tracker_ + ": is heard now";
    if (heard || told_ || time_ns - *begun_ns_ < kPatience_ns) return std::nullopt;
    told_ = true;
    return "tracker " + tracker_ +
           ": nothing has come from it yet; see that it runs, and that it sends to this machine and port";
}

}  // namespace burin::session
