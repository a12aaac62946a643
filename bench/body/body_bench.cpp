// SPDX-License-Identifier: MIT
#include "bench/body/body_bench.hpp"

#include <array>
#include <chrono>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
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
    BURIN_TRY(rest, bodies::ellipsoid(Vec3(task.radius_m), task.radius_m / task.elements_along_radius));
    bodies::SoftMaterial material;
    material.young_Pa = task.young_Pa;
    material.poisson = task.poisson;
    BURIN_TRY(body, bodies::SoftBody::create(std::move(rest), material));
    constexpr unsigned kLevel = 4;
    const bodies::EmbeddedSurface surface = bodies::ellipsoid_surface(body.rest(), Vec3(task.radius_m), kLevel);
    BodyBenchFigures figures{task, body.rest().cells.size(), body.corners(), {}, {}, {}, {}, {}, {}, {}, {}};
    for (const double closed : kSqueezes) figures.squeezes.push_back(pressed(task, body, surface, closed, 4, 0.004));
    if (task.quick) return figures;
    for (const auto& [sweeps, dt_s] : kSweepsAndSteps)
        figures.settings.push_back(pressed(task, body, surface, 0.1, sweeps, dt_s));
    figures.still = hold_putty(task.still_s);
    figures.kneaded = knead_putty(task.kneads);
    figures.grasps = grasp_at_random(task.grasps);
    figures.meeting = squeeze_until_they_meet();
    figures.dented = dent_by_a_point();
    figures.felt = feel_between_steps();
    return figures;
}

