// SPDX-License-Identifier: MIT
#include "devices/trackers/tracker_bodies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace burin::devices {
namespace {

constexpr std::string_view kBodiesUsage =
    "head=NAME/SENSOR, wand0=NAME/SENSOR, buttons0=NAME/FIRST, stick0=NAME/FIRST, likewise 1, and axes=+x+z-y, which "
    "of "
    "its axes are the world's x, y and z";
constexpr std::array<std::string_view, 8> kKeys{"head",     "wand0",  "wand1",  "buttons0",
                                                "buttons1", "stick0", "stick1", "axes"};
constexpr double kQuaternionRounded =
    0.01;  // how far a quaternion's length may be from 1, as of the lines of a UDP tracker

// "+x+z-y": the world's axes in the system's.
std::optional<TrackerFrame> axes_named(std::string_view text) {
    if (text.size() != 6) return std::nullopt;
    glm::dmat3 system_from_tracker(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const char sign = text[static_cast<std::size_t>(2 * axis)],
                   letter = text[static_cast<std::size_t>(2 * axis + 1)];
        if ((sign != '+' && sign != '-') || letter < 'x' || letter > 'z') return std::nullopt;
        system_from_tracker[axis][letter - 'x'] = sign == '+' ? 1.0 : -1.0;
    }
    const auto frame = frame_with_axes(glm::transpose(system_from_tracker), false);
    return frame ? std::optional(*frame) : std::nullopt;
}

bool is_pose(const Pose& pose) {
    const Vec3& p = pose.position_m;
    const double length = glm::length(pose.orientation);
    return finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kMostTracked_m &&
           std::abs(length - 1.0) <= kQuaternionRounded;
}

std::optional<TrackedSource>& source_of(TrackerBodies& bodies, std::string_view key) {
    if (key == "head") return bodies.head;
    const std::size_t wand = key.back() == '1' ? 1 : 0;
    if (key.starts_with("wand")) return bodies.wands[wand];
    return key.starts_with("buttons") ? bodies.buttons[wand] : bodies.sticks[wand];
}

}  // namespace

std::string_view tracker_bodies_usage() { return kBodiesUsage; }

std::optional<TrackedSource> tracked_source(std::string_view text) {
    TrackedSource source;
    const std::size_t slash = text.rfind('/');
    source.name = text.substr(0, slash);
    if (source.name.empty()) return std::nullopt;
    if (slash == std::string_view::npos) return source;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data() + slash + 1, end, source.number);
    if (error != std::errc{} || at != end || source.number < 0) return std::nullopt;
    return source;
}

std::expected<TrackerFrame, std::string> frame_with_axes(const glm::dmat3& tracker_from_system, bool is_left_handed) {
    constexpr double kRounded = 1e-4;  // of a matrix that is written with five digits
    const glm::dmat3 square = tracker_from_system * glm::transpose(tracker_from_system);
    double off = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            off = std::max(off, std::abs(square[column][row] - (column == row ? 1.0 : 0.0)));
    if (!(off <= kRounded))
        return std::unexpected(
            formatted("is no rotation: its rows are off by %.3g from length 1 at right angles", off));
    const double determinant = glm::determinant(tracker_from_system);
    if ((determinant < 0.0) != is_left_handed)
        return std::unexpected(is_left_handed ? "takes a left-handed system into another left-handed one"
                                              : "is a mirror image");
    TrackerFrame frame;
    frame.tracker_from_system = glm::normalize(glm::quat_cast((is_left_handed ? -1.0 : 1.0) * tracker_from_system));
    frame.is_left_handed = is_left_handed;
    return frame;
}

