// SPDX-License-Identifier: MIT
#include "bodies/soft_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/try.hpp"
#include "bodies/solver/plastic_flow.hpp"
#include "geometry/contact/local_surface.hpp"
#include "scene/scene_changes.hpp"

namespace burin::bodies {
namespace {

// Contacts are looked for within this distance of the surface: farther than a hand moves within a few steps.
constexpr double kNear_m = 0.012;
// The stiffest that a contact at one point is, as a share of Young's modulus times the body's size.
constexpr double kContactShare = 0.6, kPlasticShare = 0.25;
// A mesh is as stiff under a point as a punch of this radius is on a half space, in edges of its lattice (measured).
constexpr double kPunchOfEdge = 0.68;
// The least stiffness of a model, as a share of the contact's: that of a first touch.
constexpr double kLeastShare = 0.04;
constexpr double kDamping_s = 0.0005;  // of a model, over its stiffness
constexpr double kCore = 0.5;          // the share of the half axes within which the body is held
constexpr double kAtRest_m_per_s = 1e-5, kAtRest_m = 2e-6;
constexpr unsigned kTouchedLevel = 3, kDrawnLevel = 4;

struct NearestOnTriangle {
    double squared_m2 = std::numeric_limits<double>::infinity();
    std::array<std::uint32_t, 3> corners{};
    Vec3 shares{0.0};
};

// Ericson 2005, "Real-Time Collision Detection", 5.1.5, by its regions.
Vec3 nearest_shares(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {1, 0, 0};
    const Vec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return {0, 1, 0};
    if (const double vc = d1 * d4 - d3 * d2; vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {1.0 - v, v, 0};
    }
    const Vec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return {0, 0, 1};
    if (const double vb = d5 * d2 - d1 * d6; vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {1.0 - w, 0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1.0 - w, w};
    }
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

// Of a probe's point, a ball, on this body. A small dent in what yields stays, and is not Hertz's.
DentLaw dent_law_of(const SoftPartSetup& setup) {
    const SoftMaterial& material = setup.material;
    const double size_m = std::cbrt(setup.half_axes_m.x * setup.half_axes_m.y * setup.half_axes_m.z);
    const double plane_Pa = material.young_Pa / (1.0 - material.poisson * material.poisson);
    const double radius_m = setup.point_radius_m * size_m / (setup.point_radius_m + size_m);
    return {.stiffest_N_per_m = (material.is_plastic() ? kPlasticShare : kContactShare) * material.young_Pa * size_m,
            .hertz_N_per_m32 = material.is_plastic() ? 0.0 : 4.0 / 3.0 * plane_Pa * std::sqrt(radius_m),
            .mesh_m_per_N = 1.0 / (2.0 * plane_Pa * kPunchOfEdge * setup.spacing_m)};
}

// A body falls as a ball of the same volume.
std::optional<FlightRoom> room_of(const SoftPartSetup& setup, std::optional<FlightRoom> room) {
    if (room) room->radius_m = std::cbrt(setup.half_axes_m.x * setup.half_axes_m.y * setup.half_axes_m.z);
    return room;
}

}  // namespace

Result<std::unique_ptr<SoftPart>> SoftPart::create(const SoftPartSetup& given) {
    SoftPartSetup setup = given;
    const double least_m = std::min({setup.half_axes_m.x, setup.half_axes_m.y, setup.half_axes_m.z});
    if (setup.spacing_m == 0.0) setup.spacing_m = 0.25 * least_m;
    Result<Tetrahedra> rest = ellipsoid(setup.half_axes_m, setup.spacing_m);
    if (!rest) return std::unexpected(rest.error());
    Result<SoftBody> body = SoftBody::create(std::move(*rest), setup.material);
    if (!body) return std::unexpected(body.error());
    return std::unique_ptr<SoftPart>(new SoftPart(setup, std::move(*body)));
}

SoftPart::SoftPart(const SoftPartSetup& setup, SoftBody body)
    : setup_(setup),
      frame_(setup.scene_from_body, room_of(setup, setup.room)),
      body_(std::move(body)),
      state_(body_.at_rest()),
      touched_(ellipsoid_surface(body_.rest(), setup.half_axes_m, kTouchedLevel)),
      drawn_(ellipsoid_surface(body_.rest(), setup.half_axes_m, kDrawnLevel)),
      triangles_at_(touched_.points.size()),
      law_(dent_law_of(setup)),
      holds_N_per_m_(body_.corners(), 0.0) {
    for (std::uint32_t t = 0; t < touched_.triangles.size(); ++t)
        for (const std::uint32_t corner : touched_.triangles[t]) triangles_at_[corner].push_back(t);
    double core_kg = 0.0;
    for (std::uint32_t i = 0; i < body_.corners(); ++i) mass_kg_ += body_.mass_kg(i);
    for (std::uint32_t i = 0; i < body_.corners(); ++i)
        if (glm::length(body_.rest().places_m[i] / setup.half_axes_m) < kCore) core_kg += body_.mass_kg(i);
    for (std::uint32_t i = 0; i < body_.corners(); ++i)
        if (glm::length(body_.rest().places_m[i] / setup.half_axes_m) < kCore)
            holds_N_per_m_[i] = setup.held_N_per_m * body_.mass_kg(i) / core_kg;
    if (setup.material.is_plastic()) held_at_m_ = body_.rest().places_m;
}

void SoftPart::take_ticks(std::size_t part, std::span<const haptics::TickRecord> ticks) {
    if (hands_.size() <= part) hands_.resize(part + 1);
    if (ticks.empty()) return;
    const haptics::ContactRecord& contact = ticks.back().contact;
    frame_.take_tick(part, ticks.back());
    hands_[part].time_ns = ticks.back().time_ns;
    // Where the force is off, or the part is not in its place yet, it touches nothing.
    const bool touches = (ticks.back().flags & haptics::kTickProxyReset) == 0;
    hands_[part].points = touches ? contact.point_count : 0;
    for (std::uint32_t i = 0; i < hands_[part].points; ++i)
        hands_[part].places_scene_m[i] = contact.points[i].hip_object_m;
}

void SoftPart::fall_among(FlightRoom room) { frame_.use(room_of(setup_, std::move(room))); }

// The contact of a point with the surface as it is now; nothing where it is far away.
std::optional<SoftContact> SoftPart::contact_at(const Vec3& point_m) const {
    if (!finite(point_m)) return std::nullopt;
    std::uint32_t nearest = 0;
    double least_m2 = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < surface_m_.size(); ++i) {
        const Vec3 away = surface_m_[i] - point_m;
        if (const double square = glm::dot(away, away); square < least_m2) {
            least_m2 = square;
            nearest = i;
        }
    }
    const double spread_m = 2.0 * setup_.spacing_m;  // more than an edge of the surface
    if (least_m2 > (kNear_m + spread_m) * (kNear_m + spread_m)) return std::nullopt;
    NearestOnTriangle best;
    for (const std::uint32_t t : triangles_at_[nearest]) {
        const auto& [a, b, c] = touched_.triangles[t];
        const Vec3 shares = nearest_shares(point_m, surface_m_[a], surface_m_[b], surface_m_[c]);
        const Vec3 away = shares.x * surface_m_[a] + shares.y * surface_m_[b] + shares.z * surface_m_[c] - point_m;
        if (const double square = glm::dot(away, away); square < best.squared_m2)
            best = {square, touched_.triangles[t], shares};
    }
    SoftContact contact;
    Vec3 normal(0.0), place_m(0.0), bulge_m(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t corner = best.corners[static_cast<std::size_t>(i)];
        contact.add(touched_.points[corner], best.shares[i]);
        normal += best.shares[i] * normals_[corner];
        place_m += best.shares[i] * surface_m_[corner];
    }
    if (!(glm::length(normal) > 1e-9)) return std::nullopt;
    // A facet lies beneath the surface that its corners' tangent planes describe, on a paraboloid by half of its mean
    // distance from them (Boubekeur and Alexa 2008, "Phong Tessellation", take three quarters, for looks).
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t corner = best.corners[static_cast<std::size_t>(i)];
        bulge_m += 0.5 * best.shares[i] * glm::dot(surface_m_[corner] - place_m, normals_[corner]) * normals_[corner];
    }
    contact.normal = -glm::normalize(normal);
    contact.offset_m = glm::dot(contact.normal, point_m) + setup_.point_radius_m - glm::dot(contact.normal, bulge_m);
    contact.law = law_;
    if (contact.depth_m(state_.places_m) < -kNear_m) return std::nullopt;
    return contact;
}