namespace {

std::string table_of_trials(const BodyBenchFigures& figures) {
    const StillPutty& still = figures.still;
    const KneadedPutty& kneaded = figures.kneaded;
    const RandomGrasps& grasps = figures.grasps;
    std::string text = formatted(
        "putty under still fingers: dent %.3f mm after %.0f s, %.3f mm after %.0f s, %+.4f %%; as the paper prints it "
        "%+.0f %% from the first frame on\n",
        1e3 * still.early_dent_m, still.early_s, 1e3 * still.late_dent_m, still.late_s,
        100.0 * (still.late_dent_m / still.early_dent_m - 1.0),
        100.0 * (still.paper_late_m3 / still.paper_early_m3 - 1.0));
    text += formatted(
        "kneaded %zu times: volume %+.2f %%, worst element %.3f of its own, %zu inverted when pressed, %zu of "
        "%zu stopped, %.2f ms a step\n",
        kneaded.kneads, 100.0 * (kneaded.volume_share - 1.0), kneaded.least_share, kneaded.inverted, kneaded.stopped,
        kneaded.elements, kneaded.step_ms);
    text += formatted(
        "%zu random grasps: %zu not finite, asked %.1f N, given %.2f N of %.0f, %zu with an inverted element "
        "after\n",
        grasps.grasps, grasps.not_finite, grasps.most_asked_N, grasps.most_given_N, grasps.limit_N,
        grasps.inverted_after);
    text += "two fingers in by a share of the radius\n   share         N     volume   least\n";
    for (const MeetingFingers& at : figures.meeting)
        text += formatted("%8.1f %9.3f %+8.2f %% %7.3f\n", at.share, at.force_N, 100.0 * (at.volume_share - 1.0),
                          at.least_share);
    text += "dented by one point of 1 mm, 1632 elements, 100 kPa\n      mm         N  / Hertz    least     most\n";
    for (const DentedByAPoint& dent : figures.dented)
        text += formatted("%8.1f %9.3f %8.2f %8.2f %8.2f\n", 1e3 * dent.depth_m, dent.mean_N, dent.over_hertz,
                          dent.least_over_hertz, dent.most_over_hertz);
    text += "felt between steps\n     kPa     Hz   most N  held off N  model off N  true step N  felt step N\n";
    for (const FeltBetweenSteps& felt : figures.felt)
        text += formatted("%8.0f %6.0f %8.2f %11.4f %12.4f %12.4f %12.4f\n", 1e-3 * felt.young_Pa, felt.hertz,
                          felt.most_N, felt.held_off_N, felt.model_off_N, felt.true_step_N, felt.felt_step_N);
    return text;
}

Json json_of_trials(const BodyBenchFigures& figures) {
    const StillPutty& still = figures.still;
    const KneadedPutty& kneaded = figures.kneaded;
    const RandomGrasps& grasps = figures.grasps;
    Json json{{"still_putty",
               {{"early_s", still.early_s},
                {"late_s", still.late_s},
                {"early_dent_m", still.early_dent_m},
                {"late_dent_m", still.late_dent_m},
                {"change", still.late_dent_m / still.early_dent_m - 1.0},
                {"early_N", still.early_N},
                {"late_N", still.late_N},
                {"change_as_the_paper_prints_it", still.paper_late_m3 / still.paper_early_m3 - 1.0}}},
              {"kneaded_putty",
               {{"kneads", kneaded.kneads},
                {"volume_share", kneaded.volume_share},
                {"volume_share_of_the_surface", kneaded.enclosed_share},
                {"least_volume_share_of_an_element", kneaded.least_share},
                {"inverted_when_pressed", kneaded.inverted},
                {"worst_quality_of_a_rest_shape", kneaded.worst_rest_quality},
                {"elements", kneaded.elements},
                {"stopped", kneaded.stopped},
                {"timing", {{"step_ms", kneaded.step_ms}}}}},
              {"random_grasps",
               {{"grasps", grasps.grasps},
                {"not_finite", grasps.not_finite},
                {"most_asked_N", grasps.most_asked_N},
                {"most_given_N", grasps.most_given_N},
                {"limit_N", grasps.limit_N},
                {"with_an_inverted_element_after", grasps.inverted_after}}},
              {"two_fingers_that_meet", Json::array()},
              {"dented_by_a_point", Json::array()},
              {"felt_between_steps", Json::array()}};
    for (const MeetingFingers& at : figures.meeting)
        json["two_fingers_that_meet"].push_back({{"share_of_radius", at.share},
                                                 {"force_N", at.force_N},
                                                 {"volume_share", at.volume_share},
                                                 {"least_volume_share_of_an_element", at.least_share}});
    for (const DentedByAPoint& dent : figures.dented)
        json["dented_by_a_point"].push_back({{"depth_m", dent.depth_m},
                                             {"mean_N", dent.mean_N},
                                             {"over_hertz", dent.over_hertz},
                                             {"least_over_hertz", dent.least_over_hertz},
                                             {"most_over_hertz", dent.most_over_hertz}});
    for (const FeltBetweenSteps& felt : figures.felt)
        json["felt_between_steps"].push_back({{"young_Pa", felt.young_Pa},
                                              {"hertz", felt.hertz},
                                              {"most_N", felt.most_N},
                                              {"off_with_the_surface_held_still_N", felt.held_off_N},
                                              {"off_with_the_local_model_N", felt.model_off_N},
                                              {"largest_true_step_N", felt.true_step_N},
                                              {"largest_felt_step_N", felt.felt_step_N}});
    return json;
}

}  // namespace

std::string body_bench_table(const BodyBenchFigures& figures) {
    std::string text =
        formatted("%zu elements, %zu corners, R %.0f mm, E %.0f kPa, Poisson %.2f\n", figures.elements, figures.corners,
                  1e3 * figures.task.radius_m, 1e-3 * figures.task.young_Pa, figures.task.poisson);
    text += "     d/R sweeps    ms   plates N elements N  / Tatara   / Hertz      volume   least  ms a step\n";
    for (const PressedBall& ball : figures.squeezes) text += line_of(ball);
    if (!figures.settings.empty()) text += "over sweeps and steps\n";
    for (const PressedBall& ball : figures.settings) text += line_of(ball);
    return figures.task.quick ? text : text + table_of_trials(figures);
}

Json body_bench_json(const BodyBenchFigures& figures) {
    Json json{{"elements", figures.elements},      {"corners", figures.corners},
              {"radius_m", figures.task.radius_m}, {"young_Pa", figures.task.young_Pa},
              {"poisson", figures.task.poisson},   {"squeezes", Json::array()},
              {"sweeps_and_steps", Json::array()}};
    for (const PressedBall& ball : figures.squeezes) json["squeezes"].push_back(json_of(ball));
    for (const PressedBall& ball : figures.settings) json["sweeps_and_steps"].push_back(json_of(ball));
    if (!figures.task.quick) json.update(json_of_trials(figures));
    return json;
}

}  // namespace burin::bench
