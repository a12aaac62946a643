// SPDX-License-Identifier: MIT
#include "activities/wand/pressed_cube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "base/try.hpp"
#include "haptics/tick_record.hpp"

namespace burin::activities {
namespace {

// ---- The hand's way

constexpr double kApart_m = 0.02;    // of the balls from the face before a press
constexpr double kPress_m = 0.012;   // how far the hand means to go beyond touching
constexpr double kSink_m = 0.03;     // beside the cube: how far the wand is carried past the face
constexpr double kBeside_m = 0.008;  // below the cube's edge: where the middle passes
constexpr double kLean_rad = std::numbers::pi / 5.0;
constexpr double kTravel_s = 1.0, kPush_s = 0.6, kHold_s = 1.0;
constexpr double kSettles_s = 0.4, kMeasured_s = 0.5;  // of the time in which it holds

struct Press {
    CubeCase which = CubeCase::top;
    Vec3 before_m{0.0}, pressed_m{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};  // while it is pressed
};

struct Way {
    std::vector<devices::HandPose> script;           // in the scene's frame
    std::vector<std::pair<CubeCase, double>> holds;  // when each hold begins
};

// Goes to each place before the cube, presses, holds, and comes back.
Way way_along(const std::vector<Press>& presses) {
    Way way;
    double time_s = 0.0;
    const auto go = [&](const Vec3& place_m, const Quat& orientation, double duration_s) {
        time_s += duration_s;
        way.script.push_back({time_s, place_m, orientation, 0});
    };
    const Quat upright(1.0, 0.0, 0.0, 0.0);
    way.script.push_back({0.0, presses.front().before_m, upright, 0});
    for (const Press& press : presses) {
        go(press.before_m, upright, kTravel_s);
        go(press.pressed_m, press.orientation, kPush_s);
        way.holds.emplace_back(press.which, time_s);
        go(press.pressed_m, press.orientation, kHold_s);
        go(press.before_m, upright, kPush_s);
    }
    go(presses.back().before_m, upright, 0.3);
    return way;
}

// ---- The cube and the wand before it

struct Setup {
    Box cube;
    double arm_m = 0.0;  // from the middle to either end
    double radius_m = 0.0;
    [[nodiscard]] double face_m() const { return cube.lo.z; }
    [[nodiscard]] Vec3 before(double height_m) const {
        return {cube.center().x, height_m, face_m() - radius_m - kApart_m};
    }
    [[nodiscard]] Vec3 pressed(double height_m, double by_m) const {
        return {cube.center().x, height_m, face_m() - radius_m + by_m};
    }
};

std::vector<Press> with_both_ends(const Setup& s) {
    const double middle_m = s.cube.center().y;
    std::vector<Press> presses;
    for (const auto& [which, height_m] :
         {std::pair(CubeCase::top, middle_m - s.arm_m), std::pair(CubeCase::bottom, middle_m + s.arm_m),
          std::pair(CubeCase::both, middle_m)})
        presses.push_back({which, s.before(height_m), s.pressed(height_m, kPress_m)});
    return presses;
}

std::vector<Press> with_the_middle(const Setup& s) {
    const double below_m = s.cube.lo.y - s.radius_m - kBeside_m, middle_m = s.cube.center().y;
    return {{CubeCase::beside, s.before(below_m), s.pressed(below_m, kSink_m)},
            {CubeCase::against, s.before(middle_m), s.pressed(middle_m, kPress_m),
             Quat(std::cos(0.5 * kLean_rad), std::sin(0.5 * kLean_rad), 0.0, 0.0)}};
}

Result<void> check_room(const Setup& s, const devices::WandDescription& wand, const Similarity& scene_from_device) {
    const double height_m = s.cube.extent().y;
    const std::string size = formatted("is %.0f mm high", 1e3 * height_m);
    if (height_m < 2.0 * (s.arm_m + s.radius_m))
        return fail("the cube", size, formatted("both ends need a face of %.0f mm", 2e3 * (s.arm_m + s.radius_m)));
    if (0.5 * height_m > 2.0 * s.arm_m - 2.0 * s.radius_m)
        return fail("the cube", size, "one end alone cannot touch a face of that height: make it lower");
    const Box& box = wand.workspace_maker_m;
    const Vec3 half_m = 0.5 * glm::abs(devices::device_axes(wand.axes, box.extent()));
    const Similarity device_from_scene = inverse(scene_from_device);
    std::vector<Press> all = with_both_ends(s);
    for (const Press& press : with_the_middle(s)) all.push_back(press);
    for (const Press& press : all)
        for (const Vec3& place : {press.before_m, press.pressed_m}) {
            const Vec3 at = glm::abs(device_from_scene * place);
            if (at.x > half_m.x || at.y > half_m.y || at.z > half_m.z)
                return fail("the cube",
                            formatted("with the %s the handle would have to be at %.0f %.0f %.0f mm", text(press.which),
                                      1e3 * place.x, 1e3 * place.y, 1e3 * place.z),
                            "move the cube to where the wand reaches around it");
        }
    return {};
}

// ---- What is kept

class CubeKeeper {
public:
    CubeKeeper(std::vector<CubeTick>& ticks, const devices::WandDescription& wand) : ticks_(ticks) {
        top_m_ = devices::offset_device_m(wand, wand.points.front());
        bottom_m_ = devices::offset_device_m(wand, wand.points.back());
    }

