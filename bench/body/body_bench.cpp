// SPDX-License-Identifier: MIT
#include "bench/body/body_bench.hpp"

#include <array>
#include <chrono>
#include <utility>

#include "base/text.hpp"
#include "bodies/solver/plates.hpp"

namespace burin::bench {
namespace {

constexpr std::array kSqueezes{0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5};
constexpr std::array kSweepsAndSteps{std::pair(2u, 0.004),  std::pair(4u, 0.004), std::pair(8u, 0.004),
                                     std::pair(20u, 0.004), std::pair(4u, 0.002), std::pair(4u, 0.008)};

PressedBall pressed(const BodyBenchTask& task, const bodies::SoftBody& body, const bodies::EmbeddedSurface& surface,
                    double closed_share, unsigned sweeps, double dt_s) {
    const double closed_m = closed_share * task.radius_m;
    const auto begun = std::chrono::steady_clock::now();
    const bodies::PlateFigures at =
        bodies::press_between_plates(body, surface, {.closed_m = closed_m, .dt_s = dt_s, .sweeps = sweeps});
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
    PressedBall ball;
    ball.closed_share = closed_share;
    ball.sweeps = sweeps;
    ball.dt_s = dt_s;
    ball.force_N = at.force_N;
    ball.elastic_N = at.elastic_N;
    ball.tatara_N = bodies::tatara_N(task.radius_m, task.young_Pa, task.poisson, closed_m);
    ball.hertz_N = bodies::hertz_N(task.radius_m, task.young_Pa, task.poisson, closed_m);
    ball.volume_share = at.volume_share;
    ball.least_share = at.least_share;
    ball.drift = at.drift;
    ball.step_ms = took.count() / static_cast<double>(at.steps);
    return ball;
}

std::string line_of(const PressedBall& ball) {
    return formatted("%8.2f %6u %5.0f %9.4f %9.4f %10.3f %9.3f %+9.2f %% %7.3f %8.2f\n", ball.closed_share, ball.sweeps,
                     1e3 * ball.dt_s, ball.force_N, ball.elastic_N, ball.force_N / ball.tatara_N,
                     ball.force_N / ball.hertz_N, 100.0 * (ball.volume_share - 1.0), ball.least_share, ball.step_ms);
}

Json json_of(const PressedBall& ball) {
    return {{"closed_share_of_radius", ball.closed_share},
            {"sweeps", ball.sweeps},
            {"step_s", ball.dt_s},
            {"force_N", ball.force_N},
            {"force_of_elements_N", ball.elastic_N},
            {"tatara_N", ball.tatara_N},
            {"hertz_N", ball.hertz_N},
            {"over_tatara", ball.force_N / ball.tatara_N},
            {"volume_share", ball.volume_share},
            {"least_volume_share_of_an_element", ball.least_share},
            {"change_in_last_tenth_of_settling", ball.drift},
            {"timing", {{"step_ms", ball.step_ms}}}};
}

}  // namespace

Result<BodyBenchFigures> measure_body(const BodyBenchTask& task) {
    Result<bodies::Tetrahedra> rest =
        bodies::ellipsoid(Vec3(task.radius_m), task.radius_m / task.elements_along_radius);
    if (!rest) return std::unexpected(rest.error());
    bodies::SoftMaterial material;
    material.young_Pa = task.young_Pa;
    material.poisson = task.poisson;
    const Result<bodies::SoftBody> body = bodies::SoftBody::create(std::move(*rest), material);
    if (!body) return std::unexpected(body.error());
    constexpr unsigned kLevel = 4;
    const bodies::EmbeddedSurface surface = bodies::ellipsoid_surface(body->rest(), Vec3(task.radius_m), kLevel);
    BodyBenchFigures figures{task, body->rest().cells.size(), body->corners(), {}, {}};
    for (const double closed : kSqueezes) figures.squeezes.push_back(pressed(task, *body, surface, closed, 4, 0.004));
    if (task.quick) return figures;
    for (const auto& [sweeps, dt_s] : kSweepsAndSteps)
        figures.settings.push_back(pressed(task, *body, surface, 0.1, sweeps, dt_s));
    return figures;
}

std::string body_bench_table(const BodyBenchFigures& figures) {
    std::string text =
        formatted("%zu elements, %zu corners, R %.0f mm, E %.0f kPa, Poisson %.2f\n", figures.elements, figures.corners,
                  1e3 * figures.task.radius_m, 1e-3 * figures.task.young_Pa, figures.task.poisson);
    text += "     d/R sweeps    ms   plates N elements N  / Tatara   / Hertz      volume   least  ms a step\n";
    for (const PressedBall& ball : figures.squeezes) text += line_of(ball);
    if (!figures.settings.empty()) text += "over sweeps and steps\n";
    for (const PressedBall& ball : figures.settings) text += line_of(ball);
    return text;
}

Json body_bench_json(const BodyBenchFigures& figures) {
    Json json{{"elements", figures.elements},      {"corners", figures.corners},
              {"radius_m", figures.task.radius_m}, {"young_Pa", figures.task.young_Pa},
              {"poisson", figures.task.poisson},   {"squeezes", Json::array()},
              {"sweeps_and_steps", Json::array()}};
    for (const PressedBall& ball : figures.squeezes) json["squeezes"].push_back(json_of(ball));
    for (const PressedBall& ball : figures.settings) json["sweeps_and_steps"].push_back(json_of(ball));
    return json;
}

}  // namespace burin::bench
