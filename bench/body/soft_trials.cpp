// SPDX-License-Identifier: MIT
#include "bench/body/soft_trials.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "bodies/paper/paper_deformation.hpp"
#include "bodies/soft_part.hpp"
#include "bodies/solver/plastic_flow.hpp"
#include "haptics/stability/safety_gate.hpp"

namespace burin::bench {
namespace {

constexpr double kBall_m = 0.03, kFingertip_m = 0.004, kElementsAlong = 3.2;
constexpr Nanoseconds kStep_ns = 4'000'000, kTick_ns = 1'000'000;

bodies::SoftPartSetup ball_of(double young_Pa, double yield_Pa) {
    bodies::SoftPartSetup setup;
    setup.half_axes_m = Vec3(kBall_m);
    setup.spacing_m = kBall_m / kElementsAlong;
    setup.material.young_Pa = young_Pa;
    setup.material.yield_Pa = yield_Pa;
    return setup;
}

// A tick of a fingertip, its middle at a place along an axis from the ball's.
haptics::TickRecord fingertip(const Vec3& axis, double from_middle_m) {
    haptics::TickRecord tick;
    const Vec3 across = std::abs(axis.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 side = glm::normalize(glm::cross(axis, across)), up = glm::cross(axis, side);
    tick.contact.point_count = 5;
    const std::array offs{Vec3(0.0), side, -side, up, -up};
    for (std::size_t i = 0; i < offs.size(); ++i)
        tick.contact.points[i].hip_object_m = from_middle_m * axis + kFingertip_m * offs[i];
    return tick;
}

// A body, and the parts of a hand that press it.
class Pressed {
public:
    explicit Pressed(const bodies::SoftPartSetup& setup) : part_(bodies::SoftPart::create(setup).value()) {}
    void press(std::size_t finger, const haptics::TickRecord& tick) { part_->take_ticks(finger, {&tick, 1}); }
    void update(Nanoseconds by_ns = kStep_ns) { (void)part_->update(now_ns_ += by_ns, nullptr); }
    [[nodiscard]] Vec3 felt_N(std::size_t finger, const haptics::TickRecord& tick, bool by_surface = false) const {
        Vec3 sum(0.0);
        for (geometry::LocalModel model : part_->models(finger)) {
            if (by_surface) model.stiffness_N_per_m = model.surface_N_per_m;
            sum += model.force_at(tick.contact.points[model.point].hip_object_m, now_ns_) * model.normal_object;
        }
        return sum;
    }
    void pinch(const Vec3& axis, double from_middle_m) {
        press(0, fingertip(axis, from_middle_m));
        press(1, fingertip(-axis, from_middle_m));
        update();
    }
    [[nodiscard]] double pinch_N(const Vec3& axis, double from_middle_m) const {
        return glm::length(felt_N(0, fingertip(axis, from_middle_m)));
    }
    [[nodiscard]] bodies::SoftState let_go() const {
        bodies::SoftState state = part_->state();
        bodies::SoftSolver solver;
        for (int i = 0; i < 250; ++i) solver.step(part_->body(), state, {});
        return state;
    }
    [[nodiscard]] const bodies::SoftPart& part() const { return *part_; }
    [[nodiscard]] bodies::VolumeNow volume() const { return bodies::volume_of(part_->body(), part_->state().places_m); }

private:
    std::unique_ptr<bodies::SoftPart> part_;
    Nanoseconds now_ns_ = 0;
};

double dent_m(const bodies::SoftBody& body, const bodies::SoftState& state) {
    const bodies::EmbeddedSurface surface = bodies::ellipsoid_surface(body.rest(), Vec3(kBall_m), 3);
    const std::vector<Vec3> now = bodies::places_of(surface, state.places_m),
                            before = bodies::places_of(surface, body.rest().places_m);
    double top = 0.0, bottom = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i].y > 0.999 * kBall_m) top = now[i].y;
        if (before[i].y < -0.999 * kBall_m) bottom = now[i].y;
    }
    return 2.0 * kBall_m - (top - bottom);
}