    void add(double time_s, const haptics::TickRecord& record) {
        const Similarity& map = record.motion.object_from_device;
        const auto in_scene = [&](const Vec3& device) { return map.orientation * device; };
        const Vec3& position = record.sample.position_device_m;
        const Quat& orientation = record.sample.orientation_device;
        CubeTick tick;
        tick.time_s = time_s;
        tick.scene_from_handle = {map * position, record.motion.orientation_object};
        tick.top_scene_m = map * (position + orientation * top_m_);
        tick.bottom_scene_m = map * (position + orientation * bottom_m_);
        for (std::uint32_t i = 0; i < record.contact.point_count; ++i) {
            const haptics::PointRecord& point = record.contact.points[i];
            tick.point_forces_N.push_back(in_scene(point.force_device_N));
            tick.touches.push_back(point.constraints > 0);
        }
        tick.share = record.passivity.share;
        tick.force_N = in_scene(record.contact.wrench.force_device_N);
        tick.torque_Nm = in_scene(record.contact.wrench.torque_device_Nm);
        tick.given_force_N = in_scene(record.gate.given.force_device_N);
        tick.given_torque_Nm = in_scene(record.gate.given.torque_device_Nm);
        ticks_.push_back(std::move(tick));
    }

private:
    std::vector<CubeTick>& ticks_;
    Vec3 top_m_, bottom_m_;
};

CubeMeasure measured(CubeCase which, double hold_s, const std::vector<CubeTick>& ticks, const Setup& setup) {
    CubeMeasure m;
    m.which = which;
    m.from_s = hold_s + kSettles_s;
    m.to_s = m.from_s + kMeasured_s;
    std::vector<const CubeTick*> held;
    for (const CubeTick& tick : ticks)
        if (tick.time_s >= m.from_s && tick.time_s < m.to_s) held.push_back(&tick);
    m.ticks = held.size();
    if (held.empty()) return m;
    const double share = 1.0 / static_cast<double>(held.size());
    m.mean = *held[held.size() / 2];
    for (Vec3* sum : {&m.mean.force_N, &m.mean.torque_Nm, &m.mean.given_force_N, &m.mean.given_torque_Nm})
        *sum = Vec3(0.0);
    for (Vec3& force : m.mean.point_forces_N) force = Vec3(0.0);
    for (const CubeTick* tick : held) {
        m.mean.force_N += share * tick->force_N;
        m.mean.torque_Nm += share * tick->torque_Nm;
        m.mean.given_force_N += share * tick->given_force_N;
        m.mean.given_torque_Nm += share * tick->given_torque_Nm;
        for (std::size_t i = 0; i < m.mean.point_forces_N.size(); ++i)
            m.mean.point_forces_N[i] += share * tick->point_forces_N[i];
        m.sunk_top_m += share * std::max(0.0, tick->top_scene_m.z - setup.face_m());
    }
    return m;
}

// ---- What is expected

constexpr double kLeast_N = 0.2;  // a force that a hand feels, well above the arm's quantum
constexpr double kAlone = 0.01;   // the most of another component, as a share of the one that is expected
constexpr double kBalanced =
    0.05;  // the most by which two differ that are alike: friction holds the wand in either place
constexpr double kCancelled =
    0.1;  // the most that is left where two cancel: the arm's friction turns it back no farther

std::string in_newtons(const Vec3& f) { return formatted("%.3f %.3f %.3f N", f.x, f.y, f.z); }
std::string in_newton_millimetres(const Vec3& t) {
    return formatted("%.1f %.1f %.1f N mm", 1e3 * t.x, 1e3 * t.y, 1e3 * t.z);
}

class CubeJudge {
public:
    explicit CubeJudge(const std::vector<CubeMeasure>& measures) : measures_(measures) {}