Result<TrackerBodies> tracker_bodies(const std::string& where, std::span<const std::string> settings,
                                     const TrackerBodies& usual, const TrackerHost& host) {
    TrackerBodies bodies = host.described != nullptr ? *host.described : TrackerBodies{};
    bool names_any = host.described != nullptr;
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        const std::string key = setting.substr(0, equals);
        if (equals == std::string::npos || std::ranges::find(kKeys, key) == kKeys.end())
            return fail(
                "tracker " + where, "'" + setting + "' says nothing that is known",
                "the nearest is " + std::string(nearest_name(key, kKeys)) + "=; write " + std::string(kBodiesUsage));
        const std::string value = setting.substr(equals + 1);
        if (key == "axes") {
            const auto axes = axes_named(value);
            if (!axes)
                return fail("tracker " + where, "'" + setting + "' are no axes",
                            "write three different ones with their signs and no mirror image, such as axes=+x+z-y");
            bodies.frame.tracker_from_system = axes->tracker_from_system;
            bodies.frame.is_left_handed = axes->is_left_handed;
            continue;
        }
        const auto source = tracked_source(value);
        if (!source)
            return fail("tracker " + where, "'" + setting + "' names nothing",
                        "write " + key + "=NAME/NUMBER, such as " + key + "=Tracker0/0");
        source_of(bodies, key) = *source;
        names_any = true;
    }
    if (!names_any) {
        const TrackerFrame frame = bodies.frame;
        bodies = usual;
        bodies.frame = frame;
    }
    bodies.are_named = names_any;
    if (!bodies.frame.world_from_tracker) bodies.frame.world_from_tracker = host.world_from_tracker;
    return bodies;
}

bool TrackerTranslator::is_known(std::string_view name, std::int32_t number) const {
    const auto is_it = [&](const std::optional<TrackedSource>& source) {
        return source && source->name == name && source->number == number;
    };
    return is_it(bodies_.head) || std::ranges::any_of(bodies_.wands, is_it);
}

// Returns nothing where it is no pose.
std::optional<Pose> TrackerTranslator::in_tracker(const Pose& pose_system) const {
    const TrackerFrame& frame = bodies_.frame;
    const Quat& axes = frame.tracker_from_system;
    const Pose scaled{(frame.is_left_handed ? -frame.unit_m : frame.unit_m) * pose_system.position_m,
                      pose_system.orientation};
    if (!is_pose(scaled)) return std::nullopt;
    return Pose{axes * scaled.position_m,
                glm::normalize(axes * glm::normalize(scaled.orientation) * glm::conjugate(axes))};
}

Pose TrackerTranslator::point_world(Body& body, const TrackedMount& mount, const TimedPose& body_tracker) const {
    Pose pose = body_tracker.pose;
    if (mount.ahead_ns > 0) {
        if (body.count > 0 && body_tracker.time_ns <= body.poses_tracker[body.count - 1].time_ns) --body.count;
        if (body.count == Body::kMostPoses) {
            std::shift_left(body.poses_tracker.begin(), body.poses_tracker.end(), 1);
            --body.count;
        }
        body.poses_tracker[body.count++] = body_tracker;
        constexpr VelocityWindow kWindow{.max_speed_m_per_s = kMostTracked_m_per_s,
                                         .max_turn_rad_per_s = kMostTracked_rad_per_s};
        pose =
            moved(pose, velocity_of(kWindow, std::span(body.poses_tracker).first(body.count)), seconds(mount.ahead_ns));
    }
    const Pose world_from_tracker = bodies_.frame.world_from_tracker.value_or(Pose{});
    return {world_from_tracker * (pose * mount.body_from_point.position_m),
            glm::normalize(world_from_tracker.orientation * pose.orientation * mount.body_from_point.orientation)};
}

void TrackerTranslator::report(Body& body, const TrackedMount& mount, const std::optional<TimedPose>& body_tracker,
                               std::optional<std::uint32_t> wand, Nanoseconds time_ns) {
    const bool is_tracked = body_tracker.has_value();
    if (!is_tracked && !body.is_tracked) return;  // nothing new, and nothing known
    if (is_tracked)
        body.last_world = point_world(body, mount, *body_tracker);
    else
        body.count = 0;
    body.is_tracked = is_tracked;
    if (wand)
        to_.push({time_ns, WandInput{*wand, body.last_world, is_tracked}});
    else
        to_.push({time_ns, HeadInput{body.last_world, is_tracked}});
}

