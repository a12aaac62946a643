// SPDX-License-Identifier: MIT
// Validation of tick parameters, and of what a surface refers to in them.
#include "haptics/tick_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "base/space.hpp"
#include "haptics/tick.hpp"

namespace burin::haptics {
namespace {

bool share(double x) { return not_negative(x) && x < 1.0; }

bool sensible(const TouchMaterial& m) {
    return not_negative(m.stiffness_N_per_m) && not_negative(m.damping_Ns_per_m) && not_negative(m.static_friction) &&
           not_negative(m.dynamic_friction) && m.dynamic_friction <= m.static_friction &&
           not_negative(m.coulomb_velocity_m_per_s) && m.hardness_Ns_per_m3 >= 0.0 &&  // infinite: cannot be cut
           not_negative(m.cutting_yield_Pa) && not_negative(m.grain_share) && m.grain_share <= 1.0 &&
           not_negative(m.grain_spacing_m) && finite(m.grain_axis_object) && not_negative(m.cutting_drag_Ns_per_m3);
}

bool sensible(const Probe& probe) {
    if (probe.count < 1 || probe.count > kMostProbePoints) return false;
    for (std::uint32_t i = 0; i < probe.count; ++i)
        if (!finite(probe.points[i].offset_device_m) || !not_negative(probe.points[i].radius_m) ||
            !not_negative(probe.points[i].share))
            return false;
    return true;
}

bool sensible(const ToolShape& shape) {
    if (!shape.touches()) return true;
    if (shape.piece_count > ToolShape::kMostPieces || !(shape.rounding_m > 0.0) || !(shape.size_m > 0.0) ||
        !std::isfinite(shape.size_m) || !std::isfinite(shape.reach_m) || !finite(shape.inside_m))
        return false;
    std::uint32_t corners = 0;
    for (std::uint32_t i = 0; i < shape.piece_count; ++i) {
        const ConvexPiece& piece = shape.pieces[i];
        if (piece.count == 0 || piece.first != corners || piece.count > ToolShape::kMostCorners - corners) return false;
        corners += piece.count;
    }
    for (std::uint32_t i = 0; i < corners; ++i)
        if (!finite(shape.corners[i])) return false;
    if (shape.side_count > ToolShape::kMostSides || (shape.side_count > 0 && shape.piece_count != 1)) return false;
    for (std::uint32_t i = 0; i < shape.side_count; ++i)
        if (!finite(shape.sides[i].normal) || !std::isfinite(shape.sides[i].offset_m)) return false;
    return true;
}

// NaN fails this comparison.
bool unit_turn(const Quat& q) { return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6; }

bool sensible(const GuidanceCurve& curve, const GuidanceSettings& s) {
    if (curve.count == 1 || curve.count > kMostCurvePoints) return false;
    return not_negative(s.stiffness_N_per_m) && not_negative(s.damping_Ns_per_m) && not_negative(s.max_force_N) &&
           not_negative(s.reach_m) && std::isfinite(s.lead_speed_m_per_s) && unit_turn(s.orientation_object);
}

bool sensible(const WorkSettings& w) {
    return w.share > 0.0 && w.share <= 1.0 && w.pace > 0.0 && std::isfinite(w.pace);
}

bool sensible(const WeightSettings& w) {
    return not_negative(w.compensated_mass_kg) && not_negative(w.tool_mass_kg) &&
           finite(w.tool_centre_of_mass_device_m) && std::abs(glm::dot(w.down_device, w.down_device) - 1.0) <= 2e-6;
}

}  // namespace

bool materials_are_known(const geometry::LocalSurface& surface) noexcept {
    return std::ranges::all_of(surface.meshes, [](const auto& mesh) { return mesh.material < kMostMaterials; });
}

bool parameters_are_sensible(const TickParameters& p) noexcept {
    for (const TouchMaterial& material : p.materials)
        if (!sensible(material)) return false;
    return settings_are_sensible(p.workspace) && sensible(p.probe) && finite(p.placement.position_object_m) &&
           sensible(p.shape) && share(p.clearance_ratio) && share(p.signals.velocity_alpha) &&
           share(p.signals.force_alpha) && not_negative(p.coupling.stiffness_N_per_m) &&
           not_negative(p.coupling.damping_Ns_per_m) && not_negative(p.passivity.max_damping_Ns_per_m) &&
           not_negative(p.passivity.reserve_J) && not_negative(p.passivity.surface_speed_m_per_s) && sensible(p.work) &&
           sensible(p.weight) && sensible(p.curve, p.guidance) && not_negative(p.position_noise_m) &&
           not_negative(p.max_surface_age_s);
}

}  // namespace burin::haptics
