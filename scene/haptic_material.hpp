// SPDX-License-Identifier: MIT
// How an object feels, and the table in which the surfaces of a scene look that up.
//
// A surface refers to its material by an index into TickParameters::materials (haptics/forces/touch_force.hpp). One
// MaterialTable serves all parts of a scene, so that their indices agree: each object holds one entry, objects that
// feel alike share it, and an entry keeps its index for as long as anybody holds it. So a change of one object's
// material does not change what another's index means while surface and parameters are on their way to the tick
// separately. Threads: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "haptics/forces/touch_material.hpp"

namespace burin::scene {

// As felt at the device, whatever the scale of the scene. The device's own limits are applied by the tick.
struct HapticMaterial {
    double stiffness_N_per_m = 600.0;  // above 0, at most kMaxStiffness_N_per_m
    double damping_Ns_per_m = 0.5;     // at most kMaxDamping_Ns_per_m
    // Coulomb friction: 0 <= dynamic_friction <= static_friction <= kMaxFriction.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
    // Above 0, at most kMaxCoulombVelocity_m_per_s: nothing sticks, whatever static_friction is; friction grows with
    // the speed of sliding at the device up to this speed and is dynamic_friction beyond it.
    double coulomb_velocity_m_per_s = 0.0;

    bool operator==(const HapticMaterial&) const = default;
};

// Far above what any force-feedback device renders: a larger number is a mistake in the unit.
inline constexpr double kMaxStiffness_N_per_m = 1e5, kMaxDamping_Ns_per_m = 1e3, kMaxFriction = 10.0,
                        kMaxCoulombVelocity_m_per_s = 1.0;

// What is wrong with one value of a material, an object or a file.
struct Problem {
    std::string key;   // the value's name in a world file
    std::string what;  // continues the key: "is below 0"
    std::string remedy;
};
// Returns all that is wrong with the material; nothing where it can be felt.
[[nodiscard]] std::vector<Problem> problems(const HapticMaterial& material);

[[nodiscard]] haptics::TouchMaterial touch_material(const HapticMaterial& material) noexcept;

class MaterialTable {
public:
    static constexpr std::uint32_t kMaxEntries = haptics::kMostMaterials;

    // The first `reserved` entries are left to others, such as the material of a carved workpiece; at most kMaxEntries.
    explicit MaterialTable(std::uint32_t reserved = 0);

    // Returns the index of the entry for this material, which it makes or shares, and holds it once more. Fails when
    // all entries hold other materials.
    [[nodiscard]] Result<std::uint8_t> hold(const HapticMaterial& material);
    // Lets go of an entry once. It must be held.
    void release(std::uint8_t index);
    // Lets go of an entry and holds the one for another material. The index stays where nobody else holds the entry and
    // no other entry holds the material. Fails, and changes nothing, where hold() would.
    [[nodiscard]] Result<std::uint8_t> change(std::uint8_t index, const HapticMaterial& material);

    // Writes the held entries into a tick's parameters; the others stay as they are.
    void write(std::array<haptics::TouchMaterial, haptics::kMostMaterials>& materials) const;
    // Counts the changes of entries: whoever publishes parameters does so anew when it has grown.
    [[nodiscard]] std::uint64_t version() const { return version_; }

private:
    struct Entry {
        HapticMaterial material;
        std::uint32_t holders = 0;
    };
    std::array<Entry, kMaxEntries> entries_{};
    std::uint32_t reserved_;
    std::uint64_t version_ = 0;
};

}  // namespace burin::scene
