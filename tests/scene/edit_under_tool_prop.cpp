// SPDX-License-Identifier: MIT
// Whatever is done to an object while a tool presses on it, the hand is not jerked: the force goes from what it was to
// what it becomes over the time of an ease, and nowhere faster.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/forces/easing.hpp"
#include "tests/scene/scene_samples.hpp"

namespace burin::scene {
namespace {

constexpr ObjectId kPressed = 1;
constexpr double kHalf_m = 0.05;

struct UnderTool {
    const char* name;
    ObjectEdit edit;
    std::optional<ObjectEdit> back = {};  // none: it is let go, or taken hold of by the hand
};

HapticMaterial material_of(double stiffness, double damping, double static_friction, double dynamic_friction) {
    return {.stiffness_N_per_m = stiffness,
            .damping_Ns_per_m = damping,
            .static_friction = static_friction,
            .dynamic_friction = dynamic_friction};
}

// A tool of 4 mm that presses on a cube's top, and what the hand gets.
class PressedScene {
public:
    PressedScene(const HapticMaterial& material, double depth_m, double aside_m, bool omni)
        : scene_({object(material)}) {
        scene_.parameters.limit_stiffness = omni;
        scene_.parameters.position_noise_m = 1e-9;
        if (omni) scene_.device = devices::description_of({});
        for (int i = 0; i < 300; ++i) tick(0.01);
        for (int i = 0; i <= 200; ++i) tick(0.01 - (0.01 + depth_m) * 0.005 * i);
        for (int i = 0; i < 100; ++i) {
            x_m_ += 0.01 * aside_m;
            tick(-depth_m);
        }
        depth_m_ = depth_m;
        rest(50);
    }
    [[nodiscard]] MeshPart& part() { return *scene_.part; }
    [[nodiscard]] double force_N() const { return glm::length(force_N_); }
    void rest(int ticks) {
        for (int i = 0; i < ticks; ++i) tick(-depth_m_);
    }
    [[nodiscard]] Result<void> edit(const ObjectEdit& edit) {
        const auto done = part().edit(kPressed, edit);
        scene_.materials.write(scene_.parameters.materials);
        return done;
    }
    [[nodiscard]] Result<void> take_hold() {
        part().move_hand(0, {.scene_from_hand = {at_m_, {1, 0, 0, 0}}, .time_ns = scene_.now_ns()});
        return part().take_hold(kPressed, 0);
    }
    // The largest change of a tick over so many, and the way of the force, or of the spring's, in all.
    struct Course {
        double largest_N = 0.0, range_N = 0.0, most_N = 0.0;
        int at = 0;
    };
    [[nodiscard]] Course course(int ticks) {
        Course course;
        std::vector<Vec3> forces{force_N_};
        double least_N = spring_N_, greatest_N = spring_N_;
        for (int i = 0; i < ticks; ++i) {
            const Vec3 before = force_N_;
            tick(-depth_m_);
            const double change_N = glm::length(force_N_ - before);
            if (change_N > course.largest_N) course.at = i;
            course.largest_N = std::max(course.largest_N, change_N);
            course.most_N = std::max({course.most_N, force_N(), glm::length(before)});
            least_N = std::min(least_N, spring_N_), greatest_N = std::max(greatest_N, spring_N_);
            for (const Vec3& f : forces) course.range_N = std::max(course.range_N, glm::length(force_N_ - f));
            if (i % 10 == 0) forces.push_back(force_N_);
        }
        course.range_N = std::max(course.range_N, greatest_N - least_N);
        return course;
    }

private:
    static SceneObject object(const HapticMaterial& material) {
        SceneObject object = test::object_at(kPressed, test::shared_mesh(geometry::test::cube(kHalf_m)), Vec3(0.0));
        object.material = material;
        return object;
    }
    void tick(double above_m) {
        at_m_ = {x_m_, kHalf_m + test::TouchedScene::kRadius_m + above_m, 0.002};
        const haptics::TickRecord record = scene_.tick(at_m_);
        force_N_ = record.gate.given.force_device_N;
        const haptics::PointRecord& point = record.contact.points[0];
        spring_N_ = point.rendered.stiffness_N_per_m * point.penetration_m;
    }

