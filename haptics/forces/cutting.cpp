// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/contact/contact_work.hpp"
#include "haptics/contact/static_vector.hpp"

namespace burin::haptics {
namespace {

// Of the tool's size or of one radian: so much motion asks for another look.
constexpr double kLookAgain = 0.1, kLookAgainWhileFree = 0.02;
constexpr std::uint32_t kMostCutStride = 16384, kStrideOfPieces = 64;
// Pieces from which on a look that was not complete was too fine. With fewer the contact has taken this tick's work,
// and the next one may have more; only after so many ticks in a row the look is made coarser all the same.
constexpr std::uint32_t kFairPieces = 1000, kMostMissed = 20;
// Least share of the half width over which a sample becomes engaged, and least cosine of a way onto a plane.
constexpr double kLeastSpread = 0.05, kLeastApproach = 0.2;
// The search begins with a stress that rises over this much, of the tool's size, and so without sharp corners.
constexpr double kFirstCreep = 1e-3;
// It ends where a step brings the function down by this share of it, or after so many steps and halvings.
constexpr double kSettled = 1e-9;
constexpr int kMostIterations = 15, kMostHalvings = 8;
// Of the tool's size: nearer to the hand than this it is there.
constexpr double kAtHand = 1e-6;
// Of a tick's budget: what is kept at most for a look and for a step; and how much more than the last one took.
constexpr double kMostForLook = 0.4, kMostForStep = 0.15, kMoreThanLast = 1.25;
// Of the pressure: by so much at least material below its yield holds the tool along its surface.
constexpr double kHeldInMaterial = 0.25;

// One element of the tool's surface in one tick: resisted by area * stress(w), w = max(0, dot(normal, u) + ahead_m).
struct Element {
    Vec3 normal{0.0};
    double area_m2 = 0.0;
    double ahead_m = 0.0;  // what the tool's turning brings it forward, less its gap to the material
    Vec3 arm_m{0.0};       // from the tool's origin
    double held = 0.0;     // stress against motion along the surface
};
// A sample partly within the material counts as so many elements, one behind the other.
constexpr int kElementsOfSample = 4;
using Elements = StaticVector<Element, kElementsOfSample * Engagement::kMost>;

// A symmetric matrix of three rows, and the solution of a linear system with it.
struct Symmetric {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;

    void add(const Vec3& m, double weight) {
        xx += weight * m.x * m.x, xy += weight * m.x * m.y, xz += weight * m.x * m.z;
        yy += weight * m.y * m.y, yz += weight * m.y * m.z, zz += weight * m.z * m.z;
    }
    // Along all directions alike.
    void add(double weight) { xx += weight, yy += weight, zz += weight; }
    // By Cholesky's decomposition; the matrix is positive definite.
    [[nodiscard]] Vec3 solved(const Vec3& b) const {
        const double a = std::sqrt(xx), p = xy / a, q = xz / a;
        const double d = std::sqrt(std::max(yy - p * p, 1e-300)), r = (yz - p * q) / d;
        const double e = std::sqrt(std::max(zz - q * q - r * r, 1e-300));
        const double y0 = b.x / a, y1 = (b.y - p * y0) / d, y2 = (b.z - q * y0 - r * y1) / e;
        const double z = y2 / e, y = (y1 - r * z) / d;
        return {(y0 - p * y - q * z) / a, y, z};
    }
};

// The function whose least gives the step.
class Resistance {
public:
    Resistance(const Elements& elements, std::uint32_t count, const Vec3& way_m, double pull, double yield,
               double hardness, double creep_m)
        : elements_(elements),
          count_(count),
          way_m_(way_m),
          pull_(pull),
          yield_(yield),
          hardness_(hardness),
          creep_m_(creep_m) {}

    [[nodiscard]] std::uint32_t elements() const { return count_; }
    [[nodiscard]] double stress(double w) const { return yield_ * std::min(1.0, w / creep_m_) + hardness_ * w; }