bool TrackerTranslator::is_repeated(std::string_view name, std::int32_t number, Nanoseconds stamp_ns) const {
    const auto is_it = [&](const std::optional<TrackedSource>& source, const Body& body) {
        return source && source->name == name && source->number == number && body.stamp_ns == stamp_ns;
    };
    bool repeated = is_it(bodies_.head, head_);
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand)
        repeated = repeated || is_it(bodies_.wands[wand], wands_[wand]);
    return repeated;
}

void TrackerTranslator::pose(std::string_view name, std::int32_t number, const Pose& pose_system, bool is_tracked,
                             Nanoseconds time_ns, std::optional<Nanoseconds> stamp_ns) {
    note_seen(name, number, time_ns);
    if (!is_known(name, number)) return;
    if (stamp_ns) {
        if (is_repeated(name, number, *stamp_ns)) return note_repeat(name, number);
        const Nanoseconds late_ns = delay_.note(*stamp_ns, time_ns);
        if (late_ns > kStale_ns) {
            refuse(formatted("sends poses of %.*s/%d that are %.1f s late: they are lost until they are newer",
                             static_cast<int>(name.size()), name.data(), number, seconds(late_ns)),
                   time_ns);
            is_tracked = false;
        }
    }
    std::optional<TimedPose> body_tracker;
    if (is_tracked) {
        const std::optional<Pose> pose_tracker = in_tracker(pose_system);
        if (!pose_tracker)
            return refuse("sends a pose of " + std::string(name) + formatted("/%d", number) +
                              " that is none: a place within 1 km in metres, and a quaternion of length 1",
                          time_ns);
        body_tracker = {time_ns, *pose_tracker};
    }
    const TrackedSource said{std::string(name), number};
    const auto tell = [&](Body& body, const TrackedMount& mount, std::optional<std::uint32_t> wand) {
        body.heard_ns = time_ns;
        body.stamp_ns = stamp_ns;
        body.repeats = 0;
        report(body, mount, body_tracker, wand, time_ns);
    };
    if (bodies_.head == said) tell(head_, bodies_.head_mount, std::nullopt);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand)
        if (bodies_.wands[wand] == said) tell(wands_[wand], bodies_.wand_mounts[wand], wand);
}

bool TrackerTranslator::lose_stopped(Nanoseconds time_ns) {
    bool any = false;
    const auto look = [&](Body& body, const std::optional<TrackedSource>& source, std::optional<std::uint32_t> wand) {
        if (!source || !body.is_tracked || time_ns - body.heard_ns <= kStopped_ns) return;
        any = true;
        report(body, {}, {}, wand, time_ns);
        const std::string which = source->name + formatted("/%d", source->number);
        to_.say("tracker " + where_ + ": " +
                (body.repeats > 0
                     ? "poses of " + which +
                           " come with a time stamp that never changes, as of a clock that "
                           "stands still: it is lost where it was"
                     : "no new pose of " + which +
                           formatted(" has come for %.0f s: it is lost where it was", seconds(kStopped_ns))));
    };
    look(head_, bodies_.head, std::nullopt);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand) look(wands_[wand], bodies_.wands[wand], wand);
    return any;
}

void TrackerTranslator::note_repeat(std::string_view name, std::int32_t number) {
    const auto count = [&](Body& body, const std::optional<TrackedSource>& source) {
        if (source && source->name == name && source->number == number) ++body.repeats;
    };
    count(head_, bodies_.head);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand) count(wands_[wand], bodies_.wands[wand]);
}

