// SPDX-License-Identifier: MIT
#include "activities/grasp/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/text.hpp"
#include "devices/gloves/glove_device.hpp"
#include "haptics/tick_parameters.hpp"
#include "scene/object_property.hpp"
#include "session/objects/world_objects.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin::activities {
namespace {

using geometry::Finger;
using geometry::Gesture;
using scene::ObjectProperty;

constexpr Nanoseconds kGestureStep_ns = 8'000'000;  // about as often as a glove sends a set
constexpr double kPointRadius_m = 0.001;            // of a patch's points, which lie so deep under the skin
constexpr double kUsualDepth_m = 0.002;             // to which a fingertip is pressed in
constexpr scene::PropertyValue kLitUp{1.0, 0.85, 0.35};

const char* text_of(Gesture gesture) {
    switch (gesture) {
        case Gesture::none: return "open";
        case Gesture::whole: return "grasps";
        case Gesture::pinch: return "pinches";
        case Gesture::point: return "points";
    }
    return "";
}

const char* text_of(devices::DeviceFault fault) {
    switch (fault) {
        case devices::DeviceFault::disconnected:
            return "the glove is lost, so there is no force: see to its cable and its power";
        case devices::DeviceFault::motors_off:
            return "the glove's motors are off, so there is no force: switch them on at its controller";
        case devices::DeviceFault::force_differs:
            return "the glove's pistons give other forces than they are told, so there is no force: see to its air";
        case devices::DeviceFault::false_reading:
            return "no finger of the glove reads what it can be, so there is no force: see to its sensors";
        default: return "the glove reports a fault, so there is no force: see to its controller";
    }
}

std::string name_of(const session::WorldObjects& world, scene::ObjectId id) {
    const scene::SceneObject* object = world.find(id);
    return object != nullptr ? object->name : std::string();
}

// Radius of the largest object that a hand takes or points at, as the hand sees it: a hand that is larger in the scene
// takes larger ones. A table is larger, and its ball is around all that stands on it.
constexpr double kLargest_m = 0.12;

// Returns the ball around an object: its middle in the scene and its radius.
std::pair<Vec3, double> ball_around(const scene::SceneObject& object) {
    Box bounds;
    for (const Vec3& p : object.mesh->positions_m) bounds.include(p);
    return {object.pose * (object.scale * bounds.center()), 0.5 * object.scale * glm::length(bounds.extent())};
}

// Tells a ball: all corners of the mesh are at one distance from its middle, within 2 % of it.
bool is_round(const geometry::TriangleMesh& mesh) {
    Box bounds;
    for (const Vec3& p : mesh.positions_m) bounds.include(p);
    const double radius_m = 0.5 * bounds.extent().x;
    return !mesh.positions_m.empty() && std::ranges::all_of(mesh.positions_m, [&](const Vec3& p) {
        return std::abs(glm::length(p - bounds.center()) - radius_m) <= 0.02 * radius_m;
    });
}

}  // namespace

Result<GraspOptions> grasp_options_of(const std::string& settings) {
    GraspOptions options;
    std::array<char, 16> mesh{}, rendering{};
    if (std::sscanf(settings.c_str(), "hand --points %u --extent %lf --mesh %15s --rendering %15s", &options.points,
                    &options.extent_mm, mesh.data(), rendering.data()) == 4) {
        if (std::string_view(mesh.data()) == "literal") options.stiffness = PatchStiffness::literal;
        if (std::string_view(rendering.data()) == "local") options.rendering = GloveRendering::local;
        const bool is_right = options.points >= 1 && options.points <= kMostFingertipPoints &&
                              options.extent_mm >= kLeastExtent_mm && options.extent_mm <= kMostExtent_mm;
        if (is_right && Grasp(options).settings() == settings) return options;
    }
    return fail(settings, "are no settings of burin hand", "replay it with the program that recorded it");
}

Grasp::Grasp(const GraspOptions& options) : options_(options) {
    for (std::size_t i = 0; i < kFelt; ++i) {
        auto patch = geometry::fingertip_patch(geometry::known_hand_model(false), static_cast<Finger>(i),
                                               {.points = options.points, .extent_m = 1e-3 * options.extent_mm});
        BURIN_CHECK(patch.has_value());
        if (!patch) continue;
        patches_[i] = std::move(*patch);
        shares_[i] = options.stiffness == PatchStiffness::literal
                         ? std::vector<double>(patches_[i].size(), 1.0)
                         : geometry::stiffness_shares(patches_[i], kUsualDepth_m);
    }
}

Grasp::~Grasp() = default;

