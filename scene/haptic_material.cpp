// SPDX-License-Identifier: MIT
#include "scene/haptic_material.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "scene/value_text.hpp"

namespace burin::scene {
namespace {

void check_range(std::vector<Problem>& found, const char* key, double value, double most) {
    if (std::isfinite(value) && value >= 0.0 && value <= most) return;
    found.push_back({key, "is " + number_text(value), "give a number from 0 to " + number_text(most)});
}

}  // namespace

std::vector<Problem> problems(const HapticMaterial& m) {
    std::vector<Problem> found;
    if (!(m.stiffness_N_per_m > 0.0 && m.stiffness_N_per_m <= kMaxStiffness_N_per_m))
        found.push_back({"stiffness", "is " + number_text(m.stiffness_N_per_m),
                         "give N/m above 0 and up to " + number_text(kMaxStiffness_N_per_m) +
                             ", such as 600; felt = false makes an object that is not felt"});
    check_range(found, "damping", m.damping_Ns_per_m, kMaxDamping_Ns_per_m);
    check_range(found, "static_friction", m.static_friction, kMaxFriction);
    check_range(found, "dynamic_friction", m.dynamic_friction, kMaxFriction);
    check_range(found, "coulomb_velocity", m.coulomb_velocity_m_per_s, kMaxCoulombVelocity_m_per_s);
    if (m.dynamic_friction > m.static_friction)
        found.push_back({"dynamic_friction",
                         "is above static_friction, and what slides would be held harder than what "
                         "sticks",
                         formatted("give at most %g, or raise static_friction", m.static_friction)});
    return found;
}

haptics::TouchMaterial touch_material(const HapticMaterial& material) noexcept {
    haptics::TouchMaterial touched;
    touched.stiffness_N_per_m = material.stiffness_N_per_m;
    touched.damping_Ns_per_m = material.damping_Ns_per_m;
    touched.static_friction = material.static_friction;
    touched.dynamic_friction = material.dynamic_friction;
    touched.coulomb_velocity_m_per_s = material.coulomb_velocity_m_per_s;
    // Whatever tool the hand holds: an object of a scene is not cut.
    touched.hardness_Ns_per_m3 = std::numeric_limits<double>::infinity();
    return touched;
}

MaterialTable::MaterialTable(std::uint32_t reserved) : reserved_(reserved) { BURIN_CHECK(reserved <= kMaxEntries); }

Result<std::uint8_t> MaterialTable::hold(const HapticMaterial& material) {
    std::uint32_t free = kMaxEntries;
    for (std::uint32_t i = reserved_; i < kMaxEntries; ++i) {
        Entry& entry = entries_[i];
        if (entry.holders == 0) {
            free = std::min(free, i);
        } else if (entry.material == material) {
            ++entry.holders;
            return static_cast<std::uint8_t>(i);
        }
    }
    if (free == kMaxEntries)
        return fail("haptic materials",
                    formatted("all %u places hold other materials", static_cast<unsigned>(kMaxEntries - reserved_)),
                    "let some objects share a material");
    entries_[free] = {material, 1};
    ++version_;
    return static_cast<std::uint8_t>(free);
}

void MaterialTable::release(std::uint8_t index) {
    BURIN_CHECK(index < kMaxEntries && entries_[index].holders > 0);
    if (index < kMaxEntries && entries_[index].holders > 0) --entries_[index].holders;
}

Result<std::uint8_t> MaterialTable::change(std::uint8_t index, const HapticMaterial& material) {
    BURIN_CHECK(index < kMaxEntries && entries_[index].holders > 0);
    const auto holds_it = [&](const Entry& entry) { return entry.holders > 0 && entry.material == material; };
    if (entries_[index].holders == 1 && std::ranges::none_of(entries_, holds_it)) {
        entries_[index].material = material;
        ++version_;
        return index;
    }
    const Result<std::uint8_t> held = hold(material);
    if (held) release(index);
    return held;
}

void MaterialTable::write(std::array<haptics::TouchMaterial, haptics::kMostMaterials>& materials) const {
    for (std::uint32_t i = reserved_; i < kMaxEntries; ++i)
        if (entries_[i].holders > 0) materials[i] = touch_material(entries_[i].material);
}

}  // namespace burin::scene