    std::vector<CubeFinding> all() {
        const double top = of(CubeCase::top).torque_Nm.x, bottom = of(CubeCase::bottom).torque_Nm.x;
        for (const CubeCase which : {CubeCase::top, CubeCase::bottom, CubeCase::both}) {
            const CubeTick& m = of(which);
            const Vec3& f = m.given_force_N;
            add(which, "force along z alone, to -z: the cube pushes the wand back", in_newtons(f),
                f.z < -kLeast_N && std::hypot(f.x, f.y) <= kAlone * std::abs(f.z));
            const Vec3 arm_sum = torque_of(m);
            add(which, "torque is the sum of r x F",
                in_newton_millimetres(m.torque_Nm) +
                    formatted("; the energy account affords %.0f %% of it", 1e2 * m.share),
                glm::length(m.torque_Nm - arm_sum) <= kBalanced * 0.08 * kLeast_N);
        }
        add(CubeCase::top, "the bottom end does not touch", touching(CubeCase::top), touch(CubeCase::top, true, false));
        add(CubeCase::top, "negative torque about x", in_newton_millimetres(of(CubeCase::top).given_torque_Nm),
            of(CubeCase::top).given_torque_Nm.x < 0.0 && is_about_x(CubeCase::top));
        add(CubeCase::bottom, "the top end does not touch", touching(CubeCase::bottom),
            touch(CubeCase::bottom, false, true));
        add(CubeCase::bottom, "positive torque about x", in_newton_millimetres(of(CubeCase::bottom).given_torque_Nm),
            of(CubeCase::bottom).given_torque_Nm.x > 0.0 && is_about_x(CubeCase::bottom));
        add(CubeCase::bottom, "as large as with the top end, the other way round",
            formatted("%.1f and %.1f N mm", 1e3 * top, 1e3 * bottom),
            std::abs(top + bottom) <= kBalanced * std::abs(top));
        add(CubeCase::both, "both ends touch", touching(CubeCase::both), touch(CubeCase::both, true, true));
        add(CubeCase::both, "their torques cancel", in_newton_millimetres(of(CubeCase::both).given_torque_Nm),
            glm::length(of(CubeCase::both).given_torque_Nm) <= kCancelled * std::abs(top));
        judge_middle();
        return std::move(findings_);
    }

private:
    void judge_middle() {
        const CubeMeasure& beside = measure(CubeCase::beside);
        add(CubeCase::beside, "the top end sinks in, and there is no force",
            formatted("%.1f mm deep, ", 1e3 * beside.sunk_top_m) + in_newtons(beside.mean.given_force_N),
            beside.sunk_top_m > 0.01 && beside.mean.given_force_N == Vec3(0.0) &&
                beside.mean.given_torque_Nm == Vec3(0.0));
        const CubeMeasure& against = measure(CubeCase::against);
        add(CubeCase::against, "the middle is held, the top end sinks in, and there is no torque",
            formatted("%.1f mm deep, %.3f N along z, ", 1e3 * against.sunk_top_m, against.mean.given_force_N.z) +
                in_newton_millimetres(against.mean.given_torque_Nm),
            against.sunk_top_m > 0.01 && against.mean.given_force_N.z < -kLeast_N &&
                against.mean.given_torque_Nm == Vec3(0.0));
    }