void SoftPart::find_contacts() {
    surface_m_ = places_of(touched_, state_.places_m);
    normals_.assign(surface_m_.size(), Vec3(0.0));
    for (const auto& triangle : touched_.triangles) {
        const auto& [a, b, c] = triangle;
        const Vec3 area = glm::cross(surface_m_[b] - surface_m_[a], surface_m_[c] - surface_m_[a]);
        for (const std::uint32_t corner : triangle) normals_[corner] += area;
    }
    for (Vec3& normal : normals_)
        if (const double length = glm::length(normal); length > 0.0) normal /= length;
    pressed_.clear();
    contacts_.clear();
    const Pose body_from_scene = scene::inverse(frame_.pose());
    for (std::size_t hand = 0; hand < hands_.size(); ++hand)
        for (std::uint32_t i = 0; i < hands_[hand].points; ++i) {
            const Vec3 place_m = body_from_scene * hands_[hand].places_scene_m[i];
            const auto contact = contact_at(place_m);
            if (!contact) continue;
            pressed_.push_back({hand, i, place_m, -contact->normal});
            contacts_.push_back(*contact);
        }
}

void SoftPart::make_models(Nanoseconds now_ns) {
    for (Hand& hand : hands_) hand.models.clear();
    for (std::size_t i = 0; i < pressed_.size(); ++i) {
        const Pressed& at = pressed_[i];
        const SoftContact& contact = contacts_[i];
        const double sunk_m = contact.depth_m(state_.places_m), force_N = contact.law.at(sunk_m).force_N;
        const double least_N_per_m = kLeastShare * law_.stiffest_N_per_m;
        // Depth of the point in the body at rest, along the ray from the body's middle.
        const double level = glm::length(at.place_m / setup_.half_axes_m);
        const double depth_m = setup_.point_radius_m + glm::length(at.place_m) * (1.0 / std::max(level, 1e-6) - 1.0);
        const double secant = depth_m > 0.0 ? force_N / depth_m : 0.0;
        geometry::LocalModel model;
        model.point = at.point;
        model.object = setup_.object;
        model.normal_object = frame_.pose().orientation * at.normal;
        model.place_object_m = frame_.pose() * at.place_m;
        model.velocity_object_m_per_s = frame_.velocity_at(model.place_object_m);
        model.stiffness_N_per_m = std::clamp(secant, least_N_per_m, law_.stiffest_N_per_m);
        model.force_N = force_N > 0.0 ? force_N : model.stiffness_N_per_m * sunk_m;
        model.damping_Ns_per_m = kDamping_s * model.stiffness_N_per_m;
        model.surface_N_per_m = force_N > 0.0 ? force_N / sunk_m : least_N_per_m;
        // A hand that holds the body has taken it to where the hand was then.
        model.time_ns = frame_.is_held() ? hands_[at.hand].time_ns : now_ns;
        hands_[at.hand].models.push_back(model);
    }
}