double pushed_in_m3(const bodies::PaperSurface& before, const bodies::PaperSurface& now) {
    double sum = 0.0;
    for (std::size_t i = 0; i < now.places_m.size(); ++i)
        sum += before.areas_m2[i] * std::max(0.0, glm::dot(before.places_m[i] - now.places_m[i], before.normals[i]));
    return sum;
}

// The generator's own numbers are prescribed by the standard; its distributions are not.
class Draw {
public:
    double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    Vec3 direction() {
        for (;;) {
            const Vec3 at(2.0 * share() - 1.0, 2.0 * share() - 1.0, 2.0 * share() - 1.0);
            if (const double square = glm::dot(at, at); square > 0.01 && square <= 1.0) return glm::normalize(at);
        }
    }

private:
    std::mt19937_64 random_{1};
};

bodies::PaperSurface paper_ball() {
    const bodies::Tetrahedra body = bodies::ellipsoid(Vec3(kBall_m), kBall_m / kElementsAlong).value();
    const bodies::EmbeddedSurface surface = bodies::ellipsoid_surface(body, Vec3(kBall_m), 4);
    bodies::PaperSurface ball{bodies::places_of(surface, body.places_m), {}, surface.areas_m2};
    for (const Vec3& place : ball.places_m) ball.normals.push_back(glm::normalize(place));
    return ball;
}

}  // namespace

StillPutty hold_putty(double late_s) {
    StillPutty still;
    still.late_s = late_s;
    Pressed putty(ball_of(100e3, 4e3));
    const Vec3 up(0, 1, 0);
    const double in_m = 0.75 * kBall_m;
    for (int i = 0; i < 125; ++i) putty.pinch(up, kBall_m + (in_m - kBall_m) * i / 125.0);
    const auto steps = [](double s) { return static_cast<int>(s / seconds(kStep_ns) + 0.5); };
    for (int i = 0; i < steps(still.early_s); ++i) putty.pinch(up, in_m);
    still.early_dent_m = dent_m(putty.part().body(), putty.let_go());
    still.early_N = putty.pinch_N(up, in_m);
    for (int i = 0; i < steps(late_s - still.early_s); ++i) putty.pinch(up, in_m);
    still.late_dent_m = dent_m(putty.part().body(), putty.let_go());
    still.late_N = putty.pinch_N(up, in_m);
    // The paper's model, a finger 2 mm deep, at 60 frames a second.
    const bodies::PaperSurface ball = paper_ball();
    bodies::PaperPutty paper{ball, {}};
    const std::array point{Vec3(0.0, kBall_m - 0.002, 0.0)};
    const auto frames = static_cast<int>(60.0 * std::min(late_s, 10.0));
    for (int i = 0; i < frames; ++i) {
        paper = bodies::step_putty_of_paper(std::move(paper), point, 0.015, bodies::PaperForm::printed);
        if (i == 0) still.paper_early_m3 = pushed_in_m3(ball, paper.reference);
    }
    still.paper_late_m3 = pushed_in_m3(ball, paper.reference);
    return still;
}

KneadedPutty knead_putty(std::size_t kneads) {
    Pressed putty(ball_of(100e3, 4e3));
    const bodies::SoftBody& body = putty.part().body();
    KneadedPutty all{.kneads = kneads, .elements = body.rest().cells.size()};
    Draw draw;
    const auto begun = std::chrono::steady_clock::now();
    for (std::size_t knead = 0; knead < kneads; ++knead) {
        const Vec3 axis = draw.direction();
        const double deep = 0.275 + 0.275 * draw.share();
        for (int i = 0; i <= 50; ++i) {
            const double open = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * i / 50.0);
            putty.pinch(axis, kBall_m * (1.0 - deep + (deep + 0.5) * open));
            if (i == 25 && putty.volume().least_share <= 0.0) ++all.inverted;
        }
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
    all.step_ms = took.count() / static_cast<double>(std::max<std::uint64_t>(putty.part().steps(), 1));
    const bodies::SoftState state = putty.let_go();
    const bodies::VolumeNow volume = bodies::volume_of(body, state.places_m);
    all.stopped = state.flow.stopped_count;
    all.volume_share = volume.volume_m3 / bodies::volume_m3(body.rest());
    all.least_share = volume.least_share;
    all.worst_rest_quality = bodies::worst_rest_quality(body, state);
    const bodies::EmbeddedSurface surface = bodies::ellipsoid_surface(body.rest(), Vec3(kBall_m), 4);
    const std::vector<Vec3> places = bodies::places_of(surface, state.places_m);
    double enclosed_m3 = 0.0;
    for (const auto& [a, b, c] : surface.triangles)
        enclosed_m3 += bodies::volume_m3(Vec3(0.0), places[a], places[b], places[c]);
    all.enclosed_share = enclosed_m3 / bodies::volume_m3(body.rest());
    return all;
}

