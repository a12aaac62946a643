// SPDX-License-Identifier: MIT
#include "tests/app/meshes/carved_samples.hpp"

#include <random>

#include "base/space.hpp"
#include "base/text.hpp"
#include "tests/support/places.hpp"

namespace burin::app {
namespace {

constexpr const char* kTetrahedronObj =
    "# units m\nv 0 0 0\nv 0.1 0 0.01\nv 0.02 0.09 0\nv 0.03 0.02 0.08\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* kToolObj =
    "# units m\nv -0.01 -0.006 0\nv 0.012 -0.008 0\nv 0 0.011 0\nv 0.001 0.001 0.03\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 "
    "4\n";

// Strokes across a box of 100 mm, each pressed along a line on which the tool turns a little.
class Strokes {
public:
    Strokes(unsigned seed, bool about_origin) : random_(seed), shift_m_(about_origin ? 0.05 : 0.0) {}

    std::string csv(int strokes) {
        std::string text = kStrokeHeader;
        for (int stroke = 0; stroke < strokes; ++stroke) {
            Vec3 at = Vec3(between(0.0, 0.1), between(0.0, 0.1), between(0.0, 0.1)) - shift_m_;
            const Vec3 step = Vec3(between(-0.01, 0.01), between(-0.01, 0.01), between(-0.01, 0.01));
            Quat turn = glm::normalize(Quat(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)));
            constexpr int kRows = 5;
            for (int row = 0; row <= kRows; ++row) {
                text += formatted("%g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n", time_s_ += 0.1, at.x, at.y, at.z,
                                  turn.x, turn.y, turn.z, turn.w, row == kRows ? 0 : 1);
                at += step;
                turn = glm::normalize(turn * Quat(1.0, between(-0.05, 0.05), between(-0.05, 0.05), 0.0));
            }
        }
        return text;
    }

private:
    double between(double lo, double hi) {
        return lo + (hi - lo) * 1e-9 * static_cast<double>(random_() % 1000000000u);
    }

    std::mt19937 random_;
    double shift_m_;
    double time_s_ = 0.0;
};

}  // namespace

std::vector<CarvedSample> carved_samples() {
    const std::string block = "--workpiece block:0.1,0.08,0.07", ball = "--workpiece ball:0.05",
                      part = "--workpiece part.obj";
    unsigned seed = 1;
    const auto sample = [&](const std::string& workpiece, const std::string& tool, int resolution, int strokes) {
        const std::string name = formatted("part%u", seed);
        return CarvedSample{name, workpiece + " --tool " + tool,
                            Strokes(seed++, workpiece.find("ball:") != std::string::npos).csv(strokes), resolution};
    };
    return {sample(block, "ball:0.006", 128, 30),
            sample(part, "cylinder:0.004,0.03", 144, 20),
            sample(ball, "cone:0,0.008,0.03", 160, 20),
            sample(block, "bullnose:0.006,0.002,0.03", 192, 20),
            sample(ball, "box:0.01,0.02,0.005", 224, 20),
            sample(part, "mesh:tool.obj", 256, 12),
            sample(block, "box:0.012,0.006,0.03 --operation fill", 288, 12),
            sample(ball, "cylinder:0.003,0.04", 320, 16),
            sample(part, "cone:0.002,0.006,0.03", 384, 16),
            sample(block, "ball:0.003", 512, 60)};
}

void write_meshes_of_samples(const Workplace& place) {
    place.write("part.obj", kTetrahedronObj);
    place.write("tool.obj", kToolObj);
}

Workplace::Outcome carve_sample(const Workplace& place, const CarvedSample& sample, const std::string& unit) {
    const std::string file = sample.name + "-" + unit;
    place.write("stroke.csv", sample.stroke);
    return place.run(std::string(kBurinCommand) + " sculpt " + sample.options + " --stroke stroke.csv --resolution " +
                     std::to_string(sample.resolution) + " --export-units " + unit + " --export " + file +
                     ".stl --export " + file + ".ply --export " + file + ".obj --report " + file + ".json");
}

}  // namespace burin::app