    test::TouchedScene scene_;
    double x_m_ = 0.003, depth_m_ = 0.0;
    double spring_N_ = 0.0;  // of which the energy account may take a part
    Vec3 at_m_{0.0}, force_N_{0.0};
};

// What is put farther over the hand leaves it where the surface is not known: that is a fault, and zero at once.
std::vector<UnderTool> edits_of(const HapticMaterial& m, std::mt19937& random) {
    const auto share = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
    const auto with = [&](auto change) {
        HapticMaterial other = m;
        change(other);
        return SetMaterial{other};
    };
    const Pose home{}, aside{{0.0, -0.002 - 0.002 * share(), 0.0}}, up{{0.0, 0.004 * share(), 0.0}},
        away{{0.0, -0.03, 0.0}}, over{{0.0, 0.004 + 0.01 * share(), 0.0}},
        turned{{}, glm::angleAxis(0.1 * share(), Vec3(0.0, 0.0, 1.0))};
    const SetMaterial same{m};
    return {
        {"softer", with([](HapticMaterial& o) { o.stiffness_N_per_m = 100.0; }), same},
        {"stiffer", with([](HapticMaterial& o) { o.stiffness_N_per_m = 700.0; }), same},
        {"any stiffness", with([&](HapticMaterial& o) { o.stiffness_N_per_m = 20.0 + 1500.0 * share(); }), same},
        {"damped", with([&](HapticMaterial& o) { o.damping_Ns_per_m = 5.0 * share(); }), same},
        {"smooth", with([](HapticMaterial& o) { o.static_friction = o.dynamic_friction = 0.0; }), same},
        {"rough", with([](HapticMaterial& o) { o.static_friction = 1.0, o.dynamic_friction = 0.8; }), same},
        {"not felt", SetFelt{false}, SetFelt{true}},
        {"not seen", SetSeen{false}, SetSeen{true}},
        {"coloured", SetColour{{1, 2, 3}}, SetColour{{4, 5, 6}}},
        {"taken down", SetPose{aside}, SetPose{home}},
        {"pushed up", SetPose{up}, SetPose{home}},
        {"taken away", SetPose{away}, SetPose{home}},
        {"put over the hand", SetPose{over}, SetPose{home}},
        {"turned", SetPose{turned}, SetPose{home}},
        {"shrunk", SetScale{0.97}, SetScale{1.0}},
        {"grown", SetScale{1.0 + 0.05 * share()}, SetScale{1.0}},
        {"held", TakeHold{}},
    };
}

// A ramp of the whole change would be 1 / 50 of it a tick; twice that is allowed, where two ramps run at once. A small
// change may be as fast as one of kDrift. slips_N: what a stretch that is let go loses at once, by itself as under any
// hand, where what slides is held less than what sticks.
void check_course(const PressedScene::Course& course, double slips_N, double dt_s) {
    const double a_tick = dt_s / haptics::kEase_s;
    const double most_N =
        std::max({2.0 * a_tick * course.range_N, 1.5 * haptics::kDrift * a_tick * course.most_N, 1e-4}) + slips_N;
    RC_LOG() << "largest " << course.largest_N << " N at tick " << course.at << ", in all " << course.range_N << " N\n";
    RC_ASSERT(course.largest_N <= most_N);
}

RC_GTEST_PROP(EditUnderTool, ChangesTheForceNowhereFasterThanOverFiftyMilliseconds, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const auto share = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
    const double dynamic_friction = 0.6 * share();
    const HapticMaterial material =
        material_of(50.0 + 800.0 * share(), share(), dynamic_friction * 1.3, dynamic_friction);
    const double depth_m = 0.0005 + 0.0025 * share(), aside_m = 0.004 * share();
    const bool omni = random() % 2 == 0;
    const std::vector<UnderTool> edits = edits_of(material, random);
    const UnderTool& under = edits[random() % edits.size()];
    PressedScene scene(material, depth_m, aside_m, omni);
    const double before_N = scene.force_N();
    RC_LOG() << under.name << (omni ? ", Omni" : "") << ", " << 1e3 * depth_m << " mm deep, "
             << material.stiffness_N_per_m << " N/m, " << before_N << " N\n";
    RC_ASSERT(before_N > 0.001);
    RC_ASSERT((under.back ? scene.edit(under.edit) : scene.take_hold()).has_value());
    const bool rubs = std::string(under.name) == "smooth" || std::string(under.name) == "rough";
    const double slips_N = rubs ? 0.35 * dynamic_friction * before_N : 0.0;
    check_course(scene.course(400), slips_N, 1e-3);
    if (!under.back) RC_ASSERT(scene.force_N() == 0.0);
    RC_ASSERT((under.back ? scene.edit(*under.back) : scene.part().let_go(kPressed)).has_value());
    check_course(scene.course(600), slips_N, 1e-3);
}

}  // namespace
}  // namespace burin::scene
