// SPDX-License-Identifier: MIT
// The paper's own deformations: what it prints, with the faults that follow from it, and what the corrected forms keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "bodies/mesh/embedded_surface.hpp"
#include "bodies/paper/paper_deformation.hpp"

namespace burin::bodies {
namespace {

constexpr double kBall_m = 0.03, kInfluence_m = 0.015;

PaperSurface paper_ball() {
    const Tetrahedra body = ellipsoid(Vec3(kBall_m), 0.0095).value();
    const EmbeddedSurface surface = ellipsoid_surface(body, Vec3(kBall_m), 4);
    PaperSurface ball;
    ball.places_m = places_of(surface, body.places_m);
    for (const Vec3& place : ball.places_m) ball.normals.push_back(glm::normalize(place));
    ball.areas_m2 = surface.areas_m2;
    return ball;
}

Vec3 above(double height_m) { return {0.0, kBall_m + height_m, 0.0}; }
double most(const std::vector<double>& all) { return *std::ranges::max_element(all); }
double sum(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

}  // namespace

TEST(Paper, TakesShapesBetweenAnOpenAndAClosedHand) {
    const std::array angles{0.3, 0.5, 0.4};
    EXPECT_DOUBLE_EQ(closed_share(angles, 2.4), 0.5);
    EXPECT_EQ(closed_share(angles, 1.0), 1.0);
    const std::vector<Vec3> open{{0, 0, 0}, {1, 0, 0}}, closed{{2, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(between(open, closed, 0.5).front(), Vec3(1, 0, 0));
    EXPECT_NEAR(glm::length(normals_between(open, closed, 0.5).back()), 1.0, 1e-15);
}

// A vertex at an angle a from the pole is R - (R + h) cos a beyond the finger's tangent, so k times that.
TEST(Paper, DentsAsItPrints) {
    const PaperSurface ball = paper_ball();
    const std::array points{above(-0.002)};
    const std::vector<double> dents = dents_m(ball, points, kInfluence_m, PaperForm::printed);
    for (std::size_t i = 0; i < dents.size(); ++i) {
        const double cosine = ball.normals[i].y, point = kBall_m - 0.002;
        const double square = kBall_m * kBall_m + point * point - 2.0 * kBall_m * point * cosine;
        const double k = std::max(0.0, 1.0 - square / (kInfluence_m * kInfluence_m));
        EXPECT_NEAR(dents[i], k * std::max(0.0, kBall_m - point * cosine), 1e-12);
    }
}

TEST(Paper, AsPrintedDentsACurvedBodyBeforeTheFingerTouchesAndCorrectedDoesNot) {
    const PaperSurface ball = paper_ball();
    const std::array points{above(0.001)};
    EXPECT_GT(most(dents_m(ball, points, kInfluence_m, PaperForm::printed)), 0.0004);
    EXPECT_EQ(most(dents_m(ball, points, kInfluence_m, PaperForm::corrected)), 0.0);
    const std::array inside{above(-0.002)};
    EXPECT_GT(most(dents_m(ball, inside, kInfluence_m, PaperForm::printed)), 0.00201) << "deeper than the finger";
    EXPECT_LE(most(dents_m(ball, inside, kInfluence_m, PaperForm::corrected)), 0.002 + 1e-12);
    EXPECT_GT(most(dents_m(ball, inside, kInfluence_m, PaperForm::corrected)), 0.0019);
}

TEST(Paper, CorrectedKeepsTheVolumeToFirstOrder) {
    const PaperSurface ball = paper_ball();
    const std::array points{above(-0.003)};
    const auto lost_m3 = [&](PaperForm form) {
        const PaperSurface now = dented(ball, dents_m(ball, points, kInfluence_m, form), form);
        double out_m3 = 0.0;
        for (std::size_t i = 0; i < now.places_m.size(); ++i)
            out_m3 += ball.areas_m2[i] * glm::dot(now.places_m[i] - ball.places_m[i], ball.normals[i]);
        return -out_m3;
    };
    EXPECT_GT(lost_m3(PaperForm::printed), 1e-7);
    EXPECT_NEAR(lost_m3(PaperForm::corrected), 0.0, 1e-15);
}

TEST(Paper, AsPrintedCreepsWhileTheFingerRestsAndCorrectedDoesNot) {
    const std::array points{above(-0.002)}, away{above(0.05)};
    const auto rested = [&](PaperForm form, int frames) {
        PaperPutty putty{paper_ball(), {}};
        for (int i = 0; i < frames; ++i) putty = step_putty_of_paper(std::move(putty), points, kInfluence_m, form);
        putty = step_putty_of_paper(std::move(putty), away, kInfluence_m, form);
        double off_m3 = 0.0;
        const PaperSurface ball = paper_ball(), now = putty.shape(form);
        for (std::size_t i = 0; i < now.places_m.size(); ++i)
            off_m3 += ball.areas_m2[i] * std::max(0.0, glm::dot(ball.places_m[i] - now.places_m[i], ball.normals[i]));
        return off_m3;
    };
    EXPECT_GT(rested(PaperForm::printed, 60), 1.5 * rested(PaperForm::printed, 1));
    EXPECT_GT(rested(PaperForm::corrected, 1), 0.0) << "it stays";
    EXPECT_DOUBLE_EQ(rested(PaperForm::corrected, 60), rested(PaperForm::corrected, 1));
}

TEST(Paper, TakesTheLargestOfItsPointsAndDoesNotAddThem) {
    const PaperSurface ball = paper_ball();
    const std::array one{above(-0.002)};
    const std::array twice{above(-0.002), above(-0.002)};
    for (const PaperForm form : {PaperForm::printed, PaperForm::corrected})
        EXPECT_DOUBLE_EQ(sum(dents_m(ball, one, kInfluence_m, form)), sum(dents_m(ball, twice, kInfluence_m, form)));
}

}  // namespace burin::bodies