void TrackerTranslator::note_seen(std::string_view name, std::int32_t number, Nanoseconds time_ns) {
    if (told_of_missing_ || !bodies_.are_named) return;
    const auto is_it = [&](const TrackedSource& source) { return source.name == name && source.number == number; };
    if (std::ranges::none_of(seen_, is_it) && seen_.size() < kMostSeen) seen_.push_back({std::string(name), number});
    if (!first_seen_ns_) first_seen_ns_ = time_ns;
    if (time_ns - *first_seen_ns_ >= kPatience_ns) tell_of_missing();
}

void TrackerTranslator::tell_of_missing() {
    told_of_missing_ = true;
    const auto text_of = [](const TrackedSource& source) { return source.name + formatted("/%d", source.number); };
    std::string missing, seen;
    const auto look = [&](const std::string& part, const std::optional<TrackedSource>& source) {
        if (source && std::ranges::find(seen_, *source) == seen_.end())
            missing += (missing.empty() ? "" : ", ") + part + " = " + text_of(*source);
    };
    look("head", bodies_.head);
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) look(formatted("wand%zu", wand), bodies_.wands[wand]);
    for (const TrackedSource& source : seen_) seen += (seen.empty() ? "" : ", ") + text_of(source);
    if (!missing.empty()) to_.say("tracker " + where_ + ": nothing comes of " + missing + "; what comes is of " + seen);
}

void TrackerTranslator::click(std::size_t wand, std::uint32_t button, bool pressed, Nanoseconds time_ns) {
    const std::uint32_t bit = 1u << button;
    if (((pressed_[wand] & bit) != 0) == pressed) return;
    pressed_[wand] ^= bit;
    to_.push({time_ns, WandClick{static_cast<std::uint32_t>(wand), button, pressed}});
}

void TrackerTranslator::button(std::string_view name, std::int32_t number, bool pressed, Nanoseconds time_ns) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        const auto& source = bodies_.buttons[wand];
        if (!source || source->name != name || number < source->number) continue;
        std::int64_t button = std::int64_t{number} - source->number;
        if (const auto& order = bodies_.button_orders[wand]; !order.empty()) {
            const auto place = std::ranges::find(order, button);
            if (place == order.end()) continue;
            button = place - order.begin();
        }
        if (button < kMostTrackedButtons) click(wand, static_cast<std::uint32_t>(button), pressed, time_ns);
    }
}

void TrackerTranslator::channels(std::string_view name, std::span<const double> values, Nanoseconds time_ns) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        const auto& source = bodies_.sticks[wand];
        if (!source || source->name != name) continue;
        const auto first = static_cast<std::size_t>(source->number);
        if (values.size() < 2 || first > values.size() - 2) {
            refuse("has no channels " + formatted("%zu and %zu", first, first + 1) + " of " + std::string(name),
                   time_ns);
            continue;
        }
        Vec2 stick(values[first], values[first + 1]);
        if (!std::isfinite(stick.x) || !std::isfinite(stick.y)) {
            refuse("sends a stick of " + std::string(name) + " that is no number", time_ns);
            continue;
        }
        stick = glm::clamp(stick, Vec2(-1.0), Vec2(1.0));
        if (stick == sticks_[wand]) continue;
        sticks_[wand] = stick;
        to_.push({time_ns, WandStick{static_cast<std::uint32_t>(wand), stick}});
    }
}

void TrackerTranslator::lose_all(Nanoseconds time_ns) {
    report(head_, {}, {}, std::nullopt, time_ns);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand) {
        report(wands_[wand], {}, {}, wand, time_ns);
        for (std::uint32_t button = 0; button < static_cast<std::uint32_t>(kMostTrackedButtons); ++button)
            click(wand, button, false, time_ns);
        if (std::exchange(sticks_[wand], Vec2(0.0)) != Vec2(0.0)) to_.push({time_ns, WandStick{wand, Vec2(0.0)}});
    }
}

}  // namespace burin::devices