RandomGrasps grasp_at_random(std::size_t grasps) {
    RandomGrasps all{.grasps = grasps};
    Draw draw;
    Pressed ball(ball_of(200e3, 0.0));
    const auto least = [&] { return ball.volume().least_share; };
    haptics::GateLimits limits;
    limits.max_force_N = all.limit_N;
    std::array<haptics::GateState, 4> gates{};
    for (std::size_t grasp = 0; grasp < grasps; ++grasp) {
        std::array<Vec3, 4> axes{};
        std::array<double, 4> to_m{};
        for (std::size_t f = 0; f < 4; ++f) {
            axes[f] = draw.direction();
            to_m[f] = kBall_m * (1.1 - 1.3 * draw.share());
        }
        constexpr int kSteps = 12;
        for (int i = 0; i <= kSteps; ++i) {
            const double open = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * i / kSteps);
            std::array<haptics::TickRecord, 4> ticks;
            for (std::size_t f = 0; f < 4; ++f) {
                ticks[f] = fingertip(axes[f], to_m[f] + open * (1.5 * kBall_m - to_m[f]));
                ball.press(f, ticks[f]);
            }
            ball.update();
            for (std::size_t f = 0; f < 4; ++f) {
                const Vec3 asked_N = ball.felt_N(f, ticks[f]);
                haptics::GateInput input;
                input.wanted.force_device_N = asked_N;
                input.device_max_force_N = all.limit_N;
                input.in_contact = true;
                const haptics::GateStep step = haptics::pass_gate(gates[f], input, limits, seconds(kStep_ns));
                gates[f] = step.next;
                const double given_N = glm::length(step.output.given.force_device_N);
                if (!finite(asked_N) || !std::isfinite(given_N)) ++all.not_finite;
                all.most_asked_N = std::max(all.most_asked_N, glm::length(asked_N));
                all.most_given_N = std::max(all.most_given_N, given_N);
            }
        }
        for (std::size_t f = 0; f < 4; ++f) ball.press(f, fingertip(axes[f], 3.0 * kBall_m));
        // An element that is inside out gets a quarter of a second to turn back.
        for (int i = 0; i < 63 && (i < 12 || least() <= 0.0); ++i) ball.update();
        if (least() <= 0.0) ++all.inverted_after;
    }
    return all;
}

std::vector<MeetingFingers> squeeze_until_they_meet() {
    std::vector<MeetingFingers> all;
    Pressed ball(ball_of(100e3, 0.0));
    const Vec3 up(0, 1, 0);
    double in = 0.0;
    for (const double share : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        const double from = in;
        for (int i = 1; i <= 50; ++i) ball.pinch(up, kBall_m * (1.0 - (from + (share - from) * i / 50.0)));
        for (int i = 0; i < 100; ++i) ball.pinch(up, kBall_m * (1.0 - share));
        in = share;
        const bodies::VolumeNow now = ball.volume();
        all.push_back({share, ball.pinch_N(up, kBall_m * (1.0 - share)),
                       now.volume_m3 / bodies::volume_m3(ball.part().body().rest()), now.least_share});
    }
    for (int i = 0; i < 250; ++i) ball.pinch(up, 3.0 * kBall_m);
    const bodies::VolumeNow now = ball.volume();
    all.push_back({0.0, 0.0, now.volume_m3 / bodies::volume_m3(ball.part().body().rest()), now.least_share});
    return all;
}