std::string Grasp::settings() const {
    return formatted("hand --points %u --extent %g --mesh %s --rendering %s", options_.points, options_.extent_mm,
                     options_.stiffness == PatchStiffness::literal ? "literal" : "shared",
                     options_.rendering == GloveRendering::local ? "local" : "distributed");
}

Result<void> Grasp::act(std::span<const std::string> words, session::ActivityOrders&) {
    return fail("command do " + words[0], "is nothing that a hand is told", "close the fingers instead");
}

// A patch's middle is where the device has its fingertip; the tool's ball gives way to it.
void Grasp::adjust(session::PartOfHand of, haptics::TickParameters& parameters) const {
    if (of.part >= kFelt || patches_[of.part].empty()) return;
    const std::vector<geometry::PatchPoint>& patch = patches_[of.part];
    const double scale = parameters.workspace.object_from_device.scale;
    haptics::Probe& probe = parameters.probe;
    probe.count = static_cast<std::uint32_t>(std::min<std::size_t>(patch.size(), haptics::kMostProbePoints));
    // The skin's pad in the device's frame of the tip, whose origin is its middle.
    const auto under_skin = [](const geometry::PatchPoint& point) {
        return point.place_tip_m - kPointRadius_m * point.normal_tip;
    };
    const Vec3 middle_m = under_skin(patch.front());
    for (std::uint32_t i = 0; i < probe.count; ++i)
        probe.points[i] = {under_skin(patch[i]) - middle_m, scale * kPointRadius_m, shares_[of.part][i]};
    parameters.shape = {};
    parameters.tool.count = 0;
    parameters.clearance_ratio = 0.0;
    if (placements_[of.part].number > 0) parameters.placement = placements_[of.part];
    parameters.local_rendering = options_.rendering == GloveRendering::local;
}

void Grasp::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    if (view.world != nullptr && is_ball_.empty())
        for (const auto& object : view.world->objects)
            if (object->seen) is_ball_.push_back(is_round(*object->mesh));
    const std::span<const session::PartView> parts = view.hands.front().parts;
    if (parts.size() < kFelt) return;
    for (std::size_t turn = 0; turn < parts[0].ticks.size(); ++turn) {
        std::array<const haptics::TickRecord*, kFelt> ticks{};
        bool all = true;
        for (std::size_t i = 0; i < kFelt; ++i) {
            // A tick that was lost is missing from one part alone; the others of that turn are then passed over.
            const auto tick =
                std::ranges::lower_bound(parts[i].ticks, parts[0].ticks[turn].tick, {}, &haptics::TickRecord::tick);
            all = all && tick != parts[i].ticks.end() && tick->tick == parts[0].ticks[turn].tick;
            if (all) ticks[i] = &*tick;
        }
        if (!all) continue;
        watch_glove(ticks, view.world, orders);
        if (has_fault_) continue;
        const bool is_newest = turn + 1 == parts[0].ticks.size();
        if (!is_newest && ticks[0]->time_ns - gesture_.time_ns < kGestureStep_ns) continue;
        hand_ = reading_of(ticks);
        go_on_by(*hand_, view.world, orders);
    }
    if (gesture_.grasps() && !grasps_.empty()) grasps_.back().carried_m = grip_scene_m() - taken_at_m_;
}

void Grasp::watch_glove(const std::array<const haptics::TickRecord*, kFelt>& ticks, const session::WorldObjects* world,
                        session::ActivityOrders& orders) {
    const auto has_fault = [](const auto* tick) { return tick->sample.fault != devices::DeviceFault::none; };
    const Nanoseconds now_ns = ticks[0]->time_ns;
    tell_of_fingers(ticks, orders);
    count_rejected(ticks, orders);
    has_fault_ = std::ranges::all_of(ticks, has_fault);
    if (!has_fault_) {
        well_ns_ = now_ns;
        if (std::exchange(told_of_fault_, false))
            orders.messages.push_back("the glove is back: its force comes back from zero");
        return;
    }
    // A gap that keeps a grasp is nobody's concern.
    if (told_of_fault_ || now_ns - well_ns_ <= geometry::kMostGap_ns) return;
    told_of_fault_ = true;
    orders.messages.push_back(text_of(ticks[0]->sample.fault));
    if (gesture_.grasps()) end_grasp(now_ns, orders);
    gesture_ = {};
    if (hand_ && world != nullptr) point_at(*hand_, *world, orders);
}

// One may happen; many are told, ever more seldom.
void Grasp::count_rejected(const std::array<const haptics::TickRecord*, kFelt>& ticks,
                           session::ActivityOrders& orders) {
    if ((ticks[0]->sample.drive.state & devices::kDriveSetRejected) == 0) return;
    ++rejected_sets_;
    if (rejected_sets_ < std::max<std::uint64_t>(10 * told_of_sets_, 10)) return;
    told_of_sets_ = rejected_sets_;
    orders.messages.push_back(
        formatted("%llu of the glove's sets were left out, since a finger jumped in them: see to its line and sensors",
                  static_cast<unsigned long long>(rejected_sets_)));
}