    [[nodiscard]] double at(const Vec3& u) const {
        const Vec3 left = way_m_ - u;
        double sum = 0.5 * pull_ * glm::dot(left, left);
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Element& e = elements_[i];
            const double into = glm::dot(e.normal, u), w = into + e.ahead_m;
            if (e.held > 0.0) sum += e.area_m2 * e.held * creeping(glm::length(u - into * e.normal));
            if (w <= 0.0) continue;
            sum += e.area_m2 * (yield_ * creeping(w) + 0.5 * hardness_ * w * w);
        }
        return sum;
    }
    // Newton's way from u to the least of the quadratic function that agrees at u.
    [[nodiscard]] Vec3 newton(const Vec3& u) const {
        Vec3 downhill = pull_ * (way_m_ - u);
        Symmetric curvature{.xx = pull_, .yy = pull_, .zz = pull_};
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Element& e = elements_[i];
            const double into = glm::dot(e.normal, u), w = into + e.ahead_m;
            if (e.held > 0.0) hold(e, u - into * e.normal, downhill, curvature);
            if (w < 0.0) continue;
            downhill -= e.area_m2 * stress(w) * e.normal;
            curvature.add(e.normal, e.area_m2 * (hardness_ + (w < creep_m_ ? yield_ / creep_m_ : 0.0)));
        }
        return curvature.solved(downhill);
    }

    // The stress along the surface of an element that moves so, against its motion.
    [[nodiscard]] Vec3 holding(const Element& e, const Vec3& u) const {
        const Vec3 along = u - glm::dot(e.normal, u) * e.normal;
        return -e.held / std::max(glm::length(along), creep_m_) * along;
    }

private:
    // The integral of a stress of 1 that rises over the creep.
    [[nodiscard]] double creeping(double w) const { return w < creep_m_ ? 0.5 * w * w / creep_m_ : w - 0.5 * creep_m_; }
    void hold(const Element& e, const Vec3& along, Vec3& downhill, Symmetric& curvature) const {
        const double length = glm::length(along), steep = e.area_m2 * e.held / std::max(length, creep_m_);
        downhill -= steep * along;
        curvature.add(steep);
        curvature.add(e.normal, -steep);
        if (length > creep_m_) curvature.add(along / length, -steep);
    }

    const Elements& elements_;
    std::uint32_t count_;
    Vec3 way_m_;
    double pull_, yield_, hardness_, creep_m_;
};

// Newton's steps from u, each halved until it brings the function down, up to so many terms in all. With fewer the tool
// goes less far, and nowhere with none: what it finds is never worse than staying.
Vec3 least(const Resistance& resistance, Vec3 u, std::uint32_t most_terms, std::uint32_t& terms) {
    const auto affords = [&](std::uint32_t times) { return times * resistance.elements() <= most_terms - terms; };
    if (terms > most_terms || !affords(2)) return Vec3(0.0);
    double now = resistance.at(u);
    if (const double at_rest = resistance.at(Vec3(0.0)); at_rest < now) u = Vec3(0.0), now = at_rest;
    terms += 2 * resistance.elements();
    for (int i = 0; i < kMostIterations && affords(2); ++i) {
        Vec3 onward = resistance.newton(u);
        double then = resistance.at(u + onward);
        terms += 2 * resistance.elements();
        for (int k = 0; k < kMostHalvings && !(then < now) && affords(1); ++k) {
            onward *= 0.5;
            then = resistance.at(u + onward);
            terms += resistance.elements();
        }
        if (!(then < now)) break;
        u += onward;
        const bool settled = now - then <= kSettled * now;
        now = then;
        if (settled) break;
    }
    return u;
}