// The acceleration of the whole body by what touches it.
Vec3 SoftPart::push_m_per_s2() const {
    Vec3 sum_N(0.0);
    for (const SoftContact& contact : contacts_) sum_N += contact.force_N(state_.places_m) * contact.normal;
    return frame_.pose().orientation * sum_N / mass_kg_;
}

bool SoftPart::is_still() const {
    return std::ranges::all_of(state_.velocities_m_per_s, [](const Vec3& velocity_m_per_s) {
        return glm::dot(velocity_m_per_s, velocity_m_per_s) <= kAtRest_m_per_s * kAtRest_m_per_s;
    });
}

bool SoftPart::rests() const {
    if (!contacts_.empty() || !is_still()) return false;
    if (!held_at_m_.empty()) return true;  // one that has flowed has other places at rest
    for (std::uint32_t i = 0; i < body_.corners(); ++i) {
        const Vec3 away_m = state_.places_m[i] - body_.rest().places_m[i];
        if (glm::dot(away_m, away_m) > kAtRest_m * kAtRest_m) return false;
    }
    return true;
}

// ---- Dents

bool SoftPart::is_pressed() const {
    return setup_.material.is_plastic() && std::ranges::any_of(contacts_, [this](const SoftContact& contact) {
               return contact.force_N(state_.places_m) > 0.0;
           });
}