// A finger with a fault of its own is lost to the exercise, while the others go on. The joint that is wrong shows when
// the finger has come to its reading.
void Grasp::tell_of_fingers(const std::array<const haptics::TickRecord*, kFelt>& ticks,
                            session::ActivityOrders& orders) {
    constexpr std::array<const char*, kFelt> kNames{"thumb's", "index finger's", "middle finger's", "ring finger's"};
    for (std::size_t i = 0; i < kFelt; ++i) {
        const devices::DeviceSample& sample = ticks[i]->sample;
        if (sample.fault != told_of_fingers_[i]) told_of_fingers_[i] = devices::DeviceFault::none;
        if (told_of_fingers_[i] == sample.fault) continue;
        if (sample.fault == devices::DeviceFault::force_differs) {
            told_of_fingers_[i] = sample.fault;
            orders.messages.push_back(
                formatted("the %s piston gives another force than it is told (now %.1f N), so it "
                          "is told none: see to its air, then switch the glove off and on",
                          kNames[i], sample.drive.measured_N));
        }
        devices::FingerAngles angles{};
        std::copy_n(sample.joints.begin(), angles.size(), angles.begin());
        const auto joint = devices::joint_beyond(i, angles);
        if (sample.fault != devices::DeviceFault::false_reading || !joint) continue;
        told_of_fingers_[i] = sample.fault;
        orders.messages.push_back(devices::false_reading_text(i, *joint, angles[*joint]));
    }
}

// A contact that is sound holds a fingertip, also where the hand has gone away on the thing's other side. Whoever
// presses is held back by it; a hand that has let go is not.
void Grasp::free_fingers(const HandReading& hand, session::ActivityOrders& orders) {
    constexpr double kFar_m = 0.03;  // about twice as thick as a fingertip; a press goes some millimetres deep
    constexpr Nanoseconds kStays_ns = 150'000'000;
    for (std::size_t i = 0; i < kFelt; ++i) {
        const FingerReading& finger = hand.fingers[i];
        const double far_m = finger.object != 0 ? glm::length(finger.out_scene_m) / hand.scene_from_hand.scale : 0.0;
        if (gesture_.grasps() || !(far_m > kFar_m)) {
            behind_since_ns_[i] = 0;
            continue;
        }
        if (behind_since_ns_[i] == 0) behind_since_ns_[i] = hand.time_ns;
        if (hand.time_ns - behind_since_ns_[i] < kStays_ns) continue;
        behind_since_ns_[i] = 0;
        placements_[i] = {placements_[i].number + 1, finger.at_scene_m};
        orders.parameters = true;
    }
}

void Grasp::go_on_by(const HandReading& hand, const session::WorldObjects* world, session::ActivityOrders& orders) {
    geometry::GestureInput input{.time_ns = hand.time_ns, .closures = {}, .touched = opposed_contacts(hand)};
    for (std::size_t i = 0; i < geometry::kHandFingers; ++i)
        input.closures[i] = (geometry::closure_of(static_cast<Finger>(i), hand.bend[i]) - options_.open) /
                            (options_.closed - options_.open);
    for (std::uint64_t& object : input.touched)
        if (const auto* touched = world != nullptr ? world->find(object) : nullptr;
            touched == nullptr || ball_around(*touched).second > kLargest_m * hand.scene_from_hand.scale)
            object = 0;
    const geometry::GestureState before = std::exchange(gesture_, geometry::step_gesture(gesture_, input));
    free_fingers(hand, orders);
    if (world == nullptr) return;
    const bool same = before.grasps() && gesture_.grasps() && before.object == gesture_.object;
    if (before.grasps() && !same) end_grasp(hand.time_ns, orders);
    if (gesture_.grasps() && !same) begin_grasp(*world, orders);
    if (same) grasps_.back().gesture = gesture_.gesture;
    point_at(hand, *world, orders);
}

void Grasp::begin_grasp(const session::WorldObjects& world, session::ActivityOrders& orders) {
    const std::string name = name_of(world, gesture_.object);
    session::HoldObject hold{name, {}, true};
    for (std::size_t i = 0; i < kFelt; ++i)
        if (gesture_.holds[i]) hold.by.push_back({0, i});
    grasps_.push_back({name, gesture_.gesture, gesture_.time_ns, 0, Vec3(0.0)});
    holding_ = gesture_.holds;
    taken_at_m_ = grip_scene_m();
    if (name.empty()) return;
    orders.holds.push_back(std::move(hold));
    orders.messages.push_back("the hand " + std::string(text_of(gesture_.gesture)) + " " + name);
    orders.trials.push_back({gesture_.time_ns, name});
}