// Below the yield material that is pressed holds the tool along its surface as well, by friction. The pressure is that
// of the last step; what is cut is sheared off and holds nothing.
void hold_below_the_yield(const CuttingState& state, double friction, double yield, double creep_m, std::uint32_t count,
                          Elements& elements) {
    if (!state.engaged) return;
    for (std::uint32_t i = 0; i < count; ++i) {
        Element& e = elements[i];
        const double pressed = (glm::dot(e.normal, state.step_object_m) + e.ahead_m) / creep_m;
        if (pressed > 0.0 && pressed < 1.0) e.held = friction * yield * pressed;
    }
}

// How much harder than its mean the material is at a place, from a wave of straight flanks.
double grain_at(const TouchMaterial& material, const Vec3& place_object_m) {
    if (!(material.grain_share > 0.0 && material.grain_spacing_m > 0.0)) return 1.0;
    const double rings = glm::dot(place_object_m, material.grain_axis_object) / material.grain_spacing_m;
    const double phase = rings - std::floor(rings);
    return 1.0 + material.grain_share * (4.0 * std::abs(phase - 0.5) - 1.0);
}

// The cutting point at the beginning of this step.
Vec3 carried_over(const CuttingState& state, const CuttingInput& in) {
    if (!state.engaged) return in.proxy_object_m;
    const Vec3 lag = state.point_object_m - in.hip_object_m;
    const double most = glm::length(in.proxy_object_m - in.hip_object_m) + in.slack_m;
    const double lag_m = glm::length(lag);
    return lag_m > most ? in.hip_object_m + lag * (most / lag_m) : state.point_object_m;
}

// The share of a step after which a point is so far from where it is known what lies around it.
double share_within(const Vec3& from, const Vec3& step, double most_m) {
    const double a = glm::dot(step, step), b = glm::dot(from, step), c = glm::dot(from, from) - most_m * most_m;
    if (!(a > 0.0) || c + 2.0 * b + a <= 0.0) return 1.0;
    // It was so far already: nearer it may go.
    if (c >= 0.0) return b < 0.0 ? 1.0 : 0.0;
    return (std::sqrt(b * b - a * c) - b) / a;
}

// What the tool may meet on a way of most_m. The area grows evenly as the tool sinks; what lies within already is one
// element.
std::uint32_t elements_of(const CuttingState& state, const CuttingInput& in, const ToolSurface& tool, const Vec3& place,
                          double most_m, Elements& elements) {
    std::uint32_t count = 0;
    const Engagement& known = state.known;
    const Vec3 shift = place - known.place_object_m;
    for (std::uint32_t i = 0; i < known.count; ++i) {
        const EngagedSample& s = known.samples[i];
        const ToolSample& on_tool = tool.samples[s.sample];
        const Vec3 arm = in.orientation_object * Vec3(on_tool.position_m);
        const Vec3 normal = in.orientation_object * Vec3(on_tool.normal);
        const Vec3 out(s.normal);
        const double approach = -glm::dot(out, normal);
        if (approach <= 0.0) continue;  // the tool has turned away
        const double fit = static_cast<double>(s.fit);
        const double bed_m = fit * kBed * tool.size_m - (1.0 - fit) * static_cast<double>(on_tool.raised_m);
        const double free_m = glm::dot(out, arm + shift) - static_cast<double>(s.offset_m) - bed_m;
        const double tilt = std::sqrt(std::max(0.0, 1.0 - approach * approach));
        const double spread_m = static_cast<double>(on_tool.half_width_m) * (tilt + kLeastSpread);
        const double turn_m =
            state.engaged ? glm::dot(normal, arm - state.orientation_object * Vec3(on_tool.position_m)) : 0.0;
        if (free_m > spread_m + most_m + std::abs(turn_m)) continue;
        const double part_m2 = static_cast<double>(s.area_m2) / kElementsOfSample;
        double within_m2 = 0.0;
        for (int k = 0; k < kElementsOfSample; ++k) {
            const double part_m = free_m + spread_m * ((k + 0.5) * (2.0 / kElementsOfSample) - 1.0);
            const double ahead_m = turn_m - part_m / std::max(approach, kLeastApproach);
            if (part_m <= 0.0)
                within_m2 += part_m2;
            else if (ahead_m > -most_m)
                elements[count++] = {normal, part_m2, ahead_m, arm};
        }
        if (within_m2 > 0.0) elements[count++] = {normal, within_m2, turn_m, arm};
    }
    return count;
}

