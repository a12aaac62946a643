// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"
#include "devices/trackers/dtrack_tracker.hpp"
#include "devices/trackers/spacemouse_tracker.hpp"
#include "devices/trackers/tracker.hpp"
#include "devices/trackers/udp_tracker.hpp"
#include "devices/trackers/vrpn_tracker.hpp"

namespace burin::devices {
namespace {

constexpr std::array<std::string_view, 4> kLineNames{"head", "wand", "wand0", "wand1"};
constexpr std::array<std::string_view, 5> kDTrackNames{"body", "hybrid", "flystick", "flystick0", "flystick1"};

constexpr std::array kTrackerKinds{
    TrackerKind{"udp", "udp:PORT, or udp:ADDRESS:PORT for other machines", open_udp_tracker, nullptr, kLineNames},
    TrackerKind{
        "vrpn",
        "vrpn:HOST or vrpn:HOST:PORT, a VRPN server, and after a comma which of its devices are the head and the "
        "wands: vrpn:localhost,head=Tracker0/0,wand0=Tracker0/1,buttons0=Button0,stick0=Analog0,axes=+x+y+z",
        VrpnTracker::open, look_for_vrpn},
    TrackerKind{"dtrack",
                "dtrack:PORT, or dtrack:ADDRESS:PORT for other machines or a multicast group: ART's DTrack, and after "
                "a comma which of its "
                "bodies are the head and the wands: dtrack:5000,head=body/0,wand0=flystick/0,axes=+x+z-y",
                open_dtrack, nullptr, kDTrackNames, true},
    TrackerKind{
        "spacemouse",
        "spacemouse:PLACE, or spacemouse for the first, a 3Dconnexion SpaceMouse that moves the scene, and settings "
        "after commas: spacemouse:hidraw3,speed=0.3,turn=1.2,dead=0.1",
        open_spacemouse_tracker,
        look_for_spacemice,
        {},
        false,
        true},
};

bool is_pose_or_stick(const TrackerSample& sample) { return !std::holds_alternative<WandClick>(sample.input); }

}  // namespace

bool TrackerQueue::push(TrackerSample sample) {
    const bool full = samples_.size() >= kMost;
    if (full) {
        const auto replaced = std::ranges::find_if(samples_, is_pose_or_stick);
        samples_.erase(replaced != samples_.end() ? replaced : samples_.begin());
    }
    samples_.push_back(std::move(sample));
    return !full;
}

std::vector<TrackerSample> TrackerQueue::take() {
    std::vector<TrackerSample> taken(std::make_move_iterator(samples_.begin()),
                                     std::make_move_iterator(samples_.end()));
    samples_.clear();
    return taken;
}

std::span<const TrackerKind> tracker_kinds() { return kTrackerKinds; }

std::string tracker_usage() {
    std::string text;
    for (const TrackerKind& kind : kTrackerKinds) text += (text.empty() ? "" : "; ") + std::string(kind.usage);
    return text;
}

const TrackerKind* tracker_kind_of(std::string_view where) {
    const std::string_view scheme = where.substr(0, where.find(':'));
    const auto kind = std::ranges::find(kTrackerKinds, scheme, &TrackerKind::scheme);
    return kind != kTrackerKinds.end() && (scheme.size() < where.size() || kind->may_be_bare) ? &*kind : nullptr;
}

Result<std::unique_ptr<Tracker>> open_tracker(const std::string& where, TrackerHost host) {
    if (const TrackerKind* kind = tracker_kind_of(where)) return kind->open(where, std::move(host));
    return fail("tracker " + where, "is no tracker that Burin knows", "write " + tracker_usage());
}

}  // namespace burin::devices
