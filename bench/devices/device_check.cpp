// SPDX-License-Identifier: MIT
#include "bench/devices/device_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/text.hpp"
#include "bench/devices/tap_series.hpp"
#include "haptics/stability/safety_gate.hpp"

namespace burin::bench {
namespace {

using devices::DeviceFault;
using devices::DeviceSample;

constexpr Nanoseconds kCheckTick_ns = 1'000'000;
constexpr double kShow_s = 0.1;

const char* words_for(DeviceFault fault) {
    switch (fault) {
        case DeviceFault::none: return "no fault";
        case DeviceFault::disconnected: return "it does not answer";
        case DeviceFault::overheated: return "its motors are warm";
        case DeviceFault::overspeed: return "it was moved too fast";
        case DeviceFault::other: return "it reports a fault";
        case DeviceFault::motors_off: return "its motors are off";
        case DeviceFault::force_differs: return "it gives another force than it is told";
        case DeviceFault::false_reading: return "a joint of it reads what none can be";
    }
    return "";
}

std::string millimetres(const Vec3& v_m) {
    return formatted("%.0f x %.0f x %.0f mm", 1000.0 * v_m.x, 1000.0 * v_m.y, 1000.0 * v_m.z);
}
Json numbers(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

// One part of the device, and the gate before its motors.
struct CheckedPart {
    devices::HapticDevice* device = nullptr;
    std::string of;  // " of index"; empty: the only one
    DeviceSample sample;
    Vec3 velocity_m_per_s{0.0}, last_m{0.0}, wanted_N{0.0};
    haptics::GateState gate;
    double let_through = 0.0;  // the share of a wanted force that the gate lets through
};

class DeviceCheck {
public:
    DeviceCheck(devices::OpenedDevice& device, Clock& clock, CheckGuide& guide, const CheckOptions& options)
        : device_(device), clock_(clock), guide_(guide), options_(options), random_(options.seed) {
        for (const devices::DevicePart& part : device.parts)
            parts_.push_back(
                {part.device.get(), part.name.empty() ? std::string() : " of " + part.name, {}, {}, {}, {}, {}, {}});
        // Gentle: a newton comes in a twentieth of a second.
        limits_.max_slew_N_per_s = 20.0;
        limits_.max_force_N = options.force_N;
    }

    std::vector<CheckLine> run() {
        if (answers()) {
            for (CheckedPart& part : parts_) position(part);
            buttons();
            if (options_.pushes) forces();
        }
        rest();
        steadiness();
        return std::move(lines_);
    }

private:
    // Takes all parts on by a tick, each with the force that is wanted of it as the gate lets it through.
    void tick() {
        due_ns_ = std::max(due_ns_ + kCheckTick_ns, clock_.now_ns());
        clock_.sleep_until(due_ns_);
        const Nanoseconds now_ns = clock_.now_ns();
        const double gap_s = last_ns_ > 0 ? seconds(now_ns - last_ns_) : 0.0, dt_s = std::max(gap_s, 1e-4);
        last_ns_ = now_ns;
        for (CheckedPart& part : parts_) part.sample = part.device->read();
        bool is_well = true;
        for (CheckedPart& part : parts_) {
            is_well = is_well && part.sample.fault == DeviceFault::none;
            write(part, now_ns, gap_s, dt_s);
        }
        if (has_answered_) {
            ++ticks_;
            faulty_ += is_well ? 0 : 1;
        }
        for (std::string& message : taken_messages()) messages_.push_back(std::move(message));
        said_ = guide_.answers(now_ns);
        ends_ = ends_ || said_.ends;
    }

    void write(CheckedPart& part, Nanoseconds now_ns, double gap_s, double dt_s) {
        const devices::DeviceDescription& about = part.device->description();
        const Vec3& place_m = part.sample.position_device_m;
        constexpr double kBand_s = 0.01;
        if (finite(place_m)) {
            const double follows = dt_s / (dt_s + kBand_s);
            part.velocity_m_per_s += follows * ((place_m - part.last_m) / dt_s - part.velocity_m_per_s);
            part.last_m = place_m;
        }
        if (!has_answered_) part.velocity_m_per_s = Vec3(0.0);
        haptics::GateInput input;
        input.wanted.force_device_N = part.wanted_N;
        input.velocity_device_m_per_s = part.velocity_m_per_s;
        input.device_max_force_N = about.max_force_N;
        input.device_axis_max_force_N = about.axis_max_force_N;
        input.drives_device = part.sample.drive.along_device;
        input.sample_age_s = seconds(now_ns - part.sample.time_ns);
        input.loop_gap_s = gap_s;
        input.device_fault = part.sample.fault;
        input.sample_finite = finite(place_m);
        const haptics::GateStep step = haptics::pass_gate(part.gate, input, limits_, dt_s);
        part.gate = step.next;
        part.let_through = step.output.cause == haptics::GateCause::none ? step.next.faded() : 0.0;
        part.device->write(step.output.given);
    }

    std::vector<std::string> taken_messages() {
        return device_.messages != nullptr ? device_.messages->take_messages() : std::vector<std::string>{};
    }

    // Ticks until it is seen, the person goes on or skips, or the time is over; shows what `shown` says.
    bool watch(double most_s, const std::function<bool()>& is_seen, const std::function<std::string()>& shown) {
        const Nanoseconds begun_ns = clock_.now_ns();
        double showed_s = -kShow_s;
        while (!ends_) {
            tick();
            for (; told_ < messages_.size(); ++told_) guide_.say("  " + messages_[told_]);
            const double time_s = seconds(clock_.now_ns() - begun_ns);
            if (time_s - showed_s >= kShow_s) {
                guide_.show(shown());
                showed_s = time_s;
            }
            if (is_seen()) return true;
            if (said_.goes_on || said_.skips || time_s > most_s) return false;
        }
        return false;
    }

    void note(std::string check, Verdict verdict, std::string found, Json figures = Json::object()) {
        guide_.say(formatted("%-8s ", name_of(verdict)) + check + ": " + found);
        lines_.push_back({std::move(check), verdict, std::move(found), std::move(figures)});
    }

    bool answers() {
        const Nanoseconds begun_ns = clock_.now_ns();
        const auto are_well = [&] {
            return std::ranges::all_of(parts_, [](const CheckedPart& part) {
                return part.sample.fault == DeviceFault::none && finite(part.sample.position_device_m);
            });
        };
        const auto first_fault = [&] {
            for (const CheckedPart& part : parts_)
                if (part.sample.fault != DeviceFault::none) return words_for(part.sample.fault);
            return "its position is no number";
        };
        constexpr double kPatient_s = 30.0;
        const bool is_well = watch(options_.by_itself ? 5.0 : kPatient_s, are_well,
                                   [&] { return std::string("waits: ") + first_fault(); });
        const double took_s = seconds(clock_.now_ns() - begun_ns);
        if (is_well)
            note("answers", Verdict::passed, formatted("well after %.2f s", took_s), {{"seconds", took_s}});
        else
            note("answers", Verdict::failed,
                 first_fault() + (messages_.empty() ? std::string() : "; " + messages_.back()));
        has_answered_ = is_well;
        return is_well && !ends_;
    }

    void position(CheckedPart& part) {
        if (ends_) return note("position" + part.of, Verdict::skipped, "the check was ended");
        const Vec3& box_m = part.device->description().workspace_m;
        // A person goes through half of the box at least; a script shows that it moves at all.
        const Vec3 enough_m = options_.by_itself ? Vec3(0.001) : 0.5 * box_m;
        if (!options_.by_itself)
            guide_.say("Move the handle" + part.of + " to all its ends; Enter goes on, s skips, q ends.");
        constexpr double kMost = std::numeric_limits<double>::infinity();
        Vec3 lowest_m(kMost), highest_m(-kMost);
        bool is_within = true;
        const bool is_seen = watch(
            options_.watch_s,
            [&] {
                const Vec3& place_m = part.sample.position_device_m;
                if (part.sample.fault != DeviceFault::none || !finite(place_m)) return false;
                lowest_m = glm::min(lowest_m, place_m);
                highest_m = glm::max(highest_m, place_m);
                for (int axis = 0; axis < 3; ++axis) is_within = is_within && std::abs(place_m[axis]) <= box_m[axis];
                if (!options_.by_itself) return false;
                return glm::all(glm::greaterThanEqual(highest_m - lowest_m, enough_m));
            },
            [&] {
                const Vec3& p = part.sample.position_device_m;
                return formatted("  at %6.1f %6.1f %6.1f mm, seen ", 1000.0 * p.x, 1000.0 * p.y, 1000.0 * p.z) +
                       millimetres(glm::max(highest_m - lowest_m, Vec3(0.0)));
            });
        static_cast<void>(is_seen);
        if (said_.skips) return note("position" + part.of, Verdict::skipped, "skipped");
        const Vec3 seen_m = highest_m.x >= lowest_m.x ? highest_m - lowest_m : Vec3(0.0);
        const bool is_enough = glm::all(glm::greaterThanEqual(seen_m, enough_m));
        std::string found = "moved through " + millimetres(seen_m) + " of " + millimetres(box_m);
        if (!is_enough) found += options_.by_itself ? "; along some axis not at all" : "; of some axis less than half";
        if (!is_within) found += "; it was farther out than twice its box";
        note("position" + part.of, is_enough && is_within ? Verdict::passed : Verdict::failed, found,
             {{"lowest_m", numbers(lowest_m)}, {"highest_m", numbers(highest_m)}, {"workspace_m", numbers(box_m)}});
    }

    void buttons() {
        if (ends_) return note("buttons", Verdict::skipped, "the check was ended");
        const auto has_none = [](const CheckedPart& part) { return !part.device->description().has_buttons; };
        if (std::ranges::all_of(parts_, has_none)) return note("buttons", Verdict::skipped, "it has none");
        if (!options_.by_itself) guide_.say("Press each of its buttons; Enter goes on, s skips, q ends.");
        std::uint32_t seen = 0;
        watch(
            options_.watch_s,
            [&] {
                seen |= parts_.front().sample.buttons;
                return options_.by_itself && seen != 0;
            },
            [&] { return formatted("  down %04x, seen %04x", parts_.front().sample.buttons, seen); });
        if (said_.skips) return note("buttons", Verdict::skipped, "skipped");
        std::string names;
        for (int bit = 0; bit < 32; ++bit)
            if ((seen >> bit & 1u) != 0) names += (names.empty() ? "" : ", ") + std::to_string(bit + 1);
        note("buttons", seen != 0 ? Verdict::passed : Verdict::failed, seen != 0 ? "seen: " + names : "none was seen",
             {{"seen", seen}});
    }

    void forces() {
        guide_.say(
            formatted("The order of taps is that of --seed %llu.", static_cast<unsigned long long>(options_.seed)));
        for (CheckedPart& part : parts_) force(part);
    }

    void force(CheckedPart& part) {
        if (const char* const led_by = part.device->description().led_by; *led_by != '\0')
            return note("force" + part.of, Verdict::skipped,
                        std::string("nobody would feel it: what feels is simulated, and led by ") + led_by);
        if (!part.device->description().gives_way)
            return note(
                "force" + part.of, Verdict::skipped,
                "its simulated fingers hold against a gentle force: it shows on a glove's line, real or emulated");
        if (part.device->description().drives_one_way) return tap(part, 0, "outwards");
        tap(part, 0, "to the right and left");
        tap(part, 1, "up and down");
        tap(part, 2, "to you and away");
    }

    // Taps along an axis until it is known whether the handle feels it, and lets go of it.
    void tap(CheckedPart& part, int axis, const char* way) {
        const std::string check = std::string("force ") + way + part.of;
        if (ends_) return note(check, Verdict::skipped, "the check was ended");
        const devices::DeviceDescription& about = part.device->description();
        const double most_N = std::min(options_.force_N, about.max_force_N);
        if (!options_.by_itself)
            guide_.say(formatted("Hold the handle loosely, and hold the space bar: it taps with %.1f N ", most_N) +
                       way + part.of + "; s skips, q ends.");
        TapSeries series(
            {axis, about.drives_one_way, working_m(most_N, about.friction_N, about.drives_one_way), about.resolution_m},
            random_);
        DeviceFault interrupts = DeviceFault::none;
        bool is_held = false;
        auto is_gone = [&, well_ns = clock_.now_ns()]() mutable {
            if (part.sample.fault == DeviceFault::none) well_ns = clock_.now_ns();
            return options_.by_itself && seconds(clock_.now_ns() - well_ns) > 5.0;
        };
        watch(
            options_.by_itself ? 30.0 : 90.0,  // the taps take 12 s at most, and begin anew after a fault
            [&] {
                is_held = (options_.by_itself || said_.holds) && part.sample.fault == DeviceFault::none;
                if (part.sample.fault != DeviceFault::none) interrupts = part.sample.fault;
                part.wanted_N = Vec3(0.0);
                if (is_held)
                    part.wanted_N = most_N * tapped(part, axis, series);
                else if (series.has_begun())
                    series.restart();
                return series.is_over() || is_gone();
            },
            [&] {
                return is_held ? formatted("  taps, %zu of %zu at most", series.count(), kMostTaps)
                               : std::string("  waits for the space bar");
            });
        part.wanted_N = Vec3(0.0);
        if (series.is_over()) return note_taps(check, series, most_N, about);
        if (said_.skips || ends_) return note(check, Verdict::skipped, "skipped");
        note(check, Verdict::failed,
             interrupts != DeviceFault::none ? std::string("was not finished; in between ") + words_for(interrupts)
                                             : "was not finished: the space bar was not held for long enough");
    }

    // Takes the series on by a tick. Returns the direction of the force, or zero.
    Vec3 tapped(const CheckedPart& part, int axis, TapSeries& series) const {
        const devices::OneWayDrive& drive = part.sample.drive;
        const bool is_one_way = part.device->description().drives_one_way;
        // A piston's length does not know how the hand moves as a whole.
        const Vec3 place_m = is_one_way ? Vec3(drive.length_m, 0.0, 0.0) : part.sample.position_device_m;
        const int way = series.tick({seconds(clock_.now_ns()), place_m, part.let_through});
        Vec3 along(0.0);
        along[axis] = 1.0;
        return static_cast<double>(way) * (is_one_way ? drive.along_device : along);
    }

    void note_taps(const std::string& check, const TapSeries& series, double most_N,
                   const devices::DeviceDescription& about) {
        const TapAnswer& answer = series.answer();
        const Json figures{{"force_N", most_N},       {"gives_way_m", answer.moved_m}, {"doubt_m", answer.doubt_m},
                           {"sway_m", answer.sway_m}, {"taps", series.count()},        {"seed", options_.seed}};
        const std::string moved =
            formatted(about.drives_one_way ? "%.1f N move it by %.2f mm, give or take %.2f mm"
                                           : "%.1f N either way move it by %.2f mm, give or take %.2f mm",
                      most_N, 1000.0 * answer.moved_m, 1000.0 * answer.doubt_m);
        switch (answer.finding) {
            case TapFinding::felt: return note(check, Verdict::passed, moved, figures);
            case TapFinding::against: return note(check, Verdict::failed, moved + ": against the force", figures);
            case TapFinding::elsewhere:
                return note(check, Verdict::failed, moved + ", and farther along another axis", figures);
            case TapFinding::absent:
                return note(check, Verdict::failed, moved + ": it does not feel the force, or is held fast", figures);
            case TapFinding::unclear: break;
        }
        const bool is_weak = working_m(most_N, about.friction_N, about.drives_one_way) <= 0.0;
        note(check, Verdict::unclear,
             moved + (is_weak ? ": cannot tell: so little may not overcome the arm's friction; give more --force"
                              : ": cannot tell: hold it stiller"),
             figures);
    }

    // Takes the force off before anybody goes on.
    void rest() {
        constexpr int kTicks = 200;
        for (CheckedPart& part : parts_) part.wanted_N = Vec3(0.0);
        for (int i = 0; i < kTicks; ++i) tick();
    }

    void steadiness() {
        if (!has_answered_) return;
        const double share = static_cast<double>(faulty_) / std::max(1.0, static_cast<double>(ticks_));
        constexpr double kMost = 0.05;
        std::string found = formatted("%lld of %lld ticks with a fault", static_cast<long long>(faulty_),
                                      static_cast<long long>(ticks_));
        if (faulty_ > 0 && !messages_.empty()) found += "; " + messages_.back();
        note("steadiness", share <= kMost ? Verdict::passed : Verdict::failed, found,
             {{"ticks", ticks_}, {"faulty", faulty_}});
    }

    devices::OpenedDevice& device_;
    Clock& clock_;
    CheckGuide& guide_;
    CheckOptions options_;
    std::mt19937_64 random_;
    haptics::GateLimits limits_;
    std::vector<CheckedPart> parts_;
    std::vector<CheckLine> lines_;
    std::vector<std::string> messages_;
    std::size_t told_ = 0;
    CheckAnswers said_;
    Nanoseconds due_ns_ = 0, last_ns_ = 0;
    std::int64_t ticks_ = 0, faulty_ = 0;
    bool ends_ = false, has_answered_ = false;
};

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::passed: return "passed";
        case Verdict::failed: return "failed";
        case Verdict::skipped: return "skipped";
        case Verdict::unclear: return "unclear";
    }
    return "";
}

std::string checks_with(Verdict verdict, const std::vector<CheckLine>& lines) {
    std::string names;
    for (const CheckLine& line : lines)
        if (line.verdict == verdict) names += (names.empty() ? "" : ", ") + line.check;
    return names;
}

Result<int> outcome_of(const std::string& where, const std::vector<CheckLine>& lines) {
    if (const std::string failed = checks_with(Verdict::failed, lines); !failed.empty())
        return fail(where, "failed: " + failed, "the lines above say what was found");
    return checks_with(Verdict::unclear, lines).empty() ? 0 : kCannotTell;
}

std::vector<CheckLine> check_device(devices::OpenedDevice& device, Clock& clock, CheckGuide& guide,
                                    const CheckOptions& options) {
    return DeviceCheck(device, clock, guide, options).run();
}

}  // namespace burin::bench