void SoftPart::take(SoftShapeKept shape) {
    state_.places_m = std::move(shape.places_m);
    std::ranges::fill(state_.velocities_m_per_s, Vec3(0.0));
    held_at_m_ = std::move(shape.held_at_m);
    take_rest_shapes(body_, state_, shape.metrics);
    has_moved_ = true;
}

void SoftPart::follow_dents() {
    if (dents_.goes_on() && !is_pressed() && is_still()) dents_.end();
    while (!waiting_.empty() && has_gone(waiting_.front())) waiting_.erase(waiting_.begin());
}

bool SoftPart::has_gone(scene::StepWay way) {
    if (way != scene::StepWay::forget && is_pressed()) return false;
    SoftShapeKept now = shape();
    if (const SoftShapeKept* const next = dents_.next(way)) {
        SoftState before = state_;
        take(*next);
        find_contacts();
        if (is_pressed()) {
            state_ = std::move(before);
            held_at_m_ = now.held_at_m;
            find_contacts();
            return false;
        }
    }
    static_cast<void>(dents_.go(way, std::move(now)));
    walked_ += way == scene::StepWay::forget ? 0 : 1;
    return true;
}

scene::PartSteps SoftPart::undo_steps() const {
    scene::PartSteps steps = dents_.steps();
    steps.walked = walked_;
    return steps;
}

Result<void> SoftPart::save(scene::Pages& pages) {
    if (!setup_.material.is_plastic()) return ScenePart::save(pages);
    dents_.save(pages);
    save_body(setup_, shape(), pages);
    return {};
}

bool SoftPart::note(scene::Pages& pages) {
    if (!setup_.material.is_plastic() || dents_.goes_on()) return false;
    dents_.note(pages);
    save_body(setup_, shape(), pages);
    return true;
}

Result<void> SoftPart::load(const scene::Pages& pages, const scene::Steps& steps,
                            std::span<const scene::Pages> each_step, const std::string& where) {
    BURIN_TRY(saved, load_body(setup_, body_, pages, where));
    std::vector<SoftShapeKept> shapes;
    for (const scene::Pages& step : each_step) {
        BURIN_TRY(shape, shape_in(body_, step, where));
        shapes.push_back(std::move(shape));
    }
    dents_.load(steps, std::move(shapes));
    take(std::move(saved));
    return {};
}

Result<void> SoftPart::update(Nanoseconds now_ns, const scene::PartSeen* /*recorded*/) {
    if (!stepped_to_ns_) stepped_to_ns_ = now_ns;
    const Nanoseconds due = (now_ns - *stepped_to_ns_) / setup_.step_ns;
    *stepped_to_ns_ += due * setup_.step_ns;
    const Pose before = frame_.pose();
    frame_.update(now_ns, push_m_per_s2());
    has_moved_ = has_moved_ || frame_.pose() != before;
    find_contacts();
    const int steps = rests() ? 0 : static_cast<int>(std::min<Nanoseconds>(due, kMostSteps));
    for (int i = 0; i < steps; ++i) {
        if (i > 0) find_contacts();
        if (is_pressed() && !dents_.goes_on()) dents_.begin(shape());
        solver_.step(body_, state_,
                     {seconds(setup_.step_ns), setup_.sweeps, Vec3(0.0), contacts_, holds_N_per_m_, held_at_m_});
        if (!held_at_m_.empty()) follow_shape(body_, state_, holds_N_per_m_, held_at_m_);
        ++steps_;
    }
    make_models(now_ns);
    has_moved_ = has_moved_ || steps > 0;
    follow_dents();
    return {};
}

Result<void> SoftPart::add_near(const scene::ProbeBall& ball, geometry::LocalSurface& draft) {
    for (const geometry::LocalModel& model : models(ball.hand)) draft.models.add(model);
    return {};
}

std::span<const geometry::LocalModel> SoftPart::models(std::size_t hand) const {
    return hand < hands_.size() ? std::span<const geometry::LocalModel>(hands_[hand].models)
                                : std::span<const geometry::LocalModel>();
}

void SoftPart::take_changes(scene::SceneChanges& changes) {
    if (!std::exchange(has_moved_, false)) return;
    auto shape = std::make_shared<SoftShape>();
    shape->scene_from_body = frame_.pose();
    shape->places_m = places_of(drawn_, state_.places_m);
    shape->palm_from_body = frame_.palm_from_body();
    changes.drawn.push_back(std::move(shape));
}

}  // namespace burin::bodies