CuttingStep not_cutting(const CuttingState& state, const CuttingInput& in, std::uint32_t terms = 0) {
    CuttingStep step;
    step.next = state;
    step.terms = terms;
    step.next.point_object_m = step.bearing_object_m = in.proxy_object_m;
    step.next.step_object_m = Vec3(0.0);
    step.next.engaged = false;
    return step;
}

}  // namespace

CuttingStep cut(const CuttingState& state, const CuttingInput& in, const ToolSurface& tool,
                const TouchMaterial& material) noexcept {
    if (!in.cutting || !std::isfinite(material.hardness_Ns_per_m3) || tool.count == 0) return not_cutting(state, in);
    CuttingStep step;
    step.next = state;
    step.next.engaged = true;
    step.next.orientation_object = in.orientation_object;
    const Vec3 before = carried_over(state, in);
    const Vec3 way_m = in.hip_object_m - before;
    Elements elements;
    const std::uint32_t count = elements_of(state, in, tool, before, glm::length(way_m), elements);
    const double grain = grain_at(material, before);
    const double g = in.scale;
    const double pull = in.stiffness_N_per_m * g * g * in.dt_s;
    const double yield = material.cutting_yield_Pa * grain * g * in.dt_s;
    const double hardness = material.hardness_Ns_per_m3 * grain;
    hold_below_the_yield(state, std::max(kHeldInMaterial, material.static_friction), yield, kCreep * tool.size_m, count,
                         elements);
    Vec3 u = state.engaged ? state.step_object_m : Vec3(0.0);
    for (const double creep : {kFirstCreep, kCreep}) {
        const std::uint32_t most = creep == kCreep ? in.most_terms : in.most_terms / 2;
        u = least(Resistance(elements, count, way_m, pull, yield, hardness, creep * tool.size_m), u, most, step.terms);
    }
    u *= share_within(before - in.proxy_object_m, u, tool.reach_m);
    const Vec3 point = before + u;
    step.next.point_object_m = step.bearing_object_m = point;
    step.next.step_object_m = u;
    step.next.terms = step.terms;
    const Resistance resistance(elements, count, way_m, pull, yield, hardness, kCreep * tool.size_m);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Element& e = elements[i];
        const double w = glm::dot(e.normal, u) + e.ahead_m;
        if (w < 0.0) continue;
        step.engaged_area_m2 += e.area_m2 / (g * g);
        // Stresses come out as pressure times g dt, areas and arms in the object's frame.
        const Vec3 stress = resistance.stress(w) * e.normal - resistance.holding(e, u);
        step.torque_device_Nm -= glm::cross(e.arm_m / g, (e.area_m2 / (g * g) / (g * in.dt_s)) * stress);
    }
    // Nothing bears the tool, and it is where the hand is.
    const bool is_at_hand = glm::length(way_m - u) <= kAtHand * tool.size_m;
    if (!in.in_contact && is_at_hand && !(step.engaged_area_m2 > 0.0)) return not_cutting(state, in, step.terms);
    step.cut_speed_m_per_s = glm::length(u) / (g * in.dt_s);
    step.drag_device_N = -material.cutting_drag_Ns_per_m3 * step.engaged_area_m2 * in.velocity_device_m_per_s;
    return step;
}

CuttingReserve reserve_for(const CuttingState& state, const geometry::LocalSurface& surface, double budget_ns,
                           bool has_shape) noexcept {
    const Engagement& known = state.known;
    CuttingReserve reserve{kMostForLook * budget_ns, kMostForStep * budget_ns};
    const bool is_known = known.next_look_ns > 0.0f && known.missed == 0 && !known.for_bearing;
    if (is_known && !has_shape)
        reserve.look_ns = std::min(reserve.look_ns, kMoreThanLast * static_cast<double>(known.next_look_ns));
    if (is_known && (has_shape || known.surface_sequence == surface.sequence)) reserve.look_ns = 0.0;
    if (state.engaged && state.terms > 0 && !has_shape)
        reserve.step_ns = std::min(reserve.step_ns, kMoreThanLast * WorkCost::kTerm_ns * state.terms);
    return reserve;
}