std::vector<DentedByAPoint> dent_by_a_point() {
    bodies::SoftPartSetup setup = ball_of(100e3, 0.0);
    setup.held_N_per_m = 1e7;  // what holds the ball gives nothing
    const double radius_m = setup.point_radius_m * kBall_m / (setup.point_radius_m + kBall_m);
    const double plane_Pa = setup.material.young_Pa / (1.0 - setup.material.poisson * setup.material.poisson);
    constexpr std::array kFrom{Vec3(0.0, 1.0, 0.0), Vec3(0.6, 0.0, 0.8), Vec3(0.48, -0.6, 0.64),
                               Vec3(-0.64, 0.48, 0.6)};
    constexpr int kSteps = 100;
    std::vector<DentedByAPoint> all;
    for (const double depth_m : {0.0005, 0.001, 0.002, 0.004, 0.009}) {
        DentedByAPoint dent{.depth_m = depth_m, .least_over_hertz = HUGE_VAL};
        const double hertz_N = 4.0 / 3.0 * plane_Pa * std::sqrt(radius_m * depth_m) * depth_m;
        for (const Vec3& from : kFrom) {
            Pressed ball(setup);
            haptics::TickRecord tick;
            tick.contact.point_count = 1;
            tick.contact.points[0].hip_object_m = (kBall_m + setup.point_radius_m - depth_m) * from;
            ball.press(0, tick);
            for (int i = 0; i < kSteps; ++i) ball.update();
            const double force_N = glm::length(ball.felt_N(0, tick)), over = force_N / hertz_N;
            dent.mean_N += force_N / kFrom.size();
            dent.over_hertz += over / kFrom.size();
            dent.least_over_hertz = std::min(dent.least_over_hertz, over);
            dent.most_over_hertz = std::max(dent.most_over_hertz, over);
        }
        all.push_back(dent);
    }
    return all;
}

std::vector<FeltBetweenSteps> feel_between_steps() {
    std::vector<FeltBetweenSteps> all;
    for (const double young_Pa : {100e3, 300e3})
        for (const double hertz : {1.0, 8.0}) {
            bodies::SoftPartSetup setup = ball_of(young_Pa, 0.0), fine_setup = setup;
            fine_setup.step_ns = kTick_ns;
            fine_setup.sweeps = 20;
            Pressed body(setup), fine(fine_setup);
            FeltBetweenSteps felt{young_Pa, hertz};
            double last_N = 0.0, last_true_N = 0.0;
            constexpr int kFirst = 50, kTicks = 1000;
            for (int i = 1; i <= kTicks; ++i) {
                const double angle = 2.0 * std::numbers::pi * hertz * i * 0.001;
                const haptics::TickRecord tick = fingertip({0, 1, 0}, kBall_m - 0.002 + 0.002 * std::cos(angle));
                const double felt_N = glm::length(body.felt_N(0, tick));
                const double held_N = glm::length(body.felt_N(0, tick, true));
                fine.press(0, tick);
                fine.update(kTick_ns);
                const double true_N = glm::length(fine.felt_N(0, tick));
                if (i % 4 == 0) {
                    body.press(0, tick);
                    body.update();
                }
                if (i > kFirst) {
                    felt.model_off_N += (felt_N - true_N) * (felt_N - true_N);
                    felt.held_off_N += (held_N - true_N) * (held_N - true_N);
                    felt.felt_step_N = std::max(felt.felt_step_N, std::abs(felt_N - last_N));
                    felt.true_step_N = std::max(felt.true_step_N, std::abs(true_N - last_true_N));
                    felt.most_N = std::max(felt.most_N, true_N);
                }
                last_N = felt_N;
                last_true_N = true_N;
            }
            felt.model_off_N = std::sqrt(felt.model_off_N / (kTicks - kFirst));
            felt.held_off_N = std::sqrt(felt.held_off_N / (kTicks - kFirst));
            all.push_back(felt);
        }
    return all;
}

}  // namespace burin::bench
