// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <utility>

#include "base/plot/figures.hpp"
#include "bench/body/body_bench.hpp"
#include "bodies/paper/paper_deformation.hpp"

namespace burin::bench {
namespace {

constexpr double kDrawn_m = 0.03, kInfluence_m = 0.015;

// The upper half of a ball's section: points along a circle, seen as a surface.
bodies::PaperSurface section() {
    bodies::PaperSurface half;
    constexpr int kPoints = 181;
    for (int i = 0; i < kPoints; ++i) {
        const double angle = 3.14159265358979 * i / (kPoints - 1);
        half.normals.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        half.places_m.push_back(kDrawn_m * half.normals.back());
        half.areas_m2.push_back(1.0);
    }
    return half;
}

plot::PlotSeries line_of(const std::string& name, const bodies::PaperSurface& surface) {
    plot::PlotSeries line{name, {}, 0.0};
    for (const Vec3& place : surface.places_m) line.points.push_back({1e3 * place.x, 1e3 * place.y, ""});
    return line;
}

plot::Plot dents_plot(const std::string& title, double height_m, int frames) {
    plot::Plot plot{.title = title, .x_label = "mm", .y_label = "mm", .series = {}};
    plot.x_linear = plot.y_linear = plot.same_scale = true;
    plot.markers = false;
    const bodies::PaperSurface ball = section();
    plot.series.push_back(line_of("at rest", ball));
    const std::array point{Vec3(0.0, kDrawn_m + height_m, 0.0)};
    for (const auto& [form, name] : {std::pair(bodies::PaperForm::printed, "as the paper prints it"),
                                     std::pair(bodies::PaperForm::corrected, "corrected")}) {
        bodies::PaperPutty putty{ball, {}};
        for (int i = 0; i < frames; ++i)
            putty = bodies::step_putty_of_paper(std::move(putty), point, kInfluence_m, form);
        plot.series.push_back(line_of(name, putty.shape(form)));
    }
    plot::PlotSeries tip{"fingertip", {}, 0.0};
    for (int i = -30; i <= 30; ++i) {
        const double angle = 1.5707963267949 + 0.1 * i * 0.5235987756;
        tip.points.push_back({6.0 * std::cos(angle), 1e3 * (kDrawn_m + height_m) + 6.0 + 6.0 * std::sin(angle), ""});
    }
    plot.series.push_back(std::move(tip));
    return plot;
}

}  // namespace

std::string body_force_svg(const BodyBenchFigures& figures, const Json& calculix) {
    plot::Plot forces{.title = "Force on each plate",
                      .x_label = "closed by each plate, over the radius",
                      .y_label = "N",
                      .series = {}};
    plot::PlotSeries burin{"Burin", {}, 0.0}, tatara{"Tatara 1991", {}, 0.0}, hertz{"Hertz", {}, 0.0},
        peer{"CalculiX", {}, 0.0};
    for (const PressedBall& ball : figures.squeezes) {
        burin.points.push_back({ball.closed_share, ball.force_N, ""});
        tatara.points.push_back({ball.closed_share, ball.tatara_N, ""});
        hertz.points.push_back({ball.closed_share, ball.hertz_N, ""});
    }
    for (const Json& row : calculix)
        peer.points.push_back({row.at("closed_share_of_radius").get<double>(), row.at("calculix_N").get<double>(), ""});
    forces.series = {burin, tatara, hertz};
    if (!peer.points.empty()) forces.series.push_back(peer);
    plot::Plot over{.title = "Over Tatara", .x_label = forces.x_label, .y_label = "share", .series = {}};
    over.y_linear = true;
    for (const plot::PlotSeries& series : forces.series) {
        plot::PlotSeries shares{series.name, {}, 0.0};
        for (const plot::PlotPoint& point : series.points)
            for (const PressedBall& ball : figures.squeezes)
                if (std::abs(ball.closed_share - point.x) < 1e-9)
                    shares.points.push_back({point.x, point.y / ball.tatara_N, ""});
        over.series.push_back(std::move(shares));
    }
    return plot::svg_figure("A soft ball between plates", {forces, over});
}

std::string paper_dents_svg() {
    return plot::svg_figure("Dents of the paper's model in a ball",
                            {dents_plot("Finger 1 mm above", 0.001, 1), dents_plot("Finger 3 mm deep", -0.003, 1),
                             dents_plot("Plastic, rested for 60 frames", -0.003, 60)});
}

}  // namespace burin::bench