LookedAt look_at(const CuttingState& state, const CuttingInput& in, const ToolSurface& tool,
                 const geometry::LocalSurface& surface, const EngagementWork& most) noexcept {
    const Engagement& known = state.known;
    const Quat turn = in.orientation_object * glm::conjugate(known.orientation_object);
    const double half_angle = glm::length(Vec3(turn.x, turn.y, turn.z));
    // What is known of a plane has no end: a tool that leaves a face over its rim would still be borne by it.
    const double again = state.engaged && !in.in_contact ? kLookAgainWhileFree : kLookAgain;
    const bool moved =
        glm::length(in.proxy_object_m - known.place_object_m) > again * tool.size_m || half_angle > 0.5 * kLookAgain;
    const bool serves = !known.for_bearing || !in.cutting;
    if (known.surface_sequence == surface.sequence && !moved && serves) return {known, {}};
    EngagementLook look = look_around(surface, tool, in.proxy_object_m, in.orientation_object, known.stride, most,
                                      in.cutting ? LookFor::cutting : LookFor::bearing);
    if (!look.complete) {
        LookedAt as_before{known, look.work};
        // Where no look has been complete, here or at all, the part seen is better than nothing, until the next tick
        // looks again.
        const bool of_here = glm::length(in.proxy_object_m - known.place_object_m) <= tool.reach_m;
        if (known.surface_sequence == 0 || !serves || !of_here)
            as_before.known = look.engagement, as_before.known.surface_sequence = 0;
        as_before.known.missed = known.missed + 1;
        if (most.pieces >= kFairPieces || as_before.known.missed >= kMostMissed) {
            as_before.known.stride = std::min(known.stride * 2, kMostCutStride);
            as_before.known.missed = 0;
        }
        return as_before;
    }
    // From some stride on it is the looks that were too few (look_around), and a finer one would run out of them again.
    const bool has_looks = known.stride <= kStrideOfPieces || 3 * look.work.looks < most.looks;
    const bool has_room = 3 * look.work.pieces < most.pieces && has_looks;
    const bool finer = known.stride > 1 && has_room;
    if (finer) look.engagement.stride = known.stride / 2;
    const double cost_ns = WorkCost::kLook_ns * look.work.looks + WorkCost::kPiece_ns * look.work.pieces;
    look.engagement.next_look_ns = static_cast<float>(finer ? 2.0 * cost_ns : cost_ns);
    return {look.engagement, look.work};
}

std::optional<Vec3> middle_of_bearing(const Engagement& known, const CuttingInput& in,
                                      const ToolSurface& tool) noexcept {
    const Vec3 way = in.hip_object_m - in.proxy_object_m, shift = in.proxy_object_m - known.place_object_m;
    Vec3 sum(0.0);
    double weights = 0.0;
    for (std::uint32_t i = 0; i < known.count; ++i) {
        const EngagedSample& s = known.samples[i];
        const Vec3 arm = in.orientation_object * Vec3(tool.samples[s.sample].position_m);
        const Vec3 out(s.normal);
        const double gap_m = glm::dot(out, arm + shift) - static_cast<double>(s.offset_m);
        const double deep_m = -glm::dot(out, way) - gap_m;
        if (!(deep_m > 0.0)) continue;
        const double weight = deep_m * static_cast<double>(s.area_m2);
        sum += weight * arm;
        weights += weight;
    }
    if (!(weights > 0.0)) return std::nullopt;
    return in.proxy_object_m + sum / weights;
}

}  // namespace burin::haptics