    [[nodiscard]] const CubeMeasure& measure(CubeCase which) const {
        return measures_[static_cast<std::size_t>(which)];
    }
    [[nodiscard]] const CubeTick& of(CubeCase which) const { return measure(which).mean; }
    // Computes the torque from the ends' places and forces, apart from the tick; as much of it as is afforded.
    [[nodiscard]] static Vec3 torque_of(const CubeTick& m) {
        Vec3 sum(0.0);
        const std::array arms{m.top_scene_m - m.scene_from_handle.position_m,
                              m.bottom_scene_m - m.scene_from_handle.position_m};
        for (std::size_t i = 0; i < std::min(arms.size(), m.point_forces_N.size()); ++i)
            sum += m.share * glm::cross(arms[i], m.point_forces_N[i]);
        return sum;
    }
    [[nodiscard]] bool is_about_x(CubeCase which) const {
        const Vec3& t = of(which).given_torque_Nm;
        return std::hypot(t.y, t.z) <= kAlone * std::abs(t.x);
    }
    [[nodiscard]] bool touch(CubeCase which, bool top, bool bottom) const {
        const std::vector<bool>& touches = of(which).touches;
        return touches.size() == 2 && touches[0] == top && touches[1] == bottom;
    }
    [[nodiscard]] std::string touching(CubeCase which) const {
        std::string said;
        for (const bool touches : of(which).touches)
            said += std::string(said.empty() ? "top " : ", bottom ") + (touches ? "touches" : "does not touch");
        return said;
    }
    void add(CubeCase which, std::string expected, std::string found, bool holds) {
        findings_.push_back({which, std::move(expected), std::move(found), holds});
    }

    const std::vector<CubeMeasure>& measures_;
    std::vector<CubeFinding> findings_;
};

}  // namespace

const char* text(CubeCase which) noexcept {
    switch (which) {
        case CubeCase::top: return "top end alone";
        case CubeCase::bottom: return "bottom end alone";
        case CubeCase::both: return "both ends";
        case CubeCase::beside: return "middle alone beside the cube";
        case CubeCase::against: return "middle alone against the cube";
    }
    return "unknown case";
}

bool PressedCube::holds() const { return !findings.empty() && std::ranges::all_of(findings, &CubeFinding::holds); }

std::vector<CubeFinding> findings_of(const std::vector<CubeMeasure>& measures) {
    return measures.size() == kCubeCases ? CubeJudge(measures).all() : std::vector<CubeFinding>{};
}

Result<PressedCube> press_cube(const ExploredWorld& world, const Box& cube_scene_m,
                               const devices::WandDescription& wand, double radius_m) {
    if (wand.points.size() < 2) return fail(wand.name, "has no two points", "describe its ends as [[point]]");
    WandOptions options;
    options.wand = wand;
    options.radius_m = radius_m;
    options.scene_from_device = devices::scene_from_device(wand);
    const Vec3 ends_m =
        devices::offset_device_m(wand, wand.points.front()) - devices::offset_device_m(wand, wand.points.back());
    const Setup setup{cube_scene_m, 0.5 * options.scene_from_device.scale * glm::length(ends_m), radius_m};
    BURIN_TRY_DO(check_room(setup, wand, options.scene_from_device));

    PressedCube test;
    test.face_m = setup.face_m();
    const auto lead = [&](const std::vector<Press>& presses, std::vector<CubeTick>& ticks) -> Result<WandRun> {
        CubeKeeper keeper(ticks, wand);
        const Way way = way_along(presses);
        Result<WandRun> run =
            run_wand(world, script_in_device(way.script, options.scene_from_device), options,
                     [&](double time_s, const haptics::TickRecord& record) { keeper.add(time_s, record); }, {});
        for (const auto& [which, hold_s] : way.holds) test.measures.push_back(measured(which, hold_s, ticks, setup));
        return run;
    };
    options.points = {wand.points.front(), wand.points.back()};
    BURIN_TRY(two, lead(with_both_ends(setup), test.two_points));
    options.points = {{"centre", Vec3(0.0)}};
    BURIN_TRY(one, lead(with_the_middle(setup), test.one_point));
    test.two_points_run = two;
    test.one_point_run = one;
    test.findings = findings_of(test.measures);
    return test;
}

}  // namespace burin::activities