void Grasp::end_grasp(Nanoseconds time_ns, session::ActivityOrders& orders) {
    Grasped& grasped = grasps_.back();
    grasped.ended_ns = time_ns;
    if (grasped.object.empty()) return;
    orders.holds.push_back({grasped.object, {}, false});
    orders.messages.push_back(formatted("the hand lets go of %s, which it has carried %.0f mm", grasped.object.c_str(),
                                        1e3 * glm::length(grasped.carried_m)));
    orders.trials.push_back({time_ns, "", "let go"});
}

// Where the fingers that hold something are, on average.
Vec3 Grasp::grip_scene_m() const {
    Vec3 sum(0.0);
    double count = 0.0;
    for (std::size_t i = 0; i < kFelt; ++i) {
        if (!holding_[i]) continue;
        const Pose tip = devices::place_of(devices::usual_hand()[i], hand_->bend[i]).hand_from_tip;
        sum += hand_->scene_from_hand * tip.position_m;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : hand_->scene_from_hand.position_m;
}

// Lights up the first object whose ball the index' line meets.
void Grasp::point_at(const HandReading& hand, const session::WorldObjects& world, session::ActivityOrders& orders) {
    std::string wanted;
    if (gesture_.gesture == Gesture::point) {
        const devices::FingertipPlace tip = devices::place_of(devices::usual_hand()[1], hand.bend[1]);
        const Vec3 from = hand.scene_from_hand * tip.hand_from_tip.position_m;
        const Vec3 along = hand.scene_from_hand.orientation * (tip.hand_from_tip.orientation * Vec3(0.0, 1.0, 0.0));
        const double largest_m = kLargest_m * hand.scene_from_hand.scale;
        double nearest_m = HUGE_VAL;
        for (const auto& object : world.objects) {
            const auto [middle, radius_m] = ball_around(*object);
            const double ahead_m = glm::dot(middle - from, along);
            const double beside_m = glm::length(middle - from - ahead_m * along);
            if (!object->seen || radius_m > largest_m || ahead_m <= 0.0 || beside_m > radius_m) continue;
            if (ahead_m < nearest_m) wanted = object->name;
            nearest_m = std::min(nearest_m, ahead_m);
        }
    }
    if (wanted == pointed_at_) return;
    if (its_colour_) orders.edits.push_back({pointed_at_, ObjectProperty::colour, *its_colour_});
    its_colour_.reset();
    pointed_at_ = wanted;
    const auto id = object_named(world, wanted);
    if (wanted.empty() || !id) return;
    its_colour_ = scene::value_of(*world.find(*id), ObjectProperty::colour);
    orders.edits.push_back({wanted, ObjectProperty::colour, kLitUp});
    orders.messages.push_back("the hand points at " + wanted);
}

// The shadows of balls are closed forms as a hand's are.
void Grasp::cast_balls(picture::Picture& scene) const {
    constexpr std::size_t kHands = geometry::kBoneCapsules + 1;
    for (std::size_t i = 0; i < scene.objects.size() && i < is_ball_.size(); ++i) {
        picture::DrawnObject& object = scene.objects[i];
        if (!is_ball_[i] || scene.capsules.size() + kHands >= shared::kMostCapsules) continue;
        const Vec3 middle = object.world_from_mesh * object.mesh->bounds.center();
        const double radius_m = 0.5 * object.world_from_mesh.scale * object.mesh->bounds.extent().x;
        object.own_capsule = static_cast<std::int32_t>(scene.capsules.size());
        scene.capsules.push_back({middle, middle, radius_m});
    }
}

void Grasp::stage(picture::Picture& scene, std::size_t /*screen*/) const {
    scene.box.visible = scene.proposed_box.visible = false;
    if (!hand_) return;
    cast_balls(scene);
    if (!drawn_) drawn_ = std::make_unique<const DrawnHand>(geometry::known_hand_model(false));
    drawn_->add_to(scene, drawn_bend(*hand_), scene.world_from_object * hand_->scene_from_hand);
}

session::ActivityPanel Grasp::panel() const {
    using Row = session::ActivityPanel::Row;
    session::ActivityPanel panel{.title = "Hand", .aside = text_of(gesture_.gesture)};
    if (gesture_.grasps()) panel.widgets.push_back(Row{"Holds", grasps_.back().object});
    if (!pointed_at_.empty()) panel.widgets.push_back(Row{"Points at", pointed_at_});
    return panel;
}

}  // namespace burin::activities
