// SPDX-License-Identifier: MIT
#include "wall/head_prediction.hpp"

#include <algorithm>
#include <span>

#include "base/error.hpp"
#include "base/pose_motion.hpp"
#include "base/space.hpp"
#include "base/text.hpp"

namespace burin::wall {
namespace {

Vec3 shrunk(const Vec3& v, double by) {
    const double l = glm::length(v);
    return l <= by ? Vec3(0.0) : v * ((l - by) / l);
}

bool usable(const Pose& p) {
    const Quat& q = p.orientation;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return finite(p.position_m) && std::isfinite(length) && length > 1e-9;
}

struct Speed {
    double m_per_s, rad_per_s;
};

Speed speed_between(const TrackerSample& a, const TrackerSample& b) {
    const double dt_s = seconds(b.time_ns - a.time_ns);
    return {glm::length(b.sensor_tracker.position_m - a.sensor_tracker.position_m) / dt_s,
            glm::length(rotation_vector_between(a.sensor_tracker.orientation, b.sensor_tracker.orientation)) / dt_s};
}

bool follows(const HeadSettings& s, const TrackerSample& a, const TrackerSample& b) {
    if (b.time_ns <= a.time_ns) return false;
    const Speed speed = speed_between(a, b);
    return speed.m_per_s <= s.max_speed_m_per_s && speed.rad_per_s <= s.max_turn_rad_per_s;
}

void accept(HeadTrack& track, const TrackerSample& sample) {
    if (track.count == HeadTrack::kMostSamples) {
        std::shift_left(track.samples.begin(), track.samples.end(), 1);
        --track.count;
    }
    track.samples[static_cast<std::size_t>(track.count++)] = sample;
    track.pending_run = 0;
    track.fault = SampleFault::none;
}

// Records why a sample is not accepted after the newest one.
void note_fault(const HeadSettings& s, HeadTrack& track, const TrackerSample& newest, const TrackerSample& sample) {
    if (sample.time_ns <= newest.time_ns) {
        track.fault = SampleFault::back_in_time;
        track.fault_back_s = seconds(newest.time_ns - sample.time_ns);
        return;
    }
    const Speed speed = speed_between(newest, sample);
    track.fault = SampleFault::too_fast;
    track.fault_turned = speed.m_per_s <= s.max_speed_m_per_s;
    track.fault_speed = track.fault_turned ? speed.rad_per_s : speed.m_per_s;
}

void await_confirmation(const HeadSettings& s, HeadTrack& track, const TrackerSample& sample) {
    track.pending_run = track.pending_run > 0 && follows(s, track.pending, sample) ? track.pending_run + 1 : 1;
    track.pending = sample;
    if (track.pending_run < kSamplesToTrust) return;
    track.count = 0;
    accept(track, sample);
}

PoseVelocity velocity_of(const HeadSettings& s, const HeadTrack& track) {
    std::array<TimedPose, HeadTrack::kMostSamples> poses;
    const auto count = static_cast<std::size_t>(track.count);
    for (std::size_t i = 0; i < count; ++i) poses[i] = {track.samples[i].time_ns, track.samples[i].sensor_tracker};
    return burin::velocity_of({s.velocity_window_ns, s.end_of_prediction_ns, s.max_speed_m_per_s, s.max_turn_rad_per_s},
                              std::span(poses).first(count));
}

// The integral of the velocity's weight over the time since the newest sample.
double seconds_ahead(const HeadSettings& s, Nanoseconds since_ns) {
    if (since_ns <= s.full_prediction_ns) return seconds(since_ns);
    const double full_s = seconds(s.full_prediction_ns), fall_s = seconds(s.end_of_prediction_ns) - full_s;
    if (!(fall_s > 0.0)) return full_s;
    const double into_s = std::min(seconds(since_ns) - full_s, fall_s);
    return full_s + into_s - into_s * into_s / (2.0 * fall_s);
}

bool is_lost(const HeadSettings& s, const HeadTrack& track, Nanoseconds time_ns) {
    return track.count == 0 ||
           time_ns - track.samples[static_cast<std::size_t>(track.count - 1)].time_ns > s.lost_after_ns;
}

DrawnFrom source_of(const HeadSettings& s, const HeadTrack& track, Nanoseconds time_ns) {
    if (is_lost(s, track, time_ns)) return DrawnFrom::fallback;
    return velocity_of(s, track).known ? DrawnFrom::prediction : DrawnFrom::one_sample;
}

Pose with_offset(const HeadSettings& s, const HeadTrack& track, const Pose& target, Nanoseconds time_ns) {
    const double since_s = seconds(std::max<Nanoseconds>(time_ns - track.offset_ns, 0));
    return {target.position_m + shrunk(track.offset_m, s.glide_m_per_s * since_s),
            glm::normalize(rotation_by(shrunk(track.offset_rad, s.glide_rad_per_s * since_s)) * target.orientation)};
}

// Starts a glide from one pose to the target.
void start_glide(HeadTrack& track, const Pose& target, const Pose& from, Nanoseconds time_ns) {
    track.offset_ns = time_ns;
    track.offset_m = from.position_m - target.position_m;
    track.offset_rad = rotation_vector_between(target.orientation, from.orientation);
}

void keep_continuous(const HeadSettings& s, HeadTrack& track, const Pose& target, bool changed, Nanoseconds time_ns) {
    const Pose candidate = with_offset(s, track, target, time_ns);
    const double dt_s = std::abs(seconds(time_ns - track.drawn_ns));
    const Vec3 step = candidate.position_m - track.drawn_tracker.position_m;
    const Vec3 turn = rotation_vector_between(track.drawn_tracker.orientation, candidate.orientation);
    const double reach_m = s.max_speed_m_per_s * dt_s, reach_rad = s.max_turn_rad_per_s * dt_s;
    if (!changed && glm::length(step) <= reach_m && glm::length(turn) <= reach_rad) return;
    const Vec3 allowed = changed ? Vec3(0.0) : at_most(step, reach_m);
    const Vec3 allowed_turn = changed ? Vec3(0.0) : at_most(turn, reach_rad);
    start_glide(track, target,
                {track.drawn_tracker.position_m + allowed, rotation_by(allowed_turn) * track.drawn_tracker.orientation},
                time_ns);
}

std::string cause_of(const HeadSettings& settings, const HeadTrack& track) {
    switch (track.fault) {
        case SampleFault::none: break;
        case SampleFault::not_a_number:
            return "the tracker's sample is not a number; check its calibration and line of sight";
        case SampleFault::too_far: return too_far_away("the head", track.fault_away_m, settings.farthest_m);
        case SampleFault::back_in_time:
            return formatted("the tracker's time went back by %.3f s; check its clock", track.fault_back_s);
        case SampleFault::too_fast:
            return formatted(track.fault_turned
                                 ? "the tracker turned at %.0f rad/s; look for reflections or a loose sensor"
                                 : "the tracker jumped at %.1f m/s; look for reflections or a loose sensor",
                             track.fault_speed);
    }
    return {};
}

}  // namespace

std::string too_far_away(const std::string& who, double away_m, double farthest_m) {
    const std::string is = formatted("%s is %.0f m away", who.c_str(), away_m);
    if (away_m > 1000.0 * farthest_m) return is + "; check the tracker's calibration";
    return is + ", as if its tracker reported millimetres; say reported_units = \"mm\" in a description of the tracker";
}

HeadSettings head_settings(const WallSetup& setup) {
    HeadSettings settings;
    settings.fallback_tracker = setup.fallback_head_tracker;
    return settings;
}

HeadTrack take(const HeadSettings& settings, HeadTrack track, const TrackerSample& given) {
    if (!usable(given.sensor_tracker)) {
        ++track.refused;
        track.fault = SampleFault::not_a_number;
        track.pending_run = 0;
        return track;
    }
    const double away_m = glm::length(given.sensor_tracker.position_m - settings.fallback_tracker.position_m);
    if (away_m > settings.farthest_m) {
        ++track.refused;
        track.fault = SampleFault::too_far;
        track.fault_away_m = away_m;
        track.pending_run = 0;
        return track;
    }
    TrackerSample sample = given;
    sample.sensor_tracker.orientation = glm::normalize(given.sensor_tracker.orientation);
    if (track.count == 0) {
        accept(track, sample);
        return track;
    }
    const TrackerSample newest = track.samples[static_cast<std::size_t>(track.count - 1)];
    if (sample.time_ns == newest.time_ns) return track;  // the tracker was polled faster than it measures
    if (follows(settings, newest, sample)) {
        accept(track, sample);
        return track;
    }
    ++track.refused;
    note_fault(settings, track, newest, sample);
    await_confirmation(settings, track, sample);
    return track;
}

Pose predicted(const HeadSettings& settings, const HeadTrack& track, Nanoseconds time_ns) {
    BURIN_CHECK(track.count > 0);
    if (track.count == 0) return settings.fallback_tracker;
    const TrackerSample& newest = track.samples[static_cast<std::size_t>(track.count - 1)];
    return moved(newest.sensor_tracker, velocity_of(settings, track),
                 seconds_ahead(settings, time_ns - newest.time_ns));
}

EyeTimes eye_times(const DisplayTiming& timing, Nanoseconds first_field_ns) {
    if (timing.eye_order == EyeOrder::simultaneous) return {first_field_ns, first_field_ns};
    const Nanoseconds second_ns = first_field_ns + nanoseconds(1.0 / timing.refresh_Hz);
    return timing.eye_order == EyeOrder::left_first ? EyeTimes{first_field_ns, second_ns}
                                                    : EyeTimes{second_ns, first_field_ns};
}

DrawnHead draw(const HeadSettings& settings, HeadTrack track, const EyeTimes& times) {
    const bool left_first = times.left_ns <= times.right_ns;
    const Nanoseconds first_ns = std::min(times.left_ns, times.right_ns);
    const Nanoseconds second_ns = std::max(times.left_ns, times.right_ns);
    const DrawnFrom from = source_of(settings, track, first_ns);
    const auto target = [&](Nanoseconds t) {
        return from == DrawnFrom::fallback ? settings.fallback_tracker : predicted(settings, track, t);
    };
    if (track.drawn_before) {
        keep_continuous(settings, track, target(first_ns), from != track.drawn_from, first_ns);
    }
    const Pose first = with_offset(settings, track, target(first_ns), first_ns);
    const Pose second = with_offset(settings, track, target(second_ns), second_ns);
    track.drawn_before = true;
    track.drawn_from = from;
    track.drawn_ns = second_ns;
    track.drawn_tracker = second;
    return {track, left_first ? HeadPoses{first, second} : HeadPoses{second, first}};
}

TrackerReport report(const HeadSettings& settings, const HeadTrack& track, Nanoseconds time_ns) {
    TrackerReport made;
    const double since_s = seconds(std::max<Nanoseconds>(time_ns - track.offset_ns, 0));
    made.gliding = glm::length(track.offset_m) > settings.glide_m_per_s * since_s ||
                   glm::length(track.offset_rad) > settings.glide_rad_per_s * since_s;
    if (track.count == 0) {
        if (track.refused > 0) made.state = TrackerState::jumped;
        made.cause =
            track.refused > 0 ? cause_of(settings, track) : "no sample yet; is the tracker on, and its server running?";
        return made;
    }
    const Nanoseconds age_ns = time_ns - track.samples[static_cast<std::size_t>(track.count - 1)].time_ns;
    made.sample_age_s = seconds(age_ns);
    made.cause = cause_of(settings, track);
    made.state = made.cause.empty() ? TrackerState::ok : TrackerState::jumped;
    if (is_lost(settings, track, time_ns)) {
        made.state = TrackerState::lost;
        if (made.cause.empty()) {
            made.cause = formatted("no sample for %.1f s; check the tracker's line of sight, cable and battery",
                                   made.sample_age_s);
        }
    }
    return made;
}

}  // namespace burin::wall
